"""ABAQUS/Explicit decks: written from a case, and checked by a reader of their own."""

from .model import Deck, build, write

__all__ = ["Deck", "build", "write"]
