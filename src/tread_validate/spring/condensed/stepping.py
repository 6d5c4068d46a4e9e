"""The condensed face as a state that a host advances step by step."""

from __future__ import annotations

import copy

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...geometry import path_of
from ...study import Case
from .inputs import FaceState, Pose, fresh_state, scratch
from .march import start, take_step
from .roll import CondensedSettings, scene_of

Array = NDArray[np.float64]


class FaceBlock:
    """A condensed face in the hands of a host; see `tread_validate.TreadBlock`."""

    def __init__(self, case: Case, settings: CondensedSettings) -> None:
        path = path_of(case)
        self._face, self._scene, _ = scene_of(case, path, settings)
        self._height = case.height
        self._bend = self._face.bend if settings.finite_strain else self._face.bend[:0]
        self._nodes, self._terms = self._face.body.area.size, self._scene.solid.moduli.size
        self._copies = 2.0 if self._face.body.half else 1.0
        self._work = scratch(self._nodes, self._terms, self._scene.second)
        self._polygon = self._face.polygon
        self._state: FaceState | None = None
        self.mount_points = self._face.body.knots

    def start(self, position: Array, angle: float, mount: Array | None) -> None:
        """Forget the past; the block is stress-free at this pose."""
        self._state = fresh_state(self._nodes, self._terms)
        start(self._pose(position, angle, mount), self._scene, self._state, self._work)

    def step(
        self, dt: float, position: Array, angle: float, road_speed: float, mount: Array | None
    ) -> tuple[float, float]:
        """Advance by `dt` to a pose; return N and T."""
        if self._state is None:
            raise InputError("tread block", "a step before the start", "start(position, angle) first")
        scene = self._scene._replace(road=self._scene.road._replace(speed=road_speed))
        pose, parts = self._pose(position, angle, mount), self._face.operators
        while True:
            a, b, sweeps = take_step(pose, dt, scene, parts.windows, self._state, self._work)
            if sweeps >= 0:
                break
            parts.add(a, b)
        force = self._state.force.sum(axis=0)
        cosine, sine = np.cos(angle), np.sin(angle)
        along, up = cosine * force[0] - sine * force[1], sine * force[0] + cosine * force[1]
        return float(self._copies * up), float(-self._copies * along)

    def copy(self) -> FaceBlock:
        """Return the block with a state of its own."""
        twin = copy.copy(self)
        if self._state is not None:
            twin._state = copy.deepcopy(self._state)
        return twin

    def _pose(self, position: Array, angle: float, mount: Array | None) -> Pose:
        body, unloaded = self._face.body, self._face.body.face
        bend = np.zeros(0, dtype=np.float32)
        if mount is not None:
            dx, dy = mount[:, 0] - position[0], mount[:, 1] - position[1]
            cosine, sine = np.cos(angle), np.sin(angle)
            free = self._face.shape.mount(body.knots, self._height)
            moved = np.concatenate([cosine * dx + sine * dy - free[:, 0], cosine * dy - sine * dx - free[:, 1]])
            unloaded = unloaded + (self._face.follow @ moved).reshape(-1, 3)
            bend = self._bend @ moved.astype(np.float32)
        raised = self._polygon.rise(unloaded[None], self._scene.road.radius)
        return Pose(float(position[0]), float(position[1]), float(angle), unloaded, bend, float(raised[0]))
