"""The model hierarchy: what each level costs, how far it is off, what each effect is worth, and what hangs on what."""

from .build import Folders, build, representative

__all__ = ["Folders", "build", "representative"]
