"""The dimensionless groups that decide how a block rolls, and with it how far a model of it may be believed."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from ..geometry import path_of
from ..spring.rubber import law_of, series_of
from ..study import Case
from ..units import MM

Array = NDArray[np.float64]


def kind_of(case: Case) -> str:
    """Return within what the groups are compared: the family of the path and how the block sits on its mount."""
    return f"{case.path.family}, {case.block.mounting}"


@dataclass(frozen=True)
class Groups:
    """Groups of one case, dimensionless.

    Attributes
    ----------
    interference : D/h
    length, width : l/h, w/h
    radius : R/l
        Radius of the path relative to the road where the block first touches, over the block's length.
    friction : mu_s
    law : mu_s G/p
        Friction over the shear stiffness, p = E D/h; follows from D/h, mu_s and nu.
    relaxation : V tau/l
        tau the mean relaxation time, weighted in its logarithm by the moduli.
    creep : creep strain over the sticking limit
        Creep ratio times the length of contact of a column, over h mu_s p/G: beyond 1 a block slides.
    speed : V/c_s
        c_s = sqrt(G_0/rho), the wave speed of shear.
    poisson : nu
    skew : rad
        Angle of a parallelogram's edges, its size.
    """

    interference: float
    length: float
    width: float
    radius: float
    friction: float
    law: float
    relaxation: float
    creep: float
    speed: float
    poisson: float
    skew: float


def strike(groups: Groups) -> float:
    """Return V sqrt(2 D/R), at which the road meets the face, over c_s D/h, at which shear waves carry strain away."""
    return groups.speed * math.sqrt(2.0 / (groups.interference * groups.radius * groups.length))


LINEAR = ("friction", "creep", "skew")
"""Groups that are compared as they are; the others by their logarithm, Poisson's ratio by that of 1 - 2 nu."""
SLID = 1.5
"""Creep over the sticking limit beyond which a face slides from end to end, and constant friction knows no more."""
NAMES = tuple(field.name for field in fields(Groups))


def groups_of(case: Case) -> Groups:
    """Return the groups of a case whose creep ratio is known."""
    assert case.creep_ratio is not None
    path, series = path_of(case), series_of(case)
    height = case.height
    length, width = case.block.length_mm * MM, case.block.width_mm * MM
    nu, friction = case.compound.poissons_ratio, law_of(case).static_coefficient
    bend = abs(float(path.line.curvature(path.first_contact_arc)))
    bend += 0.0 if path.road.is_plane else 1.0 / path.road.radius
    column = max(path.contact_duration - path.columns.extent / path.speed, 0.0)
    strain = case.interference / height
    total = float(series.moduli.sum())
    mean_time = math.exp(float(series.moduli @ np.log(series.relaxation_times)) / total) if total > 0.0 else 0.0
    shear = series.instantaneous_modulus / (2.0 * (1.0 + nu))
    law = friction / (2.0 * (1.0 + nu) * strain)
    sheared = case.creep_ratio * path.speed * column / height
    return Groups(
        interference=strain,
        length=length / height,
        width=width / height,
        radius=1.0 / (max(bend, 1e-6) * length),
        friction=friction,
        law=law,
        relaxation=path.speed * mean_time / length,
        creep=sheared / max(2.0 * (1.0 + nu) * friction * strain, 1e-9),
        speed=path.speed / math.sqrt(shear / case.compound.density_kg_m3),
        poisson=nu,
        skew=abs(math.radians(case.block.skew_deg)),
    )


def coordinates(groups: Groups) -> Array:
    """Return the groups as numbers to measure distances with, (11,)."""
    values = {name: getattr(groups, name) for name in NAMES}
    values["creep"] = min(max(groups.creep, -SLID), SLID)
    values["poisson"] = 1.0 - 2.0 * groups.poisson
    return np.array([values[name] if name in LINEAR else math.log(max(values[name], 1e-12)) for name in NAMES])
