"""Reader of the ABAQUS keyword language: syntax, includes, parameters, assemblies and sets; no mechanics."""

from .deck import DataLine, Deck, KeywordBlock, Lines, label
from .expand import expand, expanded_lines
from .problem import DeckDifference, DeckFiles, Part, Problem, agree, deck_files, differences, problem_of
from .reader import read_deck

__all__ = [
    "DataLine",
    "Deck",
    "DeckDifference",
    "DeckFiles",
    "KeywordBlock",
    "Lines",
    "Part",
    "Problem",
    "agree",
    "deck_files",
    "differences",
    "expand",
    "expanded_lines",
    "label",
    "problem_of",
    "read_deck",
]  # fmt: skip
