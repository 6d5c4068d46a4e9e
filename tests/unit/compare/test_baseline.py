"""The regression check: what counts as moved, new, missing and stale; what may be accepted."""

from __future__ import annotations

import hashlib
import json
import subprocess
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.cli.app import run as tread_validate
from tread_validate.compare.baseline.accept import accept
from tread_validate.compare.baseline.delta import Check, check_tables
from tread_validate.compare.baseline.movement import movements
from tread_validate.compare.baseline.output import delta_csv, delta_junit, delta_markdown, summary
from tread_validate.compare.baseline.store import Acceptance, load_baseline, save_baseline
from tread_validate.compare.baseline.trend import read_trend
from tread_validate.compare.binding import write_provenance
from tread_validate.compare.tables import Delta, MetricRow, PeakRow, TableRow, read_rows, write_rows
from tread_validate.errors import InputError

FACTS = Acceptance("a test", "somebody", "2026-01-01T00:00:00Z", "0123456789ab", "0.1.0", "liu2010", "digest")
CASE = "rig-rectangle-22c-0p1mm-150rpm"


@pytest.fixture
def baseline(workspace: Any, tmp_path: Path) -> Path:
    """The workspace's tables as a baseline."""
    save_baseline(tmp_path / "baseline", workspace.tables, FACTS)
    return tmp_path / "baseline"


def changed(folder: Path, kind: type[TableRow], which: dict[str, Any], **values: Any) -> int:
    """Change columns of the rows of a table that have the given values; return how many rows it were."""
    rows, count = [], 0
    for row in read_rows(folder / f"{kind.table}.csv", kind):
        if all(getattr(row, name) == value for name, value in which.items()):
            row, count = replace(row, **values), count + 1
        rows.append(row)
    assert count
    write_rows(folder, kind, rows)
    write_provenance(folder, json.loads((folder / "provenance.json").read_text(encoding="utf-8")))
    return count


def peak(folder: Path) -> PeakRow:
    """Return the spring run of one case."""
    rows = read_rows(folder / "peaks.csv", PeakRow)
    return next(row for row in rows if (row.source, row.case_id) == ("spring:paper", CASE))


def moved(copy: Any, baseline: Path, newtons: float) -> Check:
    """Move one peak normal force and check."""
    row = peak(copy.tables)
    force = row.values["peak_normal_force"]
    assert force is not None
    values = {**row.values, "peak_normal_force": force + newtons}
    changed(copy.tables, PeakRow, {"source": "spring:paper", "case_id": CASE}, values=values)
    return check_tables(load_baseline(baseline), copy.tables)


@pytest.mark.parametrize(("newtons", "passes"), [(-1e-3, False), (1e-3, False), (-1e-4, True), (1e-4, True)])
def test_a_move_beyond_noise_fails_in_either_direction(newtons: float, passes: bool, copy: Any, baseline: Path) -> None:
    """A peak of 31 N may move by 5e-6 of itself and 5e-5 N, 2.07e-4 N: 1e-3 N is 4.8 times that, 1e-4 N is half."""
    check = moved(copy, baseline, newtons)
    (found,) = check.deltas
    assert (found.kind, found.outcome, found.passed) == ("run", "within" if passes else "moved", passes)
    assert found.times_noise == pytest.approx(abs(newtons) / 2.07e-4, rel=0.05)
    assert found.unit == "N"


def test_no_change_is_no_change(workspace: Any, baseline: Path) -> None:
    """The accepted tables against themselves: nothing at all differs, and every row of eleven tables was looked at."""
    check = check_tables(load_baseline(baseline), workspace.tables)
    assert check.deltas == ()
    lines = sum(len(path.read_text(encoding="utf-8").splitlines()) - 1 for path in workspace.tables.glob("*.csv"))
    assert check.rows == pytest.approx(lines, abs=40)  # statements and sources with line breaks apart
    assert summary(check) == f"{check.rows} rows, all within noise of the baseline (0 numbers moved at all)"


