"""Embedded explicit finite element engine: runs the decks that ABAQUS/Explicit would be given.

Its physics comes from the deck's text and the compiled friction routine alone.
"""

from .result import FeResult
from .run import run_deck

__all__ = ["FeResult", "run_deck"]
