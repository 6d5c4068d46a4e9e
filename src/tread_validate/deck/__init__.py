"""ABAQUS/Explicit decks: written from a case, and checked by a reader of their own."""

from .model import WrittenDeck, build, write

__all__ = ["WrittenDeck", "build", "write"]
