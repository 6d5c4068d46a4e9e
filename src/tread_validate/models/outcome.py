"""What came of one model on one case: ran or failed, why, and at what cost."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, NonNegativeFloat

from ..files import write_text
from ..model_file import read_model


class RunOutcome(BaseModel):
    """One case by one model, as it is filed beside the history.

    Attributes
    ----------
    status : str
        ``ran`` or ``failed``.
    message : str
        Why it failed, in one line: the fault of its history, or the last line of its log; empty where it ran.
    cpu_s, memory_MB : float or None
        Processor time and largest resident memory of the run; None where they were not measured (histories made
        elsewhere).
    shared_run : bool
        Whether the cost is an equal share of one run of all cases (and the memory that run's).
    case_digest, code_digest : str
        What it was run for, and with what.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    model: str
    case_id: str
    status: Literal["ran", "failed"]
    message: str = ""
    cpu_s: NonNegativeFloat | None = None
    memory_MB: NonNegativeFloat | None = None
    shared_run: bool = False
    case_digest: str
    code_digest: str


def write_outcome(path: Path | str, outcome: RunOutcome) -> None:
    """Write an outcome as JSON, atomically."""
    write_text(path, outcome.model_dump_json(indent=2) + "\n")


def read_outcome(path: Path | str) -> RunOutcome:
    """Read an outcome; raises `InputError` for what is none."""
    return read_model(path, RunOutcome)  # JSON is YAML
