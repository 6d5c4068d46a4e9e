"""The viscoelastic spring model of a tread block in contact (section 4 of the paper)."""

from .creep import free_rolling_creep, resolve_creep
from .run import run
from .variants import pass_of, register, variants

__all__ = ["free_rolling_creep", "pass_of", "register", "resolve_creep", "run", "variants"]
