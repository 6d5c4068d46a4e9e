"""The first screen: what was compared with what, a row for every model, and what the reader must know beside it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from ..compare.tables import ClaimRow
from . import wording
from .content import Fact, Figure, FirstScreen, Table, Tone
from .marks import Marks
from .tables import Tables, pairs_of

NOTHING = "Nothing could be compared: no run of any model has a reference of the same problem."
CAVEAT = (
    "The FE runs are a second model of the same study, not measurements: agreement with them verifies the simpler "
    "model against the finer one. Only values measured on the rig, published or imported, validate."
)


def first_screen(
    tables: Tables, marks: Marks, models: Table, moved: tuple[Tone, str] | None, picture: Figure | None
) -> FirstScreen:
    """Return the first screen's content."""
    facts = [references(tables), _baseline(moved), _inputs(tables, marks), _unanswered(tables)]
    facts += [_published(tables, marks), _slopes(tables, marks)]
    alarm = "" if any(row.error is not None for row in tables.errors) else NOTHING
    return FirstScreen(sentence(tables), models, tuple(fact for fact in facts if fact is not None), alarm, picture)


def sentence(tables: Tables) -> str:
    """Say in one sentence what was compared with what."""
    cases = wording.plural(len(tables.cases), "case")
    models = [name for name in dict.fromkeys(row.predicted_source for row in tables.errors) if name[:3] != "fe:"]
    counts = Counter(row.reference_source for row in tables.errors if row.error is not None)
    who = wording.plural(len(models), "model")
    if not counts:
        return f"{who} ran on {cases}."
    references = " and ".join(wording.in_sentence(name) for name in counts)
    paths = " and ".join(dict.fromkeys(wording.path(row.path) for row in tables.cases))
    return f"{who} compared with {references} on {cases} of {paths}."


def references(tables: Tables) -> Fact:
    """Say how many reference runs are current, made by other code, stale or missing."""
    texts: list[str] = []
    worst: Tone = "good"
    for source in tables.sources("fe"):
        states = Counter(row.status for row in tables.peaks if row.source == source)
        total, current = sum(states.values()), states.pop("current", 0)
        others = [f"{count} {wording.status(state)}" for state, count in sorted(states.items())]
        texts.append("; ".join([f"{wording.source(source)}: {current} of {total} current", *others]))
        if others:
            worst = "warn" if current and worst != "bad" else "bad"
    if not texts:
        return Fact("References", "no FE reference runs are recorded", "bad", "cases")
    return Fact("References", ". ".join(texts), worst, "provenance")


def _published(tables: Tables, marks: Marks) -> Fact | None:
    """Count, of the statements that models predict about cases of this study, how many agree with the paper."""
    unanswered = ("not_applicable", "not_compared", "missing")
    judged = [row for row in tables.claims if row.kind == "model" and row.status not in unanswered]
    if not judged:
        return None
    texts = []
    for name in dict.fromkeys(row.source for row in judged):
        own = count_claims(row for row in judged if row.source == name)
        texts.append(f"{wording.source(name)} {own['agrees']} of {sum(own.values())}")
    text = f"{'; '.join(texts)} agree"
    return Fact("Published statements", text, "", "claims", marks.of_column(row.assumed for row in judged))


def _slopes(tables: Tables, marks: Marks) -> Fact | None:
    """Say how many coefficients of speed and temperature differ from measured or published ones."""
    told = [row for row in tables.differences if row.family.startswith("measured") and row.significant is not None]
    told = [row for row in told if not all(name.endswith(":published") for name in (row.source_a, row.source_b))]
    if not told:
        return None
    differ = [row for row in told if row.significant]
    alone = [row for row in told if row.p_value is not None and row.p_value < 0.05]
    text = f"{len(differ)} of {len(told)} differ from published or measured (Holm at 5 %); {len(alone)} uncorrected"
    tone: Tone = "warn" if differ else ""
    return Fact("Effect of speed, temperature", text, tone, "table1", marks.of_column(row.assumed for row in told))


def _unanswered(tables: Tables) -> Fact | None:
    """Name what there is nothing to compare with."""
    pairs = pairs_of(tables.ensemble)
    open_ = dict.fromkeys(
        reference for pair in pairs if not ((row := tables.statistics(pair, "peak_normal_force")) and row.compared)
        for reference in pair[1:]
    )  # fmt: skip
    answered = {row.reference_source for row in tables.errors if row.error is not None}
    names = [name for name in open_ if name not in answered]
    if not names:
        return None
    texts = [
        f"{wording.source(name)} (no measured pass imported)" if name.startswith("rig:") else wording.source(name)
        for name in names
    ]
    return Fact("Not compared", f"nothing from {', '.join(texts)}", "unknown", "results")


def _baseline(moved: tuple[Tone, str] | None) -> Fact:
    if moved is None:
        return Fact("Baseline", "not checked", "unknown", "baseline")
    return Fact("Baseline", moved[1], moved[0], "baseline")


def _inputs(tables: Tables, marks: Marks) -> Fact:
    """Say how many cases depend on inputs that are assumed or synthetic."""
    known = marks.all()
    if not known:
        return Fact("Inputs", "all published or measured", "good", "inputs")
    resting = sum(bool(row.assumed) for row in tables.cases)
    kinds = Counter(mark.origin for mark in known)
    named = " and ".join(f"{count} {origin}" for origin, count in sorted(kinds.items()))
    text = f"{resting} of {wording.plural(len(tables.cases), 'case')} depend on {named} inputs"
    return Fact("Inputs", text, "warn", "inputs", known)


def count_claims(rows: Iterable[ClaimRow]) -> Counter[str]:
    """Count how published statements came out."""
    return Counter(row.assessment for row in rows)