def test_new_missing_and_stale_rows_fail(copy: Any, baseline: Path) -> None:
    """A row on one side only, a value that is gone, a run that is stale: all failures, each by its name."""
    rows = list(read_rows(copy.tables / "peaks.csv", PeakRow))
    gone = rows.pop(0)
    rows[0] = replace(rows[0], status="stale")
    rows[1] = replace(rows[1], values={**rows[1].values, "normal_impulse": None})
    rows.append(replace(rows[2], case_id="another"))
    write_rows(copy.tables, PeakRow, rows)
    found = {(row.case_id, row.outcome) for row in check_tables(load_baseline(baseline), copy.tables).failed}
    assert found == {
        (gone.case_id, "missing"),
        (rows[0].case_id, "stale"),
        (rows[1].case_id, "missing"),
        ("another", "new"),
    }


def test_flips_come_first_then_rules_then_moves_then_what_follows(copy: Any, baseline: Path) -> None:
    """One flipped assessment, a changed tolerance, a moved peak, a moved error: in this order, however far out."""
    changed(copy.tables, MetricRow, {"case_id": CASE, "quantity": "contact_duration"}, error=0.5)
    key = {"case_id": CASE, "quantity": "peak_normal_force", "reference_source": "fe:embedded"}
    changed(copy.tables, MetricRow, key, assessment="agrees")
    changed(copy.tables, MetricRow, {"case_id": CASE, "quantity": "normal_impulse"}, tolerance=0.2)
    check = moved(copy, baseline, 1e-3)
    assert [row.kind for row in check.failed] == ["flip", "rule", "run", "consequence"]
    assert len(check.flips) == 1
    assert summary(check).startswith("1 assessments flipped; 4 of")


def test_the_change_is_written_for_people_and_for_ci_systems(copy: Any, baseline: Path) -> None:
    """Markdown of a screen, however much moved, that links the worst case; JUnit whose names do not change."""
    rows = read_rows(copy.tables / "errors.csv", MetricRow)
    spoilt = [
        replace(row, error=row.error * 1.5, assessment="cannot tell") if row.error is not None else row for row in rows
    ]
    write_rows(copy.tables, MetricRow, spoilt)
    accepted = load_baseline(baseline)
    check = check_tables(accepted, copy.tables)
    page = delta_markdown(check, accepted.acceptance, movements(accepted, copy.tables), "index.html")
    assert len(page.splitlines()) <= 60
    assert page.index("assessment of") < page.index("better") < page.index("times noise")
    assert "](index.html#case=" in page
    assert "| 0 | 28 |" in page
    root = ET.fromstring(delta_junit(check, [("peaks", "spring:paper")]).split("\n", 1)[1])
    assert [suite.get("name") for suite in root] == ["assessments", "numbers"]
    assert (root.get("tests"), root.get("failures")) == ("4", "2")
    assert delta_csv(check).count("\n") == len(check.deltas) + 1


def test_names_cannot_break_the_page_or_the_xml(copy: Any, baseline: Path) -> None:
    """Markup, a control character and a pipe in a case's name: escaped in Markdown, legal in XML."""
    changed(copy.tables, PeakRow, {"source": "spring:paper", "case_id": CASE}, case_id="a|b<script>\x01&")
    accepted = load_baseline(baseline)
    check = check_tables(accepted, copy.tables)
    page = delta_markdown(check, accepted.acceptance, ())
    assert "a\\|b\\<script\\>" in page
    assert "<script>" not in page
    ET.fromstring(delta_junit(check, []).split("\n", 1)[1])


def test_a_baseline_comes_back_as_it_was_saved(workspace: Any, baseline: Path) -> None:
    """Tables and record round-trip, the tables byte for byte."""
    loaded = load_baseline(baseline)
    assert loaded.acceptance == FACTS
    for name, rows in loaded.tables.items():
        assert (baseline / f"{name}.csv").read_bytes() == (workspace.tables / f"{name}.csv").read_bytes()
        assert rows
    assert loaded.rows == sum(map(len, loaded.tables.values()))


