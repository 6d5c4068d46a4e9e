"""The regression check: what counts as moved, new, missing and stale; what may be accepted."""

from __future__ import annotations

import subprocess
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.cli.app import run as tread_validate
from tread_validate.compare.baseline.accept import accept
from tread_validate.compare.baseline.delta import deltas
from tread_validate.compare.baseline.output import delta_csv, delta_junit, delta_markdown, summary
from tread_validate.compare.baseline.rows import BaselineRow, rows_of_tables
from tread_validate.compare.baseline.store import Acceptance, Baseline, load_baseline, save_baseline
from tread_validate.errors import InputError

ROW = BaselineRow(
    "scalar", "spring:paper", "", "case-a", "peak_normal_force", "scalar", "N", 100.0, "", "current", 0.001
)  # fmt: skip
FACTS = Acceptance("a test", "somebody", "2026-01-01T00:00:00Z", "0123456789ab", "0.1.0", "study", "digest")


@pytest.mark.parametrize("change", [-0.0015, 0.0015])
def test_a_move_beyond_tolerance_fails_in_either_direction(change: float) -> None:
    """Tolerance 0.001 N, change -+0.0015 N: 1.5 times out, both ways."""
    (found,) = deltas([ROW], [replace(ROW, value=100.0 + change)])
    assert (found.outcome, found.passed) == ("moved", False)
    assert found.times_tolerance == pytest.approx(1.5, rel=1e-6)


@pytest.mark.parametrize("change", [-0.0009, 0.0, 0.0009])
def test_a_move_within_tolerance_passes(change: float) -> None:
    """Below 0.001 N: within."""
    (found,) = deltas([ROW], [replace(ROW, value=100.0 + change)])
    assert found.passed


def test_new_missing_and_stale_rows_fail() -> None:
    """A row on one side only, a value that is gone, a status that is stale or corrupt: all failures."""
    other = replace(ROW, case_id="case-b")
    outcomes = {row.case_id: row.outcome for row in deltas([ROW], [other])}
    assert outcomes == {"case-a": "missing", "case-b": "new"}
    gone = replace(ROW, value=None, status="missing")
    assert deltas([ROW], [gone])[0].outcome == "missing"
    assert deltas([gone], [ROW])[0].outcome == "new"
    for status in ("stale", "corrupt"):
        stale = replace(ROW, value=None, status=status)
        assert deltas([ROW], [stale])[0].outcome == "stale"
        assert deltas([stale], [stale])[0].outcome == "stale"


def test_a_row_that_is_missing_on_both_sides_is_unchanged() -> None:
    """A reference that was not there when the baseline was accepted and still is not: no change."""
    gone = replace(ROW, value=None, status="missing")
    assert deltas([gone], [gone])[0].passed


def test_another_verdict_or_other_inputs_fail() -> None:
    """Words must not change at all."""
    claim = replace(ROW, kind="claim", text="agrees")
    assert deltas([claim], [replace(claim, text="disagrees")])[0].outcome == "changed"
    inputs = replace(ROW, kind="case", value=None, text="a" * 64, tolerance=0.0)
    assert deltas([inputs], [replace(inputs, text="b" * 64)])[0].note == "the case has other inputs"


def test_the_furthest_out_comes_first() -> None:
    """Sorted by failure, then by how many tolerances a row has moved."""
    rows = [replace(ROW, case_id=f"case-{i}") for i in range(4)]
    moved = [replace(row, value=100.0 + step) for row, step in zip(rows, (0.0005, 0.002, 0.1, -0.01), strict=True)]
    assert [row.case_id for row in deltas(rows, moved)] == ["case-2", "case-3", "case-1", "case-0"]


def test_the_delta_is_written_for_people_and_for_ci_systems() -> None:
    """CSV holds what moved; JUnit counts failures and stays XML whatever the names hold; Markdown escapes."""
    odd = replace(ROW, case_id="a|b<script>\x01&")
    rows = deltas([ROW, odd], [ROW, replace(odd, value=101.0)])
    assert delta_csv(rows).count("\n") == 2
    assert summary(rows) == "1 of 2 rows fail: 1 moved"
    root = ET.fromstring(delta_junit(rows).split("\n", 1)[1])
    assert (root.get("tests"), root.get("failures")) == ("2", "1")
    assert len(root.findall(".//failure")) == 1
    page = delta_markdown(rows, FACTS)
    assert "a\\|b\\<script\\>" in page
    assert "<script>" not in page


def test_a_baseline_comes_back_as_it_was_saved(tmp_path: Path) -> None:
    """Rows and record round-trip."""
    save_baseline(tmp_path, Baseline((ROW, replace(ROW, case_id="case-b", value=None)), FACTS))
    loaded = load_baseline(tmp_path)
    assert loaded.acceptance == FACTS
    assert loaded.rows == (ROW, replace(ROW, case_id="case-b", value=None))


