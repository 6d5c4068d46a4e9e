"""One colour, dash and marker for each source: the Okabe-Ito palette, told apart in grey as well by dash and marker."""

from __future__ import annotations

from dataclasses import dataclass

# Okabe and Ito, "Color Universal Design", https://jfly.uni-koeln.de/color/
BLACK, BLUE, VERMILION, GREEN = "#000000", "#0072B2", "#D55E00", "#009E73"
PURPLE, ORANGE, SKY, GREY = "#CC79A7", "#E69F00", "#56B4E9", "#6b737c"


@dataclass(frozen=True)
class Look:
    """How one source is drawn, by matplotlib and in the page."""

    color: str
    line: str
    dash: str
    marker: str
    symbol: str


_REFERENCE = (
    Look(BLACK, "-", "solid", "s", "square"),
    Look(GREY, (0, (6, 2)), "longdash", "D", "diamond"),  # type: ignore[arg-type]  # matplotlib's dashes are wider than its types
    Look(SKY, (0, (6, 2)), "longdash", "P", "cross"),  # type: ignore[arg-type]  # matplotlib's dashes are wider than its types
)
_MODEL = (
    Look(BLUE, "--", "dash", "o", "circle"),
    Look(VERMILION, "-.", "dashdot", "^", "triangle-up"),
    Look(GREEN, ":", "dot", "v", "triangle-down"),
    Look(PURPLE, (0, (3, 1, 1, 1, 1, 1)), "longdashdot", "X", "x"),  # type: ignore[arg-type]  # matplotlib's dashes are wider than its types
    Look(ORANGE, (0, (1, 1)), "dot", "*", "star"),  # type: ignore[arg-type]  # matplotlib's dashes are wider than its types
)


def looks(references: list[str], models: list[str]) -> dict[str, Look]:
    """Return the look of every source, in the given order; a longer list starts over."""
    found = {name: _REFERENCE[i % len(_REFERENCE)] for i, name in enumerate(references)}
    return found | {name: _MODEL[i % len(_MODEL)] for i, name in enumerate(models)}
