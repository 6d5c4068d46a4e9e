"""The viscoelastic spring model of a tread block in contact (section 4 of the paper)."""

from .creep import free_rolling_creep, resolve_creep
from .detail import ElementHistory, FaceAtInstant, element_history, face_at
from .run import run
from .variants import pass_of, register, variants

__all__ = [
    "ElementHistory", "FaceAtInstant", "element_history", "face_at", "free_rolling_creep", "pass_of", "register",
    "resolve_creep", "run", "variants",
]  # fmt: skip