def test_a_baseline_that_is_not_whole_is_refused(baseline: Path, tmp_path: Path) -> None:
    """None at all, another schema version, a table edited, cut or gone, no reason: one line each."""
    with pytest.raises(InputError, match="accept"):
        load_baseline(tmp_path / "nothing")
    record = yaml.safe_load((baseline / "baseline.yaml").read_text(encoding="utf-8"))
    peaks = (baseline / "peaks.csv").read_text(encoding="utf-8")

    def refused(match: str, changes: dict[str, Any], text: str = peaks) -> None:
        kept = {key: value for key, value in {**record, **changes}.items() if value is not ...}
        (baseline / "baseline.yaml").write_text(yaml.safe_dump(kept), encoding="utf-8")
        (baseline / "peaks.csv").write_text(text, encoding="utf-8")
        with pytest.raises(InputError, match=match):
            load_baseline(baseline)

    refused("schema_version: got 1, expected 2; accept", {"schema_version": 1})
    refused("reason", {"reason": ...})
    refused("checksum", {}, peaks.replace("31.45", "32.45"))
    header = peaks.splitlines()[0] + "\n"
    facts = {"rows": 0, "sha256": hashlib.sha256(header.encode()).hexdigest()}
    refused("no accepted runs", {"tables": {**record["tables"], "peaks": facts}}, header)
    refused("0 rows", {"tables": {**record["tables"], "peaks": {**facts, "rows": 56}}}, header)
    (baseline / "peaks.csv").unlink()
    with pytest.raises(InputError, match=r"peaks\.csv: got no such file"):
        load_baseline(baseline)


@pytest.mark.parametrize("noise", [[1e9, 0.0], [0.0, 1e9], [5e-6, 1e-3], [float("nan"), 0.0], [-1.0, 0.0], "wide"])
def test_a_noise_that_would_hide_a_change_is_refused_even_in_a_whole_record(noise: Any, baseline: Path) -> None:
    """Every digest is right; the accepted noise of a peak force is not that of any processor."""
    path = baseline / "baseline.yaml"
    record = yaml.safe_load(path.read_text(encoding="utf-8"))
    record["noise"]["peak_normal_force"] = noise
    path.write_text(yaml.safe_dump(record), encoding="utf-8")
    with pytest.raises(InputError, match=r"noise\.peak_normal_force"):
        load_baseline(baseline)


def test_another_noise_of_the_code_is_a_change_of_rule(workspace: Any, baseline: Path) -> None:
    """A baseline that was accepted under half the noise says so."""
    path = baseline / "baseline.yaml"
    record = yaml.safe_load(path.read_text(encoding="utf-8"))
    record["noise"]["peak_normal_force"] = [2.5e-6, 5e-5]
    path.write_text(yaml.safe_dump(record), encoding="utf-8")
    (found,) = check_tables(load_baseline(baseline), workspace.tables).failed
    assert (found.kind, found.quantity, found.in_column) == ("rule", "peak_normal_force", "noise")


