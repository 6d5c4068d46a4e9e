"""The runs of a study as they lie in the results and reference folders, each with its state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import InputError, one_line
from ..history import CHECKSUM, History
from ..inp import deck_files
from ..reference import FeStore
from ..spring.variants import code_digest
from ..study import Case
from .quantities import Scalars, Statistics, scalars, statistics
from .scores.uncertainty import Uncertainty, from_mesh_error

MEND = "(mend: delete it, then make check)"


@dataclass(frozen=True)
class SourceRun:
    """One case by one source.

    Attributes
    ----------
    status : str
        ``current``; ``other_code``: a reference made before its engine's code changed, compared and marked; ``stale``,
        ``not_a_reference`` (its own record says that its energies or its forces cannot be believed),
        ``unbound`` (made nobody knows from what), ``missing``, ``failed`` (the model gave no history), ``corrupt`` or
        ``no_contact``: never compared.
    note : str
        Why it is not current.
    history, scalars : or None
        Only where current or of other code.
    uncertainty : float, mapping or None
        Relative standard uncertainty of the forces, of a run as a reference; None where not known.
    numerical : float, mapping or None
        That of the forces from mesh and step, of a run as a prediction; 0 where it counts as part of the model.
    statistics : or None
        Means and scatter, of a run that is no reference too; None where there is no history with T.
    digest : str
        SHA-256 of the history file, empty where there is none.
    folder : str
        Where a reference lies, relative to the reference folder; empty for other runs.
    """

    source: str
    case_id: str
    status: str
    note: str = ""
    history: History | None = None
    scalars: Scalars | None = None
    uncertainty: Uncertainty = None
    digest: str = ""
    folder: str = ""
    numerical: Uncertainty = 0.0
    statistics: Statistics | None = None


Runs = Mapping[tuple[str, str], SourceRun]


def spring_runs(cases: Sequence[Case], spring_dir: Path, variants: Sequence[str]) -> dict[tuple[str, str], SourceRun]:
    """Read every spring run; one that was made from other inputs than today's case is stale."""
    runs: dict[tuple[str, str], SourceRun] = {}
    for variant in variants:
        source = f"spring:{variant}"
        for case in cases:
            path = spring_dir / variant / f"{case.case_id}.csv"
            runs[source, case.case_id] = _spring_run(source, case, path)
    return runs


def fe_runs(
    cases: Sequence[Case], reference_dir: Path, engine: str, decks_dir: Path
) -> dict[tuple[str, str], SourceRun]:
    """Read every reference run of an engine and hold it against the deck of today."""
    source = f"fe:{engine}"
    store = FeStore(reference_dir)
    runs: dict[tuple[str, str], SourceRun] = {}
    for case in cases:
        found = store.find(engine, case.case_id, deck_files(decks_dir, case.case_id))
        folder = "" if found.folder is None else found.folder.relative_to(reference_dir).as_posix()
        run = SourceRun(source, case.case_id, found.status, found.reason, digest=found.digest, folder=folder)
        fault = found.fault()
        if fault:
            run = replace(run, status="not_a_reference", note=fault, statistics=_statistics(found.history))
        elif found.history is not None:
            stated = found.stated_error()
            error = store.mesh_errors.error(case, engine) if stated is None else stated
            run = with_scalars(run, found.history, from_mesh_error(error))
        runs[source, case.case_id] = run
    return runs


def engines(reference_dir: Path, first: str) -> tuple[str, ...]:
    """Return the engines to report: the study's own, then every other one with a run in the store."""
    return (first, *(engine for engine in FeStore(reference_dir).engines() if engine != first))


def _spring_run(source: str, case: Case, path: Path) -> SourceRun:
    if not path.is_file():
        return SourceRun(source, case.case_id, "missing", "no run of this variant")
    try:
        history = History.read_csv(path)
    except InputError as error:
        return SourceRun(source, case.case_id, "corrupt", one_line(f"{path.name}: {error.found} {MEND}"))
    digest = history.digest()
    status, note = _binding(history, digest, case, source.partition(":")[2])
    run = SourceRun(source, case.case_id, status, note, digest=digest)
    return run if status != "current" else with_scalars(run, history, None)


def _binding(history: History, digest: str, case: Case, variant: str) -> tuple[str, str]:
    """Return whether a history is of today's case and code, and as it was written: a status, and why it is not."""
    today = {"case_digest": case.digest("spring"), "code": code_digest(variant)}
    for key, what in (("case_digest", "inputs"), ("code", "code")):
        found = history.provenance.get(key)
        if found is None:
            return "unbound", f"no {key} in its header: nobody knows what it was made from"
        if found != today[key]:
            return "stale", f"made from other {what} ({found[:12]}, today {today[key][:12]})"
    return altered(history, digest)


def altered(history: History, digest: str) -> tuple[str, str]:
    """Return whether a history has the numbers that it was written with: a status, and why it is not current."""
    written = history.provenance.get(CHECKSUM)
    if written is None:
        return "unbound", f"no {CHECKSUM} in its header: nobody knows whether its numbers are those of the run"
    if written != digest:
        found = f"{CHECKSUM} {written[:12]}, now {digest[:12]}"
        return "corrupt", f"altered or cut off since it was written ({found}) {MEND}"
    return "current", ""


def with_scalars(run: SourceRun, history: History, uncertainty: Uncertainty) -> SourceRun:
    """Return the run with its history and what sums it up; one without contact has neither."""
    try:
        values = scalars(history)
    except InputError as error:
        return replace(run, status="no_contact", note=one_line(str(error)))
    means = _statistics(history)
    return replace(run, history=history, scalars=values, uncertainty=uncertainty, statistics=means)


def _statistics(history: History | None) -> Statistics | None:
    """Return means and scatter; None without contact or T."""
    if history is None or not history.gives_tangential:
        return None
    try:
        return statistics(history)
    except InputError:
        return None
