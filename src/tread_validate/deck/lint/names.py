"""What a deck defines and by which name, collected once for all rules."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...inp import DataLine, Deck, KeywordBlock
from .findings import Findings
from .syntax import is_number, number
from .table import ELEMENT_NODES

LONGEST_LABEL = 9  # digits of a node or element number

IntArray = NDArray[np.int64]
NO_IDS: IntArray = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True)
class ElementBlock:
    """The elements of one ``*ELEMENT``: ids (m,), node ids (m, k), and the line of each."""

    block: KeywordBlock
    kind: str
    ids: IntArray
    nodes: IntArray
    lines: list[DataLine]


@dataclass
class Names:
    """Definitions of a deck; ids are as written."""

    node_ids: IntArray = field(default_factory=lambda: NO_IDS)
    coordinates: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))
    node_set: frozenset[int] = frozenset()
    elements: list[ElementBlock] = field(default_factory=list)
    element_set: frozenset[int] = frozenset()
    nsets: dict[str, IntArray] = field(default_factory=dict)
    elsets: dict[str, IntArray] = field(default_factory=dict)
    named: dict[str, dict[str, KeywordBlock]] = field(default_factory=dict)
    explicit: bool = False

    def has(self, kind: str, name: str) -> bool:
        """Whether `kind` (``MATERIAL``, ``SURFACE``, ...) has something called `name`."""
        return name.upper() in self.named.get(kind, {})

    def nodes_of(self, text: str) -> IntArray | None:
        """Return the node ids of a node number or node set; None where there is no such."""
        return _members(text, self.nsets, self.node_set)

    def elements_of(self, text: str) -> IntArray | None:
        """Return the element ids of an element number or element set; None where there is no such."""
        return _members(text, self.elsets, self.element_set)


NAMED = {
    "MATERIAL": "NAME",
    "AMPLITUDE": "NAME",
    "SURFACE": "NAME",
    "SURFACE INTERACTION": "NAME",
    "SECTION CONTROLS": "NAME",
    "ORIENTATION": "NAME",
}


def collect(deck: Deck, findings: Findings) -> Names:
    """Collect the definitions; faults in the definitions themselves are reported on the way."""
    names = Names(explicit=any("EXPLICIT" in block.parameters for block in deck.named("DYNAMIC")))
    _nodes(deck, names, findings)
    _elements(deck, names, findings)
    for keyword, parameter in NAMED.items():
        table = names.named.setdefault(keyword, {})
        for block in deck.named(keyword):
            name = (block.parameters.get(parameter) or "").upper()
            if name in table:
                first = table[name]
                findings.add(block, "duplicate-name", f"*{keyword} {name} is already defined in line {first.line}")
            elif name:
                table[name] = block
    pairs = names.named.setdefault("CPSET", {})
    for block in deck.named("CONTACT PAIR"):
        if block.parameters.get("CPSET"):
            pairs.setdefault(block.value("CPSET").upper(), block)
    _sets(deck, names, findings)
    return names


def _nodes(deck: Deck, names: Names, findings: Findings) -> None:
    ids: list[int] = []
    places: list[tuple[float, float, float]] = []
    seen: dict[int, int] = {}
    for block in deck.named("NODE"):
        first = len(ids)
        for line in block.data:
            fields = line.fields
            if not fields or not is_label(fields[0]) or not all(is_number(text) for text in fields[1:4] if text):
                if not fields or not is_label(fields[0]):
                    findings.add(line, "bad-node", f"*NODE: {line.text[:40]}: expected id, x, y, z")
                continue
            node = int(fields[0])
            if node in seen:
                findings.add(line, "duplicate-node", f"node {node} is already defined in line {seen[node]}")
            seen[node] = line.number
            ids.append(node)
            xyz = [number(text) if text else 0.0 for text in fields[1:4]]
            places.append((*xyz, *[0.0] * (3 - len(xyz))))  # type: ignore[arg-type]
        _into(names.nsets, block.parameters.get("NSET"), ids[first:])
    names.node_ids = np.array(ids, dtype=np.int64)
    names.coordinates = np.array(places, dtype=np.float64).reshape(-1, 3)
    names.node_set = frozenset(ids)


def _elements(deck: Deck, names: Names, findings: Findings) -> None:
    seen: dict[int, int] = {}
    for block in deck.named("ELEMENT"):
        kind = block.parameters.get("TYPE") or ""
        if kind not in ELEMENT_NODES:
            findings.add(block, "element-type", f"*ELEMENT, TYPE={kind}: not an element type this lint knows")
            _into(names.elsets, block.parameters.get("ELSET"), _first_ids(block.data))
            continue
        count = ELEMENT_NODES[kind] + 1
        rows: list[list[int]] = []
        lines: list[DataLine] = []
        pending: list[int] = []
        for line in block.data:
            if not all(is_label(text) for text in line.fields):
                findings.add(
                    line, "bad-element", f"*ELEMENT: {line.text[:40]}: expected whole numbers of up to 9 digits"
                )
                pending = []
                continue
            if not pending:
                lines.append(line)
            pending += [int(text) for text in line.fields]
            if len(pending) < count and line.text.endswith(","):
                continue  # long elements go on in the next line
            if len(pending) != count:
                findings.add(
                    lines.pop(), "element-nodes", f"{kind} has {count - 1} nodes, this line gives {len(pending) - 1}"
                )
            else:
                rows.append(pending)
            pending = []
        table = np.array(rows, dtype=np.int64).reshape(-1, count)
        for row, line in zip(rows, lines, strict=False):
            if row[0] in seen:
                findings.add(line, "duplicate-element", f"element {row[0]} is already defined in line {seen[row[0]]}")
            seen[row[0]] = line.number
        names.elements.append(ElementBlock(block, kind, table[:, 0], table[:, 1:], lines))
        _into(names.elsets, block.parameters.get("ELSET"), table[:, 0].tolist())
    names.element_set = frozenset(seen)


def _first_ids(lines: Iterable[DataLine]) -> list[int]:
    return [int(text) for text in (line.fields[0] for line in lines if line.fields) if is_label(text)]


def _sets(deck: Deck, names: Names, findings: Findings) -> None:
    """Build *NSET and *ELSET in the order of the deck."""
    for block in deck.named("NSET", "ELSET"):
        of_nodes = block.keyword == "NSET"
        table = names.nsets if of_nodes else names.elsets
        known = names.node_set if of_nodes else names.element_set
        what = "node" if of_nodes else "element"
        members: list[int] = []
        for line in block.data:
            if "GENERATE" in block.parameters:
                members += _generated(line, known, what, findings)
                continue
            for text in line.fields:
                ids = _members(text, table, known)
                if ids is None:
                    findings.add(
                        line, f"dangling-{block.keyword.lower()}", f"*{block.keyword}: there is no {what} or set {text}"
                    )
                else:
                    members += ids.tolist()
        elset = block.parameters.get("ELSET") if of_nodes else None
        if elset:
            if elset in names.elsets:
                inside = names.elsets[elset]
                for part in names.elements:
                    members += part.nodes[np.isin(part.ids, inside)].ravel().tolist()
            else:
                findings.add(block, "dangling-elset", f"*NSET, ELSET={elset}: there is no such element set")
        _into(table, block.parameters.get(block.keyword), members)


def _generated(line: DataLine, known: frozenset[int], what: str, findings: Findings) -> list[int]:
    fields = line.fields
    if not 2 <= len(fields) <= 3 or not all(text.isdigit() for text in fields):
        findings.add(line, "field-count", f"GENERATE: {line.text[:40]}: expected first, last, step")
        return []
    first, last, step = int(fields[0]), int(fields[1]), int(fields[2]) if len(fields) == 3 else 1
    if step < 1 or last < first:
        findings.add(line, "field-count", f"GENERATE: {line.text[:40]}: expected first <= last and step >= 1")
        return []
    ids = sorted(label for label in known if first <= label <= last and (label - first) % step == 0)
    if not ids:
        findings.add(line, f"undefined-{what}", f"GENERATE: no {what} from {first} to {last}")
    return ids


def is_label(text: str) -> bool:
    """Whether a field is a node or element number."""
    return text.isdigit() and len(text) <= LONGEST_LABEL


def _into(table: dict[str, IntArray], name: str | None, ids: list[int]) -> None:
    if name:
        table[name.upper()] = np.union1d(table.get(name.upper(), NO_IDS), np.array(ids, dtype=np.int64))


def _members(text: str, table: dict[str, IntArray], known: frozenset[int]) -> IntArray | None:
    if is_label(text):
        return np.array([int(text)], dtype=np.int64) if int(text) in known else None
    return table.get(text.strip('"').upper())
