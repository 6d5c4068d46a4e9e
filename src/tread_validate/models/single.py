"""One case by a model of the user's own, without leaving files."""

from __future__ import annotations

import tempfile
from pathlib import Path

from ..errors import EngineError
from ..history import History
from ..study import Case, LoadedStudy
from .run import run_model


def history_of(study: LoadedStudy, name: str, case: Case, *, trusted: bool = False) -> History:
    """Run one model of the study on one case (creep ratio resolved), which need not be one of the study's.

    Raises
    ------
    InputError
        For a model that the study does not name, or that nobody has trusted.
    EngineError
        Where the model gives no history of the case; the message says why.
    """
    with tempfile.TemporaryDirectory(prefix="tread-validate-") as folder:
        (outcome,) = run_model(study, name, (case,), Path(folder), trusted=trusted)
        if outcome.status == "failed":
            raise EngineError(f"model {name}, case {case.case_id}: {outcome.message}")
        return History.read_csv(Path(folder) / f"{case.case_id}.csv")
