"""The first screen: what was asked, and how far the models can be trusted, in sentences made from the tables."""

from __future__ import annotations

from ..compare.tables import Ensemble, MetricRow
from . import wording
from .content import Tone, Verdict, Verdicts
from .marks import Marks
from .results import count_verdicts
from .tables import Tables, pairs_of

LEAD = (
    "Every case of the study is run with the spring models of a tread block. Where a finite element (FE) run of the "
    "same block on the same path exists, the two are compared; both are held against what the paper published.",
)
CAVEAT = (
    "The FE runs are a second model of the same study, not measurements: agreement with them is verification of the "
    "simpler model against the finer one. Only the published rig values are validation."
)
PEAKS = ("peak_normal_force", "peak_positive_tangential_force", "peak_negative_tangential_force")

MOST_OPEN = 0.1  # share of verdicts that may be `cannot tell` where the label says `agrees`


def summary(tables: Tables, marks: Marks, delta: tuple[Tone, str] | None) -> Verdicts:
    """Return the verdict lines."""
    pairs = pairs_of(tables.ensemble)
    answered = [pair for pair in pairs if _compared(tables, pair)]
    lines = [_model(tables, marks, pair) for pair in answered]
    lines += [_claims(tables, marks), _slopes(tables, marks), _references(tables)]
    lines += [_unanswered(tables, [pair for pair in pairs if pair not in answered])]
    if delta is not None:
        question = "Has anything moved since the accepted baseline?"
        lines.append(Verdict(question, delta[1], delta[0], _moved(delta[0]), (), "baseline"))
    lines.append(_foundations(marks))
    return Verdicts(tuple(line for line in lines if line is not None))


def _references(tables: Tables) -> Verdict:
    """Say how many FE references are current, in words."""
    texts: list[str] = []
    worst: Tone = "good"
    for source in tables.sources("fe"):
        states = [row.status for row in tables.peaks if row.source == source]
        counts = {state: states.count(state) for state in dict.fromkeys(states)}
        current = counts.pop("current", 0)
        text = f"{wording.source(source)}: {current} of {wording.plural(len(states), 'case')} have a current run"
        others = [f"{count} – {wording.status(state)}" for state, count in sorted(counts.items())]
        texts.append(text + (" (" + "; ".join(others) + ")" if others else "") + ".")
        if others:
            worst = "warn" if current else "bad"
    if not texts:
        return Verdict(
            "Is there a reference for every case?", "No FE reference runs are recorded.", "bad", "none", (), "cases"
        )
    label = {"good": "all current", "warn": "incomplete", "bad": "none current"}[worst]
    return Verdict("Is there a reference for every case?", " ".join(texts), worst, label, (), "cases")


def _model(tables: Tables, marks: Marks, pair: tuple[str, str]) -> Verdict | None:
    """Say how well one model gives forces and histories; the verdict counts normal and tangential peaks alike."""
    row = tables.statistics(pair, PEAKS[0])
    if row is None:
        return None
    mine = tables.of_pair(pair)
    parts = [f"mean |error| {_size(row)}"]
    parts.append(f"largest {wording.percent(row.largest_abs_error)} ({row.largest_case_id})")
    parts += [f"bias δ = {wording.digits(row.bias)}"] if row.bias is not None else []
    parts += [f"scatter σ = {wording.percent(row.model_scatter)}"] if row.model_scatter is not None else []
    normal = count_verdicts(item for item in mine if item.quantity == PEAKS[0])
    tangential = count_verdicts(item for item in mine if item.quantity in PEAKS[1:])
    text = f"Peak normal force: {', '.join(parts)}. {_counted(normal)}."
    text += _tangential(tables, pair, tangential) + _histories(tables, pair) + _grades(mine)
    counts = {key: normal[key] + tangential[key] for key in normal}
    question = f"{wording.source(pair[0])}: does it give the forces of {wording.source(pair[1])}?"
    return Verdict(question, text, _tone(counts), _label(counts), marks.of(row.assumed), "results")


def _compared(tables: Tables, pair: tuple[str, str]) -> bool:
    row = tables.statistics(pair, PEAKS[0])
    return row is not None and row.compared > 0


def _unanswered(tables: Tables, pairs: list[tuple[str, str]]) -> Verdict | None:
    """Name, in one line, the comparisons for which there is nothing to compare with."""
    if not pairs:
        return None
    found: dict[str, list[str]] = {}
    for predicted, reference in pairs:
        row = tables.statistics((predicted, reference), PEAKS[0])
        reason = wording.status(row.status) if row is not None else "no row"
        if reference.startswith("rig:"):
            reason = "no measured record of a pass has been imported"
        found.setdefault(f"{wording.source(reference)}: {reason}", []).append(wording.source(predicted))
    texts = [f"{reason}; so there is nothing to hold {', '.join(names)} against." for reason, names in found.items()]
    return Verdict("What could not be compared?", " ".join(texts), "unknown", "cannot tell", (), "results")


def _tangential(tables: Tables, pair: tuple[str, str], counts: dict[str, int]) -> str:
    row = tables.statistics(pair, PEAKS[1])
    if row is None or not row.compared:
        return ""
    return f" Peak tangential forces: mean |error| {_size(row)} towards the leading edge. {_counted(counts)}."


