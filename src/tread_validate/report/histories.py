"""The histories that the report draws: found, checked, thinned and packed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compare.rig_peaks import RigPeak
from ..history import History
from ..units import IN_MS
from .tables import Tables

SAMPLES = 240  # of one history, in a study of usual size
BUDGET = 90_000  # samples of all histories together, so that a page of a thousand cases can still be mailed
FEWEST = 60
TIME_SCALE = 1e-6  # s: packed times are whole microseconds
FORCE_STEPS = 20_000  # packed forces are whole steps of their largest value over this


@dataclass(frozen=True)
class HistoryStore:
    """Where the histories of one report lie."""

    spring: Path
    models: Path
    reference: Path
    rig: Mapping[str, RigPeak] = field(default_factory=dict)

    def load(self, source: str, case_id: str, folder: str = "") -> History | None:
        """Return one history, None where there is none; a rig's is the mean over its passes.

        `folder` is where a reference run lies, below the reference folder.
        """
        if source.startswith("rig:"):
            peak = self.rig.get(case_id)
            return peak.history if peak is not None and peak.source == source else None
        path = self.path(source, case_id, folder)
        return History.read_csv(path) if path.is_file() else None

    def path(self, source: str, case_id: str, folder: str) -> Path:
        """Return the file of one history; it need not exist."""
        kind, _, name = source.partition(":")
        if kind in ("spring", "model"):
            return (self.spring if kind == "spring" else self.models) / name / f"{case_id}.csv"
        return self.reference / folder / "history.csv"


def load_histories(tables: Tables, store: HistoryStore) -> dict[str, dict[str, History]]:
    """Return ``{case_id: {source: history}}`` of every history that the tables compare.

    A reference that is stale or corrupt is not drawn: its force belongs to another deck.
    """
    found: dict[str, dict[str, History]] = {}
    for row in tables.peaks:
        if row.status not in ("current", "other_code") or row.source.endswith(":published"):
            continue
        history = store.load(row.source, row.case_id, row.folder)
        if history is not None:
            found.setdefault(row.case_id, {})[row.source] = history
    return found


def samples_each(histories: int) -> int:
    """Return how many samples each of so many histories may have."""
    return max(FEWEST, min(SAMPLES, BUDGET // max(histories, 1)))


def pack(history: History, samples: int = SAMPLES) -> dict[str, Any]:
    """Return a history as small whole numbers: time steps in µs, forces in 1/20000 of their peak, slip in 1/1000."""
    keep = thin(history, samples)
    microseconds = np.rint(history.time[keep] / TIME_SCALE).astype(int)
    normal_scale, normal = _whole(history.normal_force[keep])
    tangential_scale, tangential = _whole(history.tangential_force[keep]) if history.gives_tangential else (1.0, None)
    return {
        "ts": TIME_SCALE * IN_MS,
        "t": np.diff(microseconds, prepend=0).tolist(),
        "ns": normal_scale,
        "n": normal,
        "qs": tangential_scale,
        "q": tangential,
        "s": np.rint(history.slipping_fraction[keep] * 1e3).astype(int).tolist() if history.gives_slip else None,
    }


def _whole(forces: NDArray[np.float64]) -> tuple[float, list[int]]:
    """Return a scale in N and the forces as whole multiples of it."""
    scale = float(f"{np.abs(forces).max() / FORCE_STEPS or 1.0:.4g}")
    return scale, np.rint(forces / scale).astype(int).tolist()


def thin(history: History, samples: int = SAMPLES) -> NDArray[np.int64]:
    """Return the indices to keep: evenly spread ones, and the extremes, so that a peak read off is the table's peak."""
    n = history.time.size
    if n <= samples:
        return np.arange(n)
    even = np.rint(np.linspace(0, n - 1, samples)).astype(np.int64)
    extremes = [history.normal_force.argmax()]
    if history.gives_tangential:
        extremes += [history.tangential_force.argmax(), history.tangential_force.argmin()]
    return np.unique(np.concatenate([even, np.array(extremes, dtype=np.int64)]))
