"""Rules on amplitudes, conditions, loads, rigid bodies and steps."""

from __future__ import annotations

import re
from itertools import pairwise

from ...inp import DataLine, Deck, KeywordBlock
from ...inp.parameters import MARK
from ...inp.vocabulary import keywords
from .body_rules import check_rigid_bodies
from .findings import Findings
from .names import Names
from .syntax import is_number, number
from .table import PROCEDURES

FIXITIES = frozenset({"ENCASTRE", "PINNED", "XSYMM", "YSYMM", "ZSYMM", "XASYMM", "YASYMM", "ZASYMM", "NOWARP"})
Pairs = list[tuple[float, float]]


def check_motion(deck: Deck, names: Names, findings: Findings) -> None:
    """Check what moves, and whether ABAQUS would move it as it stands there."""
    amplitudes = {
        (block.parameters.get("NAME") or ""): _amplitude(block, findings) for block in deck.named("AMPLITUDE")
    }
    smooth = {
        (block.parameters.get("NAME") or "")
        for block in deck.named("AMPLITUDE")
        if block.parameters.get("DEFINITION") == "SMOOTH STEP"
    }
    inside = False
    for block in deck.blocks:
        inside = (inside or block.keyword == "STEP") and block.keyword != "END STEP"
        if block.keyword == "BOUNDARY":
            _check_boundary(block, inside, names, amplitudes, smooth, findings)
        elif block.keyword in ("CLOAD", "DLOAD", "DSLOAD", "TEMPERATURE"):
            _check_load(block, names, findings)
        elif block.keyword == "INITIAL CONDITIONS":
            _check_initial(block, names, findings)
        amplitude = block.parameters.get("AMPLITUDE")
        if amplitude and block.keyword not in ("STEP", "AMPLITUDE") and not names.has("AMPLITUDE", amplitude):
            findings.add(block, "dangling-amplitude", f"*{block.keyword}: there is no *AMPLITUDE {amplitude}")
    check_rigid_bodies(deck, names, findings)
    check_steps(deck, findings)


def _amplitude(block: KeywordBlock, findings: Findings) -> Pairs:
    """Return the (time, value) pairs of an amplitude and report what is wrong with them."""
    definition = block.parameters.get("DEFINITION") or "TABULAR"
    if definition not in ("TABULAR", "SMOOTH STEP"):
        return []
    pairs: Pairs = []
    if any(MARK.search(text) for text in block.data.texts):
        return []  # a name without a value is said elsewhere
    for line in block.data:
        fields = line.fields
        if len(fields) % 2 or not all(is_number(text) for text in fields):
            findings.add(line, "amplitude", f"*AMPLITUDE: {line.text[:40]}: expected pairs of time and value")
            continue
        for time, value in zip(fields[::2], fields[1::2], strict=True):
            if pairs and number(time) <= pairs[-1][0]:
                text = f"*AMPLITUDE: time {time} does not come after {pairs[-1][0]:g}"
                findings.add(line, "amplitude", text, "warning" if number(time) == pairs[-1][0] else None)
                return pairs
            pairs.append((number(time), number(value)))
    if len(pairs) < 2:
        findings.add(block, "amplitude", f"*AMPLITUDE: {len(pairs)} points, expected at least 2")
    return pairs


def _check_boundary(
    block: KeywordBlock, inside: bool, names: Names, amplitudes: dict[str, Pairs], smooth: set[str], findings: Findings
) -> None:
    kind = block.parameters.get("TYPE") or "DISPLACEMENT"
    for line in block.data:
        fields = line.fields
        _known_nodes(line, fields[0], names, findings)
        if len(fields) < 2 or fields[1].upper() in FIXITIES:
            continue
        dofs = [text for text in fields[1:3] if text]
        if not _are_freedoms(dofs, names):
            text = f"*BOUNDARY: degrees of freedom {', '.join(dofs)}: expected 1 to 6, or what the elements have"
            findings.add(line, "dof", text)
        if not all(text.isdigit() for text in dofs) or any(int(text) > 6 for text in dofs):
            continue
        size = fields[3] if len(fields) > 3 else ""
        if size and not is_number(size):
            findings.add(line, "not-a-number", f"*BOUNDARY: {size} is not a number")
            continue
        moves = bool(size) and number(size) != 0.0
        if not (moves and names.explicit and kind == "DISPLACEMENT"):
            continue
        name = block.parameters.get("AMPLITUDE") or ""
        if not inside or not name:
            findings.add(
                line,
                "displacement-jump",
                "a displacement other than 0 without an amplitude is ignored by ABAQUS/Explicit",
            )
        elif amplitudes.get(name) and amplitudes[name][0][1] != 0.0 and "USER" not in block.parameters:
            findings.add(
                line,
                "displacement-jump",
                f"amplitude {name} starts at {amplitudes[name][0][1]:g}: ABAQUS/Explicit takes no jump of displacement",
            )
        elif name not in smooth and _has_kinks(amplitudes.get(name, [])):
            findings.add(
                line,
                "velocity-jump",
                f"amplitude {name} is piecewise linear: a displacement by it has jumps of velocity; use TYPE=VELOCITY",
                "warning",
            )


