"""Node and element sets: ``*NSET``, ``*ELSET`` and ``GENERATE``, read the same way by the engines and the lint.

Sets hold labels, each once, in rising order. A member is a label or a set defined before; a set given again grows.
``GENERATE`` takes ``first, last, increment``, with a whole number of increments from first to last.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from .deck import LARGEST_LABEL, DataLine, KeywordBlock, label
from .reader import Report, stop
from .table import integer_rows

Ints = NDArray[np.int64]
NONE: Ints = np.zeros(0, dtype=np.int64)


class Sets:
    """The node and element sets of a deck.

    Parameters
    ----------
    nodes, elements : (n,), (m,) arrays of int
        The labels that the deck defines.
    nodes_of_elements : callable, optional
        Takes element labels and returns the labels of their nodes (for ``*NSET, ELSET=``).
    report : callable, optional
        Is told (rule, where, found, expected) of faults; the first one stops by default.
    open_mesh : bool
        Whether the deck makes nodes or elements in a way that is not read: unknown labels are then no fault.
    """

    def __init__(
        self,
        nodes: Ints,
        elements: Ints,
        nodes_of_elements: Callable[[Ints], Ints] | None = None,
        report: Report = stop,
        open_mesh: bool = False,
    ) -> None:
        self.known: dict[str, Ints] = {"node": sorted_labels(nodes), "element": sorted_labels(elements)}
        self.tables: dict[str, dict[str, Ints]] = {"node": {}, "element": {}}
        self._nodes_of_elements = nodes_of_elements
        self._report = report
        self._open = open_mesh

    @property
    def nodes(self) -> Mapping[str, Ints]:
        """Labels of each node set."""
        return self.tables["node"]

    @property
    def elements(self) -> Mapping[str, Ints]:
        """Labels of each element set."""
        return self.tables["element"]

    def extend(self, what: str, name: str | None, members: Ints) -> None:
        """Add labels to a set of ``node`` or ``element``; without a name nothing is done."""
        if name:
            table = self.tables[what]
            old = table.get(name)
            table[name] = sorted_labels(members if old is None else np.concatenate([old, members]))

    def find(self, what: str, text: str) -> Ints | None:
        """Return the labels that a field means: a set's, or the one label; None where there is no such."""
        name = label(text)
        found = self.tables[what].get(name)
        if found is not None:
            return found
        if not is_label(name):
            return None
        return np.array([int(name)], dtype=np.int64) if self.exists(what, int(name)) else None

    def exists(self, what: str, number: int) -> bool:
        """Whether the deck defines the label (always, where the mesh is not known in full)."""
        known = self.known[what]
        at = int(np.searchsorted(known, number))
        return self._open or (at < known.size and int(known[at]) == number)

    def read(self, blocks: Iterable[KeywordBlock]) -> Sets:
        """Take in every ``*NSET`` and ``*ELSET``, in order."""
        for block in blocks:
            if block.keyword in ("NSET", "ELSET"):
                self._add(block)
        return self

    def _add(self, block: KeywordBlock) -> None:
        what = "node" if block.keyword == "NSET" else "element"
        parts: list[Ints] = []
        if "GENERATE" in block.parameters:
            parts = [self._generated(line, what) for line in block.data]
        else:
            plain = self._plain(block, what)
            if plain is not None:
                parts = [plain]
            else:
                parts = [self._member(text, line, what) for line in block.data for text in line.fields if text]
        source = block.parameters.get("ELSET") if what == "node" else None
        if source:
            parts.append(self._of_elements(block, source))
        self.extend(what, block.parameters.get(block.keyword), np.concatenate(parts) if parts else NONE)

    def _plain(self, block: KeywordBlock, what: str) -> Ints | None:
        """Return lines of nothing but known labels at once; None where there is more to it."""
        texts = [text.rstrip().rstrip(",") for text in block.data.texts]
        if len(texts) < 8:
            return None
        rows = integer_rows(block.data.with_texts([",".join(texts)]), sum(text.count(",") + 1 for text in texts))
        if rows is None:
            return None
        members = sorted_labels(rows.ravel())
        return members if self._open or np.isin(members, self.known[what], assume_unique=True).all() else None

    def _member(self, text: str, line: DataLine, what: str) -> Ints:
        found = self.find(what, text)
        if found is not None:
            return found
        if is_label(text):
            self._report(f"undefined-{what}", line.where, f"{what} {text}", f"a {what} that exists")
        elif not self._open:
            rule = "dangling-nset" if what == "node" else "dangling-elset"
            self._report(rule, line.where, f"{what} set {text[:40]}", f"a {what} set or label that exists")
        return NONE

    def _generated(self, line: DataLine, what: str) -> Ints:
        fields = line.fields
        where = line.where
        if not 2 <= len(fields) <= 3 or not all(is_label(text) for text in fields):
            self._report("generate", where, line.text[:40], "GENERATE: first, last, increment")
            return NONE
        first, last = int(fields[0]), int(fields[1])
        step = int(fields[2]) if len(fields) == 3 else 1
        if step < 1 or last < first:
            self._report("generate", where, line.text[:40], "GENERATE: first <= last and an increment of 1 or more")
            return NONE
        if (last - first) % step:
            self._report("generate", where, line.text[:40], "GENERATE: a whole number of increments from first to last")
        known = self.known[what]
        inside = known[np.searchsorted(known, first) : np.searchsorted(known, last, side="right")]
        found: Ints = inside[(inside - first) % step == 0]
        if self._open:
            return found
        if not found.size:
            self._report(f"undefined-{what}", where, f"no {what} from {first} to {last}", f"{what}s that exist")
        elif found.size != (last - first) // step + 1:
            missing = next(n for n in range(first, last + 1, step) if not self.exists(what, n))
            self._report("generate-missing", where, f"no {what} {missing}", f"every {what} from {first} to {last}")
        return found

    def _of_elements(self, block: KeywordBlock, source: str) -> Ints:
        members = self.elements.get(source)
        if members is None or self._nodes_of_elements is None:
            if not self._open:
                where = f"{block.where}: *NSET, ELSET"
                self._report("dangling-elset", where, f"element set {source}", "an element set that exists")
            return NONE
        return self._nodes_of_elements(members)


def sorted_labels(labels: Ints) -> Ints:
    """Return labels in rising order, each once; what is so already is returned as it is."""
    if labels.size < 2 or bool(np.all(labels[1:] > labels[:-1])):
        return labels
    rising = np.sort(labels)
    kept = np.ones(rising.size, dtype=np.bool_)
    kept[1:] = rising[1:] != rising[:-1]
    return np.asarray(rising[kept], dtype=np.int64)


def is_label(text: str) -> bool:
    """Whether a field is a node or element label."""
    return text.isascii() and text.isdigit() and len(text) < 10 and int(text) <= LARGEST_LABEL
