"""One row a case: what a table of spring runs says."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from ..errors import InputError
from ..history import History
from ..study import Case
from .block_pass import BlockPass
from .creep import root_of
from .variants import pass_of

COLUMNS = (
    "case_id", "variant", "creep_ratio", "free_rolling", "free_rolling_creep_ratio", "peak_normal_force_N",
    "peak_tangential_force_N", "least_tangential_force_N", "net_tangential_impulse_N_s", "contact_duration_s",
    "step_s", "samples", "assumed",
)  # fmt: skip


def summary_row(case: Case, history: History, variant: str) -> dict[str, str]:
    """Return one row of the summary.

    ``free_rolling_creep_ratio`` is the variant's own root, unrounded, whatever creep ratio the case ran at; empty
    where there is none, and for variants whose passes are too slow to search with.
    """
    block_pass = pass_of(case, variant)
    root = ""
    if isinstance(block_pass, BlockPass):
        with suppress(InputError):
            root = f"{root_of(block_pass, case.case_id):.8f}"
    touching = np.flatnonzero(history.normal_force > 0.0)
    return {
        "case_id": case.case_id,
        "variant": variant,
        "creep_ratio": f"{case.creep_ratio:.9g}",
        "free_rolling": str(case.free_rolling).lower(),
        "free_rolling_creep_ratio": root,
        "peak_normal_force_N": f"{np.max(history.normal_force):.5f}",
        "peak_tangential_force_N": f"{np.max(history.tangential_force):.5f}",
        "least_tangential_force_N": f"{np.min(history.tangential_force):.5f}",
        "net_tangential_impulse_N_s": f"{np.trapezoid(history.tangential_force, history.time):.8f}",
        "contact_duration_s": f"{history.time[touching[-1]]:.9f}" if touching.size else "0",
        "step_s": f"{history.time[1] - history.time[0]:.6e}",
        "samples": str(history.time.size),
        "assumed": "; ".join(case.assumed()),
    }


def summary_csv(rows: Sequence[dict[str, str]]) -> str:
    """Return the summary as CSV text."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
