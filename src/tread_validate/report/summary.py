"""The first screen: what was asked, and how far the models can be trusted, in sentences made from the tables."""

from __future__ import annotations

from typing import Any

from . import wording
from .content import Mark, Tone, Verdict, Verdicts
from .marks import Marks
from .results import count_verdicts
from .tables import Tables, number

LEAD = (
    "How far can a spring model of a tread block be trusted? Every case of the study is run with the spring models "
    "and, where a finite element (FE) run of the same block on the same path exists, compared with it; both are held "
    "against what the paper published.",
)
CAVEAT = (
    "The FE runs are another model of the same study, not measurements. Agreement with them shows that the simpler "
    "model keeps what the finer one predicts; only the published rig values are validation."
)


def summary(tables: Tables, marks: Marks, delta: tuple[Tone, str] | None) -> Verdicts:
    """Return the verdict lines."""
    lines = [_references(tables, marks)]
    for pair in _pairs(tables):
        lines += [line for line in (_forces(tables, marks, pair), _shape(tables, marks, pair)) if line is not None]
    lines.append(_claims(tables, marks))
    lines.append(_slopes(tables, marks))
    if delta is not None:
        lines.append(Verdict("Has anything moved since the accepted baseline?", delta[1], delta[0], _moved(delta[0]), (), "baseline"))
    lines.append(_foundations(marks))
    return Verdicts(tuple(lines))


def _pairs(tables: Tables) -> list[tuple[str, str]]:
    frame = tables.ensemble
    return list(dict.fromkeys(zip(frame["predicted_source"], frame["reference_source"], strict=True)))


def _references(tables: Tables, marks: Marks) -> Verdict:
    """Say how many FE references are current, in words."""
    frame = tables.peaks
    texts: list[str] = []
    worst: Tone = "good"
    for source in tables.sources("fe"):
        states = [str(value) for value in frame.loc[frame["source"] == source, "status"]]
        counts = {state: states.count(state) for state in dict.fromkeys(states)}
        current = counts.pop("current", 0)
        text = f"{wording.source(source)}: {current} of {wording.plural(len(states), 'case')} have a current run"
        others = [f"{count} – {wording.status(state)}" for state, count in sorted(counts.items())]
        texts.append(text + (" (" + "; ".join(others) + ")" if others else "") + ".")
        if others:
            worst = "warn" if current else "bad"
    if not texts:
        return Verdict("Is there a reference for every case?", "No FE reference runs are recorded.", "bad", "none", (), "cases")
    label = {"good": "all current", "warn": "incomplete", "bad": "none current"}[worst]
    return Verdict("Is there a reference for every case?", " ".join(texts), worst, label, (), "cases")


def _row(tables: Tables, pair: tuple[str, str], quantity: str, metric: str) -> dict[str, Any] | None:
    frame = tables.ensemble
    chosen = frame[
        (frame["predicted_source"] == pair[0])
        & (frame["reference_source"] == pair[1])
        & (frame["quantity"] == quantity)
        & (frame["metric"] == metric)
        & (frame["group"] == "all")
    ]
    records = chosen.to_dict("records")
    return {str(key): value for key, value in records[0].items()} if records else None


def _forces(tables: Tables, marks: Marks, pair: tuple[str, str]) -> Verdict | None:
    row = _row(tables, pair, "peak_normal_force", "scalar")
    if row is None:
        return None
    question = f"{wording.source(pair[0])}: does it give the FE peak forces ({wording.source(pair[1])})?"
    if not number(row["compared"]):
        reason = str(row["note"] or "") or "no current reference"
        return Verdict(question, f"Not answered: {reason}.", "unknown", "cannot tell", marks.of(row["assumed"]), "results")
    errors = tables.errors
    mine = errors[
        (errors["predicted_source"] == pair[0])
        & (errors["reference_source"] == pair[1])
        & (errors["quantity"] == "peak_normal_force")
    ]
    counts = count_verdicts(mine)
    bias, scatter = number(row["bias"]), number(row["model_scatter"])
    parts = [f"Peak normal force: mean |error| {wording.percent(number(row['mean_abs_error']))}"]
    parts.append(f"largest {wording.percent(number(row['largest_abs_error']))} ({row['largest_case_id']})")
    if bias is not None:
        parts.append(f"bias δ = {wording.digits(bias)}")
    if scatter is not None:
        parts.append(f"scatter {wording.percent(scatter)}")
    text = ", ".join(parts) + f". {_counted(counts)}."
    tangential = _row(tables, pair, "peak_positive_tangential_force", "scalar")
    if tangential is not None and number(tangential["compared"]):
        size = number(tangential["mean_abs_error"])
        kind, unit = str(tangential["error_type"]), str(tangential["unit"])
        shown = wording.percent(size) if kind == "relative" else f"{wording.digits(size)} {unit}"
        text += f" Peak tangential force: mean |error| {shown}."
    return Verdict(question, text, _tone(counts), _label(counts), marks.of(row["assumed"]), "results")


