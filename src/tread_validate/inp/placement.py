"""Where coordinates lie: ``*INSTANCE`` translations and rotations, ``*SYSTEM``, and cylindrical or spherical nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .deck import DataLine, KeywordBlock, Lines
from .table import number_table

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class RigidMotion:
    """A rigid motion of space: a point x goes to ``turn @ x + shift``.

    Attributes
    ----------
    turn : (3, 3) array
        Proper rotation.
    shift : (3,) array
    """

    turn: Floats
    shift: Floats

    @property
    def is_identity(self) -> bool:
        """Whether nothing moves."""
        return bool(np.all(self.turn == np.eye(3)) and not self.shift.any())

    def place(self, points: Floats) -> Floats:
        """Return the moved points, (n, 3)."""
        return np.asarray(points @ self.turn.T + self.shift, dtype=np.float64)

    def after(self, first: RigidMotion) -> RigidMotion:
        """Return this motion applied after another."""
        return RigidMotion(self.turn @ first.turn, self.turn @ first.shift + self.shift)


def still() -> RigidMotion:
    """Return the motion that moves nothing."""
    return RigidMotion(np.eye(3), np.zeros(3))


def instance_motion(block: KeywordBlock) -> RigidMotion:
    """Return where ``*INSTANCE`` puts its part: first the translation, then the rotation about the axis from a to b.

    Data lines: ``tx, ty, tz`` and ``ax, ay, az, bx, by, bz, angle`` (degrees), both optional.

    Raises
    ------
    InputError
        More than two lines, no number, an axis of no length.
    """
    lines = list(block.data)
    if len(lines) > 2:
        raise InputError(lines[2].where, lines[2].text[:40], "a translation and a rotation at most")
    shift = _numbers(lines[0], 3, "a translation") if lines else np.zeros(3)
    motion = RigidMotion(np.eye(3), shift)
    if len(lines) == 2:
        values = _numbers(lines[1], 7, "a rotation")
        axis = values[3:6] - values[:3]
        if not np.linalg.norm(axis) > 0.0:
            raise InputError(lines[1].where, lines[1].text[:60], "two points apart that fix the axis of rotation")
        turn = rotation(axis, float(np.radians(values[6])))
        motion = RigidMotion(turn, values[:3] - turn @ values[:3]).after(motion)
    return motion


def system_motion(block: KeywordBlock) -> RigidMotion:
    """Return where ``*SYSTEM`` puts the nodes that follow.

    Data lines: ``ax, ay, az, bx, by, bz`` (origin, a point on the local x axis) and ``cx, cy, cz`` (a point in the
    local x-y plane, on the side of positive y); without the second line the turn is about global z, without any the
    global system holds again.

    Raises
    ------
    InputError
        Points that fix no system.
    """
    lines = list(block.data)
    if not lines:
        return still()
    first = _numbers(lines[0], 6, "a coordinate")
    origin = first[:3]
    given = len([text for text in lines[0].fields if text])
    if given <= 3:
        return RigidMotion(np.eye(3), origin)
    x = first[3:] - origin
    in_plane = _numbers(lines[1], 3, "a coordinate") - origin if len(lines) > 1 else np.cross([0.0, 0.0, 1.0], x)
    z = np.cross(x, in_plane)
    if not np.linalg.norm(x) > 0.0 or not np.linalg.norm(z) > 0.0:
        raise InputError(lines[0].where, lines[0].text[:60], "points that fix a coordinate system")
    x /= np.linalg.norm(x)
    z /= np.linalg.norm(z)
    return RigidMotion(np.column_stack([x, np.cross(z, x), z]), origin)


def rotation(axis: Floats, angle: float) -> Floats:
    """Return the rotation by `angle` (rad) about `axis` (Rodrigues); quarter turns come out exact."""
    k = axis / np.linalg.norm(axis)
    cross = np.array([[0.0, -k[2], k[1]], [k[2], 0.0, -k[0]], [-k[1], k[0], 0.0]])
    turn = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    tidy = np.round(turn)
    return np.asarray(np.where(np.abs(turn - tidy) < 1e-15, tidy, turn) + 0.0, dtype=np.float64)


def moved_nodes(block: KeywordBlock, motion: RigidMotion, first_label: int) -> KeywordBlock:
    """Return a ``*NODE`` block with its labels raised and its coordinates placed, Cartesian.

    Raises
    ------
    InputError
        A line that is no label with coordinates.
    """
    system = block.parameters.get("SYSTEM") or "R"
    if system == "R" and motion.is_identity and not first_label:
        return block
    table = number_table(block.data, 4, "a node label with coordinates")
    points = _cartesian(table[:, 1:], system)
    placed = motion.place(points)
    labels = table[:, 0].astype(np.int64) + first_label
    texts = [f"{node}, {x!r}, {y!r}, {z!r}" for node, (x, y, z) in zip(labels.tolist(), placed.tolist(), strict=True)]
    parameters = {name: value for name, value in block.parameters.items() if name not in ("SYSTEM", "INPUT")}
    return KeywordBlock("NODE", parameters, block.data.with_texts(texts), block.file, block.line, block.raw)


def moved_profile(block: KeywordBlock, motion: RigidMotion) -> KeywordBlock:
    """Return an analytical ``*SURFACE`` with the points that fix its axes placed.

    Without such points the local x and y of a cylinder are those of the part, swept along its negative z. What
    `can_move` denies stays as it stands.
    """
    start = _axis_lines(block)
    if not can_move(block) or (motion.is_identity and start > 0):
        return block
    if block.parameters.get("TYPE") == "REVOLUTION":
        return _moved_axis(block, motion)
    if start == 0:
        points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    elif start == 2:
        first = _numbers(block.data[0], 6, "a coordinate")
        second = _numbers(block.data[1], 3, "a coordinate")
        points = np.array([first[:3], first[3:], second])
    else:
        return block
    a, b, c = motion.place(points).tolist()
    return _with_axes(block, [[*a, *b], c], start)


def can_move(block: KeywordBlock) -> bool:
    """Whether `moved_profile` places an analytical ``*SURFACE``: a cylinder, or a revolution whose axis is given."""
    kind = block.parameters.get("TYPE")
    return kind == "CYLINDER" or (kind == "REVOLUTION" and _axis_lines(block) == 1)


def _axis_lines(block: KeywordBlock) -> int:
    """Return how many lines stand before START."""
    begins = [line.fields[0].upper() if line.fields else "" for line in block.data]
    return begins.index("START") if "START" in begins else 0


def _moved_axis(block: KeywordBlock, motion: RigidMotion) -> KeywordBlock:
    """Return a surface of revolution with the two points of its axis placed."""
    a, b = motion.place(np.reshape(_numbers(block.data[0], 6, "a coordinate"), (2, 3))).tolist()
    return _with_axes(block, [[*a, *b]], 1)


def _with_axes(block: KeywordBlock, axes: list[list[float]], start: int) -> KeywordBlock:
    """Return an analytical surface with these lines in place of those before START."""
    lines = [*(DataLine(block.file, block.line, ", ".join(map(repr, points))) for points in axes), *block.data[start:]]
    data = Lines([one.file for one in lines], [one.number for one in lines], [one.text for one in lines])
    return KeywordBlock("SURFACE", block.parameters, data, block.file, block.line, block.raw)


def _cartesian(coordinates: Floats, system: str) -> Floats:
    """Return Cartesian from rectangular (R), cylindrical (C: r, degrees, z) or spherical (S: r, degrees, degrees)."""
    if system == "R":
        return coordinates
    radius, theta = coordinates[:, 0], np.radians(coordinates[:, 1])
    if system == "C":
        return np.column_stack([radius * np.cos(theta), radius * np.sin(theta), coordinates[:, 2]])
    phi = np.radians(coordinates[:, 2])
    return np.column_stack(
        [radius * np.cos(theta) * np.cos(phi), radius * np.sin(theta) * np.cos(phi), radius * np.sin(phi)]
    )


def _numbers(line: DataLine, count: int, what: str) -> Floats:
    if len(line.fields) > count:
        raise InputError(line.where, f"{len(line.fields)} fields", f"{what}: {count} numbers")
    return np.array([line.number_at(i, what, 0.0) for i in range(count)])
