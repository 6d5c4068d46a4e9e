"""From a case of a study to its file."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..friction import FrictionLaw, law
from ..geometry import Path as BlockPath
from ..geometry import path_of
from ..material import PronySeries, prony_series
from ..study import Case
from ..units import DEG, MM
from . import document as doc

Array = NDArray[np.float64]

ARC_SAMPLES = 801
"""Samples of the path; the mount point of every column is on it from before first contact until after the last."""
MARGIN = 0.1
"""The samples go beyond the contact by this share of its arc at either end."""
COLUMN_SAMPLES = 51
DIGITS = 10
"""Significant digits of a computed number: more than any input has, fewer than the last bits of a library."""
PRESSURES = (1e4, 1e7, 31)
SLIP_SPEEDS = (1e-3, 1e2, 51)
"""Range and number of the friction table's levels, geometric, Pa and m/s."""


def case_file(case: Case) -> doc.CaseFile:
    """Return everything that a model needs to compute the pass of `case`.

    Raises `InputError` for a free-rolling case whose creep ratio has not been resolved, and for a case that cannot run.
    """
    if case.creep_ratio is None:
        raise InputError(
            f"case {case.case_id}: creep_ratio", "a free-rolling case, unresolved", "a resolved creep ratio"
        )
    path = path_of(case)
    return doc.CaseFile(
        case_id=case.case_id,
        study=case.study_name,
        case_digest=case.problem_digest(),
        temperature_degC=case.temperature,
        interference_m=_short(case.interference),
        speed_m_s=_short(case.speed),
        creep_ratio=_short(case.creep_ratio),
        free_rolling=case.free_rolling,
        expected_duration_s=_short(path.contact_duration),
        compound=_compound(case),
        friction=_friction(case),
        block=_block(case, path),
        path=_path(case, path),
        road=_road(case, path),
    )


def _compound(case: Case) -> doc.Compound:
    compound = case.compound
    series = prony_series(compound, case.root)
    warm: PronySeries = series.at_temperature(case.temperature, compound.time_shift)
    shift = float(warm.relaxation_times[0] / series.relaxation_times[0]) if series.relaxation_times.size else 1.0
    return doc.Compound(
        name=case.compound_name,
        origin=compound.origin,
        source=compound.source,
        temperature_degC=case.temperature,
        long_term_modulus_Pa=_short(warm.long_term_modulus),
        terms=tuple(
            doc.Term(modulus_Pa=_short(modulus), relaxation_time_s=_short(time))
            for modulus, time in zip(warm.moduli, warm.relaxation_times, strict=True)
        ),
        poissons_ratio=compound.poissons_ratio,
        density_kg_m3=compound.density_kg_m3,
        data_temperature_degC=series.reference_temperature,
        shift_factor=_short(shift),
        wlf=doc.CaseWlf(**compound.wlf.model_dump()) if compound.shift is None else None,
    )


def _friction(case: Case) -> doc.CaseFriction:
    friction: FrictionLaw = law(case.friction, case.root)
    pressures, speeds = np.geomspace(*PRESSURES), np.geomspace(*SLIP_SPEEDS)
    if friction.pressures.size:  # a measured table is handed on at its own levels
        pressures, speeds = friction.pressures, friction.slip_speeds
    table = friction.kinetic(pressures[:, None], speeds[None, :])
    return doc.CaseFriction(
        name=case.friction_name,
        origin=case.friction.origin,
        source=case.friction.source,
        kind=friction.kind,
        static_coefficient=friction.static_coefficient,
        constants={
            name: doc.Constant(value=value, unit=friction.form.units[name])
            for name, value in friction.constants.items()
        },
        table=doc.CaseFrictionTable(
            pressure_Pa=_numbers(pressures),
            slip_speed_m_s=_numbers(speeds),
            coefficient=tuple(_numbers(row) for row in table),
        ),
    )


