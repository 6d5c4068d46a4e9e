"""The model data of a deck, each part as a list of lines, in deck units.

Coordinates are written to 10 nm and tables of velocity to 1e-4 mm/s: far finer than the mesh needs, and coarse enough
that the same study gives the same text on another machine.
"""

from __future__ import annotations

import hashlib
import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..geometry import Path
from ..study import Case
from ..units import DECK_DENSITY, DECK_LENGTH
from .block_mesh import BlockMesh
from .form import Form
from .inputs import Inputs
from .keywords import comment, integers, keyword, number, reals, table
from .placement import LEAD_IN, Placement
from .vfric import STATES

FloatArray = NDArray[np.float64]

ROAD_NODE, RING_NODE = 9000001, 9000002  # beyond any block's nodes (see mesh.MOST_ELEMENTS)
ROAD_MARGIN = 50.0  # mm of plane beyond the block's reach
INTERACTION = "TREAD_ROAD"
INTEGRATION = {"C3D8R": "one integration point", "C3D8": "eight integration points and one mean volume change"}
SYMMETRY = "SYMMETRY_PLANE"
"""Node set of the plane of symmetry: a deck that has it models half the block, and its forces count twice."""


class _Keyed:
    """Arguments of `_mesh_lines`, equal where their numbers are: cases of one block share its text."""

    def __init__(self, block: BlockMesh, points: FloatArray, rows: bool, element: str, decimals: int) -> None:
        self.given = (block, points, rows, element, decimals)
        total = hashlib.sha256(f"{rows} {element} {decimals} {points.shape}".encode())
        for array in (points, block.s, block.u, block.elements, block.symmetry_nodes):
            total.update(np.ascontiguousarray(array).tobytes())
        self.key = total.digest()

    def __hash__(self) -> int:
        return hash(self.key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Keyed) and self.key == other.key


def mesh_lines(
    block: BlockMesh, points: FloatArray, rows: bool, element: str = "C3D8R", decimals: int = 5
) -> tuple[str, ...]:
    """Nodes, elements, sets and the contact surface; with `rows`, a node set for each row of mount nodes."""
    return _mesh_lines(_Keyed(block, points, rows, element, decimals))


@lru_cache(maxsize=8)
def _mesh_lines(keyed: _Keyed) -> tuple[str, ...]:
    block, points, rows, kind, decimals = keyed.given
    node = np.arange(1, points.shape[0] + 1)
    element = np.arange(1, block.elements.shape[0] + 1)
    lines = [
        comment(f"Block: hexahedra with {INTEGRATION[kind]}, nodes 1-4 of each towards the road; mm"),
        keyword("NODE", NSET="BLOCK_NODES"),
        table([node, *points.T], ["%d", *[f"%.{decimals}f"] * 3]),
        keyword("ELEMENT", TYPE=kind, ELSET="BLOCK"),
        table([element, *(block.elements.T + 1)], ["%d"] * 9),
    ]
    sets = {"MOUNT": block.mount_nodes, "FACE_NODES": block.face_nodes}
    if block.symmetry_nodes.size:
        sets[SYMMETRY] = np.setdiff1d(block.symmetry_nodes, block.mount_nodes)
    if rows:
        place = mount_place(block)
        for index, s in enumerate(np.unique(place), start=1):
            sets[f"MOUNT_{index:03d}"] = block.mount_nodes[place == s]
    for name, nodes in sets.items():
        lines += [keyword("NSET", NSET=name), *integers(nodes + 1)]
    return (
        *lines,
        keyword("ELSET", ELSET="FACE_ELEMENTS"),
        *integers(block.face_elements + 1),
        keyword("SURFACE", TYPE="ELEMENT", NAME="FACE"),
        "FACE_ELEMENTS, S1",
    )


def mount_place(block: BlockMesh) -> FloatArray:
    """Return the distance behind the leading corner of every mount node, mm, equal within a row."""
    return np.asarray(np.round(block.s[block.mount_nodes], 9), dtype=np.float64)


