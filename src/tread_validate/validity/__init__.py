"""Where each model may be believed: errors against FE over the dimensionless groups, as a table and as a rule."""

from .rule import Expectation, expected_error, with_expectation

__all__ = ["Expectation", "expected_error", "with_expectation"]
