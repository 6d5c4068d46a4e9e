"""The workflow's rules, which needs which, and how long their jobs took, as Snakemake noted and measured it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError
from ..files import read_text
from ..text_table import read_text_table
from .tables import number

MEASURED = ("s", "max_rss", "cpu_time")  # columns of a Snakemake benchmark: seconds, MB, seconds


@dataclass(frozen=True)
class WorkflowRule:
    """A rule: its name, the rules whose files it reads, and the pattern of its benchmark files (empty: not timed)."""

    name: str
    needs: tuple[str, ...]
    benchmark: str = ""


@dataclass(frozen=True)
class JobTime:
    """What one job took: wall and processor seconds, largest resident memory in MB, and when it ended (s, epoch)."""

    rule: str
    job: str
    seconds: float
    cpu_seconds: float | None
    memory: float | None
    ended: float


def read_rules(path: Path) -> tuple[WorkflowRule, ...]:
    """Read the workflow's note of its rules: ``name;needed,needed;benchmark pattern`` a line."""
    found = []
    for line, text in enumerate(read_text(path).splitlines(), start=1):
        parts = text.split(";")
        if len(parts) != 3 or not parts[0]:
            raise InputError(f"{path}:{line}", text, "name;needed rules;benchmark")
        found.append(WorkflowRule(parts[0], tuple(filter(None, parts[1].split(","))), parts[2]))
    names = {rule.name for rule in found}
    unknown = [name for rule in found for name in rule.needs if name not in names]
    if unknown:
        raise InputError(path, f"the unknown rule {unknown[0]}", "rules of the workflow")
    return tuple(found)


def job_times(rules: Sequence[WorkflowRule], root: Path = Path()) -> tuple[JobTime, ...]:
    """Return the times of all jobs whose benchmark file is there; patterns are relative to `root`."""
    return tuple(time for rule in rules if rule.benchmark for time in _times(rule, root))


def _times(rule: WorkflowRule, root: Path) -> list[JobTime]:
    pattern = re.sub(r"{[^}]*}", "*", rule.benchmark)
    names = re.compile(re.sub(r"\\{[^}]*\\}", "(.+)", re.escape(rule.benchmark)))
    found = []
    for file in sorted(root.glob(pattern)):
        match = names.fullmatch(file.relative_to(root).as_posix())
        table = read_text_table(file, "\t")
        table.check(MEASURED)
        for _, row in table.records():
            seconds, memory, cpu = (number(row[name]) for name in MEASURED)
            if seconds is not None and match is not None:
                job = " ".join(match.groups())
                found.append(JobTime(rule.name, job, seconds, cpu, memory, file.stat().st_mtime))
    return found


def ancestors(rules: Sequence[WorkflowRule], name: str) -> set[str]:
    """Return the rules that a rule needs, directly or not."""
    needs = {rule.name: rule.needs for rule in rules}
    found: set[str] = set()
    open_ = list(needs.get(name, ()))
    while open_:
        one = open_.pop()
        if one not in found:
            found.add(one)
            open_ += needs.get(one, ())
    return found


def direct(rules: Sequence[WorkflowRule], rule: WorkflowRule) -> tuple[str, ...]:
    """Return what a rule needs, less what another of its needs needs already."""
    implied = {name for need in rule.needs for name in ancestors(rules, need)}
    return tuple(name for name in rule.needs if name not in implied)


def columns(rules: Sequence[WorkflowRule]) -> list[list[WorkflowRule]]:
    """Place the rules in columns: each stands right of all that it needs."""
    place: dict[str, int] = {}
    left = list(rules)
    while left:
        ready = [rule for rule in left if all(name in place for name in rule.needs)]
        if not ready:
            raise InputError("workflow", f"rules in a circle: {left[0].name}", "rules that need no file of themselves")
        for rule in ready:
            place[rule.name] = 1 + max((place[name] for name in rule.needs), default=-1)
        left = [rule for rule in left if rule.name not in place]
    return [[rule for rule in rules if place[rule.name] == at] for at in range(1 + max(place.values(), default=-1))]
