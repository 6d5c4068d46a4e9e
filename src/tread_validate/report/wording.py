"""The report's words for table keys: sources, quantities, metrics, assessments, and numbers with their units."""

from __future__ import annotations

import math

from ..compare.quantities import HISTORIES, HISTORY_METRICS, SCALARS
from .content import Tone

QUANTITIES = {item.name: item.label for item in SCALARS} | {"peak_pressure": "Peak pressure"}
QUANTITIES |= HISTORIES
METRICS = {"scalar": ""} | {item.name: item.label for item in HISTORY_METRICS}
SIGNED = ("scalar", "sprague_geers_m")
GROUPS = {
    "all": "all cases",
    "rig": "rig",
    "belt": "tyre belt",
    "track": "flat track",
    "rectangle": "rig, rectangle",
    "parallelogram": "rig, parallelogram",
    "published": "rig, 0.1 and 0.2 mm",
}
TONES: dict[str, Tone] = {
    "agrees": "good", "disagrees": "bad", "cannot tell": "unknown", "adequate": "good", "inadequate": "bad",
}  # fmt: skip
NBSP = "\u00a0"
SYMBOLS = {"agrees": "✓", "disagrees": "✗", "cannot tell": "?", "adequate": "✓", "inadequate": "✗"}
ASSESSMENTS = {"adequate": "good enough", "inadequate": "not good enough"}
STATUSES = {
    "current": "current",
    "missing": "without a run",
    "stale": "stale (made from another deck, inputs or code)",
    "not_a_reference": "not a reference: its energy balance or its forces cannot be believed",
    "other_code": "made before the engine's code changed",
    "unbound": "not bound to what they were made from",
    "corrupt": "failing their checksum",
    "no_contact": "no contact",
    "failed": "failed",
    "incomplete": "incomplete",
    "undefined": "not defined here",
    "not_given": "not given by one of the two",
    "not_applicable": "not applicable: the study's inputs are not the paper's",
}


def source(key: str) -> str:
    """Name a source: ``spring:paper`` becomes ``Springs of the paper``; a model of the user's own has its own name."""
    kind, _, name = key.partition(":")
    known = {
        "rig:published": "Rig (published)",
        "fe:published": "FE (published)",
        "rig:measured": "Rig (measured)",
        "fe:embedded": "Built-in explicit FE",
        "fe:abaqus": "FE (ABAQUS)",
        "fe:calculix": "FE (CalculiX)",
        "spring:paper": "Springs of the paper",
        "spring:shape_factor": "Shape-factor springs",
        "spring:condensed": "Condensed-FE model",
        "study": "Study",
    }
    if key in known:
        return known[key]
    if kind == "model":
        return name
    prefix = {"spring": "Springs", "fe": "FE", "rig": "Rig"}.get(kind, kind)
    return f"{prefix} ({name})" if name else prefix


def quantity(key: str, metric: str = "scalar") -> str:
    """Name a quantity with its metric."""
    words = QUANTITIES.get(key, key.replace("_", " ").capitalize())
    extra = METRICS.get(metric, metric.replace("_", " "))
    return f"{words}: {extra}" if extra else words


def group(key: str) -> str:
    """Name a group of cases."""
    return GROUPS.get(key, key.replace("_", " "))


def assessment(key: str) -> str:
    """Write an assessment with its symbol, so that colour is never its only carrier."""
    return f"{SYMBOLS[key]} {ASSESSMENTS.get(key, key)}" if key in SYMBOLS else key


def status(key: str) -> str:
    """Write a status out in words."""
    return STATUSES.get(key, key)


def digits(value: float | None, figures: int = 3) -> str:
    """Write a number with `figures` significant digits and a true minus sign; nothing is an en dash."""
    if value is None or math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if value == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    rounded = round(value, figures - 1 - exponent)
    if rounded != 0.0:
        exponent = math.floor(math.log10(abs(rounded)))
    if exponent < -4 or exponent > 6:
        mantissa = f"{rounded / 10.0**exponent:.{figures - 1}f}"
        power = str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        return f"{mantissa}·10{power}".replace("-", "−")
    return f"{rounded:.{max(0, figures - 1 - exponent)}f}".replace("-", "−")


def plain(value: float | None, figures: int = 6) -> str:
    """Write a number with up to `figures` significant digits and no zeros that say nothing."""
    if value is None:
        return "–"
    text = digits(value, figures)
    return text.rstrip("0").rstrip(".") if "." in text and "·" not in text else text


def unit(text: str) -> str:
    """Write a unit as a reader expects it; a number without a unit has none."""
    return {"1": "", "-": "", "degC": "°C", "1/degC": "1/°C", "%/degC": "%/°C", "deg": "°"}.get(text, text)


_unit = unit


def signed(text: str) -> str:
    """Put a plus sign before a positive number that has none."""
    return text if text[:1] in "-−–+∞" or text == "0" else f"+{text}"


def percent(value: float | None, decimals: int = 1, sign: bool = False) -> str:
    """Write a fraction in per cent."""
    if value is None or math.isnan(value):
        return "–"
    text = f"{100.0 * value:.{decimals}f}"
    if float(text) == 0.0:
        return f"{text.removeprefix('-')}{NBSP}%"
    text = signed(text) if sign else text
    return text.replace("-", "−") + f"{NBSP}%"


def error(value: float | None, error_type: str, unit: str = "", metric: str = "scalar") -> str:
    """Write an error as its type asks: relative in per cent, absolute in its unit, a score as it is."""
    if value is None:
        return "–"
    if error_type == "relative":
        return percent(value, sign=metric in SIGNED)
    if error_type == "score":
        return digits(value)
    return f"{signed(digits(value)) if metric in SIGNED else digits(value)} {unit}".strip()


def size(value: float | None, error_type: str, unit: str = "") -> str:
    """Write the size of an error or of an uncertainty: per cent, or two digits in its unit; a score as it is."""
    if value is None:
        return "–"
    if error_type == "relative":
        return f"below 0.1{NBSP}%" if 0.0 < abs(value) < 5e-4 else percent(value)
    return f"{digits(value, 2)} {_unit(unit)}".strip()


def in_sentence(name: str) -> str:
    """Name a source as it stands within a sentence."""
    told = source(name)
    return f"the {told[0].lower()}{told[1:]}" if name == "fe:embedded" else told


def sliding(shares: tuple[float, float] | None) -> str:
    """Say how much of the face slides, weighted with N: without sliding, T is a matter of stiffness alone."""
    if shares is None:
        return "sliding area not known"
    return f"sliding area {percent(shares[1])}, reference {percent(shares[0])}"


def path(key: str) -> str:
    """Name a path of the study."""
    return {"rig": "the two-wheel rig", "simplified": "the tyre belt", "mid_top": "the tyre belt"}.get(
        key, f"path {key.replace('_', ' ')}"
    )


def plain_text(value: object) -> str:
    """Write a cell of a table that the report does not know: sources by name, yes and no, a dash for nothing."""
    text = str(value).strip()
    if text.lower() in ("", "nan", "none"):
        return "–"
    if text.startswith(("spring:", "fe:", "rig:", "model:")) and " " not in text:
        return source(text)
    return {"true": "yes", "false": "no"}.get(text.lower(), text)


def plural(count: int, one: str, many: str | None = None) -> str:
    """Write ``1 case``, ``2 cases``."""
    return f"{count} {one if count == 1 else many or one + 's'}"
