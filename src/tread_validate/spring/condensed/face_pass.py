"""The condensed face as a variant of the spring model: forces on the uniform clock that all variants share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...geometry import Path, path_of
from ...study import Case
from .monotone import monotone
from .roll import CondensedSettings, FacePass, Ride, ride_of, roll
from .stepping import FaceBlock

Array = NDArray[np.float64]

COARSE = CondensedSettings(density=4.0, layers=8)
"""A face for thousands of runs."""
SAMPLES = 1500
"""Rows of a record per contact duration: the clock is finer than the solver's steps and is filled by interpolation."""


@dataclass(frozen=True)
class CondensedPass:
    """A case ready to run at any creep ratio."""

    case: Case
    settings: CondensedSettings
    step: float
    path: Path
    creep_tolerance: float = 2e-6
    """Creep ratios closer than this have one impulse, to the sweeps' tolerance."""

    def face(self, creep_ratio: float) -> FacePass:
        """Return the pass node by node, on the solver's own steps."""
        return roll(self.case.with_creep(creep_ratio), self.settings)

    def forces(self, creep_ratio: float) -> Array:
        """Return normal force, shear force (N, positive like lambda), touching and slipping area (m2), (n, 4)."""
        at = self._ride.moves.time
        along, up, touching, slipping = self._sums(creep_ratio).T
        time: Array = self.step * np.arange(int(np.ceil(at[-1] / self.step)), dtype=np.float64)
        smooth = monotone(at, np.column_stack([up, along]), time)
        areas = [np.interp(time, at, values) for values in (touching, slipping)]
        return np.column_stack([smooth, *areas])

    def net_shear_impulse(self, creep_ratio: float) -> float:
        """Return the time integral of the shear force over the pass, N s."""
        return float(np.trapezoid(self._sums(creep_ratio)[:, 0], self._ride.moves.time))

    @cached_property
    def _ride(self) -> Ride:
        return ride_of(self.case, self.settings, path=self.path)

    def _sums(self, creep_ratio: float) -> Array:
        """Return the sums of the record for the whole block."""
        return self._ride.copies * self._ride.record(creep_ratio, nodal=False).sums


def prepare_condensed(case: Case, settings: CondensedSettings | None = None) -> CondensedPass:
    """Return the case ready to run; raises `InputError` for a path, a block or a data file that will not do."""
    path = path_of(case)
    return CondensedPass(case, settings or CondensedSettings(), path.contact_duration / SAMPLES, path)


def prepare_coarse(case: Case) -> CondensedPass:
    """Return the case ready to run on the coarse face."""
    return prepare_condensed(case, COARSE)


def block_of(case: Case) -> FaceBlock:
    """Return the case's block as a state that a host advances."""
    return FaceBlock(case, CondensedSettings())


def coarse_block_of(case: Case) -> FaceBlock:
    """Return the same with a coarse face."""
    return FaceBlock(case, COARSE)
