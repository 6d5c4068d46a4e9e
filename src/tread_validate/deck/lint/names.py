"""What a deck defines and by which name, collected once for all rules."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...inp import DataLine, Deck, KeywordBlock, label
from ...inp.sets import Sets, is_label, sorted_labels
from .findings import Finding, Findings
from .mesh_tables import ElementTable, read_elements, read_nodes

IntArray = NDArray[np.int64]
FloatArray = NDArray[np.float64]
NO_IDS: IntArray = np.zeros(0, dtype=np.int64)
MOST = 5
"""Findings of one kind at most in one block of nodes or elements."""
GENERATORS = {
    "NGEN": "NSET", "NFILL": "NSET", "NCOPY": "NEW SET", "ELGEN": "ELSET", "ELCOPY": "NEW SET", "NMAP": "NSET",
    "SYMMETRIC MODEL GENERATION": "", "IMPORT": "", "IMPORT NSET": "", "IMPORT ELSET": "", "MATRIX INPUT": "",
    "SUBSTRUCTURE PROPERTY": "", "EMBEDDED ELEMENT": "", "ADAPTIVE MESH REFINEMENT": "", "TRACER PARTICLE": "",
}  # fmt: skip
"""Keywords that make nodes or elements which the lint does not, and the parameter that names them."""
NAMED = {
    "MATERIAL": "NAME",
    "AMPLITUDE": "NAME",
    "SURFACE": "NAME",
    "SURFACE INTERACTION": "NAME",
    "SECTION CONTROLS": "NAME",
    "ORIENTATION": "NAME",
}
"""Keywords that define a name, and by which parameter."""

LABEL = re.compile(r"(\S+)\.\d+")
UNENDED = re.compile(r"\bno \*END (PART|INSTANCE)")
"""What the reader says of a part or instance whose end is missing where it may have swallowed lines that follow it."""


@dataclass
class Names:
    """Definitions of a deck; ids are as in the flat deck, shown by `shown` as they are written."""

    deck: Deck
    node_ids: IntArray = field(default_factory=lambda: NO_IDS)
    coordinates: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    elements: list[ElementTable] = field(default_factory=list)
    sets: Sets = field(default_factory=lambda: Sets(NO_IDS, NO_IDS))
    named: dict[str, dict[str, KeywordBlock]] = field(default_factory=dict)
    explicit: bool = False
    mechanical: bool = False
    open_mesh: bool = False
    swallowed: bool = False
    unresolved: frozenset[str] = frozenset()
    fragment: bool = False

    @property
    def gaps(self) -> bool:
        """Whether part of the deck is missing or unread, so that any name might be defined there."""
        return bool(self.deck.gaps) or self.swallowed

    @property
    def nsets(self) -> dict[str, IntArray]:
        """Node labels of each set."""
        return self.sets.tables["node"]

    @property
    def elsets(self) -> dict[str, IntArray]:
        """Element labels of each set."""
        return self.sets.tables["element"]

    def lost(self, name: str) -> bool:
        """Whether a name belongs to an instance that does not resolve, which is told at the instance."""
        instance, point, _ = label(name).rpartition(".")
        return bool(point) and instance in self.unresolved

    def has(self, kind: str, name: str) -> bool:
        """Whether `kind` (``MATERIAL``, ``SURFACE``, ...) has something called `name`."""
        known = self.named.get(kind, {})
        return self.held_back(name, bool(known)) or label(name) in known or name in known

    def held_back(self, name: str, own: bool) -> bool:
        """Whether a name that nothing here defines may be defined elsewhere; `own`: the file defines such things."""
        return self.gaps or self.lost(name) or (self.fragment and not own)

    def nodes_of(self, text: str) -> IntArray | None:
        """Return the node ids of a node number or node set; None where there is no such."""
        found = self.sets.find("node", text)
        return NO_IDS if found is None and self.held_back(text, bool(self.node_ids.size)) else found

    def elements_of(self, text: str) -> IntArray | None:
        """Return the element ids of an element number or element set; None where there is no such."""
        found = self.sets.find("element", text)
        return NO_IDS if found is None and self.held_back(text, bool(self.elements)) else found

    def has_nset(self, name: str) -> bool:
        """Whether there is a node set of this name (or might be)."""
        return self.held_back(name, bool(self.nsets)) or label(name) in self.nsets or name in self.nsets

    def has_elset(self, name: str) -> bool:
        """Whether there is an element set of this name (or might be)."""
        return self.held_back(name, bool(self.elsets)) or label(name) in self.elsets or name in self.elsets

    def shown(self, number: int) -> str:
        """Return a label as it is written in its part."""
        return self.deck.label_name(int(number))


def collect(deck: Deck, findings: Findings, dialect: str = "abaqus") -> Names:
    """Collect the definitions; faults in the definitions themselves are reported on the way."""
    words = {block.keyword for block in deck.blocks}
    explicit = any("EXPLICIT" in block.parameters for block in deck.named("DYNAMIC"))
    placed = {name for _, name in deck.instances}
    declared = {block.parameters.get("NAME") or "" for block in deck.written if block.keyword == "INSTANCE"}
    names = Names(
        deck,
        unresolved=frozenset(declared - placed),
        fragment="STEP" not in words,
        explicit=(explicit or "DYNAMIC TEMPERATURE-DISPLACEMENT" in words) and dialect == "abaqus",
        swallowed=any(one.rule == "structure" and UNENDED.search(one.message) for one in findings),
        mechanical=bool(words & {"DYNAMIC", "STATIC", "VISCO"}),
    )
    made = sorted(words & set(GENERATORS))
    names.open_mesh = bool(made) or names.gaps
    if made:
        first = next(deck.named(*made))
        findings.add(first, "not-checked", f"*{first.keyword}: nodes and elements it makes are not followed")
    names.node_ids, names.coordinates = read_nodes(deck, findings)
    names.elements = read_elements(deck, findings, dialect)
    for keyword, parameter in NAMED.items():
        table = names.named.setdefault(keyword, {})
        for block in deck.named(keyword):
            name = block.parameters.get(parameter) or ""
            if name in table and not _may_repeat(block):
                first = table[name]
                findings.add(block, "duplicate-name", f"*{keyword} {name} is already defined in line {first.line}")
            table.setdefault(name, block)
    pairs = names.named.setdefault("CPSET", {})
    for block in deck.named("CONTACT PAIR"):
        if block.parameters.get("CPSET"):
            pairs.setdefault(block.value("CPSET"), block)
    _sets(deck, names, findings, dialect)
    return names


def _may_repeat(block: KeywordBlock) -> bool:
    """Whether a name may be given again: a surface that is combined or trimmed goes by another rule."""
    return block.keyword == "SURFACE" and bool({"COMBINE", "CROP", "TRIM"} & set(block.parameters))


def _sets(deck: Deck, names: Names, findings: Findings, dialect: str) -> None:
    """Build the sets in the order of the deck, through the reading that the engines use."""
    ids = np.concatenate([part.ids for part in names.elements]) if names.elements else NO_IDS

    def nodes_of(members: IntArray) -> IntArray:
        parts = [part.nodes[np.isin(part.ids, members)].ravel() for part in names.elements]
        return sorted_labels(np.concatenate(parts)) if parts else NO_IDS

    def report(rule: str, where: str, found: object, expected: str) -> None:
        missing = rule in ("undefined-node", "undefined-element")  # CalculiX leaves them out of a set and goes on
        findings.at(where, rule, found, expected, "warning" if missing and dialect == "calculix" else None)

    names.sets = Sets(names.node_ids, ids, nodes_of, report, names.open_mesh)
    for block in deck.blocks:
        if block.keyword == "NODE" and block.parameters.get("NSET"):
            names.sets.extend("node", block.parameters["NSET"], _first_labels(block.data))
        elif block.keyword in GENERATORS:
            what = "element" if GENERATORS[block.keyword] == "ELSET" or block.keyword == "ELCOPY" else "node"
            name = block.parameters.get(GENERATORS[block.keyword])
            if name:
                names.sets.extend(what, label(name), NO_IDS)
    for part in names.elements:
        names.sets.extend("element", part.block.parameters.get("ELSET"), part.ids)
    names.sets.read(deck.blocks)


def _first_labels(lines: Iterable[DataLine]) -> IntArray:
    texts = getattr(lines, "texts", [])
    found = [head for text in texts if is_label(head := text.split(",", 1)[0].strip())]
    return np.array(list(map(int, found)), dtype=np.int64)


def unique(findings: Iterable[Finding], instances: Iterable[str] = ()) -> list[Finding]:
    """Return the findings in order; what holds alike for each of the part's `instances` is said once."""
    last_words = {name.split()[-1] for name in instances if name.strip()}
    seen: dict[tuple[str, int, str, str], Finding] = {}
    for finding in findings:
        message = LABEL.sub(lambda found: "" if found[1] in last_words else found[0], finding.message)
        bare = "".join(letter for letter in message if not letter.isdigit())
        seen.setdefault((finding.file, finding.line, finding.rule, bare), finding)
    return sorted(seen.values())
