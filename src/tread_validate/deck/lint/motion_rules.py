"""Rules on amplitudes, conditions, loads, rigid bodies and steps."""

from __future__ import annotations

from itertools import pairwise

from ...inp import DataLine, Deck, KeywordBlock
from .findings import Findings
from .names import Names
from .syntax import is_number, number

FIXITIES = frozenset({"ENCASTRE", "PINNED", "XSYMM", "YSYMM", "ZSYMM", "XASYMM", "YASYMM", "ZASYMM", "NOWARP"})
Pairs = list[tuple[float, float]]


def check_motion(deck: Deck, names: Names, findings: Findings) -> None:
    """Check what moves, and whether ABAQUS would move it as it stands there."""
    amplitudes = {
        (block.parameters.get("NAME") or "").upper(): _amplitude(block, findings) for block in deck.named("AMPLITUDE")
    }
    smooth = {
        (block.parameters.get("NAME") or "").upper()
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
        if amplitude and block.keyword != "STEP" and not names.has("AMPLITUDE", amplitude):
            findings.add(block, "dangling-amplitude", f"*{block.keyword}: there is no *AMPLITUDE {amplitude}")
    _check_rigid_bodies(deck, names, findings)
    _check_steps(deck, findings)


def _amplitude(block: KeywordBlock, findings: Findings) -> Pairs:
    """Return the (time, value) pairs of an amplitude and report what is wrong with them."""
    definition = block.parameters.get("DEFINITION") or "TABULAR"
    if definition not in ("TABULAR", "SMOOTH STEP"):
        return []
    pairs: Pairs = []
    for line in block.data:
        fields = line.fields
        if len(fields) % 2 or not all(is_number(text) for text in fields):
            findings.add(line, "amplitude", f"*AMPLITUDE: {line.text[:40]}: expected pairs of time and value")
            continue
        for time, value in zip(fields[::2], fields[1::2], strict=True):
            if pairs and number(time) <= pairs[-1][0]:
                findings.add(line, "amplitude", f"*AMPLITUDE: time {time} does not come after {pairs[-1][0]:g}")
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
        if not all(text.isdigit() and 1 <= int(text) <= 6 for text in dofs) or (
            len(dofs) == 2 and int(dofs[1]) < int(dofs[0])
        ):
            findings.add(
                line, "dof", f"*BOUNDARY: degrees of freedom {', '.join(dofs)}: expected 1 to 6, first <= last"
            )
        size = fields[3] if len(fields) > 3 else ""
        if size and not is_number(size):
            findings.add(line, "not-a-number", f"*BOUNDARY: {size} is not a number")
            continue
        moves = bool(size) and number(size) != 0.0
        if not (moves and names.explicit and kind == "DISPLACEMENT"):
            continue
        name = (block.parameters.get("AMPLITUDE") or "").upper()
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
        elif not names.has("SURFACE", target):
            findings.add(line, "dangling-surface", f"*DSLOAD: there is no *SURFACE {target}")


def _check_initial(block: KeywordBlock, names: Names, findings: Findings) -> None:
    kind = block.parameters.get("TYPE")
    if kind not in ("TEMPERATURE", "VELOCITY"):
        return
    count = {"TEMPERATURE": 2, "VELOCITY": 3}[kind]
    for line in block.data:
        fields = line.fields
        _known_nodes(line, fields[0], names, findings)
        if len(fields) != count or not all(is_number(text) for text in fields[1:]):
            form = "node or set, value" if kind == "TEMPERATURE" else "node or set, degree of freedom, value"
            findings.add(line, "initial-condition", f"{line.text[:40]}: expected {form}")


def _check_rigid_bodies(deck: Deck, names: Names, findings: Findings) -> None:
    body_of: dict[int, KeywordBlock] = {}
    fixed = _prescribed(deck, names)
    massive = _massive_nodes(deck, names)
    for block in deck.named("RIGID BODY"):
        reference = block.parameters.get("REF NODE")
        node: int | None = None
        if reference:
            ids = names.nodes_of(reference)
            if ids is None:
                findings.add(block, "dangling-nset", f"*RIGID BODY, REF NODE={reference}: there is no such node or set")
            elif ids.size != 1:
                findings.add(block, "reference-node", f"REF NODE={reference} holds {ids.size} nodes, expected one")
            else:
                node = int(ids[0])
        members: list[int] = [] if node is None else [node]
        for parameter in ("TIE NSET", "PIN NSET"):
            name = block.parameters.get(parameter)
            if name and name not in names.nsets:
                findings.add(block, "dangling-nset", f"*RIGID BODY, {parameter}={name}: there is no such node set")
            elif name:
                members += names.nsets[name].tolist()
        elset = block.parameters.get("ELSET")
        if elset and elset not in names.elsets:
            findings.add(block, "dangling-elset", f"*RIGID BODY, ELSET={elset}: there is no such element set")
        elif elset:
            for part in names.elements:
                inside = [index for index, one in enumerate(part.ids.tolist()) if one in set(names.elsets[elset])]
                members += part.nodes[inside].ravel().tolist()
        surface = block.parameters.get("ANALYTICAL SURFACE")
        if surface and not names.has("SURFACE", surface):
            findings.add(block, "dangling-surface", f"*RIGID BODY: there is no *SURFACE {surface}")
        for member in dict.fromkeys(members):
            if member in body_of and body_of[member] is not block:
                findings.add(
                    block,
                    "two-rigid-bodies",
                    f"node {member} is already in the rigid body of line {body_of[member].line}",
                )
                break
        body_of.update(dict.fromkeys(members, block))
        held = [one for one in members if one != node and one in fixed]
        if held:
            findings.add(
                fixed[held[0]][min(fixed[held[0]])],
                "rigid-body-support",
                f"node {held[0]} follows its rigid body (line {block.line}) and cannot have a *BOUNDARY of its own",
            )
        if names.explicit and node is not None and len(set(members)) == 1 and node not in massive:
            free = [dof for dof in range(1, 7) if dof not in fixed.get(node, {})]
            if free:
                listed = ", ".join(map(str, free))
                findings.add(
                    block,
                    "massless-body",
                    f"massless rigid body: reference node {node} is free in {listed}; prescribe these or add mass",
                )


def _prescribed(deck: Deck, names: Names) -> dict[int, dict[int, DataLine]]:
    """Return, per node, the prescribed degrees of freedom and the line that does it."""
    held: dict[int, dict[int, DataLine]] = {}
    named = {"ENCASTRE": range(1, 7), "PINNED": range(1, 4), "XSYMM": (1, 5, 6), "YSYMM": (2, 4, 6), "ZSYMM": (3, 4, 5)}
    for block in deck.named("BOUNDARY"):
        for line in block.data:
            fields = line.fields
            ids = names.nodes_of(fields[0])
            if ids is None or len(fields) < 2:
                continue
            dofs = [int(text) for text in fields[1:3] if text.isdigit()]
            span = range(dofs[0], dofs[-1] + 1) if dofs else named.get(fields[1].upper(), ())
            for node in ids.tolist():
                for dof in span:
                    held.setdefault(node, {}).setdefault(dof, line)
    return held


def _massive_nodes(deck: Deck, names: Names) -> set[int]:
    """Return the nodes of point masses and of elements with a section."""
    return {node for part in names.elements for node in part.nodes.ravel().tolist()}


def _check_steps(deck: Deck, findings: Findings) -> None:
    procedures = ("DYNAMIC", "STATIC", "FREQUENCY", "VISCO")
    step: KeywordBlock | None = None
    found: KeywordBlock | None = None
    for block in deck.blocks:
        if block.keyword == "STEP":
            step, found = block, None
        elif block.keyword in procedures:
            found = block
            if "EXPLICIT" in block.parameters:
                period = block.data[0].fields[1] if block.data and len(block.data[0].fields) > 1 else ""
                if not is_number(period) or number(period) <= 0.0:
                    at = block.data[0] if block.data else block
                    findings.add(at, "step-time", f"*DYNAMIC, EXPLICIT: time period {period or '(none)'}: expected > 0")
        elif block.keyword == "END STEP" and step is not None and found is None:
            findings.add(step, "no-procedure", "the step has no procedure such as *DYNAMIC, EXPLICIT")
