"""What a block of a part becomes in the flat deck: names qualified, labels raised, nodes placed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..errors import InputError
from .deck import DataLine, KeywordBlock, Lines, label
from .placement import RigidMotion, moved_nodes, moved_profile, still, system_motion
from .table import integer_rows

DEFINES = {
    "NSET": "NSET",
    "ELSET": "ELSET",
    "SURFACE": "NAME",
    "ORIENTATION": "NAME",
    "NODE": "NSET",
    "ELEMENT": "ELSET",
}
"""Keywords that define a name in their part, and by which parameter."""
REFERS = ("NSET", "ELSET", "REF NODE", "TIE NSET", "PIN NSET", "ANALYTICAL SURFACE", "ORIENTATION", "SURFACE")
"""Parameters that refer to a name or label of the part."""
ALL_LABELS = frozenset({"NSET", "ELSET"})
FIRST_LABEL = frozenset({
    "SURFACE", "BOUNDARY", "CLOAD", "DLOAD", "INITIAL CONDITIONS", "TEMPERATURE", "MASS", "TRANSFORM", "TIE",
    "CONTACT PAIR", "DSLOAD", "EMBEDDED ELEMENT", "EQUATION", "MPC",
})  # fmt: skip
"""Keywords whose data lines begin with a label or name of the part."""
UNPLACED = frozenset({"NGEN", "NFILL", "NCOPY", "ELCOPY", "ELGEN", "NMAP", "ORIENTATION", "TRANSFORM"})
"""Keywords that a moved or renumbered instance does not carry over."""


@dataclass(frozen=True)
class Scope:
    """What the names and labels of one instance become."""

    prefix: str
    first: int
    names: frozenset[str]

    def name(self, text: str) -> str:
        """Return a name or label of the part as the flat deck has it."""
        bare = text.strip()
        if bare.isdigit():
            return str(int(bare) + self.first) if self.first else bare
        named = label(bare)
        return f'"{self.prefix}.{named}"' if named in self.names and self.prefix else text


def placed_nodes(
    blocks: Iterable[KeywordBlock], motion: RigidMotion | None = None, first: int = 0
) -> Iterable[KeywordBlock]:
    """Apply ``*SYSTEM`` and the instance's motion to the nodes; everything else passes."""
    place = motion or still()
    local = still()
    for block in blocks:
        if block.keyword == "SYSTEM":
            local = system_motion(block)
        elif block.keyword == "NODE":
            yield moved_nodes(block, place.after(local), first)
        else:
            yield block


def is_analytical(block: KeywordBlock) -> bool:
    """Whether a ``*SURFACE`` is given by a profile."""
    return block.parameters.get("TYPE") in ("CYLINDER", "REVOLUTION", "SEGMENTS")


def part_names(blocks: Iterable[KeywordBlock]) -> Iterable[str]:
    """Yield the names that the blocks of a part define."""
    for block in blocks:
        parameter = DEFINES.get(block.keyword)
        value = block.parameters.get(parameter) if parameter else None
        if value:
            yield value


def qualified(block: KeywordBlock, scope: Scope, motion: RigidMotion, define: bool = True) -> KeywordBlock:
    """Return a block of a part as one of the flat deck."""
    parameters = dict(block.parameters)
    own = DEFINES.get(block.keyword)
    for name in {*REFERS, *([own] if own else [])} & set(parameters):
        value = parameters[name]
        if not value or (name == own and not define):
            continue
        parameters[name] = label(scope.name(f'"{value}"' if not value.isdigit() else value))
    data = block.data
    if block.keyword == "SURFACE" and is_analytical(block):
        block = moved_profile(block, motion)
        data = block.data
    elif block.keyword == "ELEMENT":
        data = _raised(block, scope.first)
    elif block.keyword in ALL_LABELS:
        data = _members(block, scope)
    elif block.keyword in FIRST_LABEL:
        data = block.data.with_texts([_first_named(line, scope) for line in block.data])
    return KeywordBlock(block.keyword, parameters, data, block.file, block.line, block.raw)


def _raised(block: KeywordBlock, first: int) -> Lines:
    """Return element lines with every label raised."""
    if not first or not len(block.data):
        return block.data
    rows = integer_rows(block.data, block.data.texts[0].count(",") + 1)
    if rows is not None:
        return block.data.with_texts([str(row)[1:-1] for row in (rows + first).tolist()])
    texts = []
    for line in block.data:
        if not all(text.isdigit() for text in line.fields if text):
            raise InputError(line.where, line.text[:40], "element label and nodes")
        raised = ", ".join(str(int(text) + first) if text else "" for text in line.fields)
        texts.append(raised + ("," if line.text.endswith(",") else ""))
    return block.data.with_texts(texts)


def _members(block: KeywordBlock, scope: Scope) -> Lines:
    """Return the data of ``*NSET`` or ``*ELSET``; the increment of GENERATE is no label."""
    generated = "GENERATE" in block.parameters
    if not scope.first and not scope.names:
        return block.data
    texts = []
    for line in block.data:
        fields = [scope.name(text) if text else text for text in line.fields]
        if generated and len(fields) > 2:
            fields[2:] = line.fields[2:]
        texts.append(", ".join(fields))
    return block.data.with_texts(texts)


def _first_named(line: DataLine, scope: Scope) -> str:
    fields = list(line.fields)
    if not fields or not fields[0]:
        return line.text
    fields[0] = scope.name(fields[0])
    return ", ".join(fields) + ("," if len(fields) == 1 else "")


def largest_label(blocks: Iterable[KeywordBlock]) -> int:
    """Return the largest node or element label that the blocks define."""
    largest = 0
    for block in blocks:
        if block.keyword not in ("NODE", "ELEMENT"):
            continue
        for text in block.data.texts:
            head = text.split(",", 1)[0].strip()
            if head.isdigit() and len(head) < 10:
                largest = max(largest, int(head))
    return largest


def round_up(value: int) -> int:
    """Return the power of ten above `value`, so that raised labels still show the one in the part."""
    return int(10 ** len(str(max(value, 1))))
