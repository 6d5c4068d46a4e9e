"""Digits that do not hang on the machine: the exact functions and the exact minimum behind every fit."""

from __future__ import annotations

import os
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.material.exact import geometric, least_squares, power, power_of_ten, quarter_turn_part

FIT = """
import hashlib
from tread_validate.material import fit_surrogate
from tread_validate.study import FractionalZener
law = FractionalZener(kind="fractional_zener", origin="synthetic", source="a law", long_term_modulus_MPa=10.2,
    modulus_rise_MPa=77.0, corner_frequency_rad_s=1e5, exponent=0.25)
series = fit_surrogate(law).series
print(hashlib.sha256(series.moduli.tobytes() + series.relaxation_times.tobytes()).hexdigest())
"""


def test_powers_are_correctly_rounded() -> None:
    """Squares of integers, square roots and powers of ten have known doubles: equal to the last bit."""
    whole = np.arange(1.0, 200.0)
    np.testing.assert_array_equal(power(whole, 2.0), whole**2)
    np.testing.assert_array_equal(power(whole, 0.5), np.sqrt(whole))
    np.testing.assert_array_equal(power_of_ten(np.arange(-20.0, 20.0)), [float(f"1e{k}") for k in range(-20, 20)])
    np.testing.assert_array_equal(geometric(1e-3, 1e3, 7), [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3])


def test_angles_of_a_known_sine_are_exact() -> None:
    """A third of a right angle has sine 1/2, two thirds cosine 1/2, a half sqrt(1/2): within one unit of rounding."""
    assert quarter_turn_part(1.0) == (pytest.approx(0.0, abs=1e-38), 1.0)
    assert quarter_turn_part(0.0) == (1.0, 0.0)
    assert quarter_turn_part(0.5) == (0.5**0.5, 0.5**0.5)
    assert quarter_turn_part(1.0 / 3.0)[1] == pytest.approx(0.5, rel=3e-16)


@given(seed=st.integers(0, 10_000), n=st.integers(1, 7))
@settings(max_examples=30, deadline=None)
def test_minimum_does_not_depend_on_where_the_search_starts(seed: int, n: int) -> None:
    """A strictly convex problem has one minimum; every start ends there, bit for bit."""
    random = np.random.default_rng(seed)
    matrix, target = random.normal(size=(n + 4, n)), random.normal(size=n + 4)
    answers = [least_squares(matrix, target, random.random(n) < share) for share in (0.0, 0.5, 1.0)]
    np.testing.assert_array_equal(answers[0], answers[1])
    np.testing.assert_array_equal(answers[0], answers[2])
    residual = matrix.T @ (target - matrix @ answers[0])
    assert np.all(answers[0] >= 0)
    assert np.all(residual < 1e-9)
    assert np.all(np.abs(residual[answers[0] > 0]) < 1e-9)


def test_ill_conditioned_system_is_solved_to_the_last_bit() -> None:
    """Hilbert matrix of order 12 (condition 1e16): the solution of the rounded matrix by fractions, bit for bit."""
    n = 12
    matrix = np.array([[1.0 / (i + j + 1) for j in range(n)] for i in range(n)])
    target = matrix @ np.arange(1.0, n + 1)
    rows = [[Fraction(a) for a in row] + [Fraction(b)] for row, b in zip(matrix.tolist(), target.tolist(), strict=True)]
    for i in range(n):
        for k in range(i + 1, n):
            ratio = rows[k][i] / rows[i][i]
            rows[k] = [a - ratio * b for a, b in zip(rows[k], rows[i], strict=True)]
    exact = [Fraction(0)] * n
    for i in reversed(range(n)):
        exact[i] = (rows[i][n] - sum(rows[i][j] * exact[j] for j in range(i + 1, n))) / rows[i][i]
    assert min(exact) > 0
    np.testing.assert_array_equal(least_squares(matrix, target, np.ones(n, bool)), [float(x) for x in exact])


def test_columns_that_depend_on_each_other_are_refused() -> None:
    """Twice the same column has no unique solution."""
    with pytest.raises(InputError, match="depend on each other"):
        least_squares(np.ones((3, 2)), np.ones(3), np.ones(2, bool))


def test_fit_is_the_same_under_every_linear_algebra_kernel() -> None:
    """OpenBLAS kernels sum in other orders; moduli and relaxation times of the surrogate are equal bit for bit."""
    digests = set()
    for kernel in ("Haswell", "SkylakeX"):
        bare = {name: os.environ[name] for name in ("HOME", "PATH") if name in os.environ}
        bare |= {"OPENBLAS_CORETYPE": kernel} if kernel else {}
        done = subprocess.run([sys.executable, "-c", FIT], env=bare, capture_output=True, text=True, check=True)
        digests.add(done.stdout)
    assert len(digests) == 1
