"""Form of a deck: keywords, parameters, places and data lines against the table."""

from __future__ import annotations

import difflib
from collections.abc import Sequence

from ...inp import DataLine, Deck, KeywordBlock
from .findings import Findings
from .table import KEYWORDS, Keyword


def check_syntax(deck: Deck, findings: Findings) -> None:
    """Check every keyword block by itself and its place in the deck."""
    inside = False
    steps = 0
    opened: KeywordBlock | None = None
    for position, block in enumerate(deck.blocks):
        if block.keyword == "STEP":
            if inside:
                findings.add(block, "step-order", "a *STEP inside a step: *END STEP is missing before it")
            inside, opened = True, block
            steps += 1
        known = KEYWORDS.get(block.keyword)
        if known is None:
            near = difflib.get_close_matches(block.keyword, KEYWORDS, 1)
            hint = f"; did you mean *{near[0]}?" if near else ""
            findings.add(block, "unknown-keyword", f"*{block.keyword} is not a keyword this lint knows{hint}")
        else:
            _check_block(deck.blocks, position, known, inside, steps, findings)
        if block.keyword == "END STEP":
            if not inside:
                findings.add(block, "step-order", "*END STEP without a *STEP")
            inside = False
    if inside and opened is not None:
        findings.add(opened, "step-order", "this *STEP has no *END STEP")
    if deck.blocks and steps == 0:
        findings.add(deck.blocks[-1], "no-step", "the deck has no *STEP", "warning")


def _check_block(
    blocks: Sequence[KeywordBlock], position: int, known: Keyword, inside: bool, steps: int, findings: Findings
) -> None:
    block = blocks[position]
    if known.place == "model" and (inside or steps):
        findings.add(block, "wrong-place", f"*{block.keyword} is model data and stands before the first *STEP")
    if known.place == "step" and not inside:
        findings.add(block, "wrong-place", f"*{block.keyword} is history data and stands inside a *STEP")
    if not known.open:
        _check_parameters(block, known, findings)
    _check_data(block, known, findings)
    if known.parents and not _has_parent(blocks, position, known.parents):
        findings.add(block, "wrong-place", f"*{block.keyword} belongs below *{' or *'.join(known.parents)}")


def _check_parameters(block: KeywordBlock, known: Keyword, findings: Findings) -> None:
    allowed = known.required | known.optional
    for name, value in block.parameters.items():
        if name not in allowed:
            near = difflib.get_close_matches(name, allowed, 1)
            hint = f"; did you mean {near[0]}?" if near else ""
            findings.add(block, "unknown-parameter", f"*{block.keyword} has no parameter {name}{hint}")
        elif known.values_of(name) and value is not None and value not in known.values_of(name):
            expected = ", ".join(known.values_of(name))
            findings.add(block, "parameter-value", f"*{block.keyword}, {name}={value}: expected one of {expected}")
    for name in sorted(known.required - set(block.parameters)):
        findings.add(block, "missing-parameter", f"*{block.keyword} needs {name}=")


def _check_data(block: KeywordBlock, known: Keyword, findings: Findings) -> None:
    least, most = known.lines
    if len(block.data) < least and "INPUT" not in block.parameters:
        findings.add(block, "data-lines", f"*{block.keyword}: {len(block.data)} data lines, expected at least {least}")
    if 0 <= most < len(block.data):
        findings.add(block.data[most], "data-lines", f"*{block.keyword}: more data lines than the {most} it may have")
    for line in block.data if most < 0 else block.data[:most]:
        if len(line.text) > 256:
            findings.add(line, "line-length", f"{len(line.text)} characters, at most 256")
        if known.fields is not None:
            count = len(line.fields)
            low, high = known.fields
            if not low <= count <= high:
                expected = str(low) if low == high else f"{low} to {high}"
                findings.add(line, "field-count", f"*{block.keyword}: {count} fields, expected {expected}")
        if known.numeric:
            _check_numbers(block, line, findings)


def _check_numbers(block: KeywordBlock, line: DataLine, findings: Findings) -> None:
    for text in line.fields:
        if text and not is_number(text):
            findings.add(line, "not-a-number", f"*{block.keyword}: {text[:40]} is not a number")
            return


def is_number(text: str) -> bool:
    """Whether a field is a finite number in the language's form (Fortran exponents allowed)."""
    try:
        value = number(text)
    except ValueError:
        return False
    return abs(value) < float("inf")


def number(text: str) -> float:
    """Return a field as a number; Fortran's exponent letter D is one of the language's forms."""
    return float(text.upper().replace("D", "E"))


def _has_parent(blocks: Sequence[KeywordBlock], position: int, parents: tuple[str, ...]) -> bool:
    """Whether one of `parents` precedes with nothing but options in between."""
    for block in reversed(blocks[:position]):
        if block.keyword in parents:
            return True
        known = KEYWORDS.get(block.keyword)
        if known is not None and not known.parents:
            return False
    return False
