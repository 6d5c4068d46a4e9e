"""A tread block as a Winkler foundation: independent columns of one modulus, Coulomb friction at their ends."""

import numpy as np

TIMES = 600
COLUMNS = 200


def forces(case):
    """Return time (s), normal and tangential force (N) of one pass.

    `case` is the case file as an object: ``case.block.length_m`` is ``"length_m"`` of ``"block"`` in the JSON.
    The modulus is the instantaneous one, the shear modulus a third of it, friction the static coefficient.
    """
    compound, block, path, road = case.compound, case.block, case.path, case.road
    modulus = compound.long_term_modulus_Pa + sum(term.modulus_Pa for term in compound.terms)
    friction = case.friction.static_coefficient

    time = np.linspace(0.0, 1.02 * case.expected_duration_s, TIMES + 1)
    step = time[1]
    cell = block.columns.s_m[-1] / COLUMNS
    s = (np.arange(COLUMNS) + 0.5) * cell
    height = np.interp(s, block.columns.s_m, block.columns.height_m)
    offset = np.interp(s, block.columns.s_m, block.columns.arc_offset_m)
    area = cell * np.interp(s, block.width_profile.s_m, block.width_profile.width_m)

    normal, tangential = np.zeros(time.size), np.zeros(time.size)
    shear, before = np.zeros(COLUMNS), np.full(COLUMNS, np.nan)
    for row, t in enumerate(time):
        arc = path.first_contact_arc_m + path.arc_speed_m_s * t - offset
        x, y, slope = (
            np.interp(arc, path.samples.arc_m, values)
            for values in (path.samples.x_m, path.samples.y_m, path.samples.slope_rad)
        )
        x, y = x + height * np.sin(slope), y - height * np.cos(slope)
        depth = -y if road.radius_m is None else road.radius_m - np.hypot(x, y + road.radius_m)
        pressure = modulus * np.maximum(depth, 0.0) / height
        touching = depth > 0.0
        if row:
            shear = shear + (road.surface_speed_m_s * step - (x - before)) * modulus / 3.0 / height
        shear = np.where(touching, np.clip(shear, -friction * pressure, friction * pressure), 0.0)
        before = x
        normal[row] = np.sum(pressure * area)
        tangential[row] = -np.sum(shear * area)
    return time, normal, tangential
