"""Friction between tread and road: laws, their kernel, and their fit to tribometer tables."""

from .fit import FrictionFit, fit_friction
from .kernel import kinetic_kernel
from .law_file import FrictionFile, friction_schema, read_friction
from .laws import FrictionLaw, coulomb_law, huemer_law, law, table_law
from .table_file import FrictionData, measured_table, read_friction_table, table_of

__all__ = [
    "FrictionData", "FrictionFile", "FrictionFit", "FrictionLaw", "coulomb_law", "fit_friction", "friction_schema",
    "huemer_law", "kinetic_kernel", "law", "measured_table", "read_friction", "read_friction_table", "table_law",
    "table_of",
]  # fmt: skip
