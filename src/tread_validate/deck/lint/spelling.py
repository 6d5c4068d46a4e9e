"""Whether an unknown word is a known one misspelt."""

from __future__ import annotations

from collections.abc import Iterable


def misspelt(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that `word` is one letter away from (two where both have eight or more), else None.

    A letter left out, put in, changed, or two neighbours swapped count as one.
    """
    best: tuple[int, str] | None = None
    for other in known:
        limit = 2 if min(len(word), len(other)) >= 8 else 1
        if min(len(word), len(other)) < 3 or abs(len(word) - len(other)) > limit:
            continue
        distance = _distance(word, other, limit)
        if distance <= limit and (best is None or distance < best[0]):
            best = distance, other
    return None if best is None else best[1]


def _distance(a: str, b: str, limit: int) -> int:
    """Return the edit distance with swaps of neighbours, or limit + 1 where it is larger."""
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        last, before, row = before, row, [i]
        for j, other in enumerate(b, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != other))
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == other:
                cost = min(cost, last[j - 2] + 1)
            row.append(cost)
        if min(row) > limit:
            return limit + 1
    return row[-1]
