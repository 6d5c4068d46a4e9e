"""Reader of the ABAQUS keyword language: syntax only, no meaning."""

from .deck import Block, DataLine, Deck
from .problem import Difference, Part, Problem, differences, problem_of, problem_of_files
from .reader import read_deck

__all__ = [
    "Block", "DataLine", "Deck", "Difference", "Part", "Problem", "differences", "problem_of", "problem_of_files",
    "read_deck",
]  # fmt: skip
