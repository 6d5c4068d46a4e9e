"""Form of a deck: keywords, parameters, places and data lines against the vocabulary."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ...inp import DataLine, Deck, KeywordBlock, Lines
from ...inp.deck import to_float
from ...inp.parameters import MARK
from ...inp.table import all_numbers
from ...inp.vocabulary import KeywordEntry, keywords
from .findings import Finding, Findings
from .spelling import misspelt

LONGEST_LINE = 256
MOST_UNKNOWN = 200
"""Different unknown keywords that are compared with the known ones."""
MODEL_ONLY = frozenset({
    "HEADING", "PART", "INSTANCE", "ASSEMBLY", "NODE", "ELEMENT", "MATERIAL", "DENSITY", "ELASTIC", "HYPERELASTIC",
    "VISCOELASTIC", "TRS", "SOLID SECTION", "SHELL SECTION", "MEMBRANE SECTION", "SECTION CONTROLS", "RIGID BODY",
    "INITIAL CONDITIONS", "EQUATION", "TIE",
})  # fmt: skip
"""Keywords that certainly stand before the first step."""
STEP_ONLY = frozenset({
    "DYNAMIC", "STATIC", "VISCO", "BULK VISCOSITY", "CLOAD", "DLOAD", "DSLOAD", "OUTPUT", "NODE OUTPUT",
    "ELEMENT OUTPUT", "CONTACT OUTPUT", "ENERGY OUTPUT", "END STEP",
})  # fmt: skip
"""Keywords that certainly stand inside a step."""
STRICT_FORM = frozenset({
    "NODE", "ELEMENT", "NSET", "ELSET", "DENSITY", "ELASTIC", "TRS", "BOUNDARY", "CLOAD", "BULK VISCOSITY", "AMPLITUDE",
    "STEP", "END STEP", "FRICTION", "VISCOELASTIC", "PART", "END PART",
})  # fmt: skip
"""Keywords whose count of lines and fields is certain; that of others is a warning."""


def check_syntax(deck: Deck, findings: Findings, dialect: str = "abaqus") -> None:
    """Check every keyword block by itself and its place in the deck."""
    vocabulary = keywords(dialect)
    inside = False
    steps = 0
    opened: KeywordBlock | None = None
    meant = meant_keywords(deck, dialect)
    for position, block in enumerate(deck.written):
        keyword = meant.get(block.keyword) or block.keyword
        if keyword == "STEP":
            if inside:
                findings.add(block, "step-order", "a *STEP inside a step: *END STEP is missing before it")
            inside, opened = True, block
            steps += 1
        known = vocabulary.get(block.keyword)
        if known is None:
            _unknown(block, meant.get(block.keyword), vocabulary, findings, dialect)
        else:
            _check_place(block, inside, steps, findings, dialect)
            own: Findings = Findings()
            _check_block(deck.written, position, known, vocabulary, own)
            findings += own if dialect == "abaqus" else map(_of_other_dialect, own)
        _check_letters(block, findings)
        if keyword == "END STEP":
            if not inside:
                findings.add(block, "step-order", "*END STEP without a *STEP")
            inside = False
    if inside and opened is not None:
        severity = "error" if dialect == "abaqus" else "warning"  # CalculiX takes the end of the file for it
        findings.add(opened, "step-order", "this *STEP has no *END STEP", severity)  # type: ignore[arg-type]  # one of two literals
    if deck.written and steps == 0:
        findings.add(deck.written[-1], "no-step", "the deck has no *STEP")


def repaired(deck: Deck, dialect: str = "abaqus") -> Deck:
    """Return the deck with misspelt keywords (told by `check_syntax`) as they are meant, so that nothing follows."""
    meant = {word: near for word, near in meant_keywords(deck, dialect).items() if near is not None}
    if not meant:
        return deck
    blocks = (replace(one, keyword=meant[one.keyword]) if one.keyword in meant else one for one in deck.blocks)
    return replace(deck, blocks=tuple(blocks))


def meant_keywords(deck: Deck, dialect: str) -> dict[str, str | None]:
    """Return, for the first `MOST_UNKNOWN` unknown keywords, the known one that each is a letter or two from."""
    vocabulary = keywords(dialect)
    found: dict[str, str | None] = {}
    for block in deck.written:
        if block.keyword in vocabulary or block.keyword in found or len(found) == MOST_UNKNOWN:
            continue
        own = dialect == "calculix" and _begins_with_keyword(block.keyword, vocabulary)
        found[block.keyword] = None if own else misspelt(block.keyword, vocabulary)
    return found


def _begins_with_keyword(word: str, vocabulary: Mapping[str, KeywordEntry]) -> bool:
    """Whether CalculiX, which compares first letters, takes a longer word for a keyword (or one of its own)."""
    squeezed = word.replace(" ", "")
    return any(squeezed.startswith(name.replace(" ", "")) for name in vocabulary)


def _unknown(
    block: KeywordBlock, near: str | None, vocabulary: Mapping[str, KeywordEntry], findings: Findings, dialect: str
) -> None:
    if dialect == "calculix" and _begins_with_keyword(block.keyword, vocabulary):
        findings.add(block, "not-checked", f"*{block.keyword} begins with a keyword: not checked")
        return
    if near is not None:
        findings.add(block, "unknown-keyword", f"*{block.keyword} is no keyword; did you mean *{near}?")
    elif dialect == "abaqus" and block.keyword in keywords("calculix"):
        findings.add(block, "not-checked", f"*{block.keyword} is a keyword of CalculiX: --dialect calculix")
    else:
        findings.add(block, "not-checked", f"*{block.keyword} is not in the lint's vocabulary: not checked")


def _of_other_dialect(finding: Finding) -> Finding:
    """Return a finding on the form of a block as it counts where the vocabulary is not that of the program."""
    if finding.rule in ("parameter-value", "unknown-parameter"):
        return replace(finding, rule="not-checked", severity="note")
    if finding.rule in ("field-count", "data-lines") and finding.severity == "error":
        return replace(finding, severity="warning")
    return finding


def _check_place(block: KeywordBlock, inside: bool, steps: int, findings: Findings, dialect: str) -> None:
    if block.keyword in MODEL_ONLY and (inside or steps) and dialect == "abaqus":
        findings.add(block, "wrong-place", f"*{block.keyword} is model data and stands before the first *STEP")
    if block.keyword in STEP_ONLY and not inside and block.keyword != "END STEP":
        findings.add(block, "wrong-place", f"*{block.keyword} is history data and stands inside a *STEP")


def _check_block(
    blocks: Sequence[KeywordBlock],
    position: int,
    known: KeywordEntry,
    vocabulary: Mapping[str, KeywordEntry],
    findings: Findings,
) -> None:
    block = blocks[position]
    if known.open:
        return
    _check_parameters(block, known, findings)
    if block.keyword not in ("NODE", "ELEMENT"):  # the mesh is read in bulk; see `check_lines`
        _check_data(block, known, findings)
    if known.parents and not _has_parent(blocks, position, known.parents, vocabulary):
        findings.add(block, "wrong-place", f"*{block.keyword} belongs below *{' or *'.join(known.parents)}")


def _check_parameters(block: KeywordBlock, known: KeywordEntry, findings: Findings) -> None:
    allowed = known.required | known.optional
    for name, value in block.parameters.items():
        if name not in allowed:
            near = misspelt(name, allowed)
            if near is not None:
                findings.add(block, "unknown-parameter", f"*{block.keyword} has no {name}; did you mean {near}?")
            else:
                findings.add(block, "not-checked", f"*{block.keyword}, {name}: a parameter the lint does not know")
        elif value is not None and known.values_of(name) and value not in known.values_of(name):
            expected = ", ".join(known.values_of(name))
            findings.add(block, "parameter-value", f"*{block.keyword}, {name}={value}: expected one of {expected}")
    for name in sorted(known.required - set(block.parameters)):
        findings.add(block, "missing-parameter", f"*{block.keyword} needs {name}=")


def check_lines(block: KeywordBlock, findings: Findings) -> None:
    """Check the data lines of a block by themselves: for nodes and elements that are no plain table."""
    known = keywords().get(block.keyword)
    if known is not None:
        _check_data(block, known, findings)


def _check_data(block: KeywordBlock, known: KeywordEntry, findings: Findings) -> None:
    least, most = known.lines
    severity = None if block.keyword in STRICT_FORM else "warning"
    if len(block.data) < least and "INPUT" not in block.parameters:
        text = f"*{block.keyword}: {len(block.data)} data lines, expected at least {least}"
        findings.add(block, "data-lines", text, severity)  # type: ignore[arg-type]  # one of two literals
    if 0 <= most < len(block.data):
        text = f"*{block.keyword}: more data lines than the {most} it may have"
        findings.add(block.data[most], "data-lines", text, severity)  # type: ignore[arg-type]  # one of two literals
    data = block.data if most < 0 else block.data[:most]
    if known.numeric and known.fields is not None and all_numbers(data, *known.fields):
        return
    for line in data:
        if known.fields is not None:
            count = len(line.fields)
            low, high = known.fields
            if not low <= count <= high:
                expected = str(low) if low == high else f"{low} to {high}"
                text = f"*{block.keyword}: {count} fields, expected {expected}"
                findings.add(line, "field-count", text, severity)  # type: ignore[arg-type]  # one of two literals
        if known.numeric:
            _check_numbers(block, line, findings)


def _check_numbers(block: KeywordBlock, line: DataLine, findings: Findings) -> None:
    for text in line.fields:
        if text and not is_number(text) and not MARK.search(text):  # a name without a value is said elsewhere
            findings.add(line, "not-a-number", f"*{block.keyword}: {text[:40]} is not a number")
            return


def _check_letters(block: KeywordBlock, findings: Findings) -> None:
    """Check line lengths and letters, once a block."""
    data: Lines = block.data
    if max(map(len, data.texts), default=0) > LONGEST_LINE:
        line = next(line for line in data if len(line.text) > LONGEST_LINE)
        findings.add(line, "line-length", f"{len(line.text)} characters, at most {LONGEST_LINE}")
    if block.keyword == "HEADING":
        return
    if not all(map(str.isascii, data.texts)):
        line = next(line for line in data if not line.text.isascii())
        findings.add(line, "non-ascii", f"*{block.keyword}: {line.text[:40]!a}")
    elif not block.text.isascii():
        findings.add(block, "non-ascii", ascii(block.text[:60]))


def is_number(text: str) -> bool:
    """Whether a field is a finite number in the language's form (Fortran exponents allowed)."""
    try:
        value = to_float(text)
    except ValueError:
        return False
    return abs(value) < float("inf")


def number(text: str) -> float:
    """Return a field as a number; Fortran's exponent letter D is one of the language's forms."""
    return to_float(text)


def _has_parent(
    blocks: Sequence[KeywordBlock], position: int, parents: tuple[str, ...], vocabulary: Mapping[str, KeywordEntry]
) -> bool:
    """Whether one of `parents` precedes with nothing but options in between; what is not known might be one."""
    for block in reversed(blocks[:position]):
        if block.keyword in parents:
            return True
        known = vocabulary.get(block.keyword)
        if known is None or (known.open and not known.parents):
            return True
        if not known.parents and block.keyword not in ("INCLUDE", "PARAMETER"):
            return False
    return False
