"""The front door for notebooks and scripts: ``import tread_validate as tv``."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .history import History

if TYPE_CHECKING:
    import pandas as pd

    from .case_file.document import CaseFile
    from .compare.tables.errors import MetricRow
    from .study import Case, LoadedStudy

Function = Callable[["CaseFile"], Any]


def load_study(path: Path | str) -> LoadedStudy:
    """Read and validate a study file (YAML); nothing that it names is executed.

    Raises `InputError` with file, key, found and expected.

    >>> len(load_study("config/study.yaml").cases())
    52
    """
    from .study import load_study as load

    return load(path)


def run(case: Case, model: str | Function = "paper") -> History:
    """Run one case by a model and return the block's forces.

    Parameters
    ----------
    case : Case
        Of a study: ``study.case(case_id)``. A free-rolling one gets the creep ratio without net tangential impulse.
    model : str or function
        A built-in spring model by its name (``tread-validate spring STUDY --variant list``), or a function from a
        `CaseFile` to a `History` or to arrays of time (s), normal and, if known, tangential force (N).

    Raises
    ------
    InputError
        For an unknown model, a case that cannot run, or a result that cannot be a history of the case.

    >>> case = load_study("config/study.yaml").case("rig-rectangle-22c-0p2mm-300rpm")
    >>> round(float(run(case).normal_force.max()), 1)
    92.8
    """
    if isinstance(model, str):
        from .spring import resolve_creep
        from .spring import run as run_spring
        from .validity import with_expectation

        (case,) = resolve_creep([case])
        return with_expectation(run_spring(case, model), case, model)
    from .case_file.build import case_file
    from .models.checks import as_history, check_history
    from .spring import resolve_creep

    (case,) = resolve_creep([case])
    document = case_file(case)
    history = as_history(model(document))
    name = getattr(model, "__name__", "function")
    check_history(
        history,
        name,
        case_id=case.case_id,
        case_digest=document.case_digest,
        duration=document.expected_duration_s,
    )
    bound = {"case_id": case.case_id, "producer": name, "case_digest": document.case_digest}
    return history.with_provenance({**history.provenance, **bound})


def write_deck(case: Case, folder: Path | str) -> Path:
    """Write the ABAQUS/Explicit deck of a case and its friction routine into `folder`; returns the deck's path."""
    from . import deck
    from .spring import resolve_creep

    (case,) = resolve_creep([case])
    place = Path(folder)
    deck.write(case, place)
    return place / f"{case.case_id}.inp"


def run_fe(case_or_deck: Case | Path | str, *, threads: int = 1) -> History:
    """Run a case, or a deck with its ``vfric.f`` beside it, in the built-in explicit FE engine.

    Takes seconds on a 1 mm mesh; needs gfortran. Raises `InputError` for a deck outside the documented subset,
    `EngineError` where the run fails.
    """
    from .fe import run_deck

    if isinstance(case_or_deck, str | Path):
        deck = Path(case_or_deck)
        user = deck.with_name("vfric.f")
        return run_deck(deck, user if user.is_file() else None, threads=threads).history
    with tempfile.TemporaryDirectory(prefix="tread-validate-") as folder:
        return run_fe(write_deck(case_or_deck, folder), threads=threads)


@dataclass(frozen=True)
class Comparison:
    """The rows of a comparison of two histories: every scalar and every history score."""

    rows: tuple[MetricRow, ...]

    def to_frame(self) -> pd.DataFrame:
        """Return the rows as a data frame."""
        import pandas as pd

        return pd.DataFrame([asdict(row) for row in self.rows])

    def __repr__(self) -> str:
        """Show quantity, both values and the error, one row a line."""
        return "\n".join(f"{row.quantity:32} {row.metric:22} {_error(row)}" for row in self.rows)

    def _repr_html_(self) -> str:
        shown = ["quantity", "metric", "unit", "reference", "predicted", "error", "error_type", "assessment"]
        return str(self.to_frame()[shown].to_html(index=False, na_rep="not given"))


def _error(row: MetricRow) -> str:
    if row.error is None:
        return "not given"
    return f"{100.0 * row.error:+.2f} %" if row.error_type == "relative" else f"{row.error:+.4g} {row.unit}"


def compare(reference: History, predicted: History, *, uncertainty: float | None = None) -> Comparison:
    """Compare a predicted history with its reference.

    Parameters
    ----------
    uncertainty : float, optional
        Relative uncertainty of the reference's forces; without it no row says that the two agree.

    Raises
    ------
    InputError
        Where both say which case they are of, and it is not the same.

    >>> case = load_study("config/study.yaml").case("rig-rectangle-22c-0p2mm-300rpm")
    >>> compare(run(case), run(case)).rows[0].error
    0.0
    """
    from .compare import compare as compare_histories
    from .errors import InputError

    ids = [history.provenance.get("case_id", "") for history in (reference, predicted)]
    if all(ids) and ids[0] != ids[1]:
        raise InputError("compare: case_id", ids[1], f"{ids[0]}, the reference's case")
    return Comparison(
        tuple(
            compare_histories(
                reference,
                predicted,
                case_id=ids[0] or ids[1],
                reference_source=reference.provenance.get("producer", "reference"),
                predicted_source=predicted.provenance.get("producer", "predicted"),
                uncertainty=uncertainty,
            )
        )
    )


def report(
    study: LoadedStudy | Path | str,
    out: Path | str | None = None,
    *,
    root: Path | str = ".",
    references: Path | str | None = None,
) -> Path:
    """Compare the runs of a study as they lie in its workspace and write the report; returns the page.

    Nothing is run: a model or a reference without a run is said to be missing.

    Parameters
    ----------
    study : LoadedStudy or path
    out : path, optional
        Folder for ``index.html``, ``report.pdf``, ``tables/``, ``figures/``; ``reports/<study>`` below `root` if left
        out.
    root : path
        The folder that holds ``fe_inputs``, ``results`` and ``reports``.
    references : path, optional
        The reference data package; ``reference_data`` below `root` if left out.

    Raises
    ------
    InputError
        For a study or a reference package that cannot be read.
    """
    from .compare import build_tables
    from .report import build_report
    from .workspace import Workspace

    file = Path(study) if isinstance(study, str | Path) else study.source
    name = load_study(file).model.name
    place = Workspace(name, Path(root))
    data = Path(root) / "reference_data" if references is None else Path(references)
    target = place.reports if out is None else Path(out)
    build_tables(file, place.spring, data, place.tables, place.decks)
    build_report(file, place.tables, place.spring, data, place.decks, target, hierarchy_dir=data / "hierarchy" / name)
    return target / "index.html"