def mesh(
    form: Form, block: BlockMesh, placement: Placement, block_name: str, rows: bool, element: str = "C3D8R"
) -> list[str]:
    """Put the block where it starts: from a file in its own frame, or with its nodes in place."""
    if form.single_file:
        placed = np.round(placement.placed(placement.written), 8) + 0.0
        return list(mesh_lines(block, placed, rows, element, decimals=8))
    x, y = placement.origin.tolist()
    c, s = 100.0 * math.cos(placement.angle), 100.0 * math.sin(placement.angle)
    return [
        comment("Frame of the block at the start of the lead-in: origin on the mount above the leading corner, then a"),
        comment("point on its x axis (direction of travel) and one on its y axis (away from the road)"),
        keyword("SYSTEM"),
        f"{x:.9f}, {y:.9f}, 0., {x + c:.9f}, {y + s:.9f}, 0.",
        f"{x - s:.9f}, {y + c:.9f}, 0.",
        *form.include(f"mesh-{block_name}", mesh_lines(block, placement.written, rows, element)),
        comment("From here on in the frame of the axle again"),
        keyword("SYSTEM"),
    ]


def road(form: Form, inputs: Inputs, path: Path, placement: Placement) -> list[str]:
    """Build the rigid road with its reference node: a plane, or the big wheel as three arcs.

    Outward is to the left of the profile's direction in the local axes x, y, where y is x cross the generator;
    so the plane runs towards +x and the circle clockwise.
    """
    y = form.put(inputs["road_y"])
    if path.road.is_plane:
        begin, end = _plane_reach(path, inputs["creep_ratio"].number, placement.points, inputs["pass_time"].number)
        profile = [f"START, {number(begin)}, 0.", f"LINE, {number(end)}, 0."]
        what = f"Road: rigid plane, long enough for the run with {ROAD_MARGIN:g} mm to spare at either end"
    else:
        radius = path.road.radius * DECK_LENGTH
        high, wide = 0.5 * radius, 0.5 * math.sqrt(3.0) * radius
        corners = [(0.0, -radius), (-wide, high), (wide, high), (0.0, -radius)]
        start, *ends = [f"{number(px)}, {number(py)}" for px, py in corners]
        profile = [f"START, {start}", *(f"CIRCL, {end_}, 0., 0." for end_ in ends)]
        what = "Road: rigid big wheel; three arcs, since an arc must stay under 180 deg"
    return [
        comment(what),
        keyword("NODE", NSET="ROAD_REF"),
        f"{ROAD_NODE}, 0., {y}, 0.",
        comment("Analytical surface. Its local axes: origin a, local x from a to b, generator from a to c (across),"),
        comment("local y = x cross generator. The body of the road lies to the right of the profile's direction."),
        keyword("SURFACE", TYPE="CYLINDER", NAME="ROAD"),
        f"0., {y}, 0., 1., {y}, 0.",
        f"0., {y}, -1.",
        *profile,
        keyword("RIGID BODY", REF_NODE="ROAD_REF", ANALYTICAL_SURFACE="ROAD"),
    ]  # fmt: skip


def ring(path: Path) -> list[str]:
    """Build the rigid ring: the mount's nodes tied to a reference node on the small wheel's axle."""
    return [
        comment("Small wheel: rigid ring that carries the mount, turning about its axle"),
        keyword("NODE", NSET="RING_REF"),
        ", ".join([str(RING_NODE), *(number(value) for value in axle(path))]),
        keyword("RIGID BODY", REF_NODE="RING_REF", TIE_NSET="MOUNT"),
    ]


def axle(path: Path) -> tuple[float, float, float]:
    """Return the place of the small wheel's axle, mm."""
    return 0.0, float(path.line.parameters[2]) * DECK_LENGTH, 0.0


def user_friction(form: Form, inputs: Inputs, properties: tuple[float, ...], kind: str) -> list[str]:
    """Friction by a user routine: `kind` FRIC (VFRIC, contact pairs) or FRICTION (VFRICTION, general contact)."""
    named = [form.put(value) for value in inputs.friction]
    *rest, mass = [number(value, 13) for value in properties[len(named) :]]
    texts = [*named, *rest, mass]
    lines = [comment("Properties of the friction routine, eight to a line:")]
    lines += [comment(f"  {value.legend}") for value in inputs.friction]
    if rest:
        first = len(named) + 1
        lines += [
            comment(f"  property {first}: number of pressures, {first + 1}: number of slip speeds, then the"),
            comment("  pressures (MPa), the slip speeds (mm/s) and the coefficients, one row a pressure"),
        ]
    lines.append(comment(f"  property {len(texts)}: mass of the face's nodes per area, t/mm2 (of this mesh)"))
    return [
        keyword("SURFACE INTERACTION", NAME=INTERACTION),
        *lines,
        keyword("FRICTION", USER=kind, PROPERTIES=len(texts), DEPVAR=STATES[kind]),
        *[", ".join(texts[i : i + 8]) for i in range(0, len(texts), 8)],
    ]