def _are_freedoms(dofs: list[str], names: Names) -> bool:
    """Whether the fields are a range of degrees of freedom that the deck's elements may have."""
    if not all(text.isdigit() and 1 <= int(text) <= 30 for text in dofs):
        return False
    if len(dofs) == 2 and int(dofs[1]) < int(dofs[0]):
        return False
    plain = all(re.fullmatch(r"C3D\d+[RIHM]*|R3D\d|MASS|ROTARYI|S\dR?|M3D\d+R?", part.kind) for part in names.elements)
    return max(map(int, dofs), default=1) <= 6 or not plain or names.gaps


def _has_kinks(pairs: Pairs) -> bool:
    slopes = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in pairwise(pairs)]
    scale = max((abs(slope) for slope in slopes), default=0.0)
    return any(abs(b - a) > 0.2 * scale for a, b in pairwise([0.0, *slopes]))


def _known_nodes(line: DataLine, text: str, names: Names, findings: Findings) -> None:
    if names.nodes_of(text) is None:
        findings.add(line, "dangling-nset", f"there is no node or node set {text or '(blank)'}")


def _check_load(block: KeywordBlock, names: Names, findings: Findings) -> None:
    for line in block.data:
        target = line.fields[0]
        if block.keyword in ("CLOAD", "TEMPERATURE"):
            _known_nodes(line, target, names, findings)
        elif block.keyword == "DLOAD":
            if target and names.elements_of(target) is None:
                findings.add(line, "dangling-elset", f"*DLOAD: there is no element or element set {target}")
        elif target and not names.has("SURFACE", target):
            findings.add(line, "dangling-surface", f"*DSLOAD: there is no *SURFACE {target}")


def _check_initial(block: KeywordBlock, names: Names, findings: Findings) -> None:
    kind = block.parameters.get("TYPE")
    if kind == "ROTATING VELOCITY":
        for line in block.data[::2]:
            _known_nodes(line, line.fields[0], names, findings)
        if len(block.data) % 2:
            findings.add(block.data[-1], "initial-condition", "expected pairs of lines: set, rate, velocity; axis")
    if kind not in ("TEMPERATURE", "VELOCITY"):
        return
    for line in block.data:
        fields = line.fields
        _known_nodes(line, fields[0], names, findings)
        enough = len(fields) == 3 if kind == "VELOCITY" else len(fields) >= 2
        if not enough or not all(is_number(text) for text in fields[1:] if text):
            form = "node or set, value" if kind == "TEMPERATURE" else "node or set, degree of freedom, value"
            findings.add(line, "initial-condition", f"{line.text[:40]}: expected {form}")


def check_steps(deck: Deck, findings: Findings) -> None:
    """Check that every step has a procedure, and an explicit one a duration."""
    known = keywords("calculix")
    step: KeywordBlock | None = None
    found: KeywordBlock | None = None
    for block in deck.blocks:
        if block.keyword == "STEP":
            step, found = block, None
        elif block.keyword in PROCEDURES or block.keyword not in known:
            found = block
            if "EXPLICIT" in block.parameters:
                period = block.data[0].fields[1] if block.data and len(block.data[0].fields) > 1 else ""
                if not is_number(period) or number(period) <= 0.0:
                    at = block.data[0] if block.data else block
                    findings.add(at, "step-time", f"*DYNAMIC, EXPLICIT: time period {period or '(none)'}: expected > 0")
        elif block.keyword == "END STEP" and step is not None and found is None:
            findings.add(step, "no-procedure", "the step has no procedure such as *DYNAMIC, EXPLICIT")
