"""What moved since the accepted baseline: flipped assessments first, then what they depend on, then what moved."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from ..compare.baseline.histories import Histories, accepted_histories
from ..compare.baseline.movement import Movement, movements
from ..compare.baseline.store import RECORD, load_baseline
from ..compare.baseline.trend import read_trend
from ..compare.quantities import HEADLINE
from ..compare.tables import Delta, TrendRow, read_rows
from . import wording
from .content import Cell, Column, Figure, Figures, Item, Paragraph, Row, Section, Table, Tone
from .marks import Marks

TITLE = "Change since the accepted baseline"
WAYS = {
    "passed": "Cases that are good enough",
    "assessment": "Good enough for the purpose",
    "agreement": "Agreement within uncertainty",
}
KINDS = {
    "flip": "Assessments that flipped",
    "rule": "What assessments depend on",
    "input": "Inputs",
    "run": "Runs that moved",
    "consequence": "What follows from them",
}
LIMIT = 60
FEW = 8  # flips that a reader takes in one by one; more are counted first
WORST = ("inadequate", "disagrees", "differs", "cannot tell")


def baseline_section(
    delta: Path | None,
    marks: Marks,
    tables: Path | None = None,
    accepted: Path | None = None,
    draw: Callable[[Sequence[Movement], Histories], tuple[Figure, ...]] | None = None,
) -> tuple[Section, tuple[Tone, str] | None]:
    """Return the section, and for the summary a tone and a sentence (None where no check was made).

    `tables` are those of today and `accepted` is the baseline's folder: where both are there, better and worse are
    counted by model and quantity, the histories of those that moved most are drawn with `draw`, and the headline errors
    of every accepted baseline are listed.
    """
    if delta is None or not delta.is_file():
        words = "No check against a baseline was made for this report; the command “tread-validate check” makes one."
        return Section("baseline", TITLE, (Paragraph(words),)), None
    rows = read_rows(delta, Delta)
    failed = [row for row in rows if not row.passed]
    outcome: tuple[Tone, str] = ("good", "No number and no word differs from the baseline beyond its noise.")
    if failed:
        places = len({(row.in_table, row.row_key) for row in failed})
        words = _flipped([row for row in failed if row.kind == "flip"])
        outcome = ("bad", f"{words}{wording.plural(places, 'row')} moved beyond noise, or are new, missing or stale.")
    items: list[Item] = [Paragraph(outcome[1])]
    flips = sorted((row for row in failed if row.kind == "flip"), key=_gravity)
    if len(flips) > FEW:
        items.append(_counted(flips))
    if flips:
        items.append(_table(flips, "flips", "Assessments that flipped", folded=len(flips) > FEW, limit=len(flips)))
    if tables is not None and accepted is not None and (accepted / "baseline.yaml").is_file():
        found = movements(load_baseline(accepted), tables)
        items.append(_movements(found))
        items += _drawn(found, accepted, draw)
        items += _trend(read_trend(accepted))
    others = [row for row in rows if row.passed or row.kind != "flip"]
    if others:
        items.append(_table(others, "delta", "Cells that are not what they were", folded=True))
    return Section("baseline", TITLE, tuple(items)), outcome


def _flipped(flips: Sequence[Delta]) -> str:
    """Say how many assessments flipped, and which way."""
    if not flips:
        return "No assessment flipped; "
    ways = Counter(_way(row) for row in flips)
    told = ", ".join(f"{ways[way]} for the {word}" for way, word in ((-1, "worse"), (1, "better")) if ways[way])
    return f"{wording.plural(len(flips), 'assessment')} flipped" + (f" ({told}); " if told else "; ")


def _way(row: Delta) -> int:
    """Return 1 for a change to the better, -1 to the worse, 0 where neither can be said."""
    ends = [float(text) if text.isdigit() else _rank(text) for text in (row.baseline, row.current)]
    return (ends[1] > ends[0]) - (ends[1] < ends[0])


def _rank(word: str) -> int:
    """Order assessments from worst to best."""
    return WORST.index(word) if word in WORST else len(WORST)


def _counted(flips: Sequence[Delta]) -> Table:
    """Return the flips counted by source, quantity and what became of them, most losses first.

    Groups of cases are left out where the row of all cases says it.
    """
    whole = [row for row in flips if row.in_table != "ensemble" or row.case_id == "all"]
    counts: Counter[tuple[str, str, str, str, str, int]] = Counter()
    for row in whole:
        size = 1
        if row.baseline.isdigit() and row.current.isdigit():
            size = abs(int(row.current) - int(row.baseline))
        name = wording.quantity(row.quantity, row.metric or "scalar") if row.quantity else "–"
        group = "Published statements" if row.in_table == "claims" else WAYS.get(row.in_column, row.in_column)
        counts[group, row.source, name, row.baseline, row.current, _way(row)] += size
    ordered = sorted(counts.items(), key=lambda item: (item[0][0], item[0][5], -item[1]))
    tones: dict[int, Tone] = {-1: "bad", 1: "good"}
    lines = [
        Row(
            (
                Cell(wording.source(source) if source else "–"),
                Cell(name),
                Cell(before or "–"),
                Cell(now or "–", tone=tones.get(way, "")),
                Cell(f"{count}", sort=count),
            ),
            group=group,
        )
        for (group, source, name, before, now, way), count in ordered
    ]
    columns = (
        Column("Source", wide=True), Column("Quantity", wide=True), Column("Baseline"), Column("Now"),
        Column("Flips", "cases or statements", numeric=True),
    )  # fmt: skip
    return Table(
        "flip-counts", "Assessments that flipped, counted", columns, tuple(lines), csv="delta.csv", printed=8,
        help="Every flip by itself is in the folded table below; its filter takes a case, a model or a quantity.",
    )  # fmt: skip


def _gravity(row: Delta) -> tuple[bool, int]:
    """Order flips: assessments before agreement within uncertainty, and those that are worst now first."""
    return row.in_column != "assessment", _rank(row.current)


def _drawn(
    found: Sequence[Movement],
    accepted: Path,
    draw: Callable[[Sequence[Movement], Histories], tuple[Figure, ...]] | None,
) -> list[Item]:
    """Return the histories before and after, or in words why there are none."""
    if draw is None or not found:
        return []
    histories = accepted_histories(accepted, RECORD)
    if not histories:
        return [Paragraph("The baseline was accepted without histories, so none of before can be drawn.", tone="mute")]
    figures = draw(found, histories)
    return [Figures(figures)] if figures else []


def _table(rows: Sequence[Delta], key: str, title: str, folded: bool, limit: int = LIMIT) -> Table:
    columns = (
        Column("Change"),
        Column("Row of a table", wide=True, long=True),
        Column("Column"),
        Column("Baseline", numeric=True),
        Column("Now", numeric=True),
        Column("Change / noise", numeric=True),
    )
    lines = tuple(_line(row) for row in rows[:limit])
    caption = f"First {limit} of {len(rows)} rows." if len(rows) > limit else ""
    return Table(key, title, columns, lines, caption, folded=folded, csv="delta.csv", printed=8)


def _movements(found: Sequence[Movement]) -> Table:
    """Return better and worse by model and quantity, those that got worse in most cases first."""
    rows = []
    for item in found:
        before, now = (wording.size(value, item.error_type, item.unit) for value in (item.before, item.now))
        cells = (
            Cell(wording.source(item.predicted_source)),
            Cell(wording.quantity(item.quantity, item.metric)),
            Cell(f"{item.better}", sort=item.better),
            Cell(f"{item.worse}", sort=item.worse, tone="bad" if item.worse > item.better else ""),
            Cell(item.case_id, case=item.case_id),
            Cell(before, sort=item.before, kind=item.unit),
            Cell(now, sort=item.now, kind=item.unit),
        )
        rows.append(Row(cells))
    columns = (
        Column("Model"), Column("Quantity", wide=True), Column("Better", "cases", numeric=True),
        Column("Worse", "cases", numeric=True), Column("Moved most", wide=True), Column("|E| before", numeric=True),
        Column("|E| now", "of that case", numeric=True),
    )  # fmt: skip
    return Table(
        "movements", "Better and worse, by model and quantity", columns, tuple(rows), empty="Nothing moved.",
        printed=8,
        help="Cases whose |E| fell or grew by more than its noise; errors of scores are 1 − R.",
    )  # fmt: skip


def _trend(rows: Sequence[TrendRow]) -> list[Table]:
    """Return the mean peak normal force error of every accepted baseline."""
    own = [row for row in rows if (row.quantity, row.metric) == HEADLINE[0]]
    lines = [
        Row(
            (
                Cell(wording.source(row.predicted_source), note=f"{row.when[:10]}, code {row.commit}"),
                Cell(f"{row.compared}", sort=row.compared),
                Cell(wording.percent(row.mean_abs_error), sort=row.mean_abs_error),
                Cell(wording.percent(row.largest_abs_error), sort=row.largest_abs_error),
            ),
            group=f"{row.when[:10]}: {row.reason}",
        )
        for row in own
    ]  # fmt: skip
    columns = (
        Column("Model", "accepted, code", wide=True), Column("Cases", numeric=True),
        Column("Mean |E|", "peak N", numeric=True), Column("Worst |E|", "peak N", numeric=True),
    )  # fmt: skip
    title = "Headline errors of every accepted baseline"
    return [Table("trend", title, columns, tuple(lines), folded=True)] if lines else []


def _line(row: Delta) -> Row:
    name = row.name.removesuffix(f": {row.in_column}") if row.in_column else row.name
    unit = wording.unit(row.unit)
    if row.in_table == "errors" and row.source and row.quantity and row.case_id:
        quantity = wording.quantity(row.quantity, row.metric or "scalar")
        name = f"{wording.source(row.source)}: {quantity}, {row.case_id}"
        if row.reference_source:
            name += f", compared with {wording.source(row.reference_source)}"
    cells = (
        Cell(row.outcome, tone="" if row.passed else "bad", note=row.note),
        Cell(name, case=row.case_id if row.in_table in ("errors", "peaks") else ""),
        Cell(row.in_column.replace("_", " ") or "whole row"),
        Cell(f"{row.baseline or '–'} {unit if row.baseline else ''}".strip()),
        Cell(f"{row.current or '–'} {unit if row.current else ''}".strip()),
        Cell(wording.digits(row.times_noise), sort=row.times_noise),
    )
    return Row(cells, group=KINDS.get(row.kind, row.kind) if not row.passed else "Within noise")
