"""Arithmetic whose digits do not hang on the machine: transcendental functions and least squares in decimal numbers.

A Prony fit amplifies the last bit of its input some 1e6-fold, and that bit differs between linear algebra kernels,
vector units and C libraries. What decides the digits of a deck is therefore worked out with integers and
`decimal`, which give the same answer everywhere, and rounded to a double once.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import Context, Decimal, localcontext
from operator import mul

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError

Array = NDArray[np.float64]

FUNCTION_DIGITS = 40
SOLVE_DIGITS = 120  # twice what the normal equations of 60 terms, the most allowed, lose
FIXED_POINT_BITS = 160
GRADIENT_ZERO = Decimal("1e-30")


def power(base: ArrayLike, exponent: float) -> Array:
    """Return `base` > 0 to the `exponent`, any shape, correctly rounded."""
    return _each(base, lambda value: value ** Decimal(exponent))


def power_of_ten(exponent: ArrayLike) -> Array:
    """Return 10 to the `exponent`, any shape, correctly rounded."""
    return _each(exponent, lambda value: Decimal(10) ** value)


def geometric(low: float, high: float, count: int) -> Array:
    """Return `count` >= 2 numbers from `low` to `high` (> 0), evenly spaced in logarithm, correctly rounded."""
    with localcontext(Context(prec=FUNCTION_DIGITS)):
        ratio = (Decimal(high) / Decimal(low)).ln() / (count - 1)
        inner = [float(Decimal(low) * (ratio * k).exp()) for k in range(1, count - 1)]
    return np.array([low, *inner, high], dtype=np.float64)


def quarter_turn_part(fraction: float) -> tuple[float, float]:
    """Return cosine and sine of `fraction` (0..1) of a right angle, correctly rounded."""
    with localcontext(Context(prec=FUNCTION_DIGITS)):
        angle = Decimal("1.5707963267948966192313216916397514420985846996876") * Decimal(fraction)
        cosine, sine, term = Decimal(1), Decimal(0), Decimal(1)
        for k in range(1, 60):
            term = term * angle / k
            sign = -1 if k % 4 in (2, 3) else 1
            if k % 2:
                sine += sign * term
            else:
                cosine += sign * term
        return float(cosine), float(sine)


def _each(values: ArrayLike, function: Callable[[Decimal], Decimal]) -> Array:
    array = np.asarray(values, dtype=np.float64)
    with localcontext(Context(prec=FUNCTION_DIGITS)):
        found = [float(function(Decimal(value))) for value in array.reshape(-1).tolist()]
    return np.array(found, dtype=np.float64).reshape(array.shape)


def least_squares(matrix: Array, target: Array, start: NDArray[np.bool_]) -> Array:
    """Return x >= 0, (n,), that minimises |matrix x - target|, correctly rounded; `start` guesses where x > 0.

    The active-set method of Lawson and Hanson (Solving Least Squares Problems, 1974, chapter 23) on normal equations
    formed without rounding from columns in fixed point (160 bits) and solved with 120 decimal digits: the minimum
    of a full-rank system is unique, so neither `start` nor the machine shows in the answer.

    Raises `InputError` where columns depend on each other.
    """
    exponents = [int(np.frexp(np.max(np.abs(column)))[1]) for column in matrix.T]
    columns = [_fixed_point(column, exponent) for column, exponent in zip(matrix.T, exponents, strict=True)]
    right = _fixed_point(target, 0)
    with localcontext(Context(prec=SOLVE_DIGITS)):
        unit = Decimal(2) ** (-2 * FIXED_POINT_BITS)
        normal = [[Decimal(sum(map(mul, a, b))) * unit for b in columns[: i + 1]] for i, a in enumerate(columns)]
        moment = [Decimal(sum(map(mul, a, right))) * unit for a in columns]
        solution = _active_set(normal, moment, [bool(value) for value in start])
        return np.array([float(x / Decimal(2) ** e) for x, e in zip(solution, exponents, strict=True)])


def _fixed_point(column: Array, exponent: int) -> list[int]:
    """Return the numbers over 2^exponent in units of 2^-160; what is below that is cut off."""
    found = []
    for value in column.tolist():
        numerator, denominator = value.as_integer_ratio()
        shift = FIXED_POINT_BITS - exponent
        found.append((numerator << shift if shift >= 0 else numerator >> -shift) // denominator)
    return found


def _active_set(normal: list[list[Decimal]], moment: list[Decimal], start: list[bool]) -> list[Decimal]:
    n = len(moment)
    free = [k for k in range(n) if start[k]]
    x = [Decimal(int(k in free)) for k in range(n)]
    for _ in range(20 * n):
        trial = _solve(normal, moment, free)
        while any(value <= 0 for value in trial):
            step = min(x[k] / (x[k] - value) for k, value in zip(free, trial, strict=True) if value <= 0)
            bound = [k for k, value in zip(free, trial, strict=True) if value <= 0 and x[k] / (x[k] - value) == step]
            for k, value in zip(free, trial, strict=True):
                x[k] = Decimal(0) if k in bound else x[k] + step * (value - x[k])
            free = [k for k in free if k not in bound]
            trial = _solve(normal, moment, free)
        x = [Decimal(0)] * n
        for k, value in zip(free, trial, strict=True):
            x[k] = value
        slope = {k: moment[k] - sum(_at(normal, k, j) * x[j] for j in free) for k in range(n) if k not in free}
        steepest = max(slope, key=lambda k: slope[k] / normal[k][k].sqrt(), default=None)
        if steepest is None or slope[steepest] <= GRADIENT_ZERO * abs(moment[steepest]):
            return x
        free = sorted([*free, steepest])
    raise InputError("non-negative least squares", f"no end after {20 * n} changes of the active set", "a minimum")


def _at(normal: list[list[Decimal]], i: int, j: int) -> Decimal:
    return normal[i][j] if i >= j else normal[j][i]


def _solve(normal: list[list[Decimal]], moment: list[Decimal], free: list[int]) -> list[Decimal]:
    """Solve the rows and columns `free` of the normal equations by Cholesky factors."""
    factor: list[list[Decimal]] = []
    forward: list[Decimal] = []
    for i in free:
        row: list[Decimal] = []
        for j in range(len(factor)):
            partial = _at(normal, i, free[j]) - sum(map(mul, row, factor[j]))
            row.append(partial / factor[j][j])
        square = normal[i][i] - sum(map(mul, row, row))
        if not square > 0:
            raise InputError("least squares", "columns that depend on each other", "relaxation times that differ")
        row.append(square.sqrt())
        forward.append((moment[i] - sum(map(mul, row, forward))) / row[-1])
        factor.append(row)
    back = [Decimal(0)] * len(free)
    for i in reversed(range(len(free))):
        back[i] = (forward[i] - sum(factor[j][i] * back[j] for j in range(i + 1, len(free)))) / factor[i][i]
    return back
