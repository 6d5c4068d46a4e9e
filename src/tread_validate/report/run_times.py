"""The page of run times beside the report: what every rule of the workflow took, and in which run."""

from __future__ import annotations

import datetime
import html
from collections.abc import Sequence
from pathlib import Path

from ..files import write_text
from .landing import HEAD
from .workflow import JobTime, WorkflowRule, job_times, read_rules

STYLE = "table { border-collapse: collapse; width: 100%; } th, td { text-align: left; padding: .25rem .6rem; } "
STYLE += "td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; } tr { border-bottom: 1px solid #8884; }"
HELP = (
    "Seconds and memory of every job as Snakemake's benchmarks measured them. A report is made again only where an "
    "input changed, so that most times may be of an earlier run."
)


def write_run_times(graph: Path, out: Path, began: float | None = None, root: Path = Path()) -> None:
    """Write the page.

    Parameters
    ----------
    graph : path
        The workflow's note of its rules.
    began : float, optional
        When the present run began, in seconds of the epoch; without it no time is said to be of this run.
    root : path
        What the benchmark patterns are relative to.
    """
    rules = read_rules(graph)
    times = job_times(rules, root)
    head = HEAD.replace("Tread-block validation reports", "Run times of the workflow").replace(
        "</style>", STYLE + "</style>"
    )
    rows = "\n".join(_row(rule, [time for time in times if time.rule == rule.name], began) for rule in rules)
    titles = ("Rule", "Jobs", "Sum, s", "Longest, s", "Processor, s", "Memory, MB", "Measured (UTC)")
    header = "".join(f'<th scope="col"{_side(index)}>{title}</th>' for index, title in enumerate(titles))
    body = f"<p>{html.escape(HELP)}</p>\n<table>\n<thead><tr>{header}</tr></thead>\n<tbody>\n{rows}\n</tbody></table>\n"
    write_text(out, f'{head}{body}<p><a href="index.html">The report</a></p>\n</body>\n</html>\n')


def _row(rule: WorkflowRule, times: Sequence[JobTime], began: float | None) -> str:
    if not times:
        words = "has not run here" if rule.benchmark else "is not timed"
        return f"<tr><td>{html.escape(rule.name)}</td><td class=n>–</td><td colspan=5>{words}</td></tr>"
    longest = max(times, key=lambda time: time.seconds)
    cpu = [time.cpu_seconds for time in times if time.cpu_seconds is not None]
    memory = [time.memory for time in times if time.memory is not None]
    cells = (
        rule.name, f"{len(times)}", f"{sum(time.seconds for time in times):.1f}",
        f"{longest.seconds:.1f}" + (f" ({longest.job})" if longest.job else ""),
        f"{sum(cpu):.1f}" if cpu else "–", f"{max(memory):.0f}" if memory else "–", _when(times, began),
    )  # fmt: skip
    return "<tr>" + "".join(f"<td{_side(i)}>{html.escape(cell)}</td>" for i, cell in enumerate(cells)) + "</tr>"


def _when(times: Sequence[JobTime], began: float | None) -> str:
    last = datetime.datetime.fromtimestamp(max(time.ended for time in times), datetime.UTC)
    words = f"{last:%Y-%m-%d %H:%M}"
    if began is None:
        return words
    earlier = sum(time.ended < began for time in times)
    if earlier == len(times):
        return f"{words}, an earlier run"
    return f"{words}, this run" + (f"; {earlier} of an earlier run" if earlier else "")


def _side(index: int) -> str:
    return " class=n" if 0 < index < 6 else ""