def _histories(tables: Tables, pair: tuple[str, str]) -> str:
    found = []
    for quantity, name in (("normal_force", "normal"), ("tangential_force", "tangential")):
        row = tables.statistics(pair, quantity, "relative_rms")
        if row is not None and row.compared:
            found.append(f"{_size(row)}{' of the peak' if row.error_type == 'relative' else ''} ({name})")
    return f" Histories: mean RMS error {' and '.join(found)}." if found else ""


def _size(row: Ensemble) -> str:
    """Write a mean error in per cent or, where it is judged so, in its unit."""
    size = row.mean_abs_error
    return wording.percent(size) if row.error_type == "relative" else f"{wording.digits(size)} {row.unit}"


def _grades(errors: list[MetricRow]) -> str:
    text = ""
    for quantity, name in (("normal_force", "normal"), ("tangential_force", "tangential")):
        grades = [row.grade for row in errors if (row.quantity, row.metric) == (quantity, "iso18571_r")]
        found = [f"{grades.count(g)} {g}" for g in ("excellent", "good", "fair", "poor") if g in grades]
        if found:
            text += f" ISO/TS 18571, {name}: {', '.join(found)}."
    return text


def _claims(tables: Tables, marks: Marks) -> Verdict:
    judged = [row for row in tables.claims if row.kind == "model" and row.status != "not_compared"]
    counts = count_verdicts(judged)
    statements = wording.plural(len({row.claim_id for row in judged}), "published statement")
    per_source = []
    for name in dict.fromkeys(row.source for row in judged):
        own = count_verdicts(row for row in judged if row.source == name)
        told = f"{own['agrees']} agree, {own['disagrees']} disagree"
        open_ = f", {own['cannot tell']} cannot be told" if own["cannot tell"] else ""
        per_source.append(f"{wording.source(name)}: {told}{open_}")
    text = f"{statements} predicted here. {'; '.join(per_source)}."
    tuned = len({row.claim_id for row in tables.claims if row.kind == "tuned"})
    if tuned:
        text += f" Not counted: {tuned} that the stand-in compound was made to meet."
    return Verdict(
        "Do the models reproduce what the paper states?",
        text,
        _tone(counts),
        _label(counts),
        marks.of_column(row.assumed for row in judged),
        "claims",
    )


def _slopes(tables: Tables, marks: Marks) -> Verdict:
    means = [row for row in tables.regression if row.set == "mean"]
    texts: list[str] = []
    for coefficient, name in (("a_v", "Speed, % per m/s"), ("a_theta", "Temperature, % per °C")):
        values: dict[str, list[str]] = {}
        for row in means:
            if row.coefficient == coefficient and row.value is not None:
                shown = wording.percent(row.value, 1 if coefficient == "a_v" else 2).removesuffix("%").strip()
                values.setdefault(row.source, []).append(shown)
        own = [f"{wording.source(source)} {' and '.join(found)}" for source, found in values.items()]
        texts.append(f"{name} ({' and '.join(dict.fromkeys(row.shape for row in means))}): {'; '.join(own)}.")
    different = tables.differences
    count = sum(bool(row.significant) for row in different)
    if different:
        texts.append(f"{count} of {wording.plural(len(different), 'pair')} of coefficients differ significantly.")
    return Verdict(
        "Is the effect of speed and temperature right?",
        " ".join(texts) or "No regressions.",
        "unknown",
        "see Table 1",
        marks.of_column(row.assumed for row in means),
        "table1",
    )


def _foundations(marks: Marks) -> Verdict:
    known = marks.all()
    if not known:
        return Verdict(
            "What does this rest on?",
            "No input is assumed or synthetic.",
            "good",
            "published or measured",
            (),
            "inputs",
        )
    names = "; ".join(f"{mark.code} {mark.text.split(':')[0]}" for mark in known)
    text = f"{wording.plural(len(known), 'input')} assumed or synthetic: {names}. Numbers that rest on them carry tags."
    return Verdict("What does this rest on?", text, "warn", "assumptions", known, "inputs")


def _counted(counts: dict[str, int]) -> str:
    words = (
        ("agrees", "good enough"),
        ("disagrees", "not"),
        ("cannot tell", "cannot be told"),
    )
    return "Verdicts: " + ", ".join(f"{counts[key]} {text}" for key, text in words)


def _tone(counts: dict[str, int]) -> Tone:
    if counts["disagrees"]:
        return "bad" if counts["disagrees"] >= counts["agrees"] else "warn"
    return "good" if _label(counts) == "agrees" else "unknown"


def _label(counts: dict[str, int]) -> str:
    """Say `agrees` only where nothing disagrees and nearly everything could be told."""
    told = counts["agrees"] + counts["disagrees"]
    if not told:
        return "cannot tell"
    if counts["disagrees"] == 0:
        return "agrees" if counts["cannot tell"] <= MOST_OPEN * (told + counts["cannot tell"]) else "agrees in part"
    return "disagrees" if counts["agrees"] == 0 else "agrees in part"


def _moved(tone: Tone) -> str:
    return {"good": "unchanged", "bad": "moved"}.get(tone, "not checked")
