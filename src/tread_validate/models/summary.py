"""One row a case: what a model did, and at what cost."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..history import History
from .outcome import RunOutcome

COLUMNS = (
    "case_id", "model", "status", "message", "peak_normal_force_N", "peak_tangential_force_N",
    "least_tangential_force_N", "cpu_s", "memory_MB",
)  # fmt: skip


def summary_csv(outcomes: Sequence[RunOutcome], folder: Path) -> str:
    """Return the summary of a folder of histories as CSV text; what is not known is left empty."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    for outcome in outcomes:
        row = {
            "case_id": outcome.case_id,
            "model": outcome.model,
            "status": outcome.status,
            "message": outcome.message,
            "cpu_s": "" if outcome.cpu_s is None else f"{outcome.cpu_s:.4g}",
            "memory_MB": "" if outcome.memory_MB is None else f"{outcome.memory_MB:.4g}",
        }
        if outcome.status == "ran":
            history = History.read_csv(folder / f"{outcome.case_id}.csv")
            row["peak_normal_force_N"] = f"{np.max(history.normal_force):.5f}"
            if history.gives_tangential:
                row["peak_tangential_force_N"] = f"{np.max(history.tangential_force):.5f}"
                row["least_tangential_force_N"] = f"{np.min(history.tangential_force):.5f}"
        writer.writerow(row)
    return text.getvalue()
