"""One declaration a table: what is written is what is declared, and it comes back as it was."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from frictionless import Package, Resource, system
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.compare.quantities import SCALARS, Noise, scalars
from tread_validate.compare.tables import TABLES, CaseRow, MetricRow, PeakRow, Sensitivity, cell, read_rows, rows_text
from tread_validate.errors import InputError
from tread_validate.study.factors import FACTORS


@pytest.mark.parametrize("name", TABLES)
def test_every_column_says_what_it_holds(name: str) -> None:
    """A description for every column; a key of columns that the table has; a unit where the name ends with one."""
    kind = TABLES[name]
    columns = {column.name: column for column in kind.columns()}
    assert all(column.description for column in columns.values())
    assert set(kind.key) <= set(columns)
    assert kind.title
    for ending, unit in (("_N", "N"), ("_degC", "degC"), ("_mm", "mm"), ("_MPa", "MPa"), ("_percent", "%")):
        assert all(column.unit == unit for column in columns.values() if column.name.endswith(ending))


@pytest.mark.parametrize("name", TABLES)
def test_a_table_comes_back_as_it_was(name: str, workspace: Any, tmp_path: Path) -> None:
    """Read as rows and written again: the same rows and, but for the published numbers, which stand as the paper
    prints them, the same bytes.
    """
    path, kind = workspace.tables / f"{name}.csv", TABLES[name]
    rows = read_rows(path, kind)
    text = rows_text(kind, rows)
    assert name == "published" or text == path.read_text(encoding="utf-8")
    (tmp_path / "again.csv").write_text(text, encoding="utf-8")
    assert read_rows(tmp_path / "again.csv", kind) == rows


def test_the_results_are_a_data_package(workspace: Any) -> None:
    """Frictionless finds every table with its checksum, every cell of the kind declared, no key twice."""
    with system.use_context(trusted=True):
        package = Package(str(workspace.tables / "datapackage.yaml"))
        assert {Path(resource.path or "").stem for resource in package.resources} == set(TABLES)
        report = package.validate()
    assert report.valid, report.flatten(["title", "rowNumber", "fieldName", "message"])[:3]
    force = Resource.from_descriptor(package.get_resource("peaks").to_descriptor()).schema
    assert force.get_field("peak_normal_force_N").to_descriptor()["unit"] == "N"


def test_every_scalar_has_a_column_and_a_row(workspace: Any) -> None:
    """A quantity of the catalogue reaches peaks, errors and statistics without a further declaration."""
    header = (workspace.tables / "peaks.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
    errors = read_rows(workspace.tables / "errors.csv", MetricRow)
    for quantity in SCALARS:
        assert quantity.column in header
        assert any((row.quantity, row.metric) == (quantity.name, "scalar") for row in errors)
    peaks = read_rows(workspace.tables / "peaks.csv", PeakRow)
    assert set(peaks[0].values) == {quantity.name for quantity in SCALARS}
    assert peaks[0].peak_normal_force_N == peaks[0].values["peak_normal_force"]


def test_every_factor_of_a_study_has_a_column() -> None:
    """A factor that a study may vary stands in the table of the cases."""
    assert {factor.column for factor in FACTORS} <= set(CaseRow.header())


@given(st.floats(-1e12, 1e12))
def test_a_number_is_written_to_seven_digits_and_stays_there(value: float) -> None:
    """Writing, reading and writing again changes nothing after the first time."""
    once = cell(value)
    assert cell(float(once)) == once
    assert float(once) == pytest.approx(value, rel=5e-7, abs=0.0)


@pytest.mark.parametrize(
    ("change", "match"),
    [
        (("samples", "sample"), "no column samples"),
        (("change\n", "change,more\n"), ":2: got 7 cells, expected 8"),
        (("2001", "many"), ":2: samples: got 'many', expected a finite integer"),
        (("0.5,0", "inf,0"), ":2: value"),
        (("0.5,0\n", "0.5\n"), ":2: got 6 cells, expected 7"),
        (("0.5,0\n", "0.5,0\n" + "relative_rms,normal_force,a,as reported,2001,0.5,0\n"), "again"),
        (("0.5,0", ",0"), "an empty cell"),
    ],
)
def test_a_damaged_table_is_refused(change: tuple[str, str], match: str, tmp_path: Path) -> None:
    """File, line, column, what was found and what was expected."""
    row = Sensitivity("relative_rms", "normal_force", "a", "as reported", 2001, 0.5, 0.0)
    text = rows_text(Sensitivity, [row])
    assert change[0] in text
    path = tmp_path / "sensitivity.csv"
    path.write_text(text.replace(*change), encoding="utf-8")
    with pytest.raises(InputError, match=match):
        read_rows(path, Sensitivity)


@pytest.mark.parametrize(("relative", "absolute"), [(1e9, 0.0), (0.5, 0.0), (-1e-6, 0.0), (0.0, float("nan"))])
def test_a_noise_that_would_hide_a_change_is_refused(relative: float, absolute: float) -> None:
    """No deterministic model moves by a thousandth of itself from one processor to another."""
    with pytest.raises(ValueError, match="noise"):
        Noise(relative, absolute)


def test_a_scalar_that_does_not_exist_is_an_attribute_error(half_sine: Any) -> None:
    """A misspelt name is not a silent zero."""
    found = scalars(half_sine())
    assert found.peak_normal_force == pytest.approx(100.0, rel=1e-5)
    with pytest.raises(AttributeError):
        _ = found.peak_normal_farce


def test_the_summary_says_what_the_tables_say(workspace: Any, tmp_path: Path) -> None:
    """Mean error, counts of assessments and states of the references are those of the tables; no check, no baseline."""
    facts = json.loads((workspace.tables / "summary.json").read_text(encoding="utf-8"))
    assert facts["baseline"] is None
    errors = read_rows(workspace.tables / "errors.csv", MetricRow)
    model = next(item for item in facts["models"] if item["reference"] == "fe:embedded")
    for item in model["quantities"]:
        own = [
            row
            for row in errors
            if (row.reference_source, row.quantity, row.metric) == ("fe:embedded", item["quantity"], item["metric"])
        ]
        known = [abs(row.error) for row in own if row.error is not None]
        assert item["mean_abs_error"] == pytest.approx(sum(known) / len(known), rel=1e-5)
        assert item["largest_abs_error"] == pytest.approx(max(known), rel=1e-6)
        assessments = [item[name] for name in ("adequate", "inadequate", "cannot_tell")]
        assert assessments == [
            sum(row.assessment == name for row in own) for name in ("adequate", "inadequate", "cannot tell")
        ]
        words = {row.assessment for row in own}
        expected = "inadequate" if "inadequate" in words else "adequate" if words == {"adequate"} else "cannot tell"
        assert item["assessment"] == expected
        if item["metric"] == "iso18571_r":
            assert sum(item["grades"].values()) == len(own)
    assert facts["references"]["fe:embedded"] == {"current": len(model["runs"]) and sum(model["runs"].values())}
