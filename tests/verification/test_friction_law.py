"""Friction laws and their fit against exact answers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.friction import FrictionData, FrictionLaw, fit_friction, kinetic_kernel, law, table_law
from tread_validate.friction.synthetic import synthetic_table
from tread_validate.friction.table_file import _levels
from tread_validate.study import load_study


@pytest.fixture(scope="module")
def huemer(paper_study) -> FrictionLaw:
    return law(load_study(paper_study).model.friction_laws["road"])


def data_of(columns: tuple[np.ndarray, np.ndarray, np.ndarray]) -> FrictionData:
    p, v, mu = columns
    pressures, i = _levels(p)
    speeds, j = _levels(v)
    return FrictionData(p, v, mu, i, j, pressures, speeds, "test")


def test_assumed_law_gives_one_at_its_peak_and_seven_tenths_at_ten_metres_a_second(huemer: FrictionLaw) -> None:
    """Stated with the constants: 1.0 at 0.4 MPa and 0.1 m/s (the peak over v), 0.70 at 10 m/s; printed digits."""
    assert huemer.kinetic(0.4e6, 0.1) == pytest.approx(1.0, abs=0.005)
    assert huemer.kinetic(0.4e6, 10.0) == pytest.approx(0.70, abs=0.005)
    speeds = np.geomspace(1e-3, 10, 4001)
    assert speeds[np.argmax(huemer.kinetic(0.4e6, speeds))] == pytest.approx(0.1, rel=0.05)


def test_law_equals_its_printed_form(huemer: FrictionLaw) -> None:
    """(alpha p^(n-1) + beta)/(a + b v^(-1/m) + c v^(-2/m)), written out again here; equal to rounding."""
    p, v = np.meshgrid(np.geomspace(2e4, 5e6, 9), np.geomspace(2e-3, 20, 9))
    printed = 0.8212 * (p * 1e-6) ** -0.1 / (3.729 - 4.495 * v**-0.1 + 1.785 * v**-0.2)
    np.testing.assert_allclose(huemer.kinetic(p, v), printed, rtol=1e-12)
    np.testing.assert_allclose(huemer.kinetic(p, -v), printed, rtol=1e-12)


def test_law_is_held_below_its_floors(huemer: FrictionLaw) -> None:
    """10 kPa and 1 mm/s: any less pressure or slip speed gives the value at the floor, exactly."""
    assert huemer.kinetic(0.0, 0.5) == huemer.kinetic(10e3, 0.5)
    assert huemer.kinetic(0.3e6, 0.0) == huemer.kinetic(0.3e6, 1e-3)
    assert huemer.kinetic(0.3e6, 0.9e-3) < huemer.kinetic(0.3e6, 1.1e-3)


def test_constants_of_a_clean_table_are_recovered(huemer: FrictionLaw) -> None:
    """120 exact values, beta held: the other six to 0.1 % after the scaling a + b + c = 1."""
    fit = fit_friction(data_of(synthetic_table(huemer, 0.0)), {"beta": 0.0})
    scale = 3.729 - 4.495 + 1.785
    exact = {"alpha": 0.8212 / scale, "n": 0.9, "m": 10.0, "a": 3.729 / scale, "b": -4.495 / scale, "c": 1.785 / scale}
    assert {name: fit.constants[name] for name in exact} == pytest.approx(exact, rel=1e-3)
    assert fit.rms < 1e-5
    assert not [text for text in fit.warnings if "determine" in text]


def test_intervals_hold_the_true_constants_nineteen_times_in_twenty(huemer: FrictionLaw) -> None:
    """95 % intervals of alpha and n over 40 noisy tables: 70 of 80 or more, which chance undercuts once in 1000."""
    inside = 0
    for seed in range(40):
        fit = fit_friction(data_of(synthetic_table(huemer, 0.02, seed)), {"beta": 0.0, "m": 10.0})
        for name, exact in (("alpha", 0.8212 / 1.019), ("n", 0.9)):
            low, high = fit.intervals[name]
            inside += low <= exact <= high
    assert inside >= 70


def test_table_of_one_decade_of_pressure_cannot_tell_beta_from_alpha(huemer: FrictionLaw) -> None:
    """p^-0.1 over a factor of 16 is nearly a constant plus a line: the fit says so and holds beta at 0."""
    fit = fit_friction(data_of(synthetic_table(huemer, 0.02)))
    assert fit.held["beta"] == 0.0
    assert "beta is held at 0" in fit.warnings[0]


def test_lack_of_fit_is_seen_when_the_law_is_the_wrong_one(huemer: FrictionLaw) -> None:
    """Friction that rises with pressure and peaks twice over speed: probability of chance below 0.1 %.

    The right law with the same noise keeps a probability above 5 %.
    """
    p, v, mu = synthetic_table(huemer, 0.01)
    right = fit_friction(data_of((p, v, mu)), {"beta": 0.0})
    wrong = fit_friction(data_of((p, v, mu * (1.0 + 0.1 * np.sin(4 * np.log(v))))), {"beta": 0.0})
    assert right.lack_of_fit is not None
    assert wrong.lack_of_fit is not None
    assert right.lack_of_fit > 0.05
    assert wrong.lack_of_fit < 1e-3


@given(
    seed=st.integers(0, 10_000),
    rows=st.integers(1, 6),
    columns=st.integers(1, 6),
    p=st.floats(0, 1e8),
    v=st.floats(0, 100),
)
@settings(max_examples=150, deadline=None)
def test_interpolated_table_never_overshoots(seed: int, rows: int, columns: int, p: float, v: float) -> None:
    """Anywhere, in the table or outside it, the value lies between the least and the largest entry (1e-12 rounding).

    Inside a cell it lies between the cell's four corners.
    """
    random = np.random.default_rng(seed)
    grid_p = np.cumsum(random.uniform(1e3, 1e6, rows))
    grid_v = np.cumsum(random.uniform(1e-3, 2.0, columns))
    table = random.uniform(0.1, 2.0, (rows, columns))
    value = float(table_law(grid_p, grid_v, table, 0.9).kinetic(p, v))
    i = slice(max(np.searchsorted(grid_p, p) - 1, 0), np.searchsorted(grid_p, p) + 1)
    j = slice(max(np.searchsorted(grid_v, v) - 1, 0), np.searchsorted(grid_v, v) + 1)
    corners = table[i, j] if table[i, j].size else table[-1:, -1:]
    assert corners.min() - 1e-12 <= value <= corners.max() + 1e-12


def test_table_returns_its_nodes_and_the_mean_half_way_in_the_logarithm() -> None:
    """Nodes exactly; at the geometric mean of two nodes the arithmetic mean of their values (linear in log v)."""
    built = table_law(np.array([1e5, 4e5]), np.array([0.01, 1.0]), np.array([[1.0, 2.0], [0.5, 0.9]]), 0.9)
    assert built.kinetic(1e5, 1.0) == 2.0
    assert built.kinetic(4e5, 0.01) == 0.5
    assert built.kinetic(1e5, 0.1) == pytest.approx(1.5, rel=1e-12)
    assert built.kinetic(2e5, 0.01) == pytest.approx(0.75, rel=1e-12)
    assert built.kinetic(9e9, 99.0) == 0.9


def test_kernel_and_law_are_one_function(huemer: FrictionLaw) -> None:
    """The scalar kernel that the spring solver calls and the array law agree to the last bit."""
    for p, v in ((0.0, 0.0), (3e5, 0.2), (2e6, -7.0)):
        assert kinetic_kernel(*huemer.kernel_arguments, p, v) == float(huemer.kinetic(p, v))