def _shape(tables: Tables, marks: Marks, pair: tuple[str, str]) -> Verdict | None:
    normal = _row(tables, pair, "normal_force", "relative_rms")
    tangential = _row(tables, pair, "tangential_force", "relative_rms")
    if normal is None or tangential is None or not number(normal["compared"]):
        return None
    frame = tables.errors
    mine = frame[
        (frame["predicted_source"] == pair[0])
        & (frame["reference_source"] == pair[1])
        & (frame["metric"] == "iso18571_r")
    ]
    grades: dict[str, dict[str, int]] = {}
    for quantity, grade in zip(mine["quantity"], mine["note"], strict=True):
        if str(grade) in ("excellent", "good", "fair", "poor"):
            counts = grades.setdefault(str(quantity), {})
            counts[str(grade)] = counts.get(str(grade), 0) + 1
    text = (
        f"Relative RMS error over the pass: normal {wording.percent(number(normal['mean_abs_error']))}, tangential "
        f"{wording.percent(number(tangential['mean_abs_error']))} of the reference's peak, on average."
    )
    for quantity, counts in grades.items():
        order = [f"{counts[g]} {g}" for g in ("excellent", "good", "fair", "poor") if g in counts]
        text += f" ISO/TS 18571, {wording.quantity(quantity).lower()}: {', '.join(order)}."
    question = f"{wording.source(pair[0])}: does it give the shape of the force histories?"
    return Verdict(question, text, "unknown", "graded", marks.of(normal["assumed"]), "results")


def _claims(tables: Tables, marks: Marks) -> Verdict:
    counts = count_verdicts(tables.claims)
    claims = tables.claims["claim_id"].nunique()
    text = f"{wording.plural(claims, 'published statement')} checked, some against more than one model. {_counted(counts)}."
    return Verdict(
        "Do the models reproduce what the paper states?",
        text,
        _tone(counts),
        _label(counts),
        marks.of_column(tables.claims["assumed"]),
        "claims",
    )


def _slopes(tables: Tables, marks: Marks) -> Verdict:
    frame = tables.regression[(tables.regression["set"] == "mean") & (tables.regression["coefficient"] == "a_v")]
    texts: list[str] = []
    for shape in dict.fromkeys(str(value) for value in frame["shape"]):
        values = []
        for record in frame[frame["shape"] == shape].to_dict("records"):
            value = number(record["value"])
            if value is not None:
                values.append(f"{wording.source(str(record['source']))} {100 * value:.1f}".replace("-", "−"))
        texts.append(f"{shape.capitalize()}, % per m/s: " + ", ".join(values) + ".")
    different = tables.regression_differences
    count = sum(str(value).lower() in ("true", "1", "1.0") for value in different["significant"])
    if len(different):
        texts.append(f"{count} of {wording.plural(len(different), 'pair')} of coefficients differ significantly.")
    return Verdict(
        "Is the effect of speed and temperature right?",
        " ".join(texts) or "No regressions.",
        "unknown",
        "see Table 1",
        marks.of_column(frame["assumed"]),
        "table1",
    )


def _foundations(marks: Marks) -> Verdict:
    known = marks.all()
    if not known:
        return Verdict("What does this rest on?", "No input is assumed or synthetic.", "good", "published or measured", (), "inputs")
    names = "; ".join(f"{mark.code} {mark.text.split(':')[0]}" for mark in known)
    text = f"{wording.plural(len(known), 'input')} assumed or synthetic: {names}. Every number they touch carries their tags."
    return Verdict("What does this rest on?", text, "warn", "assumptions", known, "inputs")


def _counted(counts: dict[str, int]) -> str:
    words = (
        ("agrees", "agree within uncertainty"),
        ("disagrees", "disagree"),
        ("cannot tell", "cannot be told"),
        ("none", "without a verdict"),
    )
    return "Verdicts: " + ", ".join(f"{counts[key]} {text}" for key, text in words if counts[key] or key != "none")


def _tone(counts: dict[str, int]) -> Tone:
    if counts["disagrees"]:
        return "bad" if counts["disagrees"] >= counts["agrees"] else "warn"
    return "good" if counts["agrees"] and not counts["cannot tell"] else "unknown"


def _label(counts: dict[str, int]) -> str:
    if not (counts["agrees"] or counts["disagrees"]):
        return "cannot tell"
    if counts["disagrees"] == 0:
        return "agrees" if not counts["cannot tell"] else "agrees in part"
    return "disagrees" if counts["agrees"] == 0 else "agrees in part"


def _moved(tone: Tone) -> str:
    return {"good": "unchanged", "bad": "moved"}.get(tone, "not checked")


def mark_codes(marks: tuple[Mark, ...]) -> str:
    """Write marks as text, for places that have no links."""
    return " ".join(f"{mark.origin} {mark.code}" for mark in marks)
