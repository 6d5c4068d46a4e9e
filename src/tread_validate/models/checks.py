"""Whether a history can be the one that was asked for: its length, its sign, its case."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import InputError, one_line
from ..history import History
from ..units import IN_MS

SHORTEST = 0.8
"""A record must last for this share of the geometric contact time: the rubber may let go before the road leaves it."""


def check_history(history: History, where: str, *, case_id: str, case_digest: str, duration: float) -> None:
    """Raise `InputError` where a model's history cannot be that of the case.

    Parameters
    ----------
    where : str
        File or model, for the message.
    duration : float, s
        Geometric contact time of the pass (``expected_duration_s`` of the case file).
    """
    carried = history.provenance.get("case_id")
    if carried not in (None, case_id):
        raise InputError(f"{where}: case_id", carried, f"{case_id}: the history of another case")
    digest = history.provenance.get("case_digest")
    if digest not in (None, case_digest):
        raise InputError(
            f"{where}: case_digest", str(digest)[:12], f"{case_digest[:12]}: the case has other inputs today"
        )
    largest, least = float(np.max(history.normal_force)), float(np.min(history.normal_force))
    if (largest <= 0.0 and least < 0.0) or -least > 2.0 * largest > 0.0:
        raise InputError(
            f"{where}: normal_force_N", f"{least:.4g} N at its largest magnitude", "compression to be positive"
        )
    if largest <= 0.0:
        raise InputError(f"{where}: normal_force_N", "no force at any time", "a block that touches the road")
    if history.time[-1] - history.time[0] < SHORTEST * duration:
        raise InputError(
            f"{where}: time_s",
            f"a record of {(history.time[-1] - history.time[0]) * IN_MS:.4g} ms",
            f"the whole pass, {duration * IN_MS:.4g} ms",
        )


def as_history(result: Any) -> History:
    """Turn what a model returned into a history: a `History`, or arrays of time, normal and, if known, tangential."""
    if isinstance(result, History):
        return result
    try:
        parts = tuple(result)
    except TypeError:
        parts = ()
    if len(parts) not in (2, 3, 4):
        raise InputError(
            "the function's result", type(result).__name__, "a History, or (time, normal force[, tangential force])"
        )
    try:
        arrays = [None if part is None else np.asarray(part, dtype=np.float64) for part in parts]
    except (TypeError, ValueError) as error:
        raise InputError("the function's result", one_line(str(error)), "arrays of numbers") from None
    if arrays[0] is None or arrays[1] is None:
        raise InputError("the function's result", "None", "arrays of time and normal force")
    return History.of(*arrays)  # type: ignore[arg-type]  # time and N are there, by the test above
