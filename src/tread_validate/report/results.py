"""Tables of results: ensemble statistics, Table 1, differences of slopes, published claims."""

from __future__ import annotations

from ..compare.quantities import HEADLINE
from ..compare.tables import Ensemble
from . import wording
from .content import Cell, Column, Row, Table, Tone
from .marks import Marks
from .tables import Tables, pair_of


def value_cell(value: float | None, text: str, note: str = "", tone: Tone = "") -> Cell:
    """Return a numeric cell that sorts by its value."""
    return Cell(text, sort=value, note=note, tone=tone)


def assessment_cell(assessment: str, note: str = "", status: str = "current") -> Cell:
    """Return an assessment with its symbol and reason."""
    if status == "not_compared":
        return Cell("not compared", tone="mute", note=note)
    if status != "current":
        note = "; ".join(part for part in (wording.status(status), note) if part)
    return Cell(wording.assessment(assessment), tone=wording.TONES.get(assessment, "mute"), note=note)


def ensemble_table(tables: Tables, marks: Marks, *, headline: bool) -> Table:
    """Return the ensemble statistics: the headline quantities over all cases, or every row."""
    found = sorted(tables.ensemble, key=_order)
    if headline:
        wanted = {key: rank for rank, key in enumerate(HEADLINE)}
        found = [row for row in found if row.group == "all" and (row.quantity, row.metric) in wanted]
        found.sort(key=lambda row: (*_order(row), wanted[row.quantity, row.metric]))
        answered = {pair_of(row) for row in found if row.compared}
        # a comparison with nothing to compare with is one row, not eleven
        found = [row for row in found if pair_of(row) in answered or (row.quantity, row.metric) == HEADLINE[0]]
    rows = tuple(_ensemble_row(row, marks, headline, _sliding(tables, row)) for row in found)
    columns = [
        Column("Quantity", wide=True),
        Column("Cases compared", "of all", numeric=True),
        Column("Mean |error|", "or mean R", numeric=True),
        Column("Largest |error|", "or least R", numeric=True),
        Column("Bias δ", "predicted / reference", numeric=True),
        Column("Scatter σ", "of the model", numeric=True),
        Column("U", "mean", numeric=True),
        Column("Good enough", "cases; not; open", numeric=True),
        Column("Agrees", "|E| within U", numeric=True),
        Column("Area metric", "of mean reference", numeric=True),
    ]
    if not headline:
        columns.insert(1, Column("Cases"))
    title = "Models against their references, all cases" if headline else "Every ensemble statistic"
    caption = (
        "Bias and scatter over ln(predicted/reference), as in the FDS validation guide; δ = 1 is no bias. An ISO/TS "
        "18571 score is better the nearer it is to 1: > 0.94 excellent, > 0.80 good, > 0.58 fair."
    )
    return Table(
        "results" if headline else "ensemble",
        title,
        tuple(columns),
        rows,
        caption,
        with_marks=True,
        folded=not headline,
        empty="No comparison: no case has both a run of a model and a current reference.",
        help="δ: predicted over reference, 1 is none. σ: scatter of the model, that of the reference taken out.",
        csv="ensemble.csv",
    )


def _order(row: Ensemble) -> tuple[bool, str, str]:
    """Spring models against FE come first."""
    predicted, reference = pair_of(row)
    return not (predicted.startswith(("spring", "model")) and reference.startswith("fe")), predicted, reference


def _sliding(tables: Tables, row: Ensemble) -> str:
    """Return the sliding share where a longitudinal force is judged over all cases."""
    judged = (
        row.group == "all" and row.compared and row.metric == "scalar" and row.quantity.endswith("tangential_force")
    )
    return wording.sliding(tables.sliding(pair_of(row))) if judged else ""


def _ensemble_row(row: Ensemble, marks: Marks, headline: bool, sliding: str) -> Row:
    note = row.note
    if row.compared:  # how many are missing stands in the next column already
        note = "; ".join(part for part in note.split("; ") if not part.endswith("runs cannot be compared"))
    else:
        note = note or wording.status(row.status)
    note = "; ".join(filter(None, (note, sliding)))

    def show(value: float | None) -> str:
        if value is None:
            return "–"
        if row.error_type == "score":
            return f"R {wording.digits(1.0 - value)}"
        return (
            wording.percent(value)
            if row.error_type == "relative"
            else f"{wording.digits(value)} {wording.unit(row.unit)}".strip()
        )

    kind = row.unit if row.error_type == "absolute" else row.error_type

    cells = [
        Cell(wording.quantity(row.quantity, row.metric), note=note),
        value_cell(row.compared, f"{row.compared} of {row.cases}"),
        Cell(show(row.mean_abs_error), sort=row.mean_abs_error, kind=kind),
        Cell(
            show(row.largest_abs_error),
            sort=row.largest_abs_error,
            kind=kind,
            note=row.largest_case_id,
            case="" if row.largest_abs_error is None else row.largest_case_id,
        ),
        value_cell(row.bias, wording.digits(row.bias)),
        value_cell(row.model_scatter, _scatter(row)),
        value_cell(row.mean_uncertainty, wording.size(row.mean_uncertainty, row.error_type, row.unit)),
        value_cell(row.adequate, _answers(row), note=row.criterion),
        value_cell(row.agrees, f"{row.agrees}" if row.compared else "–"),
        value_cell(row.area_metric, wording.percent(row.area_metric)),
    ]
    if not headline:
        cells.insert(1, Cell(wording.group(row.group)))
    pair = f"{wording.source(row.predicted_source)} compared with {wording.source(row.reference_source)}"
    return Row(tuple(cells), marks.of(row.assumed), group=pair)


def _scatter(row: Ensemble) -> str:
    """Write the model's own scatter; where it is less than the reference's there is nothing of its own to be seen."""
    if row.model_scatter == 0.0 and row.total_scatter and row.reference_scatter:
        return f"below σ_E {wording.percent(row.reference_scatter)}"
    return wording.percent(row.model_scatter)


def _answers(row: Ensemble) -> str:
    """Write in how many cases the model is good enough, is not, and cannot be told."""
    if not row.compared:
        return "–"
    return f"{row.adequate}; {row.inadequate}; {row.compared - row.adequate - row.inadequate}"
