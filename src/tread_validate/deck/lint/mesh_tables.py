"""The nodes and elements of a deck as tables, with the line of each, and what is wrong with their lines."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...inp import DataLine, Deck, KeywordBlock
from ...inp.sets import is_label
from ...inp.table import integer_rows, plain_rows
from . import elements as kinds
from .findings import Findings
from .spelling import misspelt
from .syntax import check_lines, is_number, number

IntArray = NDArray[np.int64]
FloatArray = NDArray[np.float64]
MOST = 5
"""Findings of one kind at most in the nodes or elements of a deck."""


@dataclass(frozen=True)
class ElementTable:
    """The elements of one ``*ELEMENT``: ids (m,), node ids (m, k), and the data line of each."""

    block: KeywordBlock
    kind: str
    ids: IntArray
    nodes: IntArray
    rows: IntArray

    def line(self, row: int) -> DataLine:
        """Return the line of an element."""
        return self.block.data[int(self.rows[row])]


def read_nodes(deck: Deck, findings: Findings) -> tuple[IntArray, FloatArray]:
    """Return the label and the place of every node, in the order of the deck; labels given twice are reported."""
    blocks, tables, rows = [], [], []
    for block in deck.named("NODE"):
        table = plain_rows(block.data)
        if table is None:
            check_lines(block, findings)
            table, row = _node_lines(block, findings)
        else:
            row = np.arange(table.shape[0], dtype=np.int64)
        wide = np.zeros((table.shape[0], 4))
        width = min(4, table.shape[1])
        wide[:, :width] = table[:, :width]
        blocks.append(block)
        tables.append(wide)
        rows.append(row)
    if not tables:
        return np.zeros(0, dtype=np.int64), np.zeros((0, 3))
    whole = np.concatenate(tables)
    ids = whole[:, 0].astype(np.int64)
    starts = np.cumsum([0, *(table.shape[0] for table in tables)]).tolist()

    def line(index: int) -> DataLine:
        which = bisect_right(starts, index) - 1
        return blocks[which].data[int(rows[which][index - starts[which]])]

    for first, second in _repeated(ids)[:MOST]:
        same = deck.label_name(int(ids[second]))
        text = f"node {same} is already defined in line {line(first).number}"
        findings.add(line(second), "duplicate-node", text)
    return ids, whole[:, 1:]


def _repeated(ids: IntArray) -> list[tuple[int, int]]:
    """Return (first place, later place) of every label that comes again."""
    order = np.argsort(ids, kind="stable")
    again = np.flatnonzero(np.diff(ids[order]) == 0)
    return [(int(order[i]), int(order[i + 1])) for i in again]


def _node_lines(block: KeywordBlock, findings: Findings) -> tuple[FloatArray, IntArray]:
    """Read node lines one at a time; what is none is reported and left out."""
    places, rows = [], []
    for row, line in enumerate(block.data):
        fields = line.fields
        if not fields or not is_label(fields[0]):
            findings.add(line, "bad-node", f"*NODE: {line.text[:40]}: expected id, x, y, z")
            continue
        numbers = [number(text) if is_number(text) else 0.0 for text in fields[1:4]]
        places.append([float(fields[0]), *numbers, *[0.0] * (3 - len(numbers))])
        rows.append(row)
    return np.array(places, dtype=np.float64).reshape(-1, 4), np.array(rows, dtype=np.int64)


def read_elements(deck: Deck, findings: Findings, dialect: str = "abaqus") -> list[ElementTable]:
    """Return the elements of every ``*ELEMENT``; misspelt types, wrong counts and labels given twice are reported.

    CalculiX reads on until it has all nodes, with a comma at the end of a line or without, and passes over more.
    """
    parts: list[ElementTable] = []
    for block in deck.named("ELEMENT"):
        kind = (block.parameters.get("TYPE") or "").upper()
        count = kinds.node_count(kind)
        if not kinds.is_known(kind):
            near = misspelt(kind, kinds.EXAMPLES)
            if near is not None:
                findings.add(block, "element-type", f"*ELEMENT, TYPE={kind}: no such type; did you mean {near}?")
            else:
                findings.add(block, "not-checked", f"*ELEMENT, TYPE={kind}: elements of this type are not checked")
        if count is None:
            first = [line.fields[0] for line in block.data if line.fields and is_label(line.fields[0])]
            ids = np.array(list(map(int, first)), dtype=np.int64)
            parts.append(ElementTable(block, kind, ids, np.zeros((ids.size, 0), dtype=np.int64), _range(ids)))
            continue
        table = integer_rows(block.data, count + 1)
        rows = np.arange(len(block.data), dtype=np.int64)
        if table is None:
            table, rows = _element_lines(block, kind, count + 1, findings, dialect)
        parts.append(ElementTable(block, kind, table[:, 0], table[:, 1:], rows))
    _check_repeated_elements(parts, deck, findings)
    return parts


def _range(ids: IntArray) -> IntArray:
    return np.arange(ids.size, dtype=np.int64)


def _check_repeated_elements(parts: list[ElementTable], deck: Deck, findings: Findings) -> None:
    counted = [part for part in parts if part.nodes.shape[1]]
    if not counted:
        return
    starts = np.cumsum([0, *(part.ids.size for part in counted)]).tolist()

    def line(index: int) -> DataLine:
        which = bisect_right(starts, index) - 1
        return counted[which].line(index - starts[which])

    ids = np.concatenate([part.ids for part in counted])
    for first, second in _repeated(ids)[:MOST]:
        text = f"element {deck.label_name(int(ids[second]))} is already defined in line {line(first).number}"
        findings.add(line(second), "duplicate-element", text)


def _element_lines(
    block: KeywordBlock, kind: str, count: int, findings: Findings, dialect: str
) -> tuple[IntArray, IntArray]:
    """Read element lines one at a time, joining those that go on after a comma."""
    table: list[list[int]] = []
    rows: list[int] = []
    pending: list[int] = []
    start = 0
    for row, line in enumerate(block.data):
        fields = [text or "0" for text in line.fields]  # an end left out is the ground
        if not all(is_label(text) for text in fields):
            findings.add(line, "bad-element", f"*ELEMENT: {line.text[:40]}: expected whole numbers of up to 9 digits")
            pending = []
            continue
        start = start if pending else row
        pending += map(int, fields)
        if len(pending) < count and (line.text.endswith(",") or dialect == "calculix"):
            continue
        if len(pending) > count and dialect == "calculix":
            text = f"{kind} has {count - 1} nodes, this line gives {len(pending) - 1}: the rest is passed over"
            findings.add(block.data[start], "element-nodes", text, "warning")
            pending = pending[:count]
        if len(pending) == count:
            table.append(pending)
            rows.append(start)
        else:
            text = f"{kind} has {count - 1} nodes, this line gives {len(pending) - 1}"
            findings.add(block.data[start], "element-nodes", text)
        pending = []
    return np.array(table, dtype=np.int64).reshape(-1, count), np.array(rows, dtype=np.int64)