def test_a_column_that_the_baseline_lacks_is_said_once(workspace: Any, baseline: Path) -> None:
    """A table of an older form is compared in what both have."""
    path = baseline / "sensitivity.csv"
    lines = [line.rsplit(",", 1)[0] for line in path.read_text(encoding="utf-8").splitlines()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    record = yaml.safe_load((baseline / "baseline.yaml").read_text(encoding="utf-8"))
    record["tables"]["sensitivity"]["sha256"] = hashlib.sha256(path.read_bytes()).hexdigest()
    (baseline / "baseline.yaml").write_text(yaml.safe_dump(record), encoding="utf-8")
    (found,) = check_tables(load_baseline(baseline), workspace.tables).failed
    assert (found.outcome, found.in_table, found.in_column) == ("new", "sensitivity", "change")


def test_accept_needs_a_reason_a_clean_tree_and_current_runs(
    workspace: Any, copy: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A short reason, a dirty tree, tables of another commit, no repository, a stale run: refused; told so: accepted,
    and a second time the trend has grown by as many rows and kept the first ones.
    """
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
    assert load_baseline(repository / "baseline").tables == made.tables
    first = read_trend(repository / "baseline")
    again = accept(workspace.tables, repository / "baseline", "another reason", allow_dirty=True, when="2027-01-01")
    assert again.rows == made.rows
    both = read_trend(repository / "baseline")
    assert both[: len(first)] == first
    assert len(both) == 2 * len(first) > 0
    git("commit", "-q", "-a", "-m", "change")
    monkeypatch.setattr("tread_validate.compare.baseline.accept.commit", lambda: "feedfeedfeed")
    with pytest.raises(InputError, match="expected feedfeedfeed"):
        accept(workspace.tables, repository / "baseline", "a good reason")
    changed(copy.tables, PeakRow, {"source": "fe:embedded", "case_id": CASE}, status="stale")
    with pytest.raises(InputError, match=rf"fe:embedded, {CASE}: got stale"):
        accept(copy.tables, repository / "baseline", "a good reason", allow_dirty=True)


def test_check_ends_with_one_where_a_cell_moved(copy: Any, baseline: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit codes 0 and 1 through the command line; the delta table names the cell; --report-only ends with 0."""
    arguments = ["check", str(copy.tables), "--baseline", str(baseline)]
    assert tread_validate(arguments) == 0
    moved(copy, baseline, 1.0)
    junit = copy.folder / "check.xml"
    assert tread_validate([*arguments, "--junit", str(junit), "--markdown", str(copy.folder / "check.md")]) == 1
    said = capsys.readouterr()
    assert f"moved: peaks: spring:paper, {CASE}: peak_normal_force_N" in said.out
    assert "1 moved" in said.err
    assert ET.parse(junit).getroot().get("failures") == "1"
    (row,) = read_rows(copy.tables / "delta.csv", Delta)
    assert row.change == pytest.approx(1.0)
    assert tread_validate([*arguments, "--report-only"]) == 0


def test_a_model_that_iterates_has_wider_noise(copy: Any, baseline: Path) -> None:
    """A peak that moves by twice the noise fails; under the name of the condensed face it passes (five times)."""
    width = 2.07e-4
    assert moved(copy, baseline, 2.0 * width).failed
    for folder in (copy.tables, baseline):
        path = folder / "peaks.csv"
        path.write_text(path.read_text(encoding="utf-8").replace("spring:paper", "spring:condensed"), encoding="utf-8")
    record = yaml.safe_load((baseline / "baseline.yaml").read_text(encoding="utf-8"))
    record["tables"]["peaks"]["sha256"] = hashlib.sha256((baseline / "peaks.csv").read_bytes()).hexdigest()
    (baseline / "baseline.yaml").write_text(yaml.safe_dump(record), encoding="utf-8")
    check = check_tables(load_baseline(baseline), copy.tables)
    assert not check.failed
    assert len(check.deltas) == 1


@pytest.mark.parametrize("verb", ["check", "accept", "assessment", "report"])
@pytest.mark.parametrize("damage", ["lines", "gone"])
def test_a_table_that_is_not_as_it_was_written_is_refused(
    verb: str, damage: str, copy: Any, baseline: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Half of its rows lost, or the file: one line with the file and the command that makes it anew."""
    path = copy.tables / "ensemble.csv"
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    path.unlink()
    if damage == "lines":
        path.write_text("".join(lines[: len(lines) // 2]), encoding="utf-8")
    before = {file: file.read_bytes() for file in baseline.iterdir()}
    tables, study = str(copy.tables), str(copy.study)
    command = {
        "check": ["check", tables, "--baseline", str(baseline)],
        "accept": ["accept", tables, "--baseline", str(baseline), "--reason", "a good reason", "--allow-dirty"],
        "assessment": ["assessment", study, "--tables", tables, "--reports", str(copy.folder / "reports")],
        "report": ["report", study, "--tables", tables, "-o", str(copy.folder / "page")],
    }[verb]
    assert tread_validate(command) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "ensemble.csv: got " in said
    assert "(mend: tread-validate tables " in said
    assert {file: file.read_bytes() for file in baseline.iterdir()} == before


def test_tables_of_another_study_are_refused(copy: Any, baseline: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A baseline says nothing about another study: wrong input, not a failed check."""
    facts = copy.tables / "provenance.json"
    facts.write_text(facts.read_text(encoding="utf-8").replace("liu2010", "other"), encoding="utf-8")
    assert tread_validate(["check", str(copy.tables), "--baseline", str(baseline)]) == 2
    assert "got other, expected liu2010" in capsys.readouterr().err
