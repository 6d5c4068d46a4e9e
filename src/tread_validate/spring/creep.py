"""The creep ratio of free rolling: the root of the net tangential impulse (section 4.3 of the paper)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache

from ..errors import InputError
from ..study import Case
from .variants import Pass, pass_of

BRACKET = (-0.2, 0.2)
"""Creep ratios between which a root is looked for."""
FIRST_TRIAL = 2e-3
"""Second creep ratio tried; then the step doubles."""
BEYOND = 1.1
"""Part of the way to the secant's root that a step goes."""
TOLERANCE = 2e-8
CLOSING = 0.1
"""Step over the one before it that shows that the trials close in."""
MOST_TRIALS = 6
"""Trials by interpolation before Brent's method takes over."""
DIGITS = 5
"""Decimal places of a creep ratio that decks and spring runs share."""


def free_rolling_creep(case: Case, variant: str = "paper", bracket: tuple[float, float] = BRACKET) -> float:
    """Return the creep ratio at which the net tangential impulse of a pass vanishes.

    Raises `InputError` where the impulse does not change sign within the bracket.
    """
    return root_of(pass_of(case, variant), case.case_id, bracket)


def root_of(block_pass: Pass, case_id: str, bracket: tuple[float, float] = BRACKET) -> float:
    """Return the root for a pass that is ready to run, as sharp as the pass (`creep_tolerance`, 2e-8 without).

    The impulse of a face that mostly sticks is nearly linear: steps from 0 double, or end a little beyond the
    secant's root where that is nearer, until the sign changes or the secant's root is as near as the tolerance.
    Within a bracket: inverse interpolation through the last three trials, and Brent's method where that fails.
    """
    impulse = cache(block_pass.net_shear_impulse)
    low, high = bracket
    start = min(max(0.0, low), high)
    at_start = impulse(start)
    if at_start == 0.0:
        return start
    # a faster road drags the block along: the impulse along lambda grows with the creep ratio
    way = 1.0 if at_start < 0.0 else -1.0
    trials, step = [(start, at_start)], FIRST_TRIAL
    tolerance = getattr(block_pass, "creep_tolerance", TOLERANCE)
    while True:
        near, at_near = trials[-1]
        far = min(max(near + way * step, low), high)
        at_far = impulse(far)
        trials.append((far, at_far))
        if at_far * at_start <= 0.0:
            return _within(impulse, trials, tolerance)
        if far in (low, high):
            raise InputError(
                f"case {case_id}: creep_percent",
                f"no creep ratio between {low:g} and {high:g} without net tangential impulse",
                "a case that can roll freely, or a creep ratio in its place",
            )
        fall = abs(at_near) - abs(at_far)
        secant = BEYOND * abs(at_far) / fall * step if fall > 0.0 else 2.0 * step
        step = min(2.0 * step, max(secant, 0.1 * step))


def _within(impulse: Callable[[float], float], trials: list[tuple[float, float]], tolerance: float) -> float:
    """Return the root between the last two of the trials, whose impulses differ in sign.

    Where trials close in, the one whose next would be nearer than the tolerance is the last: that next one is the root.
    """
    from scipy.optimize import brentq

    (a, at_a), (b, at_b) = trials[-2:]
    for _ in range(MOST_TRIALS):
        if at_b == 0.0:
            return b
        root = _interpolated(trials[-3:])
        if not min(a, b) < root < max(a, b):
            root = (a * at_b - b * at_a) / (at_b - at_a)
        (before, _), (last, _) = trials[-2:]
        if len(trials) > 2 and abs(root - last) <= min(tolerance, CLOSING * abs(last - before)):
            return root
        at_root = impulse(root)
        trials.append((root, at_root))
        if at_root * at_b <= 0.0:
            a, at_a = b, at_b
        b, at_b = root, at_root
    return float(brentq(impulse, a, b, xtol=tolerance, rtol=1e-10))


def _interpolated(trials: list[tuple[float, float]]) -> float:
    """Return the creep ratio at impulse 0 of the polynomial through the trials (Lagrange); nan where two are alike."""
    if len({impulse for _, impulse in trials}) < len(trials):
        return float("nan")
    root = 0.0
    for creep, impulse in trials:
        weight = 1.0
        for _, other in trials:
            if other != impulse:
                weight *= other / (other - impulse)
        root += weight * creep
    return root


def resolve_creep(cases: Iterable[Case], variant: str = "paper") -> tuple[Case, ...]:
    """Return the cases with every creep ratio known; a free-rolling one is rounded to 1e-5.

    Cases that differ in nothing but their name share one search. Decks and spring runs use the rounded value alike.
    """
    known: dict[str, float] = {}
    resolved = []
    for case in cases:
        if case.creep_ratio is None:
            digest = case.digest("spring")
            if digest not in known:
                known[digest] = round(free_rolling_creep(case, variant), DIGITS) + 0.0
            case = case.with_creep(known[digest])
        resolved.append(case)
    return tuple(resolved)
