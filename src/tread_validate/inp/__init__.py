"""Reader of the ABAQUS keyword language: syntax only, no meaning."""

from .deck import Block, DataLine, Deck
from .reader import read_deck

__all__ = ["Block", "DataLine", "Deck", "read_deck"]
