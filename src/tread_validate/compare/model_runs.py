"""The runs of the user's own models as they lie in the results folder, each with its state."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..errors import InputError, one_line
from ..history import History
from ..models.code import code_of
from ..models.outcome import RunOutcome, read_outcome
from ..study import Case, LoadedStudy
from .runs import SourceRun, altered, with_scalars


def model_source(name: str) -> str:
    """Return the source under which a model of the user's own stands in the tables."""
    return f"model:{name}"


def model_runs(
    study: LoadedStudy, cases: Sequence[Case], folder: Path, names: Sequence[str] | None = None
) -> dict[tuple[str, str], SourceRun]:
    """Read every run of every model that the study names, or of some; nothing of theirs is executed.

    Statuses are those of `SourceRun`, and ``failed``: the model ran on the case and gave no history of it.
    """
    runs: dict[tuple[str, str], SourceRun] = {}
    for name in study.model.models if names is None else names:
        source, code = model_source(name), code_of(study, name)
        for case in cases:
            runs[source, case.case_id] = _run(source, case, folder / name / case.case_id, code)
    return runs


def _run(source: str, case: Case, stem: Path, code: str) -> SourceRun:
    def bad(status: str, note: str) -> SourceRun:
        return SourceRun(source, case.case_id, status, one_line(note))

    file = stem.with_name(f"{stem.name}.json")
    if not file.is_file():
        return bad("missing", "no run of this model")
    try:
        outcome = read_outcome(file)
        stale = _stale(outcome, case, code)
        if stale:
            return bad("stale", stale)
        if outcome.status == "failed":
            return bad("failed", outcome.message)
        history = History.read_csv(file.with_suffix(".csv"))
    except InputError as error:
        return bad("corrupt", str(error))
    bound = (history.provenance.get("case_digest"), history.provenance.get("code"))
    if bound != (outcome.case_digest, outcome.code_digest):
        return bad("unbound", "its header does not say that it was made for this case by this model")
    digest = history.digest()
    status, note = altered(history, digest)
    if status != "current":
        return bad(status, note)
    return with_scalars(SourceRun(source, case.case_id, "current", digest=digest), history, None)


def _stale(outcome: RunOutcome, case: Case, code: str) -> str:
    today = case.problem_digest()
    if outcome.case_digest != today:
        return f"made from other inputs ({outcome.case_digest[:12]}, today {today[:12]})"
    if outcome.code_digest != code:
        return f"made by another state of the model ({outcome.code_digest[:12]}, today {code[:12]})"
    return ""
