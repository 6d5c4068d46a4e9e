"""Reader of the ABAQUS keyword language: syntax, includes, parameters, assemblies and sets; no mechanics."""

from .deck import Block, DataLine, Deck, Lines, label
from .expand import expand, expanded_lines
from .problem import Difference, Part, Problem, differences, problem_of, problem_of_files
from .reader import read_deck

__all__ = [
    "Block", "DataLine", "Deck", "Difference", "Lines", "Part", "Problem", "differences", "expand", "expanded_lines",
    "label", "problem_of", "problem_of_files", "read_deck",
]  # fmt: skip
