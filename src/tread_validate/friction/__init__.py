"""Friction between tread and road: laws, their kernel, and their fit to tribometer tables."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .kernel import kinetic_kernel
from .law import FrictionEntry, FrictionLaw, LawForm
from .law_file import FrictionFile, friction_schema, read_friction
from .laws import ENTRIES, FORMS, Friction
from .laws.coulomb import Coulomb, coulomb_law
from .laws.huemer import Huemer, huemer_law
from .laws.huemer_file import HuemerFile
from .laws.power import Power, power_law
from .laws.table import FrictionTable, table_law
from .table_file import FrictionData, read_friction_table, table_of

if TYPE_CHECKING:
    from .fit import FrictionFit, fit_friction

__all__ = [
    "ENTRIES", "FORMS", "Coulomb", "Friction", "FrictionData", "FrictionEntry", "FrictionFile", "FrictionFit",
    "FrictionLaw", "FrictionTable", "Huemer", "HuemerFile", "LawForm", "Power", "coulomb_law", "fit_friction",
    "friction_schema", "huemer_law", "kinetic_kernel", "law", "measured_table", "power_law", "read_friction",
    "read_friction_table", "table_law", "table_of",
]  # fmt: skip


def law(friction: FrictionEntry, root: Path | str | None = None) -> FrictionLaw:
    """Return the law of a study's friction entry.

    A file name in it is relative to `root` (the study's root; the working directory where it is None). Raises
    `InputError` for a file that is missing or wrong and for constants that make no law.
    """
    return friction.law(Path(root) if root is not None else Path())


def measured_table(friction: FrictionEntry, root: Path | str | None = None) -> FrictionData | None:
    """Return the measurements behind a study's law, for a report; None for a law without any."""
    return friction.measurements(Path(root) if root is not None else Path())


def __getattr__(name: str) -> object:
    """Load the fit, and SciPy's optimisers with it, when it is first asked for."""
    if name in ("FrictionFit", "fit_friction"):
        from . import fit

        return getattr(fit, name)
    raise AttributeError(f"module {__name__} has no attribute {name}")
