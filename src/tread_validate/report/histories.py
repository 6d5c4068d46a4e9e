"""The histories that the report draws: found and checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ..compare.rig_peaks import RigPeak
from ..history import History
from .tables import Tables

SAMPLES = 240  # of one history, in a study of usual size
BUDGET = 90_000  # samples of all histories together, so that a page of a thousand cases can still be mailed
FEWEST = 60


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
