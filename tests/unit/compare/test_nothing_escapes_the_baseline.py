"""Changes that once passed the check: each table, each assessment and each rule behind one is held."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tread_validate.compare.baseline.delta import check_tables
from tread_validate.compare.baseline.store import Acceptance, load_baseline, save_baseline
from tread_validate.compare.quantities import catalogue, tolerance
from tread_validate.compare.scores import ensemble, iso18571
from tread_validate.compare.tables import (
    TABLES,
    ClaimRow,
    Coefficient,
    Difference,
    Ensemble,
    MetricRow,
    Residual,
    Sensitivity,
    TableRow,
    read_rows,
    write_rows,
)  # fmt: skip

FACTS = Acceptance("a test", "somebody", "2026-01-01T00:00:00Z", "0123456789ab", "0.1.0", "liu2010", "digest")


@pytest.fixture
def baseline(workspace: Any, tmp_path: Path) -> Path:
    """The workspace's tables as a baseline."""
    save_baseline(tmp_path / "baseline", workspace.tables, FACTS)
    return tmp_path / "baseline"


@pytest.mark.parametrize("name", TABLES)
def test_a_table_that_lost_a_row_fails(name: str, copy: Any, baseline: Path) -> None:
    """One row less in any table, and every row less: one missing row, and as many as there were."""
    rows = list(read_rows(copy.tables / f"{name}.csv", TABLES[name]))
    write_rows(copy.tables, TABLES[name], rows[1:])
    check = check_tables(load_baseline(baseline), copy.tables)
    assert [(row.outcome, row.in_table) for row in check.failed] == [("missing", name)]
    write_rows(copy.tables, TABLES[name], [])
    assert len(check_tables(load_baseline(baseline), copy.tables).failed) == len(rows)


@pytest.mark.parametrize("name", TABLES)
def test_every_word_and_every_number_is_held(name: str, copy: Any, baseline: Path) -> None:
    """Each column but notes and digests of files: changed in one row, it is a failure with the column's name."""
    kind = TABLES[name]
    rows = list(read_rows(copy.tables / f"{name}.csv", kind))
    accepted = load_baseline(baseline)
    held = [column for column in kind.columns() if not column.free and column.name not in kind.key]
    for column in held:
        index, changed = next(
            (index, other)
            for index, row in enumerate(rows)
            if (other := _changed(row, column.name, column.kind)) is not None
        )
        write_rows(copy.tables, kind, [*rows[:index], changed, *rows[index + 1 :]])
        found = [row.in_column for row in check_tables(accepted, copy.tables).failed]
        assert found == [column.name] or (column.name == "status" and found), column.name


def _changed(row: TableRow, name: str, kind: str) -> TableRow | None:
    """Return the row with another value in one column; None where it is empty."""
    if name not in row.__dataclass_fields__:
        key, value = next((key, value) for key, value in row.values.items() if name.startswith(key))  # type: ignore[attr-defined]
        return None if value is None else replace(row, values={**row.values, key: 2.0 * value + 1.0})  # type: ignore[attr-defined]
    value = getattr(row, name)
    if kind == "number":
        return None if value is None else replace(row, **{name: 2.0 * value + 1.0})
    if kind == "integer":
        return replace(row, **{name: value + 1})
    if kind == "boolean":
        return None if value is None else replace(row, **{name: not value})
    return replace(row, **{name: ("other",) if kind == "list" else "other"})


def _rebuilt(copy: Any, baseline: Path) -> list[tuple[str, str, str]]:
    """Build the tables anew and return (kind, table, column) of what fails, in order."""
    copy.build()
    found = check_tables(load_baseline(baseline), copy.tables).failed
    return [(row.kind, row.in_table, row.in_column) for row in found]


