"""Where each model may be believed: errors against FE over the dimensionless groups, as a table and as a rule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..later import loaded

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
    return loaded(__name__, _LATER, name)
