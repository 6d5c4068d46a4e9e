"""Force histories at the resolution at which they are drawn: thinned, and packed as small whole numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..history import History
from ..units import IN_MS, KILO, US

TIME_SCALE = US  # s: packed times are whole microseconds
FORCE_STEPS = 20_000  # packed forces are whole steps of their largest value over this

Packed = Mapping[str, Any]


def thin(history: History, samples: int) -> NDArray[np.int64]:
    """Return the indices to keep: evenly spread ones, and the extremes, so that a peak read off is the table's peak."""
    n = history.time.size
    if n <= samples:
        return np.arange(n)
    even = np.rint(np.linspace(0, n - 1, samples)).astype(np.int64)
    extremes = [history.normal_force.argmax()]
    if history.gives_tangential:
        extremes += [history.tangential_force.argmax(), history.tangential_force.argmin()]
    return np.unique(np.concatenate([even, np.array(extremes, dtype=np.int64)]))


def pack(history: History, samples: int) -> dict[str, Any]:
    """Return a thinned history as whole numbers, each series as its differences from sample to sample.

    ``t`` in µs, ``n`` (normal) and ``q`` (longitudinal force) in multiples of ``ns`` and ``qs`` newtons, ``s`` (sliding
    area fraction) in thousandths; ``q`` and ``s`` are null where the source does not give them. ``ts`` turns µs to ms.
    """
    keep = thin(history, samples)
    normal_scale, normal = _whole(history.normal_force[keep])
    tangential_scale, tangential = _whole(history.tangential_force[keep]) if history.gives_tangential else (1.0, None)
    return {
        "ts": TIME_SCALE * IN_MS,
        "t": _differences(history.time[keep] / TIME_SCALE),
        "ns": normal_scale,
        "n": normal,
        "qs": tangential_scale,
        "q": tangential,
        "s": _differences(history.slipping_fraction[keep] * KILO) if history.gives_slip else None,
    }


def unpack(packed: Packed, series: str) -> NDArray[np.float64]:
    """Return one series of a packed history: ``t`` in ms, ``n`` and ``q`` in N; nothing of one that is not given."""
    scale = {"t": "ts", "n": "ns", "q": "qs"}[series]
    steps = packed[series]
    return np.empty(0) if steps is None else np.cumsum(np.asarray(steps, dtype=np.float64)) * float(packed[scale])


def _whole(forces: NDArray[np.float64]) -> tuple[float, list[int]]:
    """Return a scale in N and the forces' differences as whole multiples of it."""
    scale = float(f"{np.abs(forces).max() / FORCE_STEPS or 1.0:.4g}")
    return scale, _differences(forces / scale)


def _differences(values: NDArray[np.float64]) -> list[int]:
    found: list[int] = np.diff(np.rint(values).astype(int), prepend=0).tolist()
    return found