def test_a_wider_tolerance_is_caught_with_its_flips_first(copy: Any, baseline: Path) -> None:
    """Ten to fifty per cent for forces: models 23 % off would agree. The flips come first, the tolerance next."""
    text = copy.study.read_text(encoding="utf-8")
    wide = "".join(
        f"  {name}: {{value: 0.5, reason: everything passes}}\n"
        for name in ("peak_normal_force", "normal_impulse", "relative_rms", "sprague_geers_m", "sprague_geers_c")
    )
    copy.study.write_text(f"{text}tolerances:\n{wide}", encoding="utf-8")
    found = _rebuilt(copy, baseline)
    assert found[0] == ("flip", "errors", "assessment") or found[0] == ("flip", "errors", "passed")
    kinds = [kind for kind, _, _ in found]
    assert kinds.index("rule") == kinds.count("flip")
    assert ("rule", "errors", "tolerance") in found


def test_another_limit_of_an_iso_grade_is_caught(copy: Any, baseline: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`good` from 0.62 on in place of 0.80: grades are words of the baseline."""
    monkeypatch.setattr(iso18571, "GRADES", ((0.94, "excellent"), (0.62, "good"), (0.58, "fair")))
    found = _rebuilt(copy, baseline)
    assert set(found) == {("flip", "errors", "grade")}


def test_a_one_sided_interval_is_caught(copy: Any, baseline: Path) -> None:
    """A lower end of a confidence interval that is gone or moved."""
    rows = [
        replace(row, ci_low=None if row.set == "mean" else row.ci_low)
        for row in read_rows(copy.tables / "regression.csv", Coefficient)
    ]
    write_rows(copy.tables, Coefficient, rows)
    found = check_tables(load_baseline(baseline), copy.tables).failed
    assert {(row.in_table, row.in_column, row.outcome) for row in found} == {("regression", "ci_low", "missing")}


def test_the_sign_of_a_bias_is_caught(copy: Any, baseline: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """1/bias in place of bias."""
    honest = ensemble.bias_and_scatter

    def swapped(reference: Any, predicted: Any, scatter: float) -> Any:
        return honest(predicted, reference, scatter)

    monkeypatch.setattr(ensemble, "bias_and_scatter", swapped)
    found = _rebuilt(copy, baseline)
    assert ("consequence", "ensemble", "bias") in found


def test_a_larger_mesh_error_of_a_reference_is_caught(copy: Any, baseline: Path) -> None:
    """Two per cent to fifty: assessments flip to `cannot tell`, and the uncertainty they depend on has moved."""
    for record in (copy.references / "fe").rglob("*.yaml"):
        record.write_text(record.read_text(encoding="utf-8").replace("mesh_error: 0.02", "mesh_error: 0.5"))
    found = _rebuilt(copy, baseline)
    assert {row[0] for row in found[:10]} == {"flip"}
    assert ("flip", "errors", "assessment") in found
    assert ("rule", "errors", "u_data") in found


@pytest.mark.parametrize("kind", [Ensemble, Sensitivity, Difference, Residual, ClaimRow, MetricRow])
def test_a_number_that_moved_by_a_thousandth_is_caught_in_every_table(
    kind: type[TableRow], copy: Any, baseline: Path
) -> None:
    """The tables that nothing held: one number of the first row that has one, by a thousandth of itself and of one."""
    rows = list(read_rows(copy.tables / f"{kind.table}.csv", kind))
    name = {"ensemble": "largest_abs_error", "sensitivity": "value", "claims": "computed", "errors": "error"}.get(
        kind.table, "residual_N" if kind is Residual else "difference"
    )
    index = next(i for i, row in enumerate(rows) if getattr(row, name) not in (None, 0.0))
    rows[index] = replace(rows[index], **{name: getattr(rows[index], name) * 1.001 + 0.001})
    write_rows(copy.tables, kind, rows)
    (found,) = check_tables(load_baseline(baseline), copy.tables).failed
    assert (found.in_table, found.in_column) == (kind.table, name)


def test_a_tolerance_of_the_code_is_a_rule(copy: Any, baseline: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The default for forces from ten to fifty per cent, in the catalogue."""
    wide = {**catalogue.SCALAR, "peak_normal_force": replace(catalogue.SCALAR["peak_normal_force"], tolerance=0.5)}
    monkeypatch.setattr(tolerance, "SCALAR", wide)
    found = _rebuilt(copy, baseline)
    assert found[0][0] == "flip"
    assert ("rule", "tolerances", "value") in found
    assert ("rule", "errors", "tolerance") in found
