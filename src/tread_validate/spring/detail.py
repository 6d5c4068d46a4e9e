"""What happens inside a pass: one element against time, the whole face at one instant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..study import Case
from . import element_record as columns
from .block_pass import BlockPass, prepare
from .condensed.face_pass import CondensedPass
from .condensed.roll import FacePass
from .creep import resolve_creep
from .variants import pass_of

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class ElementHistory:
    """One element of the spring model against time; every array is (n,).

    Attributes
    ----------
    time : s
        From the block's first contact.
    radial_length, longitudinal_length : m
        delta and lambda; nan while the element does not touch.
    radial_force, longitudinal_force : N
        F_r and F_l of one of the block's n elements.
    friction_force : N
        Force of the road on the element, positive like lambda. It is F_l while the element sticks; with slip it
        differs from it by the lumped mass's inertia.
    slip_speed : m/s
    touches, slips : bool
    """

    time: Array
    radial_length: Array
    longitudinal_length: Array
    radial_force: Array
    longitudinal_force: Array
    friction_force: Array
    slip_speed: Array
    touches: Flags
    slips: Flags


@dataclass(frozen=True)
class FaceAtInstant:
    """The contact face along the block at one instant, means over the width; every array is (n,), a value an element.

    Attributes
    ----------
    place : m
        Middle of the element, from the end that touches first.
    contact_pressure, shear_traction : Pa
        The shear is that of the road on the block, positive towards the leading edge (-x), as T is.
    slips : bool
    area : m2
        Of the face, that the value stands for: pressure times area adds up to N.
    """

    place: Array
    contact_pressure: Array
    shear_traction: Array
    slips: Flags
    area: Array


def element_history(case: Case, s: float = 0.0, mass_factor: float = 1.0) -> ElementHistory:
    """Return the history of the element at `s` (m from the leading end) of a case of variant ``paper``."""
    block_pass, creep_ratio = _ready(case, mass_factor)
    record, _ = block_pass.element(creep_ratio, s)
    shift = float(s / block_pass.path.speed) if block_pass.path.columns.are_equal else 0.0
    area = block_pass.path.profile.area / block_pass.elements()[1].size
    touches = record[:, columns.TOUCHING] > 0.0
    return ElementHistory(
        time=np.asarray(shift + block_pass.step * np.arange(record.shape[0]), dtype=np.float64),
        radial_length=np.where(touches, record[:, columns.DELTA], np.nan),
        longitudinal_length=np.where(touches, record[:, columns.DEFLECTION], np.nan),
        radial_force=area * record[:, columns.PRESSURE],
        longitudinal_force=area * record[:, columns.SHEAR],
        friction_force=area * record[:, columns.FRICTION],
        slip_speed=record[:, columns.SLIP_SPEED],
        touches=touches,
        slips=record[:, columns.SLIPPING] > 0.0,
    )


def face_at(case: Case, time: float, mass_factor: float = 1.0, variant: str = "paper") -> FaceAtInstant:
    """Return pressure and shear along the block at one time (s from first contact) of a case.

    `mass_factor` is for the variant ``paper`` alone. Raises `InputError` for a variant that has no such face.
    """
    block_pass, creep_ratio = _ready(case, mass_factor)
    if variant != "paper":
        made = pass_of(case.with_creep(creep_ratio), variant)
        if isinstance(made, CondensedPass):
            return _condensed(made.face(creep_ratio), time)
        if not isinstance(made, BlockPass):
            raise InputError("variant", variant, "one with springs or with a condensed face")
        block_pass = made
    _, middles = block_pass.elements()
    values = np.zeros((middles.size, columns.COLUMNS))
    shared = block_pass.element(creep_ratio)[0] if block_pass.path.columns.are_equal else None
    for row, s in enumerate(middles):
        if shared is not None:
            values[row] = _row_at(shared, (time - s / block_pass.path.speed) / block_pass.step)
        else:
            values[row] = _row_at(block_pass.element(creep_ratio, float(s))[0], time / block_pass.step)
    return FaceAtInstant(
        place=middles,
        contact_pressure=values[:, columns.PRESSURE],
        shear_traction=-values[:, columns.SHEAR] + 0.0,
        slips=values[:, columns.SLIPPING] > 0.5,
        area=np.full(middles.size, block_pass.path.profile.area / middles.size),
    )


def _condensed(face: FacePass, time: float) -> FaceAtInstant:
    """Return the means over the width of a condensed face, at stations an element apart.

    A node's force and area go to the two stations beside it, in the proportion of their nearness: forces add up to
    those of the block.
    """
    later = int(np.clip(np.searchsorted(face.time, time), 1, face.time.size - 1))
    share = float(np.clip((time - face.time[later - 1]) / (face.time[later] - face.time[later - 1]), 0.0, 1.0))
    force = face.copies * ((1.0 - share) * face.force[later - 1] + share * face.force[later])
    slips = face.state[later if share > 0.5 else later - 1] == 2
    distance = face.body.along.max() - face.body.along
    across = face.body.face[:, 2]
    steps = np.diff(np.sort(distance[np.isclose(across, across.min())]))
    stations = 1 + round(float(np.ptp(distance) / steps.mean()))
    place = np.linspace(0.0, float(np.ptp(distance)), stations)
    left = np.clip(np.searchsorted(place, distance, side="right") - 1, 0, stations - 2)
    weight = (distance - place[left]) / (place[1] - place[0])
    values = np.column_stack([force[:, 1], -force[:, 0], face.copies * face.body.area, slips * face.body.area])
    summed = np.zeros((stations, 4))
    np.add.at(summed, left, (1.0 - weight)[:, None] * values)
    np.add.at(summed, left + 1, weight[:, None] * values)
    area = summed[:, 2]
    return FaceAtInstant(place, summed[:, 0] / area, summed[:, 1] / area, face.copies * summed[:, 3] > 0.5 * area, area)


def _ready(case: Case, mass_factor: float) -> tuple[BlockPass, float]:
    (case,) = resolve_creep([case])
    assert case.creep_ratio is not None
    return prepare(case, mass_factor), case.creep_ratio


def _row_at(record: Array, node: float) -> Array:
    """Return the record between nodes, linearly; zeros outside it."""
    if node < 0.0 or node >= record.shape[0] - 1:
        return np.zeros(record.shape[1])
    k = int(node)
    return np.asarray((1.0 - (node - k)) * record[k] + (node - k) * record[k + 1], dtype=np.float64)
