"""The workflow as the report tells it: who needs whom, what ran when."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tread_validate.errors import InputError
from tread_validate.report.run_times import write_run_times
from tread_validate.report.workflow import WorkflowRule, ancestors, columns, direct, job_times, read_rules

NOTE = (
    "decks;;logs/decks.tsv\nspring;;logs/spring-{variant}.tsv\ntables;decks,spring;\nreport;decks,tables;logs/r.tsv\n"
)
HEAD = "s\th:m:s\tmax_rss\tmax_vms\tcpu_time\n"


@pytest.fixture
def rules(tmp_path: Path) -> tuple[WorkflowRule, ...]:
    (tmp_path / "workflow.txt").write_text(NOTE)
    (tmp_path / "logs").mkdir()
    for name, seconds in (("decks", "2.0"), ("spring-paper", "3.5"), ("spring-own", "1.5")):
        file = tmp_path / "logs" / f"{name}.tsv"
        file.write_text(f"{HEAD}{seconds}\t0:00:02\t100.0\t1\tNA\n")
        os.utime(file, (1000.0, 1000.0) if name == "decks" else (2000.0, 2000.0))
    return read_rules(tmp_path / "workflow.txt")


def test_rules_stand_right_of_what_they_need(rules: tuple[WorkflowRule, ...]) -> None:
    """Exact: three columns; an arrow that another way implies is left out."""
    assert [[rule.name for rule in column] for column in columns(rules)] == [
        ["decks", "spring"],
        ["tables"],
        ["report"],
    ]
    assert ancestors(rules, "report") == {"decks", "spring", "tables"}
    assert direct(rules, rules[-1]) == ("tables",)


def test_rules_in_a_circle_are_refused(tmp_path: Path) -> None:
    """Exact: they could be placed nowhere."""
    (tmp_path / "w.txt").write_text("a;b;\nb;a;\n")
    with pytest.raises(InputError, match="circle"):
        columns(read_rules(tmp_path / "w.txt"))


@pytest.mark.parametrize("note", ["a;b", "a;unknown;", ";;"])
def test_damaged_note_is_refused(tmp_path: Path, note: str) -> None:
    """Exact: one line that says what was expected."""
    (tmp_path / "w.txt").write_text(note + "\n")
    with pytest.raises(InputError):
        read_rules(tmp_path / "w.txt")


def test_times_are_those_of_the_benchmarks(rules: tuple[WorkflowRule, ...], tmp_path: Path) -> None:
    """Exact: a job a file, named by its wildcards; what was not measured is None."""
    found = {(time.rule, time.job): time for time in job_times(rules, tmp_path)}
    assert set(found) == {("decks", ""), ("spring", "own"), ("spring", "paper")}
    assert found["spring", "paper"].seconds == 3.5
    assert found["decks", ""].cpu_seconds is None


def test_page_tells_a_time_of_this_run_from_one_of_an_earlier_run(
    rules: tuple[WorkflowRule, ...], tmp_path: Path
) -> None:
    """Exact: by the time at which the run began; without it, no time is said to be of this run."""
    write_run_times(tmp_path / "workflow.txt", tmp_path / "t.html", began=1500.0, root=tmp_path)
    rows = {row.split("</td>")[0].split("<td>")[-1]: row for row in (tmp_path / "t.html").read_text().split("<tr>")}
    assert "an earlier run" in rows["decks"]
    assert "this run" in rows["spring"]
    assert "5.0" in rows["spring"]
    assert "3.5 (paper)" in rows["spring"]
    assert "has not run here" in rows["report"]
    assert "is not timed" in rows["tables"]
    write_run_times(tmp_path / "workflow.txt", tmp_path / "t.html", root=tmp_path)
    assert "this run" not in (tmp_path / "t.html").read_text()
