"""Friction between tread and road: laws, their kernel, and their fit to tribometer tables."""

from .kernel import kinetic_kernel
from .laws import FrictionLaw, coulomb_law, huemer_law, law, table_law

__all__ = ["FrictionLaw", "coulomb_law", "huemer_law", "kinetic_kernel", "law", "table_law"]
