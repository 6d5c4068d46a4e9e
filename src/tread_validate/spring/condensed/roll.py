"""One pass of the condensed face: case in, nodal forces and history out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...friction import FrictionLaw
from ...geometry import Path, path_of
from ...material import PronySeries
from ...study import Case
from ..inputs import KernelLaw
from ..rubber import law_of, series_of
from .body import ON_WHEEL, Body, BodySettings, fitted
from .inputs import SLIP, SMALL_STRAIN, RoadMotion, Scene, Solid, Solver, fresh_state, scratch
from .march import Course, Record, clear_at_first, march, record_of
from .mesh_body import mesh_file_of
from .motion import free_shape, motion
from .operators import FaceOperators
from .store import ReadyFace, ready

Array = NDArray[np.float64]


LEAD, LONGEST_LEAD = 2.0, 64.0
"""Elements of travel before the first contact of a column at which a pass starts: the bent mount pushes the face's
corner out, which meets the road earlier. Doubled until the face is clear of the road, up to the longest."""


@dataclass(frozen=True)
class CondensedSettings:
    """How the condensed face is discretised.

    Attributes
    ----------
    density : float
        Elements of the face along the block per height of the block; `ON_WHEEL` times as many on a wheel.
    layers : int
        Elements over the height.
    body : BodySettings or None
        The division of the block where it shall not follow from the block.
    step : float
        Travel per step while an edge of the contact moves over the face, in elements (of a face on a belt).
    long_step : float
        The same where the contact grows longer than the face (a belt).
    middle_step : float
        The same while all of the face is on the road and is still pressed in or lifted.
    longest_step : float
        The same while the whole face lies still.
    finite_strain : bool
        Take strain and rotation to second order.
    mesh_correction : bool
        Scale the face's stiffness to the static stiffness of the limit of fine meshes.
    tolerance : float
        Change of a node's force in the last sweep over the largest nodal force.
    """

    density: float = 8.0
    layers: int = 12
    body: BodySettings | None = None
    step: float = 0.6
    long_step: float = 0.8
    middle_step: float = 2.0
    longest_step: float = 8.0
    finite_strain: bool = True
    mesh_correction: bool = True
    tolerance: float = 1e-3
    most_sweeps: int = 200


@dataclass(frozen=True)
class FacePass:
    """Everything the condensed face knows about a pass.

    Attributes
    ----------
    time : (m,) array, s
    force : (m, n, 3) array, N
        Force of the road on the nodes, axle frame; of the half block where `body.half`.
    displacement : (m, n, 3) array, m
        Elastic displacement of the face's nodes in the block's frame.
    state : (m, n) array of int
        0 free, 1 sticking, 2 slipping.
    sweeps : (m,) array of int
    """

    body: Body
    time: Array
    force: Array
    displacement: Array
    state: NDArray[np.int64]
    sweeps: NDArray[np.int64]

    @property
    def copies(self) -> float:
        """How many times the body stands in the block."""
        return 2.0 if self.body.half else 1.0

    @property
    def normal_force(self) -> Array:
        """N(t) of the whole block, N."""
        return np.asarray(self.copies * self.force[:, :, 1].sum(axis=1))

    @property
    def tangential_force(self) -> Array:
        """T(t) of the whole block, positive towards the leading edge, N."""
        return np.asarray(-self.copies * self.force[:, :, 0].sum(axis=1))

    @property
    def slipping_fraction(self) -> Array:
        """Slipping over touching area, 0..1."""
        touching = (self.state > 0) @ self.body.area
        return np.asarray(
            np.where(touching > 0, (self.state == SLIP) @ self.body.area / np.maximum(touching, 1e-30), 0.0)
        )


def roll(
    case: Case,
    settings: CondensedSettings | None = None,
    series: PronySeries | None = None,
    friction: FrictionLaw | None = None,
) -> FacePass:
    """Run one pass of a case whose creep ratio is known.

    `series` (at the case's temperature) and `friction` replace the case's own where given. Raises `InputError` for a
    case without a creep ratio, and for a path or a block that will not do.
    """
    if case.creep_ratio is None:
        raise InputError(f"case {case.case_id}: creep ratio", "none yet", "a resolved free-rolling case")
    ride = ride_of(case, settings or CondensedSettings(), series, friction)
    return FacePass(ride.face.body, ride.moves.time, *ride.record(case.creep_ratio)[:4])


@dataclass(frozen=True)
class Ride:
    """A case's face on its path, ready to roll at any creep ratio; `speed` (m/s) is the path's."""

    face: ReadyFace
    scene: Scene
    moves: Course
    speed: float

    @property
    def copies(self) -> float:
        """How many times the body stands in the block."""
        return 2.0 if self.face.body.half else 1.0

    def record(self, creep_ratio: float, nodal: bool = True) -> Record:
        """Run the pass; `nodal`: with what each node does."""
        parts = self.face.operators
        known = parts.count
        road = RoadMotion(self.scene.road.radius, self.speed * (1.0 + creep_ratio))
        record = run_course(self.moves, self.scene._replace(road=road), parts, nodal)
        if parts.count > known:
            self.face.remember()
        return record


def ride_of(
    case: Case,
    settings: CondensedSettings,
    series: PronySeries | None = None,
    friction: FrictionLaw | None = None,
    path: Path | None = None,
) -> Ride:
    """Return the case on its path (made if not given); arguments and errors as of `roll`, at any creep ratio."""
    path = path or path_of(case)
    face, scene, division = scene_of(case, path, settings, series, friction)
    bend = face.bend if settings.finite_strain else face.bend[:0]
    size = division.face_size * (ON_WHEEL if settings.body is None and _on_wheel(path) else 1.0)
    lead = LEAD
    while True:
        time = step_times(path, size, settings, lead)
        moves = motion(path, face, bend, case.height, time)
        if clear_at_first(moves, path.road.radius):
            return Ride(face, scene, moves, path.speed)
        if lead > LONGEST_LEAD:
            where = f"case {case.case_id}: path"
            raise InputError(where, "a face in the road all the time", "a path that comes down to it")
        lead *= 2.0


def scene_of(
    case: Case,
    path: Path,
    settings: CondensedSettings,
    series: PronySeries | None = None,
    friction: FrictionLaw | None = None,
) -> tuple[ReadyFace, Scene, BodySettings]:
    """Return the case's face, what stays the same over its pass (the road at rest), and its division."""
    division = settings.body or fitted(case.block, settings.density, settings.layers, _on_wheel(path))
    shape = free_shape(path, case.block)
    file = mesh_file_of(case)
    face = ready(case.block, shape, division, case.compound.poissons_ratio, settings.mesh_correction, file)
    series, friction = series or series_of(case), friction or law_of(case)
    solid = Solid(series.long_term_modulus, series.moduli, series.relaxation_times)
    law = KernelLaw(friction.static_coefficient, *friction.kernel_arguments)
    solver = Solver(settings.tolerance, settings.most_sweeps)
    second = face.second if settings.finite_strain else SMALL_STRAIN
    return face, Scene(face.operators.nodes, solid, RoadMotion(path.road.radius, 0.0), law, solver, second), division


def run_course(moves: Course, scene: Scene, parts: FaceOperators, nodal: bool = True) -> Record:
    """Run a block along a course and return the record; `nodal`: with what each node does."""
    steps, n, terms = moves.time.size, scene.face.area.size, scene.solid.moduli.size
    record = record_of(steps, n, nodal)
    state, work = fresh_state(n, terms), scratch(n, terms, scene.second)
    at = 0
    while True:
        at, a, b = march(at, moves, scene, parts.windows, state, work, record)
        if at == steps:
            return record
        parts.add(a, b)


def step_times(path: Path, size: float, settings: CondensedSettings, lead: float = LEAD) -> Array:
    """Return the times of the steps, s: fine while the contact's edges move, longer while the whole face is down.

    `size` is the length of the face's elements in m; `lead` of them pass before the first contact.
    """
    extent = path.columns.extent
    total = path.contact_duration * path.speed
    edge_step = settings.long_step if total > 2.0 * extent else settings.step
    fine, longest = edge_step * size, settings.longest_step * size
    if path.columns.together:  # nothing rolls over the face: it is pressed, and slides, as a whole
        even = min(fine / path.speed, 2.0 * path.finest_time)
        return np.arange(-lead * even, 1.05 * path.contact_duration, even)
    edge = extent + max(0.0, _approach(path))
    down, quiet = (extent, total - extent), (edge, total - edge)
    travel = [-lead * size, -0.5 * lead * size]
    end = total + 3.0 * size
    step = fine
    while travel[-1] < end - 1e-3 * fine:
        here = travel[-1] + 1e-3 * fine  # rounding does not decide on a step
        if quiet[0] <= here < quiet[1] - fine:
            step = min(step * 1.4, longest, max(quiet[1] - here, fine))
        elif down[0] <= here < down[1]:
            step = settings.middle_step * size
        else:
            step = fine
        travel.append(min(travel[-1] + step, end))
    return np.array(travel) / path.speed


def _on_wheel(path: Path) -> bool:
    return path.line.ring_radius is not None


def _approach(path: Path) -> float:
    """Return the travel between the touch of a column and the middle of its compression, m."""
    total = path.contact_duration * path.speed - path.columns.extent
    corners = path.line.corners
    return corners[0] - path.first_contact_arc if corners else 0.25 * total
