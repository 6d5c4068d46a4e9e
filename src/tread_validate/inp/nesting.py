"""Parts, instances and the assembly closed where they must have ended, so that what follows is read for what it is."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from .deck import KeywordBlock, Lines

Report = Callable[[str, str, object, str], None]

STRUCTURE = frozenset({"PART", "END PART", "INSTANCE", "END INSTANCE", "ASSEMBLY", "END ASSEMBLY"})
MODEL_LEVEL = frozenset({
    "AMPLITUDE", "BOUNDARY", "CONTACT", "CONTACT PAIR", "INITIAL CONDITIONS", "MATERIAL", "SECTION CONTROLS", "STEP",
    "SURFACE INTERACTION",
})  # fmt: skip
"""Keywords that stand neither in a part nor in an instance nor in the assembly."""


def nested(written: Sequence[KeywordBlock], report: Report) -> list[KeywordBlock]:
    """Return the blocks with every end that is missing put in, and every end of nothing left out.

    A missing end is put where the next part, instance or assembly begins or ends, or before the first keyword that
    cannot stand inside. `report` is told (rule, where, found, expected) at the line of what is not closed: "no *END"
    where lines before that place may belong inside or outside, else what stands before the end.
    """
    return _Nesting(written, report).run()


class _Nesting:
    def __init__(self, written: Sequence[KeywordBlock], report: Report) -> None:
        self.written = written
        self.report = report
        self.open: list[tuple[KeywordBlock, int]] = []
        self.out: list[KeywordBlock] = []
        self.meshed: set[str] = set()

    def run(self) -> list[KeywordBlock]:
        for position, block in enumerate(self.written):
            if block.keyword.startswith("END ") and block.keyword in STRUCTURE:
                self._end(block, position)
                continue
            if block.keyword in ("PART", "INSTANCE", "ASSEMBLY"):
                self._leave(("PART", "INSTANCE"), block, position)
                if block.keyword == "INSTANCE" and not self._is_open("ASSEMBLY"):
                    self._tell(block, "no *ASSEMBLY open", "*ASSEMBLY before it")
                    self._begin(KeywordBlock("ASSEMBLY", {}, Lines(block.file), block.file, block.line), position)
                self._begin(block, position)
                continue
            if self.open:
                self._leave_for(block, position)
            if block.keyword == "NODE" and self.open and self.open[-1][0].keyword == "PART":
                self.meshed.add(self.open[-1][0].parameters.get("NAME") or "")
            self.out.append(block)
        while self.open:
            self._close(None, len(self.written))
        return self.out

    def _begin(self, block: KeywordBlock, position: int) -> None:
        self.open.append((block, position))
        self.out.append(block)

    def _is_open(self, keyword: str) -> bool:
        return any(one.keyword == keyword for one, _ in self.open)

    def _end(self, block: KeywordBlock, position: int) -> None:
        keyword = block.keyword.removeprefix("END ")
        if not self._is_open(keyword):
            self._tell(block, f"no *{keyword} open", f"*{keyword} before it")
            return
        while self.open[-1][0].keyword != keyword:
            self._close(block, position)
        self.open.pop()
        self.out.append(block)

    def _leave(self, keywords: tuple[str, ...], block: KeywordBlock, position: int) -> None:
        while self.open and self.open[-1][0].keyword in keywords:
            self._close(block, position)

    def _leave_for(self, block: KeywordBlock, position: int) -> None:
        """Close what cannot hold `block`, unless its end does come."""
        model = block.keyword in MODEL_LEVEL
        inner = self.open[-1][0]
        second = (
            block.keyword == "NODE"
            and inner.keyword == "INSTANCE"
            and (inner.parameters.get("PART") or "") in self.meshed  # its nodes are those of the part
        )
        if not (model or second or (block.keyword in ("NSET", "ELSET") and "INSTANCE" in block.parameters)):
            return
        for keywords in (("PART", "INSTANCE"), ("ASSEMBLY",) if model else ()):
            if self.open and self.open[-1][0].keyword in keywords and not self._ends(position):
                self._close(block, position)

    def _ends(self, position: int) -> bool:
        """Whether the end of what is open comes before another of its kind begins, or what is around it ends."""
        keyword = self.open[-1][0].keyword
        others = STRUCTURE if keyword != "ASSEMBLY" else {"ASSEMBLY", "END ASSEMBLY"}
        ahead = (one.keyword for one in self.written[position:] if one.keyword in others)
        return next(ahead, "") == f"END {keyword}"

    def _close(self, before: KeywordBlock | None, position: int) -> None:
        """End what is open innermost, and say so."""
        block, first = self.open.pop()
        own = position - first - 1
        if before is None or (block.keyword == "INSTANCE" and own):
            found = f"no *END {block.keyword}" + (f" before line {before.line}" if before is not None else "")
        else:
            found = f"*{before.keyword} in line {before.line} before *END {block.keyword}"
        self._tell(block, found, f"*END {block.keyword}")
        where = before or block
        self.out.append(KeywordBlock(f"END {block.keyword}", {}, Lines(where.file), where.file, where.line))

    def _tell(self, block: KeywordBlock, found: str, expected: str) -> None:
        self.report("structure", f"{block.where}: *{block.keyword}", found, expected)
