"""What the report says, from the made-up tables."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tread_validate.compare.tables import Delta, rows_text
from tread_validate.palette import looks
from tread_validate.report import wording
from tread_validate.report.alternating import alternating_table
from tread_validate.report.baseline import baseline_section
from tread_validate.report.cases import case_views, facets, factor_levels
from tread_validate.report.claims import claims_table
from tread_validate.report.content import Table
from tread_validate.report.expected import expected_section
from tread_validate.report.figures.errors import heat
from tread_validate.report.figures.overview import overview
from tread_validate.report.histories import HistoryStore, load_histories
from tread_validate.report.marks import Marks
from tread_validate.report.models import Costs, models_table, own_words
from tread_validate.report.summary import first_screen
from tread_validate.report.table1 import table1
from tread_validate.report.tables import Tables, read_tables
from tread_validate.study import LoadedStudy, load_study
from tread_validate.study.own_model import HistoriesModel


@pytest.fixture(scope="module")
def tables(inputs: Any) -> Tables:
    """Read the made-up tables."""
    return read_tables(inputs.tables)


@pytest.fixture
def marks(tables: Tables) -> Marks:
    """Code the assumptions."""
    return Marks(tables.assumed)


def test_every_case_is_in_one_cell_of_one_grid(tables: Tables) -> None:
    """Exact: the heat maps' grids hold each case once and nothing else."""
    views = case_views(tables.cases)
    cells = [view.case_id for facet in facets(views) for _, row in facet.rows for view in row if view is not None]
    assert Counter(cells) == Counter(row.case_id for row in tables.cases)


def test_only_factors_that_vary_can_be_chosen(tables: Tables) -> None:
    """Exact: one compound and one friction law are no choice; the path always is."""
    levels = {factor.key: list(factor.levels) for factor in factor_levels(case_views(tables.cases))}
    assert set(levels) == {"path", "block", "temperature_degC", "interference_mm", "speed", "creep"}
    assert levels["speed"] == ["150 rpm", "300 rpm", "16.7 m/s"]
    assert levels["creep"] == ["0 %", "free rolling", "0.3 %"]


def test_expected_errors_stand_beside_the_actual_ones(tables: Tables, marks: Marks) -> None:
    """12 % expected, 30 % the limit, 10 % low; outside the map nothing is expected, and the reason is said."""
    section = expected_section(tables, marks)
    assert section is not None
    summary, each = (item for item in section.items if isinstance(item, Table))
    of_normal = [cell.text.replace(wording.NBSP, " ") for cell in summary.rows[0].cells]
    assert of_normal[1:5] == [f"{len(tables.cases)} of {len(tables.cases)}", "12.0 %", "10.0 %", "30.0 %"]
    outside = [row for row in each.rows if row.cells[-1].text == "outside"]
    assert len(outside) == len(tables.cases)
    assert {row.cells[-1].note for row in outside} == {"interference"}
    assert {row.cells[2].text for row in outside} == {"–"}
    assert any("changed since the map was made" in getattr(item, "text", "") for item in section.items)


def test_where_stick_and_slip_alternate_means_stand_in_place_of_histories(tables: Tables, marks: Marks) -> None:
    """FE 100 N and the model 95 N in the mean: -5 %; no other case is in the table."""
    table = alternating_table(tables, marks)
    assert table is not None
    assert [row.cells[0].text for row in table.rows] == [tables.cases[0].case_id] * 2
    texts = [[cell.text.replace(wording.NBSP, " ") for cell in row.cells] for row in table.rows]
    assert texts[0][1:] == ["100", "\N{MINUS SIGN}40", "50", "3", "2500"]
    assert "5.0 %)" in texts[1][1]
    assert "No reliable history in this regime" in table.caption
    steady = replace(tables, statistics_rows=tuple(row for row in tables.statistics_rows if not row.alternates))
    assert alternating_table(steady, marks) is None


