"""A deck with its includes, parameters and instances written out: what the engines run, as text."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from .deck import Deck
from .reader import read_deck


def expand(deck: Deck | Path | str) -> str:
    """Return the flat text of a deck: one keyword line for each block, its data lines, no comments.

    Includes stand in their place, every ``<name>`` is its value, parts are placed and keyword lines are whole; a deck
    that uses none of these comes back with its own lines. Two decks that expand to the same lines are the same run.

    Raises
    ------
    InputError
        What `read_deck` raises.
    """
    return "\n".join(expanded_lines(deck)) + "\n"


def expanded_lines(deck: Deck | Path | str) -> Iterator[str]:
    """Yield the lines of `expand`."""
    read = deck if isinstance(deck, Deck) else read_deck(deck)
    for block in read.blocks:
        yield block.text
        yield from block.data.texts
