"""Analytical rigid surfaces: a profile of lines and arcs swept along a generator or turned about an axis."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import DataLine, KeywordBlock

# Columns of a segment: kind (0 line, 1 arc), then for a line x0, y0, unit tangent (2), length, 0; for an arc its centre
# (2), radius, +1 when the outward normal points away from the centre else -1, start angle, signed sweep.
HALF_TURN = math.pi * (1.0 - 1e-9)


@dataclass(frozen=True)
class RigidSurface:
    """An analytical surface of TYPE=CYLINDER or TYPE=REVOLUTION.

    Attributes
    ----------
    origin : (3,), frame : (3, 3)
        Rows of `frame` are the local x, y and generator directions; y is x cross the generator, which is the
        negative local z axis. Of a surface of revolution y is the axis, and the profile's x the distance from it.
    segments : (k, 7)
        See the columns above. The outward normal lies to the left of the direction of travel in the local x, y plane.
    name : str
    where : str
    revolved : bool
        TYPE=REVOLUTION.
    """

    origin: NDArray[np.float64]
    frame: NDArray[np.float64]
    segments: NDArray[np.float64]
    name: str
    where: str
    revolved: bool = False


def read_rigid_surface(block: KeywordBlock) -> RigidSurface:
    """Read ``*SURFACE, TYPE=CYLINDER`` or ``TYPE=REVOLUTION``.

    Raises
    ------
    InputError
        Points that fix no frame, a profile without START, arcs of 180 degrees or more or of two radii; a profile that
        crosses its axis of revolution.
    """
    if block.parameters.get("TYPE") == "REVOLUTION":
        return _revolved(block)
    if len(block.data) < 4:
        raise InputError(block.where, f"{len(block.data)} data lines", "two frame lines, START and a LINE or CIRCL")
    first, second, start, *rest = block.data
    a = np.array([first.number_at(i, "a coordinate") for i in range(3)])
    b = np.array([first.number_at(i, "a coordinate") for i in range(3, 6)])
    c = np.array([second.number_at(i, "a coordinate") for i in range(3)])
    x = b - a
    z = c - a
    if not np.linalg.norm(x) > 0 or not np.linalg.norm(z) > 0:
        raise InputError(first.where, "points that coincide", "a, b and c apart")
    x /= np.linalg.norm(x)
    z /= np.linalg.norm(z)
    if abs(float(x @ z)) > 1e-6:
        raise InputError(second.where, "a generator that is not normal to the local x axis", "a right angle")
    # ABAQUS sweeps along the negative local z: the local y axis is x cross generator
    frame = np.array([x, np.cross(x, z), z])
    return RigidSurface(a, frame, _profile(start, rest), block.value("NAME"), block.where)


def _revolved(block: KeywordBlock) -> RigidSurface:
    """Read the surface whose profile in the r, z plane is turned about the axis from point a to point b."""
    if len(block.data) < 3:
        raise InputError(block.where, f"{len(block.data)} data lines", "a line for the axis, START and a LINE or CIRCL")
    first, start, *rest = block.data
    a = np.array([first.number_at(i, "a coordinate") for i in range(3)])
    axis = np.array([first.number_at(i, "a coordinate") for i in range(3, 6)]) - a
    if not np.linalg.norm(axis) > 0:
        raise InputError(first.where, "points that coincide", "a and b apart")
    axis /= np.linalg.norm(axis)
    across = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    across /= np.linalg.norm(across)
    segments = _profile(start, rest)
    least, extent = _least_radius(segments), float(np.abs(segments[:, 1:4]).max())
    if least < -1e-9 * extent:
        raise InputError(
            block.where, f"a profile down to r = {least:g}", "r of 0 or more: the profile turns about r = 0"
        )
    frame = np.array([across, axis, np.cross(across, axis)])
    return RigidSurface(a, frame, segments, block.value("NAME"), block.where, revolved=True)


def _least_radius(segments: NDArray[np.float64]) -> float:
    """Return the least x of a profile."""
    found: list[float] = []
    for kind, x, _, third, _, fifth, sweep in segments.tolist():
        if kind == 0.0:
            found += [x, x + third * fifth]
            continue
        ends = sorted((fifth, fifth + sweep))
        # an arc that passes the half turn has its least x there
        passes = any(ends[0] < turn < ends[1] for turn in (-math.pi, math.pi))
        found += [x + third * math.cos(angle) for angle in ends] + ([x - third] if passes else [])
    return min(found)


def _profile(start: DataLine, rest: list[DataLine]) -> NDArray[np.float64]:
    """Read START, LINE and CIRCL into segments, (k, 7)."""
    if not start.fields or start.fields[0].upper() != "START":
        raise InputError(start.where, start.text, "START, x, y")
    at = (start.number_at(1, "x"), start.number_at(2, "y"))
    segments = []
    for line in rest:
        word = line.fields[0].upper() if line.fields else ""
        to = (line.number_at(1, "x"), line.number_at(2, "y"))
        if word == "LINE":
            segments.append(_line(at, to, line))
        elif word == "CIRCL":
            segments.append(
                _arc(at, to, (line.number_at(3, "x of the centre"), line.number_at(4, "y of the centre")), line)
            )
        else:
            raise InputError(line.where, word or line.text, "LINE or CIRCL")
        at = to
    return np.array(segments)


def _line(at: tuple[float, float], to: tuple[float, float], line: DataLine) -> list[float]:
    dx, dy = to[0] - at[0], to[1] - at[1]
    length = math.hypot(dx, dy)
    if length <= 0.0:
        raise InputError(line.where, line.text, "a line of some length")
    return [0.0, at[0], at[1], dx / length, dy / length, length, 0.0]


def _arc(at: tuple[float, float], to: tuple[float, float], centre: tuple[float, float], line: DataLine) -> list[float]:
    radius = math.hypot(at[0] - centre[0], at[1] - centre[1])
    other = math.hypot(to[0] - centre[0], to[1] - centre[1])
    if radius <= 0.0 or abs(radius - other) > 1e-6 * radius:
        raise InputError(line.where, f"radii {radius:g} and {other:g}", "both ends at one distance from the centre")
    begin = math.atan2(at[1] - centre[1], at[0] - centre[0])
    sweep = math.atan2(to[1] - centre[1], to[0] - centre[0]) - begin
    sweep = (sweep + math.pi) % (2.0 * math.pi) - math.pi
    if abs(sweep) >= HALF_TURN or sweep == 0.0:
        raise InputError(line.where, f"an arc of {math.degrees(abs(sweep)):.6g} degrees", "less than 180 degrees")
    # Travelling clockwise (sweep < 0) leaves the normal, to the left, pointing away from the centre.
    return [1.0, centre[0], centre[1], radius, -math.copysign(1.0, sweep), begin, sweep]
