"""Numbers that sum up one block pass: the catalogue's scalars by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...history import History
from .catalogue import SCALARS
from .contact import contact_of


@dataclass(frozen=True)
class Scalars:
    """Scalars of one run, SI: each of the catalogue's names is an attribute (``peak_normal_force``, N, ...).

    What the history does not give the columns for has no scalar.
    """

    values: Mapping[str, float]

    def __getattr__(self, name: str) -> float:
        """Return one scalar by its name in the catalogue."""
        if name != "values" and name in self.values:
            return self.values[name]
        raise AttributeError(name)

    def as_dict(self) -> dict[str, float]:
        """Return the scalars by name."""
        return dict(self.values)


def scalars(history: History) -> Scalars:
    """Return the scalars of one run; raises `InputError` for a history without contact."""
    contact = contact_of(history)
    given = {"normal": True, "tangential": history.gives_tangential, "slip": history.gives_slip}
    return Scalars({quantity.name: float(quantity.compute(contact)) for quantity in SCALARS if given[quantity.needs]})
