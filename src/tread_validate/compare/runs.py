"""The runs of a study as they lie in the results and reference folders, each with its state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError, one_line
from ..files import read_text
from ..history import History
from ..provenance import deck_digest
from ..reference import load_fe
from ..study import Case
from .quantities import Scalars, scalars


@dataclass(frozen=True)
class SourceRun:
    """One case by one source.

    Attributes
    ----------
    status : str
        ``current``, ``missing``, ``stale``, ``corrupt`` or ``no_contact``; only a current run has a history that
        may be compared.
    note : str
        Why it is not current.
    history, scalars : or None
        Only where current.
    uncertainty : float, mapping or None
        Relative, of the forces; None where not known.
    digest : str
        SHA-256 of the history file, empty where there is none.
    """

    source: str
    case_id: str
    status: str
    note: str = ""
    history: History | None = None
    scalars: Scalars | None = None
    uncertainty: float | Mapping[str, float] | None = None
    digest: str = ""


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
    runs: dict[tuple[str, str], SourceRun] = {}
    for case in cases:
        reference = load_fe(reference_dir, engine, case.case_id, today_digest(decks_dir, case.case_id))
        run = SourceRun(source, case.case_id, reference.status, reference.reason, digest=reference.digest)
        if reference.status == "current" and reference.history is not None:
            run = _with_scalars(source, case.case_id, reference.history, reference.digest, reference.uncertainty())
        runs[source, case.case_id] = run
    return runs


def today_digest(decks_dir: Path, case_id: str) -> str | None:
    """Return the digest of a case's deck and friction routine as they lie in the deck folder, None without them."""
    deck = decks_dir / case_id / f"{case_id}.inp"
    user = decks_dir / case_id / "vfric.f"
    if not deck.is_file():
        return None
    return deck_digest(read_text(deck), read_text(user) if user.is_file() else None)


def engines(reference_dir: Path, first: str) -> tuple[str, ...]:
    """Return the engines to report: the study's own, then every other one with a run in the store."""
    store = reference_dir / "fe"
    others = sorted(
        folder.name
        for folder in (store.iterdir() if store.is_dir() else ())
        if folder.is_dir() and folder.name != first and any(folder.glob("*.csv"))
    )
    return (first, *others)


def _spring_run(source: str, case: Case, path: Path) -> SourceRun:
    if not path.is_file():
        return SourceRun(source, case.case_id, "missing", "no run of this variant")
    try:
        history = History.read_csv(path)
    except InputError as error:
        return SourceRun(source, case.case_id, "corrupt", one_line(f"{path.name}: {error.found}"))
    digest = history.digest()
    made_from = history.provenance.get("case_digest")
    today = case.digest("spring")
    if made_from is not None and made_from != today:
        note = f"made from other inputs ({made_from[:12]}, today {today[:12]})"
        return SourceRun(source, case.case_id, "stale", note, digest=digest)
    return _with_scalars(source, case.case_id, history, digest, None)


def _with_scalars(
    source: str, case_id: str, history: History, digest: str, uncertainty: float | Mapping[str, float] | None
) -> SourceRun:
    try:
        values = scalars(history)
    except InputError as error:
        return SourceRun(source, case_id, "no_contact", one_line(str(error)), digest=digest)
    return SourceRun(source, case_id, "current", "", history, values, uncertainty, digest)
