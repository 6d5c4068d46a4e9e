"""The viscoelastic spring model of a tread block in contact (section 4 of the paper)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..later import loaded
from .creep import free_rolling_creep, resolve_creep
from .run import run
from .variants import pass_of, register, variants

if TYPE_CHECKING:
    from .detail import ElementHistory, FaceAtInstant, element_history, face_at

__all__ = [
    "ElementHistory",
    "FaceAtInstant",
    "element_history",
    "face_at",
    "free_rolling_creep",
    "pass_of",
    "register",
    "resolve_creep",
    "run",
    "variants",
]  # fmt: skip

_LATER = {
    "ElementHistory": ".detail",
    "FaceAtInstant": ".detail",
    "element_history": ".detail",
    "face_at": ".detail",
}


def __getattr__(name: str) -> Any:
    return loaded(__name__, _LATER, name)