def face_mass(case: Case, block: BlockMesh) -> float:
    """Return the lumped mass of the contact face's nodes per area, t/mm2: half of that of the layer at the face."""
    layer = float(block.u[block.u > 0.0].min()) * case.block.height_mm
    return 0.5 * case.compound.density_kg_m3 * DECK_DENSITY * layer


def constant_friction(form: Form, inputs: Inputs, coefficient: float) -> list[str]:
    """Contact with built-in Coulomb friction, to compare with."""
    static = inputs["friction_static"]
    value = form.put(static) if coefficient == static.number else reals([coefficient])[0]
    return [
        comment("Variant: built-in constant friction instead of VFRIC"),
        keyword("SURFACE INTERACTION", NAME=INTERACTION),
        keyword("FRICTION"),
        f"{value},",
    ]


def initial_conditions(form: Form, inputs: Inputs, case: Case, path: Path, placement: Placement) -> list[str]:
    """Uniform temperature, and the rigid motion that everything starts with."""
    rate = form.put(inputs["block_rate"])
    if case.path.mount_is_rigid:
        shift = "0., 0., 0."
        x, y, _ = axle(path)
    else:
        shift = f"{form.put(inputs['start_x'])}, {form.put(inputs['start_y'])}, 0."
        x, y = placement.origin.tolist()
    point = f"{x:.9f}, {y:.9f}"
    lines = [
        keyword("INITIAL CONDITIONS", TYPE="TEMPERATURE"),
        f"BLOCK_NODES, {form.put(inputs['temperature'])}",
        comment("Node set, angular velocity about the axis from a to b, velocity (x, y, z); then a and b"),
        keyword("INITIAL CONDITIONS", TYPE="ROTATING VELOCITY"),
        f"BLOCK_NODES, {rate}, {shift}",
        f"{point}, 0., {point}, 1.",
        keyword("INITIAL CONDITIONS", TYPE="VELOCITY"),
        f"ROAD_REF, {road_freedom(path)}, {form.put(inputs['road_rate'])}",
    ]
    if case.path.mount_is_rigid:
        lines.append(f"RING_REF, 6, {rate}")
    return lines


def fixed_supports(case: Case, path: Path, block: BlockMesh) -> list[str]:
    """Build the degrees of freedom that never move."""
    free = road_freedom(path)
    lines = [keyword("BOUNDARY")]
    lines += [f"ROAD_REF, {first}, {last}" for first, last in ((1, free - 1), (free + 1, 6)) if first <= last]
    lines.append("RING_REF, 1, 5" if case.path.mount_is_rigid else "MOUNT, 3, 3")
    if block.symmetry_nodes.size:
        lines += [comment("Half the block is modelled: forces, energies and areas of the whole are twice those here"),
                  f"{SYMMETRY}, ZSYMM"]  # fmt: skip
    return lines


def road_freedom(path: Path) -> int:
    """Return the degree of freedom in which the road moves: the plane slides along x, the wheel turns about z."""
    return 1 if path.road.is_plane else 6


def _plane_reach(path: Path, creep_ratio: float, points: FloatArray, pass_time: float) -> tuple[float, float]:
    """Return where the plane must begin and end (mm, at the start) to stay under the block all through the run."""
    t = np.linspace(-LEAD_IN, pass_time, 201)[:, None]
    s = np.array([0.0, path.columns.extent])
    block = path.at(s, t).x * DECK_LENGTH
    moved = path.speed * (1.0 + creep_ratio) * (t + LEAD_IN) * DECK_LENGTH
    place = np.append((block - moved).ravel(), points[:, 0])
    return math.floor(place.min() - ROAD_MARGIN), math.ceil(place.max() + ROAD_MARGIN)
