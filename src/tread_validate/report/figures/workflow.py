"""The workflow's rule graph."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch

from ...palette import BLUE
from ..workflow import WorkflowRule, ancestors, columns, direct
from .style import Drawn, draw

WIDE, HIGH = 1.65, 0.6  # inches a column and a row
HALF = 0.3  # of a box, in columns
FAINT = "#9aa3ab"
LAST = "report"


def rule_graph(folder: Path, rules: Sequence[WorkflowRule]) -> Drawn:
    """Draw the rules in columns, each right of what it needs; what the report does not wait for is grey."""
    placed = columns(rules)
    waited = ancestors(rules, LAST) | {LAST}
    # within a column, near the mean height of what is needed, so that few lines cross
    height: dict[str, float] = {}
    for column in placed:
        column.sort(key=lambda rule: (rule.name not in waited, _mean(rule, height), rule.name))
        height |= {rule.name: float(index) for index, rule in enumerate(column)}
    across = {rule.name: float(index) for index, column in enumerate(placed) for rule in column}
    deepest = max((len(column) for column in placed), default=1)

    def paint(axes: Axes) -> None:
        for rule in rules:
            color = BLUE if rule.name in waited else FAINT
            for name in direct(rules, rule):
                start, end = (across[name] + HALF, height[name]), (across[rule.name] - HALF, height[rule.name])
                axes.annotate(
                    "",
                    end,
                    start,
                    arrowprops={"arrowstyle": "-|>", "color": color, "lw": 0.9, "shrinkA": 0, "shrinkB": 0},
                )
            corner = (across[rule.name] - HALF, height[rule.name] - 0.32)
            axes.add_patch(
                FancyBboxPatch(corner, 2 * HALF, 0.64, boxstyle="round,pad=0,rounding_size=0.05", fc="white", ec=color)
            )
            words = rule.name.replace("_", "\n", 1)
            axes.text(
                across[rule.name], height[rule.name], words, ha="center", va="center", fontsize=8, linespacing=1.0
            )
        axes.set(xlim=(-0.5, len(placed) - 0.5), ylim=(deepest - 0.45, -0.55))
        axes.set_axis_off()

    numbers = (("rule", "needs"), [(rule.name, " ".join(rule.needs)) for rule in rules])
    caption = (
        "Blue: what the report waits for; grey: what runs when it is asked for. An arrow leads to a rule that needs "
    )
    caption += "files of the other; where another way says so already, none is drawn."
    size = (WIDE * len(placed), HIGH * deepest + 0.1)
    return draw(folder, "rule-graph", "Rules of the workflow", caption, paint, (), size, wide=True, numbers=numbers)


def _mean(rule: WorkflowRule, height: dict[str, float]) -> float:
    known = [height[name] for name in rule.needs if name in height]
    return sum(known) / len(known) if known else 0.0