def test_stale_reference_is_not_loaded(tables: Tables, inputs: Any, made_up: ModuleType) -> None:
    """Exact: its file exists, but its force belongs to another deck."""
    store = HistoryStore(inputs.spring, inputs.spring.parent / "models", inputs.reference)
    assert store.path("fe:embedded", made_up.STALE, f"fe/embedded/{made_up.STALE}-0").is_file()
    assert set(load_histories(tables, store)[made_up.STALE]) == {"spring:paper"}


def test_a_picture_without_a_reference_says_so(
    tables: Tables, inputs: Any, made_up: ModuleType, tmp_path: Path
) -> None:
    """The case whose reference is stale is drawn by its models alone, and titled so; any other by both."""
    store = HistoryStore(inputs.spring, inputs.spring.parent / "models", inputs.reference)
    histories = load_histories(tables, store)
    titles = []
    for view in case_views(tables.cases):
        drawn = histories[view.case_id]
        of = looks(["fe:embedded"], ["spring:paper"])
        titles.append((len(drawn), overview(tmp_path, view, drawn, of, (), ()).title))
    assert (1, "One case: the models, without a reference") in titles
    assert (2, "One case: reference and models") in titles


@pytest.fixture
def study(inputs: Any) -> LoadedStudy:
    """Load the made-up study."""
    return load_study(inputs.study)


def test_a_model_has_one_row_with_errors_score_assessment_and_cost(
    tables: Tables, study: LoadedStudy, marks: Marks
) -> None:
    """Exact: 16 of 18 cases compared, each 10 % low; R = 1 - 0.09; both forces fail their tolerance and are named."""
    table = models_table(tables, study, Costs({"spring:paper": 1.4e-3}), marks)
    assert [row.cells[0].text for row in table.rows] == ["Springs of the paper"]
    cells = table.rows[0].cells
    assert cells[1].text == "10.0\u00a0%; 10.0\u00a0%"
    assert cells[3].text == "0.91 good; –"
    assert cells[4].text == "✗ N and T not good enough"
    assert "of the reference: 0 of 16 (U not known)" in cells[4].note
    assert cells[5].text == "1.40 ms"
    assert [mark.code for mark in table.rows[0].marks] == ["S1"]


def test_first_screen_names_cases_references_baseline_and_inputs(
    tables: Tables, study: LoadedStudy, marks: Marks
) -> None:
    """Exact: one sentence, then a fact each; two references are not current and each is said why."""
    screen = first_screen(tables, marks, models_table(tables, study, Costs({}), marks), None, None)
    words = "1 model compared with the built-in explicit FE on 18 cases of the two-wheel rig and the tyre belt."
    assert (screen.alarm, screen.sentence) == ("", words)
    facts = {fact.label: fact.text for fact in screen.facts}
    assert facts["References"].startswith("Built-in explicit FE: 16 of 18 current; 1 without a run; 1 stale")
    assert facts["Baseline"] == "not checked"
    assert facts["Inputs"] == "18 of 18 cases depend on 3 assumed and 1 synthetic inputs"


def test_statements_about_other_cases_are_not_counted_as_disagreeing(
    tables: Tables, study: LoadedStudy, marks: Marks
) -> None:
    """A study of another block has none of the published cases: the first screen does not count them."""
    others = [replace(row, status="not_applicable", assessment="cannot tell") for row in tables.claims]
    models = models_table(tables, study, Costs({}), marks)
    told = (tables, replace(tables, claims=others))
    screens = [first_screen(read, marks, models, None, None) for read in told]
    said = [{fact.label for fact in screen.facts} for screen in screens]
    assert [("Published statements" in labels) for labels in said] == [True, False]


