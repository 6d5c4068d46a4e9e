"""The assessment of a study as a badge: SVG drawn here, or JSON in the layout of shields.io's endpoint badge."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import read_text

LABEL = "tread_validate"
GREEN, AMBER, RED, GREY = "#2e7d32", "#b26a00", "#c62828", "#5f6368"  # white text on each: contrast 4.5:1 at least
HEIGHT, MARGIN, ADVANCE = 20, 7, 6.6  # px; mean advance of 11 px sans-serif text, to which it is then stretched
HEADLINE = ("peak_normal_force", "scalar")


@dataclass(frozen=True)
class Badge:
    """A badge's words and the colour (``#rrggbb``) behind the message."""

    message: str
    color: str
    label: str = LABEL

    def as_svg(self) -> str:
        """Return the badge as a stand-alone SVG of 20 px height."""
        left, right = (round(2 * MARGIN + ADVANCE * len(text)) for text in (self.label, self.message))
        label, message = escape(self.label), escape(self.message)

        def text(words: str, start: int, width: int) -> str:
            return (
                f'<text x="{start + width / 2:g}" y="14" text-anchor="middle" textLength="{width - 2 * MARGIN}" '
                f'lengthAdjust="spacingAndGlyphs">{words}</text>'
            )

        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + right}" height="{HEIGHT}" role="img" '
            f'aria-label="{label}: {message}">\n'
            f"<title>{label}: {message}</title>\n"
            f'<rect width="{left}" height="{HEIGHT}" fill="#3c4043"/>\n'
            f'<rect x="{left}" width="{right}" height="{HEIGHT}" fill="{self.color}"/>\n'
            f'<g fill="#fff" font-family="Verdana, DejaVu Sans, sans-serif" font-size="11">\n'
            f"{text(label, 0, left)}\n{text(message, left, right)}\n</g>\n</svg>\n"
        )

    def as_json(self) -> str:
        """Return the badge for an endpoint, https://shields.io/badges/endpoint-badge."""
        facts = {"schemaVersion": 1, "label": self.label, "message": self.message, "color": self.color}
        return json.dumps(facts, indent=1) + "\n"


def badge_of(summary: Path, model: str = "") -> Badge:
    """Return the badge of a study from its ``summary.json``; or that of one model of it.

    Of a study: whether assessments flipped or rows moved since the baseline. Of a model: in how many cases the peak
    normal force is good enough.

    Raises
    ------
    InputError
        For a file that is no summary, and a model that is not in it.
    """
    facts = _read(summary)
    compared = [entry for entry in facts["models"] if any(item["compared"] for item in entry["quantities"])]
    if model:
        return _of_model(facts, model, summary)
    if not compared:
        return Badge("nothing compared", GREY)
    found = facts["baseline"]
    if found is None:
        return Badge("no baseline", GREY)
    if found["flips"]:
        return Badge(_counted(len(found["flips"]), "assessment") + " flipped", RED)
    if found["moved_rows"]:
        return Badge(_counted(found["moved_rows"], "row") + " moved", AMBER)
    return Badge("no assessment flipped", GREEN)


def _of_model(facts: Mapping[str, Any], model: str, summary: Path) -> Badge:
    names = list(dict.fromkeys(entry["model"] for entry in facts["models"]))
    full = model if model in names else next((name for name in names if name.partition(":")[2] == model), "")
    if not full:
        raise InputError("--model", model, f"one of {', '.join(names) or 'none'}, the models of {summary}")
    own = [item for entry in facts["models"] if entry["model"] == full for item in entry["quantities"]]
    head = next((item for item in own if (item["quantity"], item["metric"]) == HEADLINE and item["compared"]), None)
    if head is None:
        return Badge(f"{full}: nothing compared", GREY)
    share = head["adequate"] / head["cases"]
    color = GREEN if share == 1.0 else AMBER if share >= 0.5 else RED if head["inadequate"] else GREY
    return Badge(f"{full}: peak N good enough in {head['adequate']} of {head['cases']}", color)


def _counted(number: int, word: str) -> str:
    return f"{number} {word}" + ("" if number == 1 else "s")


def _read(path: Path) -> Mapping[str, Any]:
    try:
        facts = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}:{error.lineno}", error.msg, "JSON") from None
    if not isinstance(facts, dict) or not {"models", "baseline", "schema_version"} <= facts.keys():
        raise InputError(path, "no models and baseline", "a summary.json that `tread-validate check` wrote")
    return facts
