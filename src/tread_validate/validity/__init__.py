"""Where each model may be believed: errors against FE over the dimensionless groups, as a table and as a rule."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .rule import Expectation, expected_error, with_expectation

__all__ = [
    "Expectation",
    "expected_error",
    "with_expectation",
]  # fmt: skip

_LATER = {
    "Expectation": ".rule",
    "expected_error": ".rule",
    "with_expectation": ".rule",
}


def __getattr__(name: str) -> Any:
    """Load what is offered when it is first asked for: a command needs little of it."""
    if name in _LATER:
        return getattr(import_module(_LATER[name], __name__), name)
    raise AttributeError(f"module {__name__} has no attribute {name}")
