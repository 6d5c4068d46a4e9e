"""The creep ratio of free rolling: the root of the net tangential impulse (section 4.3 of the paper)."""

from __future__ import annotations

from collections.abc import Iterable
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
DIGITS = 5
"""Decimal places of a creep ratio that decks and spring runs share."""


def free_rolling_creep(case: Case, variant: str = "paper", bracket: tuple[float, float] = BRACKET) -> float:
    """Return the creep ratio at which the net tangential impulse of a pass vanishes.

    Raises `InputError` where the impulse does not change sign within the bracket.
    """
    return root_of(pass_of(case, variant), case.case_id, bracket)


def root_of(block_pass: Pass, case_id: str, bracket: tuple[float, float] = BRACKET) -> float:
    """Return the root for a pass that is ready to run: bracketing by growing steps from 0, then Brent's method.

    Steps double, or end a little beyond the secant's root where that is nearer: the impulse of a face that mostly
    sticks is nearly linear. The root is as sharp as the pass (`creep_tolerance`, 2e-8 without).
    """
    from scipy.optimize import brentq

    impulse = cache(block_pass.net_shear_impulse)
    low, high = bracket
    start = min(max(0.0, low), high)
    at_start = impulse(start)
    if at_start == 0.0:
        return start
    # a faster road drags the block along: the impulse along lambda grows with the creep ratio
    way = 1.0 if at_start < 0.0 else -1.0
    near, step = start, FIRST_TRIAL
    at_near = at_start
    tolerance = getattr(block_pass, "creep_tolerance", TOLERANCE)
    while True:
        far = min(max(near + way * step, low), high)
        at_far = impulse(far)
        if at_far * at_start <= 0.0:
            return float(brentq(impulse, near, far, xtol=tolerance, rtol=1e-10))
        if far in (low, high):
            raise InputError(
                f"case {case_id}: creep_percent",
                f"no creep ratio between {low:g} and {high:g} without net tangential impulse",
                "a case that can roll freely, or a creep ratio in its place",
            )
        fall = abs(at_near) - abs(at_far)
        secant = BEYOND * abs(at_far) / fall * step if fall > 0.0 else 2.0 * step
        near, at_near, step = far, at_far, min(2.0 * step, max(secant, 0.1 * step))


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