def _block(case: Case, path: BlockPath) -> doc.CaseBlock:
    block, profile = case.block, path.profile
    skew = block.skew_deg * DEG
    s = np.linspace(0.0, profile.extent, COLUMN_SAMPLES)
    places, widths = _steps(profile.positions, profile.jumps, profile.kinks)
    return doc.CaseBlock(
        name=case.block_name,
        origin=block.origin,
        source=block.source,
        shape=block.shape,
        length_m=_short(case.length),
        width_m=_short(case.width),
        height_m=_short(case.height),
        skew_rad=_short(skew),
        mounting=block.mounting,
        sipes=tuple(
            doc.CaseSipe(
                position_m=_short(sipe.position_mm * MM),
                width_m=_short(sipe.width_mm * MM),
                depth_m=_short((sipe.depth_mm or block.height_mm) * MM),
            )
            for sipe in block.sipes
        ),
        draft_rad=_short(math.radians(block.draft_deg)),
        mesh=block.mesh,
        area_m2=_short(profile.area),
        outline_m=_outline(case, skew),
        width_profile=doc.CaseWidthProfile(s_m=_numbers(places), width_m=_numbers(widths)),
        columns=doc.CaseColumns(
            s_m=_numbers(s),
            arc_offset_m=_numbers(path.columns.arc_offset(s)),
            x_offset_m=_numbers(path.columns.x_offset(s)),
            height_m=_numbers(path.columns.column_height(s)),
        ),
    )


def _steps(positions: Array, jumps: Array, kinks: Array) -> tuple[Array, Array]:
    """Return the width profile as points with both values at a jump."""
    places, widths = [float(positions[0])], [0.0]
    width, slope = 0.0, 0.0
    for index, (place, jump, kink) in enumerate(zip(positions, jumps, kinks, strict=True)):
        if index:
            width += slope * float(place - positions[index - 1])
            places.append(float(place))
            widths.append(width)
        if jump:
            width += float(jump)
            places.append(float(place))
            widths.append(width)
        slope += float(kink)
    return np.array(places), np.abs(np.round(np.array(widths), 15))


def _outline(case: Case, skew: float) -> tuple[tuple[tuple[float, float], ...], ...]:
    """Return the polygons of the solid parts, corners in order; the leading corner is at s = 0."""
    lean = case.width * math.tan(skew) if case.block.shape == "parallelogram" else 0.0
    near, far = max(0.0, -lean), max(0.0, lean)
    half = 0.5 * case.width
    ends = [0.0]
    for sipe in case.block.sipes:
        ends += [sipe.position_mm * MM, (sipe.position_mm + sipe.width_mm) * MM]
    ends.append(case.length)
    return tuple(
        tuple(
            (_short(s), _short(z)) for s, z in ((a + near, -half), (b + near, -half), (b + far, half), (a + far, half))
        )
        for a, b in list(pairwise(ends))[::2]
        if b > a
    )


def _path(case: Case, path: BlockPath) -> doc.CasePath:
    first = path.first_contact_arc - float(path.columns.arc_offset(path.profile.extent))
    last = path.first_contact_arc + path.speed * path.contact_duration
    reach = MARGIN * (last - first)
    arc = np.linspace(first - reach, last + reach, ARC_SAMPLES)
    x, y, theta = path.mount(arc)
    return doc.CasePath(
        name=case.path_name,
        origin=case.path.origin,
        source=case.path.source,
        kind=case.path.kind,
        parameters=_parameters(case),
        first_contact_arc_m=_short(path.first_contact_arc),
        arc_speed_m_s=_short(path.speed),
        mount_speed_ratio=_short(path.line.speed_ratio),
        samples=doc.PathSamples(
            time_s=_numbers((arc - path.first_contact_arc) / path.speed),
            arc_m=_numbers(arc),
            x_m=_numbers(x),
            y_m=_numbers(y),
            slope_rad=_numbers(theta),
            curvature_1_m=_numbers(path.line.curvature(arc)),
        ),
    )


def _parameters(case: Case) -> dict[str, doc.Constant]:
    """Return the path's numbers by the study's keys, with the unit that the key names."""
    found = {}
    for key, value in case.path.model_dump(exclude={"kind", "origin", "source"}).items():
        if isinstance(value, int | float):
            name, _, unit = key.rpartition("_")
            factor = MM if unit == "mm" else 1.0
            found[name] = doc.Constant(value=_short(value * factor), unit="m" if unit == "mm" else unit)
    return found


def _road(case: Case, path: BlockPath) -> doc.CaseRoad:
    assert case.creep_ratio is not None
    return doc.CaseRoad(
        kind="plane" if path.road.is_plane else "wheel",
        radius_m=None if path.road.is_plane else _short(path.road.radius),
        surface_speed_m_s=_short(case.speed * (1.0 + case.creep_ratio)),
    )


def _numbers(values: Array) -> tuple[float, ...]:
    return tuple(_short(float(value)) for value in np.asarray(values, dtype=np.float64).ravel())


def _short(value: float) -> float:
    return float(f"{float(value):.{DIGITS}g}") + 0.0
