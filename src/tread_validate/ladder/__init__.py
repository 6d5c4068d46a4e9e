"""The model ladder: what each rung costs, how far it is off, what each effect is worth, and what hangs on what."""

from .compatibility import compatibility_rows
from .effects import effect_rows
from .pareto import pareto_rows
from .published import combination_rows, published_rows
from .sensitivity import sobol_rows

__all__ = [
    "combination_rows", "compatibility_rows", "effect_rows", "pareto_rows", "published_rows", "sobol_rows",
]  # fmt: skip
