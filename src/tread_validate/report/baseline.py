"""What moved since the accepted baseline."""

from __future__ import annotations

from pathlib import Path

from .content import Item, Paragraph, Section, Tone
from .inputs import plain_table
from .marks import Marks
from .tables import read_table


def baseline_section(delta: Path | None, marks: Marks) -> tuple[Section, tuple[Tone, str] | None]:
    """Return the section, and for the summary a tone and a sentence (None where no check was made)."""
    if delta is None or not delta.is_file():
        words = "No check against a baseline was made for this report; the command “tread-validate check” makes one."
        return Section("baseline", "Change since the accepted baseline", (Paragraph(words),)), None
    frame = read_table(delta, ())
    outcome: tuple[Tone, str]
    if not len(frame):
        outcome = ("good", "No row differs from the baseline beyond its tolerance.")
        items: tuple[Item, ...] = (Paragraph(outcome[1]),)
        return Section("baseline", "Change since the accepted baseline", items), outcome
    failed = _failed(frame)
    if failed:
        outcome = ("bad", f"{failed} of {len(frame)} rows moved beyond tolerance, or are new, missing or stale.")
    else:
        outcome = ("good", f"All {len(frame)} rows lie within tolerance of the baseline.")
    table = plain_table("delta", "Delta to the baseline, furthest out first", frame, marks)
    return Section("baseline", "Change since the accepted baseline", (Paragraph(outcome[1]), table)), outcome


def _failed(frame: object) -> int:
    import pandas as pd

    assert isinstance(frame, pd.DataFrame)
    if "passed" in frame.columns:
        return int(sum(str(value).lower() in ("false", "0", "0.0") for value in frame["passed"]))
    if "outcome" in frame.columns:
        return int(sum(str(value) not in ("within", "unchanged", "ok") for value in frame["outcome"]))
    return len(frame)
