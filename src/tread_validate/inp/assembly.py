"""Parts, instances and the assembly, resolved into the flat deck that means the same.

Each ``*INSTANCE`` yields the blocks of its part: nodes placed, node and element labels raised to a range of their own,
names of sets, surfaces and orientations qualified as ``INSTANCE.NAME``, which is how the rest of the deck refers to
them. ``*SYSTEM`` is applied to the nodes that follow it. Lines keep the file and number they are written at.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from ..errors import InputError
from .deck import LARGEST_LABEL, KeywordBlock, Lines, label
from .nesting import STRUCTURE, Report, nested
from .placement import can_move, instance_motion, still
from .qualify import (
    REFERS,
    UNPLACED,
    Scope,
    is_analytical,
    largest_label,
    part_names,
    placed_nodes,
    qualified,
    round_up,
)

MOST_LINES = 5_000_000
"""Data lines of all instances together: a part may be instanced without end."""


@dataclass
class _Part:
    """A part, or the own blocks of an instance or of the assembly."""

    name: str
    at: KeywordBlock
    blocks: list[KeywordBlock] = field(default_factory=list)


def resolve(
    written: Sequence[KeywordBlock], report: Report
) -> tuple[tuple[KeywordBlock, ...], tuple[tuple[int, str], ...]]:
    """Return the flat blocks of a deck and the first label of each instance.

    Parameters
    ----------
    written : sequence of KeywordBlock
        As read.
    report : callable
        Is told (rule, where, found, expected) of what does not resolve.

    Returns
    -------
    blocks, instances
        See `Deck`.
    """
    if not any(block.keyword in STRUCTURE or block.keyword == "SYSTEM" or "SYSTEM" in block.parameters
               for block in written):  # fmt: skip
        return tuple(written), ()
    return _Resolver(report).run(nested(written, report))


class _Resolver:
    """Walks through a deck and keeps what is open."""

    def __init__(self, report: Report) -> None:
        self.report = report
        self.parts: dict[str, _Part] = {}
        self.flat: list[KeywordBlock] = []
        self.instances: list[tuple[int, str]] = []
        self.names: set[str] = set()
        self.scopes: dict[str, Scope] = {}
        self.lines = 0
        self.next_label = 0
        self.uncounted: list[KeywordBlock] = []
        self.held: _Part | None = None
        self.assembled = False

    def run(self, written: Sequence[KeywordBlock]) -> tuple[tuple[KeywordBlock, ...], tuple[tuple[int, str], ...]]:
        """Resolve all blocks."""
        self._number_assembly(written)
        for block in written:
            if block.keyword in STRUCTURE:
                getattr(self, "_" + block.keyword.lower().replace(" ", "_"))(block)
            elif self.held is not None:
                self.held.blocks.append(block)
            elif self.assembled:
                self.flat.append(self._of_assembly(block))
            else:
                self.flat.append(block)
        return tuple(placed_nodes(self.flat)), tuple(self.instances)

    def _tell(self, rule: str, block: KeywordBlock, found: object, expected: str) -> None:
        self.report(rule, f"{block.where}: *{block.keyword}", found, expected)

    def _number_assembly(self, written: Sequence[KeywordBlock]) -> None:
        """Nodes and elements of the assembly itself keep their labels: instances begin above them."""
        inside, assembly, largest = False, False, 0
        for block in written:
            if block.keyword in ("PART", "INSTANCE"):
                inside = True
            elif block.keyword in ("END PART", "END INSTANCE"):
                inside = False
            elif block.keyword == "ASSEMBLY":
                inside, assembly = False, True
            elif not inside and block.keyword in ("NODE", "ELEMENT"):
                largest = max(largest, largest_label([block]))
        self.next_label = round_up(largest) if largest else 0
        if assembly and largest:
            self.instances.append((0, ""))

    # structure ------------------------------------------------------------------------------------------------

    def _part(self, block: KeywordBlock) -> None:
        name = block.parameters.get("NAME") or ""
        if name in self.parts:
            self._tell("duplicate-name", block, f"part {name} twice", "each part once")
        self.held = self.parts[name] = _Part(name, block)

    def _end_part(self, block: KeywordBlock) -> None:
        self.held = None

    def _assembly(self, block: KeywordBlock) -> None:
        self.assembled = True

    def _end_assembly(self, block: KeywordBlock) -> None:
        """What follows refers to names of instances as the assembly does."""

    def _instance(self, block: KeywordBlock) -> None:
        self.held = _Part(block.parameters.get("NAME") or "", block)

    def _end_instance(self, block: KeywordBlock) -> None:
        own, self.held = self.held, None
        assert own is not None  # what ends has begun: see `nested`
        self._place(own)

    # instances ------------------------------------------------------------------------------------------------

    def _place(self, own: _Part) -> None:
        """Add the blocks of one instance."""
        at = own.at
        name = own.name
        named = at.parameters.get("PART")
        if named is None:
            self.names.add(name)
            found = "an instance imported from another analysis" if "INSTANCE" in at.parameters else "no PART="
            self._tell("import", at, found, "PART=name of a part of this deck")
            return
        if not name or name in self.names:
            self._tell("duplicate-name", at, f"instance {name} twice" if name else "no NAME", "each instance once")
            return
        self.names.add(name)
        part = self.parts.get(named)
        if part is None:
            known = ", ".join(sorted(self.parts)[:6]) or "none"
            self._tell("dangling-part", at, f"part {named}", f"a *PART of the deck ({known})")
            return
        blocks = [*part.blocks, *own.blocks]
        before = self.lines
        self.lines += sum(len(block.data) for block in blocks)
        if before > MOST_LINES:
            return  # told already
        if self.lines > MOST_LINES:
            self._tell("not-placed", at, f"more than {MOST_LINES} lines in all instances together", "fewer")
            return
        try:
            motion = instance_motion(at)
        except InputError as error:
            self.report("structure", error.where, error.found, error.expected)
            motion = still()
        if self.uncounted:  # counted when another instance comes: a deck of one needs no count
            self.next_label += round_up(largest_label(self.uncounted))
        first, self.uncounted = self.next_label, blocks
        if first + (largest_label(blocks) if first else 0) > LARGEST_LABEL:
            self._tell("structure", at, f"labels beyond {LARGEST_LABEL} in all instances together", "fewer or lower")
            return
        self.instances.append((first, name))
        scope = self.scopes[name] = Scope(name, first, frozenset(part_names(blocks)))
        for block in placed_nodes(blocks, motion, first):
            fixed = block.keyword == "SURFACE" and is_analytical(block) and not can_move(block)
            if (fixed and not motion.is_identity) or (block.keyword in UNPLACED and (first or not motion.is_identity)):
                bare = fixed and block.parameters.get("TYPE") == "REVOLUTION"
                found = "TYPE=REVOLUTION without its axis" if bare else f"in instance {name}, moved or renumbered"
                self._tell("not-placed", block, found, "an instance as it stands")
            self.flat.append(qualified(block, scope, motion))

    def _of_assembly(self, block: KeywordBlock) -> KeywordBlock:
        """Return a block of the assembly or after it, with labels of the form ``INSTANCE.7`` resolved."""
        instance = block.parameters.get("INSTANCE")
        if block.keyword in ("NSET", "ELSET") and instance is not None:
            prefix = self.scopes.get(instance)
            if prefix is None:
                if instance not in self.names:  # else its own fault is told already
                    self._tell("dangling-instance", block, f"instance {instance}", "an *INSTANCE of the assembly")
                parameters = {name: value for name, value in block.parameters.items() if name in ("NSET", "ELSET")}
                return KeywordBlock(block.keyword, parameters, Lines(block.file), block.file, block.line, block.raw)
            block = qualified(block, prefix, still(), define=False)
            parameters = {name: value for name, value in block.parameters.items() if name != "INSTANCE"}
            return KeywordBlock(block.keyword, parameters, block.data, block.file, block.line, block.raw)
        return self._with_labels(block)

    def _with_labels(self, block: KeywordBlock) -> KeywordBlock:
        """Replace ``INSTANCE.7`` in data lines and parameters by the label that it is in the flat deck."""
        if block.keyword in ("NODE", "HEADING"):
            return block

        def replaced(text: str) -> str:
            head, point, tail = text.strip().rpartition(".")
            if not point or not tail.strip().isdigit() or not head or head[0].isdigit() or head[0] in "+-.":
                return text
            scope = self.scopes.get(label(head))
            return text if scope is None else str(scope.first + int(tail))

        parameters = {
            name: replaced(block.raw.get(name, value)) if value and name in REFERS and "." in value else value
            for name, value in block.parameters.items()
        }
        parameters = {
            name: value if value is None or value.isdigit() else block.parameters[name]
            for name, value in parameters.items()
        }
        texts = block.data.texts
        if any("." in text and any(letter.isalpha() for letter in text) for text in texts):
            texts = [
                ", ".join(replaced(one) for one in line.fields) + ("," if line.text.endswith(",") else "")
                if "." in line.text else line.text
                for line in block.data
            ]  # fmt: skip
            data = block.data.with_texts(texts)
        else:
            data = block.data
        return KeywordBlock(block.keyword, parameters, data, block.file, block.line, block.raw)
