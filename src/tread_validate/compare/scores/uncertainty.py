"""What is known of the uncertainty of two runs, and what it makes of a scalar or of the score of two histories."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..quantities import Quantity, Scalars
from .assessment import Parts

Uncertainty = float | Mapping[str, float] | None
Names = tuple[str, str, str]
TANGENTIAL_PEAKS = ("peak_positive_tangential_force", "peak_negative_tangential_force")

SAFETY = 1.25  # of a Richardson extrapolation from three meshes: Roache's GCI, 95 %


@dataclass(frozen=True)
class Uncertainties:
    """Relative standard uncertainties of the forces: one for all of them, or by quantity; None where not known."""

    data: Uncertainty
    numerical: Uncertainty
    inputs: Uncertainty

    def of_scalar(self, quantity: Quantity, reference: Scalars, predicted: Scalars) -> Parts:
        """Return what they make of one scalar, in its unit."""
        return Parts(
            _of_scalar(self.numerical, quantity, predicted),
            _of_scalar(self.inputs, quantity, predicted),
            _of_scalar(self.data, quantity, reference),
        )

    def of_history(self, quantity: str) -> Parts:
        """Return the relative errors of amplitude of a force history: its own, or those of its peaks."""
        return Parts(*(_amplitude(known, quantity) for known in (self.numerical, self.inputs, self.data)))


def from_mesh_error(error: Uncertainty) -> Uncertainty:
    """Turn relative mesh errors, as three meshes give them, into standard uncertainties.

    The grid convergence index, 1.25 times the extrapolated error, is a 95 % interval (Celik et al., J. Fluids Eng. 130
    (2008) 078001, doi:10.1115/1.2960953); ASME V&V 20 takes half of it as standard uncertainty.
    """
    if error is None:
        return None
    if isinstance(error, Mapping):
        return {name: 0.5 * SAFETY * value for name, value in error.items()}
    return 0.5 * SAFETY * error


def _of_scalar(known: Uncertainty, quantity: Quantity, values: Scalars) -> float | None:
    scales = values.as_dict()
    if known is None or quantity.name not in scales:
        return None
    if not isinstance(known, Mapping):
        return 0.0 if known == 0.0 else quantity.spread(known, quantity.name, scales)
    own = known.get(quantity.name)
    if own is None:
        return 0.0 if quantity.flag else None
    return own * abs(scales[quantity.name])


def _amplitude(known: Uncertainty, quantity: str) -> float | None:
    if not isinstance(known, Mapping):
        return known
    if quantity in known:
        return known[quantity]
    peaks = ("peak_normal_force",) if quantity == "normal_force" else TANGENTIAL_PEAKS
    found = [known[name] for name in peaks if name in known]
    return max(found) if found else None
