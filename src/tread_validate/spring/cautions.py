"""What a case asks of the spring models that they have not been shown to give."""

from __future__ import annotations

import math

from ..friction import FrictionLaw
from ..geometry import path_of
from ..study import Case
from ..units import MM
from .rubber import law_of, series_of

DEEP = 0.1
"""D/h beyond which strains near the face are no longer small: against FE up to here."""
INCOMPRESSIBLE = 0.495
"""Poisson's ratio beyond which nothing was compared with FE."""
SHARP = 1.5
"""Radius of the path over the block's height below which the block's frame turns by more than a block can follow."""
SLIDING = 0.7
"""Creep strain over the sticking limit from which on a large part of the face slides."""
HEAVY = 0.35
"""Speed over the shear wave's from which on the lumped mass of `paper` moves T by some per cent (7.8 % at 60 m/s on
the study's belt block, V/c_s = 0.53), and waves run in the real block."""
STRUCK = 0.4
"""Speed at which the road first meets the face, V sqrt(2 D/R), over c_s D/h, that with which a shear wave carries the
strain away: on the rig N of `condensed` is 1 % low below it, 4 to 8 % low from 0.5 to 1, and 20 % at 2.4."""

SHEARED = 0.4
"""Mean shear strain squared over D/h beyond which friction presses the block down by more than a second order follows.
Flat block, R/l 2.7, D/h 0.011 against FE: N 1 % low at 0.24 (mu 0.8), 15 % high at 0.65 (0.95), 25 % at 0.9 (1.12)."""


def cautions(case: Case, variant: str) -> tuple[str, ...]:
    """Return what to be wary of, one line each; empty for a case like those that were compared with FE."""
    path, series, friction = path_of(case), series_of(case), law_of(case)
    nu = case.compound.poissons_ratio
    found = []
    depth = case.interference / case.height
    if depth > DEEP:
        found.append(f"interference {100 * depth:.0f} % of the height: small strains end at {100 * DEEP:.0f} %")
    if nu > INCOMPRESSIBLE:
        found.append(f"Poisson's ratio {nu:g}: compared with FE up to {INCOMPRESSIBLE:g}")
    if case.compound.elasticity != "linear":
        found.append(
            f"linear viscoelastic; decks of this compound are neo-Hookean: N 1 % lower at D/h 0.04, 2 % at {DEEP:g}"
        )
    bend = abs(float(path.line.curvature(path.first_contact_arc)))
    if bend * case.height * SHARP > 1.0:
        found.append(f"path radius {1.0 / bend / MM:.3g} mm below {SHARP:g} times the block's height")
    instant = series.instantaneous_modulus / (2.0 * (1.0 + nu))
    ratio = case.speed / math.sqrt(instant / case.compound.density_kg_m3)
    if ratio > HEAVY:
        mass = "the lumped mass moves T by some per cent; " if variant == "paper" else "no inertia in the model; "
        found.append(f"{mass}speed {ratio:.2f} of the shear wave's")
    struck = ratio * math.sqrt(2.0 * _bend(case) * case.height / depth) if depth > 0.0 else 0.0
    if struck > STRUCK:
        found.append(
            f"no waves in the model; the road meets the face at {struck:.2f} of the speed with which shear waves carry "
            f"the strain away: N some per cent low above {STRUCK:g}"
        )
    if case.creep_ratio is not None:
        column = max(path.contact_duration - path.columns.extent / path.speed, 0.0)
        limit = 2.0 * (1.0 + nu) * friction.static_coefficient * depth
        strain = abs(case.creep_ratio) * path.speed * column / case.height
        pressure = float(series.relaxation_modulus(0.5 * path.contact_duration)) * depth
        slip = abs(case.creep_ratio) * case.speed
        if limit > 0.0 and strain > SLIDING * limit and _falls(friction, pressure, slip):
            found.append(
                "no reliable history in this regime: much of the face slides where friction falls with slip or drops "
                "when it begins; forces depend on mesh and step, in FE too"
            )
    return tuple(found)


def sheared(case: Case, variant: str, tangential: float) -> tuple[str, ...]:
    """Return what to be wary of in a prediction of `condensed` with this largest size of T (N)."""
    depth = case.interference / case.height
    if not variant.startswith("condensed") or depth <= 0.0:
        return ()
    young = float(series_of(case).relaxation_modulus(0.5 * path_of(case).contact_duration))
    area = case.block.length_mm * case.block.width_mm * MM**2
    strain = 2.0 * (1.0 + case.compound.poissons_ratio) * tangential / (young * area)
    share = strain**2 / depth
    if share <= SHEARED:
        return ()
    return (
        f"outside the map: mean shear strain {100 * strain:.0f} %, its square {share:.2f} of D/h; friction presses the "
        f"block down by more than a second order follows, N may be tens of per cent high above {SHEARED:g}",
    )


def _bend(case: Case) -> float:
    """Return the curvature of the path relative to the road where the block first touches, 1/m."""
    path = path_of(case)
    bend = abs(float(path.line.curvature(path.first_contact_arc)))
    return bend if path.road.is_plane else bend + 1.0 / path.road.radius


def _falls(friction: FrictionLaw, pressure: float, slip: float) -> bool:
    """Tell whether friction is smaller at this slip speed (m/s) than at rest or at half the speed, by 2 % or more."""
    here, slower = (float(friction.kinetic(pressure, speed)) for speed in (slip, 0.5 * slip))
    return here < 0.98 * max(friction.static_coefficient, slower)
