"""Running a model of the user's own over the cases of a study."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from ..case_file.build import case_file
from ..case_file.document import CaseFile
from ..case_file.io import write_case
from ..errors import InputError
from ..history import History
from ..provenance import version
from ..study import Case, LoadedStudy, problems_digest
from ..study.own_model import CommandModel, HistoriesModel, OwnModel, PythonModel
from .checks import check_history
from .code import code_of
from .command_model import find_program, run_command, working_folder
from .outcome import RunOutcome, write_outcome
from .process import Finished
from .python_model import PythonRunner
from .trust import executes, require_trust

Progress = Callable[[Sequence[Case]], Iterator[Case]]


@dataclass(frozen=True)
class Job:
    """A model, the cases it is to run, and where its results go.

    Attributes
    ----------
    name : str
        The model's name in the study.
    documents : mapping of case id to CaseFile
    folder : Path
        For ``ID.csv`` (only of cases that ran), ``ID.json`` (`RunOutcome`) and logs.
    """

    name: str
    model: OwnModel
    root: Path
    cases: tuple[Case, ...]
    documents: Mapping[str, CaseFile]
    folder: Path
    code: str
    problems: str


def run_model(
    study: LoadedStudy,
    name: str,
    cases: Sequence[Case],
    folder: Path,
    *,
    trusted: bool = False,
    jobs: int = 1,
    progress: Progress = iter,
) -> tuple[RunOutcome, ...]:
    """Run one model of the study over `cases` (creep ratios resolved) and file histories and outcomes in `folder`.

    `jobs` cases run at a time where the model is a command that runs one. A case that fails loses nothing but itself:
    its outcome says why, and no history of it is left in the folder.

    Raises
    ------
    InputError
        For a model that the study does not name, one that nobody has trusted, a program or folder that is missing.
    """
    models = study.model.models
    if name not in models:
        raise InputError(f"{study.source}: models.{name}", "no such model", f"one of {', '.join(models) or 'none'}")
    model = models[name]
    if executes(model):
        require_trust(study, trusted)
    if isinstance(model, CommandModel):
        working_folder(model, study.root)
        find_program(model, study.root)
    documents = {case.case_id: case_file(case) for case in cases}
    folder.mkdir(parents=True, exist_ok=True)
    code = code_of(study, name)
    problems = problems_digest(study.cases())
    job = Job(name, model, study.root, tuple(cases), documents, folder, code, problems)
    with tempfile.TemporaryDirectory(prefix="tread-validate-") as temporary:
        scratch = Path(temporary)
        return tuple(_all(job, scratch, progress, jobs))


def _all(job: Job, scratch: Path, progress: Progress, jobs: int) -> Iterator[RunOutcome]:
    if isinstance(job.model, HistoriesModel):
        place = job.root / job.model.folder
        if not place.is_dir():
            raise InputError(f"models.{job.name}.folder", job.model.folder, f"a folder below {job.root.name}/")
        for case in progress(job.cases):
            yield _filed(job, case, place / f"{case.case_id}.csv", None)
        return
    files = scratch / "cases"
    for case_id, document in job.documents.items():
        write_case(files / f"{case_id}.json", document)
    made = scratch / "histories"
    made.mkdir()
    if isinstance(job.model, PythonModel):
        with PythonRunner(job.model, job.root, job.folder / "model.log") as runner:
            for case in progress(job.cases):
                target = made / f"{case.case_id}.csv"
                yield _filed(job, case, target, runner.run(files / f"{case.case_id}.json", target))
        return
    if job.model.runs_all:
        count = len(job.cases)
        done = run_command(job.model, job.root, {"cases": files, "folder": made}, job.folder / "model.log", count)
        share = Finished(done.fault, done.cpu_s / count, done.memory_MB)
        for case in progress(job.cases):
            target = made / f"{case.case_id}.csv"
            # a run for all that stopped half way has still computed the histories it has written
            yield _filed(job, case, target, share, shared=True)
        return
    command = job.model

    def one(case: Case) -> RunOutcome:
        target = made / f"{case.case_id}.csv"
        fill = {"case": files / f"{case.case_id}.json", "history": target}
        return _filed(job, case, target, run_command(command, job.root, fill, job.folder / f"{case.case_id}.log"))

    # threads only wait here: the work is in the processes that they start
    with ThreadPoolExecutor(jobs) as pool:
        running = [pool.submit(one, case) for case in job.cases]
        for _, future in zip(progress(job.cases), running, strict=True):
            yield future.result()


def _filed(job: Job, case: Case, made: Path, done: Finished | None, shared: bool = False) -> RunOutcome:
    """Check what a model left for a case, file it with what it is bound to, and return the outcome."""
    digest = case.problem_digest()
    target = job.folder / f"{case.case_id}.csv"
    target.unlink(missing_ok=True)
    fault = done.fault if done is not None and not (shared and made.is_file()) else ""
    if not fault:
        try:
            history = _checked(job, case, made, digest)
        except InputError as error:
            fault = str(error)
        else:
            _bind(history, job, case, digest).write_csv(target)
    outcome = RunOutcome(
        model=job.name,
        case_id=case.case_id,
        status="failed" if fault else "ran",
        message=fault,
        cpu_s=None if done is None else done.cpu_s,
        memory_MB=None if done is None else done.memory_MB,
        shared_run=shared,
        case_digest=digest,
        code_digest=job.code,
    )
    write_outcome(target.with_suffix(".json"), outcome)
    return outcome


def _checked(job: Job, case: Case, made: Path, digest: str) -> History:
    if not made.is_file():
        raise InputError(f"model {job.name}, case {case.case_id}", "no history", f"a file {made.name}")
    history = History.read_csv(made)
    where = made.name
    if isinstance(job.model, HistoriesModel) and "case_digest" not in history.provenance:
        _require_statement(job, job.model, where)
    check_history(
        history,
        where,
        case_id=case.case_id,
        case_digest=digest,
        duration=job.documents[case.case_id].expected_duration_s,
    )
    return history


def _require_statement(job: Job, model: HistoriesModel, where: str) -> None:
    """Raise `InputError` unless the study says what unbound histories were made for, and that is today's study."""
    if model.made_for is None:
        raise InputError(
            f"{where}: case_digest",
            "none, so nobody can tell which case it was computed for",
            f"a line '# case_digest: ...' in the file, or models.{job.name}.made_for and .statement in the study",
        )
    if model.made_for != job.problems:
        raise InputError(
            f"models.{job.name}.made_for",
            model.made_for[:12],
            f"{job.problems[:12]}: the study's inputs have changed since the histories were made",
        )


def _bind(history: History, job: Job, case: Case, digest: str) -> History:
    """Return the history with what it was made for and by."""
    return history.with_provenance(
        {
            **history.provenance,
            "case_id": case.case_id,
            "producer": f"model/{job.name}",
            "version": version(),
            "case_digest": digest,
            "code": job.code,
            "origin": job.model.origin,
            "creep_ratio": f"{case.creep_ratio:.9g}",
            "free_rolling": str(case.free_rolling).lower(),
            "assumed": "; ".join(case.assumed()) or "none",
        }
    ).with_checksum()
