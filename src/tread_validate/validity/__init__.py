"""Where each model may be believed: errors against FE over the dimensionless groups, as a table and as a rule."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..later import loader

if TYPE_CHECKING:
    from .rule import Expectation, expected_error, with_expectation

__all__ = [
    "Expectation",
    "expected_error",
    "with_expectation",
]  # fmt: skip

__getattr__ = loader(
    __name__,
    {
        "Expectation": ".rule",
        "expected_error": ".rule",
        "with_expectation": ".rule",
    },
)
