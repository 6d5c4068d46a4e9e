"""A designed study over the groups: a scrambled Sobol sequence turned into cases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import InputError
from ..friction import Coulomb
from ..geometry import Block, PathEntry
from ..geometry.paths.rig import Rig
from ..geometry.paths.simplified_belt import SimplifiedBelt
from ..study import Case
from ..units import MM

SEED = 20100672
HEIGHT_MM = 8.0
"""All blocks are as tall: the models are scale-free, and so is FE but for the wave speed, which is a group."""
RANGES = {
    "interference": (0.003, 0.08), "length": (1.25, 4.0), "width": (1.25, 3.0), "radius": (2.5, 30.0),
    "friction": (0.15, 1.2), "temperature": (-5.0, 60.0), "creep": (-1.5, 1.5), "speed_m_s": (1.0, 25.0),
    "poisson": (0.3, 0.495), "kind": (0.0, 1.0), "mounting": (0.0, 1.0),
    "shape": (0.0, 1.0), "skew_deg": (10.0, 35.0),
}  # fmt: skip
"""Between which values each direction of the sequence runs; those above 0 at both ends but for temperature, friction,
creep and Poisson's ratio in their logarithm."""
LOGARITHMIC = ("interference", "length", "width", "radius", "speed_m_s")
RIG_SHARE, SKEW_SHARE = 0.35, 0.2
"""Shares of the points on the rig, and of the parallelograms."""
FLAT_ON_RIG = 0.4
"""Share of flat blocks on the rig: enough that every kind of a map of 192 points has neighbours."""


def design(base: Case, count: int, begin: int = 0) -> list[Case]:
    """Return the cases begin..count-1 of the design; `base` gives compound and settings.

    The sequence does not depend on `count`: a longer study begins with the shorter one.
    """
    if count < 1:
        raise InputError("map: runs", count, "1 or more")
    from scipy.stats import qmc

    size = 1 << max(count - 1, 1).bit_length()
    points = qmc.Sobol(len(RANGES), seed=SEED, bits=30).random(max(size, 256))[begin:count]
    return [_case(base, begin + k, dict(zip(RANGES, point, strict=True))) for k, point in enumerate(points)]


def _case(base: Case, number: int, unit: dict[str, float]) -> Case:
    at = {}
    for name, (low, high) in RANGES.items():
        share = float(unit[name])
        at[name] = float(low * (high / low) ** share if name in LOGARITHMIC else low + share * (high - low))
    length, width = at["length"] * HEIGHT_MM, at["width"] * HEIGHT_MM
    rig = at["kind"] < RIG_SHARE
    assumed = {"origin": "assumed", "source": "a point of the validity map"}
    # a flat block on a wheel stands on its middle or its ends: most of the rig is conforming
    flat = at["mounting"] < (FLAT_ON_RIG if rig else 0.8)
    skewed = at["shape"] < SKEW_SHARE
    block = Block(
        **assumed, shape="parallelogram" if skewed else "rectangle", skew_deg=at["skew_deg"] if skewed else 0.0,
        length_mm=length, width_mm=width,
        height_mm=HEIGHT_MM, mounting="flat" if flat else "conforming",
    )  # fmt: skip
    radius = max(at["radius"] * length, 2.5 * HEIGHT_MM)
    path: PathEntry
    if rig:  # two wheels, the big one three times as large: 1/R1 + 1/(3 R1) = 1/R
        wheel = max(4.0 / 3.0 * radius, 6.0 * HEIGHT_MM)
        path = Rig(**assumed, kind="rig", small_wheel_diameter_mm=2.0 * wheel, big_wheel_diameter_mm=6.0 * wheel)
    else:
        path = SimplifiedBelt(**assumed, kind="simplified_belt", patch_length_mm=2.0 * length, edge_radius_mm=radius)
    law = Coulomb(**assumed, kind="coulomb", kinetic_coefficient=at["friction"], static_coefficient=at["friction"])
    strain = at["interference"]
    column = 2.0 * length if not rig else 2.0 * np.sqrt(2.0 * strain * HEIGHT_MM * radius)
    nu = round(at["poisson"], 4)
    limit = 2.0 * (1.0 + nu) * at["friction"] * strain * HEIGHT_MM / column
    creep = float(np.clip(at["creep"] * limit, -0.15, 0.15))
    return replace(
        base, case_id=f"map-{number:03d}", block=block, path=path, friction=law, block_name="map", path_name="map",
        friction_name="map", run="map", temperature=round(at["temperature"], 2), interference=strain * HEIGHT_MM * MM,
        speed=at["speed_m_s"], speed_rpm=None, creep_ratio=round(creep, 6), free_rolling=False,
        compound=base.compound.model_copy(update={"poissons_ratio": nu}),
    )  # fmt: skip