def test_where_nothing_was_compared_that_is_said_first(inputs: Any, study: LoadedStudy, marks: Marks) -> None:
    """Exact: without a single current reference the assessment is `cannot tell`, never `good enough`, never a zero."""
    tables = read_tables(inputs.tables)
    blank = {"mean_abs_error": None, "largest_abs_error": None, "bias": None, "model_scatter": None}
    empty = replace(
        tables,
        ensemble=tuple(replace(row, **blank, compared=0, status="missing") for row in tables.ensemble),
        errors=tuple(replace(row, error=None, assessment="cannot tell") for row in tables.errors),
    )
    screen = first_screen(empty, marks, models_table(empty, study, Costs({}), marks), None, None)
    assert screen.alarm.startswith("Nothing could be compared")
    cells = screen.models.rows[0].cells
    assert [cell.text for cell in cells[1:]] == ["–", "–", "–", "? cannot tell", "–"]
    assert cells[4].note == "without a run"


def test_an_own_model_stands_by_its_name_description_and_origin(tables: Tables, study: LoadedStudy) -> None:
    """Exact: what the study says of it, and nothing for a built-in model."""
    own = HistoriesModel(kind="histories", folder="h", description="Winkler foundation", origin="A. Engineer")
    named = replace(study, model=study.model.model_copy(update={"models": {"mine": own}}))
    assert own_words(named, "model:mine") == "Winkler foundation; A. Engineer"
    assert own_words(named, "spring:paper") == ""
    assert wording.source("model:mine") == "mine"


def test_table_1_has_a_column_for_every_source(tables: Tables, marks: Marks) -> None:
    """Exact: published columns first and untagged; a_v of 3 % times the source's factor, in per cent per m/s."""
    table = table1(tables, marks)
    titles = [column.title for column in table.columns[2:]]
    assert titles == ["Rig (published)", "FE (published)", "Built-in explicit FE", "Springs of the paper"]
    assert [bool(column.marks) for column in table.columns[2:]] == [False, False, True, True]
    assert [cell.text for cell in table.rows[0].cells[2:]] == [
        "3.60",
        "3.30",
        "3.00",
        "2.70",
    ]
    assert table.rows[0].cells[4].note == "sd 0.60; 95 % CI 1.80 to 4.20"


def test_heat_map_that_no_page_can_hold_says_where_it_is(tables: Tables, marks: Marks, tmp_path: Path) -> None:
    """Exact: 34 speeds at each of 31 depths and two temperatures are 62 rows; on paper there is a sentence instead."""
    first = tables.cases[0]
    rows = tuple(
        replace(
            first, case_id=f"{depth}-{warm}-{rpm}", interference_mm=0.01 * depth, temperature_degC=warm, speed_rpm=rpm
        )
        for depth in range(1, 32) for warm in (22.0, 45.0) for rpm in range(100, 3500, 100)
    )  # fmt: skip
    pair = ("spring:paper", "fe:embedded")
    drawn = heat(tmp_path, tables, case_views(rows), pair, marks.all())
    assert drawn.figure is None
    assert drawn.reason.endswith(f"{len(rows)} cases do not fit a page; the HTML page has a cell for each.")


def test_claim_without_a_value_shows_a_dash_and_its_reason(tables: Tables, marks: Marks) -> None:
    """Exact: the third claim has no run behind it."""
    row = claims_table(tables, marks).rows[2]
    assert row.cells[4].text == "–"
    assert row.cells[4].note == "? cannot tell; without a run"


def test_report_without_a_check_says_so(marks: Marks) -> None:
    """Exact: no delta table, no assessment in the summary."""
    section, moved = baseline_section(None, marks)
    assert moved is None
    assert "No check against a baseline was made" in section.items[0].text  # type: ignore[union-attr]


MOVED = Delta(
    "moved", "run", "peaks", "spring:paper, c", "spring:paper", "", "c", "", "", "peak_normal_force_N", "N", "1", "1.1",
    0.1, 0.01, 10.0, False, "",
)  # fmt: skip
FLIP = replace(
    MOVED, outcome="changed", kind="flip", in_table="errors", in_column="assessment", unit="", baseline="agrees",
    current="disagrees", change=None, times_noise=None,
)  # fmt: skip


