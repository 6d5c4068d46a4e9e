"""What disagrees, model by model, and what bias and scatter say of the reason; the method in one page, for the PDF."""

from __future__ import annotations

from ..compare.quantities import HEADLINE
from ..compare.tables import ClaimRow, Ensemble
from . import wording
from .content import Cell, Column, Paragraph, Row, Section, Table
from .marks import Marks
from .tables import Tables

SYSTEMATIC = 2.0  # how many times its scatter a bias must be to be called systematic
MOST = 12  # published statements listed for the PDF's reader

METHOD = (
    "Cases. A study names compounds, friction laws, blocks and paths; its test matrix is every combination of "
    "their levels. A case is one pass of a tread block through its contact, free of the tyre: on a two-wheel rig "
    "or along the measured or simplified line of a belt.",
    "Models. The spring models divide the block along its length into viscoelastic radial and longitudinal "
    "springs with friction at their ends (Liu, Sutcliffe and Graham, Wear 269, 2010): with the modulus of a free "
    "block, with shape factors of a bonded block, or with a stiffness condensed from finite elements. Models of "
    "the user's own stand beside them. None shares solver code with the references.",
    "References. The built-in explicit finite element engine runs the very decks that ABAQUS/Explicit or CalculiX"
    " would; a run counts only where its record names today's deck. A run made before the engine's code changed "
    "is compared and marked.",
    "Assessment. For each quantity the comparison error is E = S - D, of the simulation S and its reference D. "
    "Its standard uncertainty u_val joins numerical, input and data parts; U = 2 u_val (ASME V&V 20). A model "
    "agrees within uncertainty where |E| <= U. It is good enough for the study's purpose where |E| + U is within "
    "the tolerance, not where |E| - U is beyond it, and otherwise it cannot be told.",
    "Histories. Scores are the relative RMS error, Sprague and Geers' magnitude, phase and combined errors, and "
    "the rating R of ISO/TS 18571 (excellent above 0.94, good above 0.80, fair above 0.58).",
    "Over all cases. Bias and scatter are those of ln(S/D) with the reference's own uncertainty taken out (FDS "
    "validation guide); the area metric is the distance of the two distributions. Slopes over speed and "
    "temperature are compared by paired or Welch t tests, corrected after Holm.",
)


def method_section() -> Section:
    """Return the method in one page."""
    return Section("method", "Method", tuple(Paragraph(text) for text in METHOD), pdf_only=True)


def discussion_section(tables: Tables, marks: Marks) -> Section:
    """Return the quantities and statements in which a model is not good enough, and what the numbers say of why."""
    rows = [row for row in tables.ensemble if row.group == "all" and (row.quantity, row.metric) in HEADLINE]
    failed = [row for row in rows if row.inadequate]
    items: list[Paragraph | Table] = [_disagreements(failed, marks)]
    if not failed:
        items = [Paragraph("No model is beyond its tolerance in any headline quantity.", "good")]
    wrong = [row for row in tables.claims if row.kind == "model" and row.assessment == "disagrees"]
    if wrong:
        items.append(_statements(wrong, marks))
    return Section("discussion", "What disagrees, and why", tuple(items))


def _disagreements(rows: list[Ensemble], marks: Marks) -> Table:
    lines = []
    for row in rows:
        cells = (
            Cell(wording.quantity(row.quantity, row.metric)),
            Cell(f"{row.inadequate} of {row.compared}", sort=row.inadequate),
            Cell(wording.size(row.mean_abs_error, row.error_type, row.unit)),
            Cell(wording.plain(row.bias, 3), sort=row.bias),
            Cell(wording.percent(row.model_scatter), sort=row.model_scatter),
            Cell(row.criterion or "–"),
            Cell(reason(row)),
        )
        pair = f"{wording.source(row.predicted_source)} compared with {wording.source(row.reference_source)}"
        lines.append(Row(cells, marks.of(row.assumed), group=pair))
    columns = (
        Column("Quantity", wide=True),
        Column("Not good enough", "cases", numeric=True),
        Column("Mean |E|", "scores: 1 − R", numeric=True),
        Column("Bias δ", numeric=True),
        Column("Scatter σ", numeric=True),
        Column("Good enough", "|E| + U within", wide=True),
        Column("What the numbers say", wide=True),
    )
    return Table(
        "disagreements", "Where a model is not good enough", columns, tuple(lines), csv="ensemble.csv",
        help="A bias well beyond the scatter is one wrong stiffness or a missing effect in all cases alike.",
    )  # fmt: skip


def reason(row: Ensemble) -> str:
    """Say whether the error is the same in all cases (a bias) or differs from case to case (a scatter)."""
    if row.bias is None or row.model_scatter is None:
        return "no bias is defined: values change sign or are scores"
    away = abs(row.bias - 1.0)
    way = "low" if row.bias < 1.0 else "high"
    if away > SYSTEMATIC * row.model_scatter:
        return f"systematic: {wording.percent(away)} {way} in all cases alike"
    if away < 0.5 * row.model_scatter:
        return "differs from case to case about the reference"
    return f"{wording.percent(away)} {way} on average, and differs from case to case"


def _statements(rows: list[ClaimRow], marks: Marks) -> Table:
    ordered = sorted(rows, key=lambda row: -abs(row.error or 0.0) if row.error_type == "relative" else 0.0)
    lines = [
        Row(
            (
                Cell(row.statement[:1].upper() + row.statement[1:]),
                Cell(wording.source(row.source)),
                Cell(f"{wording.plain(row.published)} {wording.unit(row.unit)}".strip()),
                Cell(f"{wording.plain(row.computed, 4)} {wording.unit(row.unit)}".strip(), note=row.note),
            ),
            marks.of(row.assumed),
        )
        for row in ordered[:MOST]
    ]
    columns = (Column("Published statement", wide=True), Column("Source"), Column("Published"), Column("Found"))
    caption = f"The {MOST} furthest of {len(rows)}; claims.csv has all." if len(rows) > MOST else ""
    return Table(
        "disagreeing-statements", "Published statements that are not met", columns, tuple(lines), caption,
        csv="claims.csv",
    )  # fmt: skip