def test_a_baseline_that_is_not_whole_is_refused(tmp_path: Path) -> None:
    """None at all, another schema version, empty, edited by hand, without a reason: one line each."""
    with pytest.raises(InputError, match="accept"):
        load_baseline(tmp_path)
    with pytest.raises(InputError, match="no rows"):
        save_baseline(tmp_path, Baseline((), FACTS))
    save_baseline(tmp_path, Baseline((ROW,), FACTS))
    record = yaml.safe_load((tmp_path / "baseline.yaml").read_text(encoding="utf-8"))
    rows = (tmp_path / "rows.csv").read_text(encoding="utf-8")

    def refused(match: str, changes: dict[str, Any], text: str = rows) -> None:
        kept = {key: value for key, value in {**record, **changes}.items() if value is not ...}
        (tmp_path / "baseline.yaml").write_text(yaml.safe_dump(kept), encoding="utf-8")
        (tmp_path / "rows.csv").write_text(text, encoding="utf-8")
        with pytest.raises(InputError, match=match):
            load_baseline(tmp_path)

    refused("schema_version: got 2, expected 1", {"schema_version": 2})
    refused("reason", {"reason": ...})
    refused("checksum", {}, rows.replace("100", "101"))
    header = rows.splitlines()[0] + "\n"
    import hashlib

    refused("header only", {"rows_sha256": hashlib.sha256(header.encode()).hexdigest()}, header)


def test_accept_needs_a_reason_a_clean_tree_and_current_rows(
    workspace: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A short reason, a dirty tree, tables of another commit, no repository: refused; told so: accepted."""
    repository = tmp_path / "repository"
    repository.mkdir()
    monkeypatch.chdir(repository)

    def git(*arguments: str) -> None:
        subprocess.run(
            ["git", "-c", "user.name=Tester", "-c", "user.email=t@example.org", *arguments], check=True,
            capture_output=True,
        )  # fmt: skip

    with pytest.raises(InputError, match="no git repository"):
        accept(workspace.tables, repository / "baseline", "a good reason")
    git("init", "-q")
    (repository / "code.py").write_text("1\n", encoding="utf-8")
    git("add", "code.py")
    git("commit", "-q", "-m", "start")
    with pytest.raises(InputError, match="--reason"):
        accept(workspace.tables, repository / "baseline", "  ok ")
    (repository / "code.py").write_text("2\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"uncommitted changes, first code\.py"):
        accept(workspace.tables, repository / "baseline", "a good reason")
    made = accept(workspace.tables, repository / "baseline", "a good reason", allow_dirty=True, who="Tester")
    assert (made.acceptance.reason, made.acceptance.who) == ("a good reason", "Tester")
    assert made.acceptance.when.endswith("Z")
    assert load_baseline(repository / "baseline").rows == made.rows
    git("commit", "-q", "-a", "-m", "change")
    monkeypatch.setattr("tread_validate.compare.baseline.accept.commit", lambda: "feedfeedfeed")
    with pytest.raises(InputError, match="expected feedfeedfeed"):
        accept(workspace.tables, repository / "baseline", "a good reason")


def test_check_ends_with_one_where_a_row_moved(workspace: Any, copy: Any, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit codes 0 and 1 through the command line; the delta table names the row; --report-only ends with 0."""
    baseline = copy.folder / "baseline"
    accept(workspace.tables, baseline, "a good reason", allow_dirty=True)
    arguments = ["check", str(copy.tables), "--baseline", str(baseline)]
    assert tread_validate(arguments) == 0
    peaks = copy.tables / "peaks.csv"
    line = next(line for line in peaks.read_text(encoding="utf-8").splitlines() if line.startswith("spring:paper"))
    cells = line.split(",")
    cells[9] = f"{float(cells[9]) * 0.99:.7g}"
    peaks.write_text(peaks.read_text(encoding="utf-8").replace(line, ",".join(cells)), encoding="utf-8")
    junit = copy.folder / "check.xml"
    assert tread_validate([*arguments, "--junit", str(junit)]) == 1
    said = capsys.readouterr()
    assert "peak_normal_force" in said.out
    assert "1 moved" in said.err
    assert ET.parse(junit).getroot().get("failures") == "1"
    assert (copy.tables / "delta.csv").read_text(encoding="utf-8").count("\n") == 2
    assert tread_validate([*arguments, "--report-only"]) == 0


def test_a_model_that_iterates_has_wider_tolerances(workspace: Any, copy: Any) -> None:
    """The same table under the name of the coupled springs: five times the tolerance, to the four digits printed."""
    for table in copy.tables.glob("*.csv"):
        text = table.read_text(encoding="utf-8")
        table.write_text(text.replace("spring:paper", "spring:coupled"), encoding="utf-8")
    narrow = [row for row in rows_of_tables(workspace.tables) if row.source == "spring:paper"]
    wide = [row for row in rows_of_tables(copy.tables) if row.source == "spring:coupled"]
    assert len(narrow) == len(wide) > 0
    for a, b in zip(narrow, wide, strict=True):
        assert b.tolerance == pytest.approx(5.0 * a.tolerance, rel=1e-3)


def test_tables_of_another_study_are_refused(workspace: Any, copy: Any, capsys: pytest.CaptureFixture[str]) -> None:
    """A baseline says nothing about another study: wrong input, not a failed check."""
    baseline = copy.folder / "baseline"
    accept(workspace.tables, baseline, "a good reason", allow_dirty=True)
    facts = copy.tables / "provenance.json"
    facts.write_text(facts.read_text(encoding="utf-8").replace("liu2010", "other"), encoding="utf-8")
    assert tread_validate(["check", str(copy.tables), "--baseline", str(baseline)]) == 2
    assert "got other, expected liu2010" in capsys.readouterr().err


def test_tables_without_rows_are_refused(copy: Any) -> None:
    """An empty comparison is an error, not a pass."""
    path = copy.tables / "errors.csv"
    path.write_text(path.read_text(encoding="utf-8").splitlines()[0] + "\n", encoding="utf-8")
    with pytest.raises(InputError, match="header only"):
        rows_of_tables(copy.tables)