def test_a_flipped_assessment_stands_before_what_moved(tmp_path: Path, marks: Marks) -> None:
    """Exact: the table of `check` is shown in its order, grouped by what happened; the sentence counts flips first."""
    path = tmp_path / "delta.csv"
    path.write_text(rows_text(Delta, [FLIP, MOVED]), encoding="utf-8")
    section, moved = baseline_section(path, marks)
    assert moved == (
        "bad",
        "1 assessment flipped (1 for the worse); 2 rows moved beyond noise, or are new, missing or stale.",
    )
    flips, moves = section.items[1:]
    assert isinstance(flips, Table)
    assert isinstance(moves, Table)
    assert [row.group for row in (*flips.rows, *moves.rows)] == ["Assessments that flipped", "Runs that moved"]
    assert [cell.text for cell in flips.rows[0].cells][3:5] == ["agrees", "disagrees"]
    assert [cell.text for cell in moves.rows[0].cells][2:] == ["peak normal force N", "1 N", "1.1 N", "10.0"]


def test_the_gravest_flip_stands_first(tmp_path: Path, marks: Marks) -> None:
    """Exact: assessments before agreement, and of those the ones that are worst now, whatever the table's order."""
    ends = [("agreement", "differs"), ("assessment", "cannot tell"), ("assessment", "adequate"),
            ("assessment", "inadequate")]  # fmt: skip
    path = tmp_path / "delta.csv"
    rows = [replace(FLIP, row_key=f"case {now}", in_column=at, current=now) for at, now in ends]
    path.write_text(rows_text(Delta, rows), encoding="utf-8")
    flips = baseline_section(path, marks)[0].items[1]
    assert isinstance(flips, Table)
    assert [row.cells[4].text for row in flips.rows] == ["inadequate", "cannot tell", "adequate", "differs"]


def test_many_flips_are_counted_before_they_are_listed(tmp_path: Path, marks: Marks) -> None:
    """Exact: 40 cases from adequate to inadequate and one back are two rows, 52 cases less 12 that are good enough one;
    what a group of cases repeats is left out; all 43 stand folded below."""
    worse = [replace(FLIP, quantity="peak_normal_force", metric="scalar", row_key=f"case {i}", baseline="adequate",
                     current="inadequate") for i in range(40)]  # fmt: skip
    better = replace(worse[0], row_key="case 40", baseline="inadequate", current="adequate")
    path = tmp_path / "delta.csv"
    passed = [replace(worse[0], in_table="ensemble", in_column="passed", case_id=group, row_key=group, baseline="52",
                      current="12") for group in ("all", "rig")]  # fmt: skip
    path.write_text(rows_text(Delta, [*worse, better, *passed]), encoding="utf-8")
    section, moved = baseline_section(path, marks)
    assert moved is not None
    assert moved[1].startswith("43 assessments flipped (42 for the worse, 1 for the better); ")
    counted, flips = section.items[1:3]
    assert isinstance(counted, Table)
    assert isinstance(flips, Table)
    assert [[cell.text for cell in row.cells] for row in counted.rows] == [
        ["Springs of the paper", "Peak normal force", "52", "12", "40"],
        ["Springs of the paper", "Peak normal force", "adequate", "inadequate", "40"],
        ["Springs of the paper", "Peak normal force", "inadequate", "adequate", "1"],
    ]
    assert flips.folded
    assert len(flips.rows) == 43


def test_a_move_within_noise_is_good(tmp_path: Path, marks: Marks) -> None:
    """Exact: shown, and not counted as a failure."""
    path = tmp_path / "delta.csv"
    path.write_text(rows_text(Delta, [replace(MOVED, outcome="within", passed=True)]), encoding="utf-8")
    _, moved = baseline_section(path, marks)
    assert moved is not None
    assert moved[0] == "good"


def test_baseline_with_no_row_moved_is_good(tmp_path: Path, marks: Marks) -> None:
    """Exact: a delta table with only its header says that nothing moved."""
    path = tmp_path / "delta.csv"
    path.write_text(rows_text(Delta, []), encoding="utf-8")
    _, moved = baseline_section(path, marks)
    assert moved == ("good", "No number and no word differs from the baseline beyond its noise.")
