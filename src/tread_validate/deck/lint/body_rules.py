"""Rules on rigid bodies."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...inp import DataLine, Deck, KeywordBlock
from ...inp.sets import sorted_labels
from .findings import Findings
from .names import Names

IntArray = NDArray[np.int64]
NAMED = {"ENCASTRE": range(1, 7), "PINNED": range(1, 4), "XSYMM": (1, 5, 6), "YSYMM": (2, 4, 6), "ZSYMM": (3, 4, 5)}


def check_rigid_bodies(deck: Deck, names: Names, findings: Findings) -> None:
    """Check that rigid bodies have their own nodes, a reference node and, moving freely, mass."""
    bodies = [
        (block, _reference(block, names, findings), _members(block, names, findings))
        for block in deck.named("RIGID BODY")
    ]
    if not bodies:
        return
    held = [members for _, _, members in bodies] + [np.array([node]) for _, node, _ in bodies if node is not None]
    fixed = _prescribed(deck, names, sorted_labels(np.concatenate(held)))
    massive = _massive_nodes(deck, names)
    body_of: dict[int, KeywordBlock] = {}
    for block, node, members in bodies:
        whole = ([] if node is None else [node]) + members.tolist()
        for member in dict.fromkeys(whole):
            if member in body_of and body_of[member] is not block:
                text = f"node {names.shown(member)} is already in the rigid body of line {body_of[member].line}"
                findings.add(block, "two-rigid-bodies", text)
                break
        body_of.update(dict.fromkeys(whole, block))
        following = [one for one in members.tolist() if one != node and one in fixed]
        if following:
            text = (
                f"node {names.shown(following[0])} follows its rigid body (line {block.line}): no *BOUNDARY of its own"
            )
            findings.add(fixed[following[0]][min(fixed[following[0]])], "rigid-body-support", text)
        alone = node is not None and set(whole) == {node}
        if names.explicit and node is not None and alone and node not in massive and not names.open_mesh:
            free = [dof for dof in range(1, 7) if dof not in fixed.get(node, {})]
            if free:
                listed = ", ".join(map(str, free))
                text = f"massless rigid body: reference node {names.shown(node)} is free in {listed}"
                findings.add(block, "massless-body", text)


def _reference(block: KeywordBlock, names: Names, findings: Findings) -> int | None:
    """Return the reference node; None where there is none, or not one."""
    reference = block.parameters.get("REF NODE")
    if not reference:
        return None
    ids = names.nodes_of(reference)
    if ids is None:
        findings.add(block, "dangling-nset", f"*RIGID BODY, REF NODE={reference}: there is no such node or set")
        return None
    if ids.size != 1:
        if not names.open_mesh:
            findings.add(block, "reference-node", f"REF NODE={reference} holds {ids.size} nodes, expected one")
        return None
    return int(ids[0])


def _members(block: KeywordBlock, names: Names, findings: Findings) -> IntArray:
    """Return the nodes that follow the reference node."""
    parts: list[IntArray] = [np.zeros(0, dtype=np.int64)]
    for parameter in ("TIE NSET", "PIN NSET"):
        name = block.parameters.get(parameter)
        if name and not names.has_nset(name):
            findings.add(block, "dangling-nset", f"*RIGID BODY, {parameter}={name}: there is no such node set")
        elif name in names.nsets:
            parts.append(names.nsets[name])
    elset = block.parameters.get("ELSET")
    if elset and not names.has_elset(elset):
        findings.add(block, "dangling-elset", f"*RIGID BODY, ELSET={elset}: there is no such element set")
    elif elset in names.elsets:
        parts += [part.nodes[np.isin(part.ids, names.elsets[elset])].ravel() for part in names.elements]
    surface = block.parameters.get("ANALYTICAL SURFACE")
    if surface and not names.has("SURFACE", surface):
        findings.add(block, "dangling-surface", f"*RIGID BODY: there is no *SURFACE {surface}")
    return sorted_labels(np.concatenate(parts))


def _prescribed(deck: Deck, names: Names, wanted: IntArray) -> dict[int, dict[int, DataLine]]:
    """Return, for each of the nodes wanted, the prescribed degrees of freedom and the line that does it."""
    held: dict[int, dict[int, DataLine]] = {}
    for block in deck.named("BOUNDARY"):
        for line in block.data:
            fields = line.fields
            ids = names.nodes_of(fields[0])
            if ids is None or len(fields) < 2:
                continue
            dofs = [int(text) for text in fields[1:3] if text.isdigit()]
            span = range(dofs[0], min(dofs[-1], 6) + 1) if dofs else NAMED.get(fields[1].upper(), ())
            for node in np.intersect1d(ids, wanted, assume_unique=True).tolist():
                for dof in span:
                    held.setdefault(node, {}).setdefault(dof, line)
    return held


def _massive_nodes(deck: Deck, names: Names) -> set[int]:
    """Return the nodes of point masses and of other small blocks of elements."""
    if next(deck.named("MASS ADJUST", "NONSTRUCTURAL MASS"), None) is not None:
        return set(names.node_ids.tolist())
    parts = [part.nodes.ravel() for part in names.elements if part.nodes.size < 100_000]
    return set(sorted_labels(np.concatenate(parts)).tolist()) if parts else set()
