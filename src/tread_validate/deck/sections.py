"""The parts of a deck, each as a list of lines, in deck units.

Coordinates are written to 10 nm, velocities to 1e-3 mm/s and tables of velocity to 1e-4 mm/s: far finer than the mesh
needs, and coarse enough that the same study gives the same text on another machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..geometry import Path
from ..material import prony_series
from ..material.wlf import referred_to
from ..study import Case
from ..units import DECK_DENSITY, DECK_LENGTH, DECK_STRESS, US
from .keywords import comment, integers, keyword, number, reals, table
from .mesh import BlockMesh
from .placement import LEAD_IN, MountTable

FloatArray = NDArray[np.float64]

ROAD_NODE, RING_NODE = 9000001, 9000002  # beyond any block's nodes (see mesh.MOST_ELEMENTS)
ROAD_MARGIN = 50.0  # mm of plane beyond the block's reach
ENERGIES = "ALLIE, ALLKE, ALLAE, ALLVD, ALLCD, ALLSE, ALLFD, ALLWK, ETOTAL"


def mesh(block: BlockMesh, points: FloatArray) -> list[str]:
    """Nodes, elements, sets and the contact surface."""
    node = np.arange(1, points.shape[0] + 1)
    element = np.arange(1, block.elements.shape[0] + 1)
    return [
        comment("Block: hexahedra with one integration point, nodes 1-4 of each towards the road"),
        keyword("NODE", NSET="BLOCK_NODES"),
        table([node, *_round(points, 5).T], ["%d", "%.5f", "%.5f", "%.5f"]),
        keyword("ELEMENT", TYPE="C3D8R", ELSET="BLOCK"),
        table([element, *(block.elements.T + 1)], ["%d"] * 9),
        keyword("NSET", NSET="MOUNT"),
        *integers(block.mount_nodes + 1),
        keyword("NSET", NSET="FACE_NODES"),
        *integers(block.face_nodes + 1),
        keyword("ELSET", ELSET="FACE_ELEMENTS"),
        *integers(block.face_elements + 1),
        keyword("SURFACE", TYPE="ELEMENT", NAME="FACE"),
        "FACE_ELEMENTS, S1",
    ]


def material(case: Case) -> list[str]:
    """Section and compound: instantaneous moduli, Prony series of one ratio for shear and bulk, WLF shift."""
    compound = case.compound
    series = prony_series(compound, case.root)
    ratios = series.moduli / series.instantaneous_modulus
    c1, c2 = referred_to(compound.wlf, series.reference_temperature)
    lines = [
        keyword("SECTION CONTROLS", NAME="BLOCK_CONTROLS", HOURGLASS=case.deck.hourglass),
        keyword("SOLID SECTION", ELSET="BLOCK", MATERIAL="COMPOUND", CONTROLS="BLOCK_CONTROLS"),
        ",",
        keyword("MATERIAL", NAME="COMPOUND"),
        keyword("DENSITY"),
        number(compound.density_kg_m3 * DECK_DENSITY) + ",",
        keyword("ELASTIC", MODULI="INSTANTANEOUS"),
        f"{number(series.instantaneous_modulus * DECK_STRESS, 10)}, {number(compound.poissons_ratio)}",
    ]
    if case.deck.stiffness_damping_us > 0.0:
        lines += [
            comment(
                "Loss above the band of the Prony series, without which sliding rubber flutters at mesh frequencies"
            ),
            keyword("DAMPING", BETA=number(case.deck.stiffness_damping_us * 1e-6)),
        ]
    if ratios.size:
        lines += [
            comment("g_i, k_i, tau_i: constant Poisson's ratio means one ratio for shear and bulk"),
            keyword("VISCOELASTIC", TIME="PRONY"),
            table([ratios, ratios, series.relaxation_times], ["%.10g", "%.10g", "%.9g"]),
            keyword("TRS"),
            f"{number(series.reference_temperature)}, {number(c1)}, {number(c2)}",
        ]
    return lines


def road(path: Path, creep_ratio: float, points: FloatArray, pass_time: float) -> list[str]:
    """Build the rigid road with its reference node: a plane, or the big wheel as three arcs.

    Outward is to the left of the profile's direction in the local axes x, y, where y is x cross the generator;
    so the plane runs towards +x and the circle clockwise.
    """
    if path.road.is_plane:
        reach = _plane_reach(path, creep_ratio, points, pass_time)
        place = (0.0, 0.0, 0.0)
        profile = [
            f"START, {number(reach[0])}, 0.",
            f"LINE, {number(reach[1])}, 0.",
        ]
        what = "Road: rigid plane"
    else:
        radius = path.road.radius * DECK_LENGTH
        place = (0.0, -radius, 0.0)
        high, wide = 0.5 * radius, 0.5 * math.sqrt(3.0) * radius
        corners = [(0.0, -radius), (-wide, high), (wide, high), (0.0, -radius)]
        start, *ends = [f"{number(x)}, {number(y)}" for x, y in corners]
        profile = [f"START, {start}", *(f"CIRCL, {end}, 0., 0." for end in ends)]
        what = "Road: rigid big wheel"
    x, y, z = place
    return [
        comment(what),
        keyword("NODE", NSET="ROAD_REF"),
        ", ".join([str(ROAD_NODE), *(number(value) for value in place)]),
        keyword("SURFACE", TYPE="CYLINDER", NAME="ROAD"),
        ", ".join(number(value) for value in (x, y, z, x + 1.0, y, z)),
        ", ".join(number(value) for value in (x, y, z - 1.0)),
        *profile,
        keyword("RIGID BODY", REF_NODE="ROAD_REF", ANALYTICAL_SURFACE="ROAD"),
    ]


def ring(path: Path) -> list[str]:
    """Build the rigid ring: the mount's nodes tied to a reference node on the small wheel's axle."""
    axle = (0.0, float(path.line.parameters[2]) * DECK_LENGTH, 0.0)
    return [
        comment("Small wheel: rigid ring that carries the mount, turning about its axle"),
        keyword("NODE", NSET="RING_REF"),
        ", ".join([str(RING_NODE), *(number(value) for value in axle)]),
        keyword("RIGID BODY", REF_NODE="RING_REF", TIE_NSET="MOUNT"),
    ]


def mount_rows(block: BlockMesh, tables: Sequence[MountTable]) -> list[str]:
    """Build a node set for each row of mount nodes and the amplitudes of its velocity (mm/s, total time)."""
    lines = [comment("Belt: each row of mount nodes follows the belt; velocities in mm/s against total time")]
    place = np.round(block.s[block.mount_nodes], 9)
    for index, row in enumerate(tables, start=1):
        lines += [
            keyword("NSET", NSET=f"MOUNT_{index:03d}"),
            *integers(block.mount_nodes[place == row.s] + 1),
        ]
        for axis, time, velocity in (("X", row.time_x, row.velocity_x), ("Y", row.time_y, row.velocity_y)):
            lines += [
                keyword("AMPLITUDE", NAME=f"V{axis}_{index:03d}", TIME="TOTAL TIME"),
                *_pairs(time, velocity),
            ]
    return lines


def user_friction(properties: Sequence[float]) -> list[str]:
    """Contact with VFRIC."""
    return [
        keyword("SURFACE INTERACTION", NAME="TREAD_ROAD"),
        keyword("FRICTION", USER="FRIC", PROPERTIES=len(properties), DEPVAR=1),
        *reals(properties, digits=13),
    ]


def face_mass(case: Case, block: BlockMesh) -> float:
    """Return the lumped mass of the contact face's nodes per area, t/mm2: half of that of the layer at the face."""
    layer = float(block.u[block.u > 0.0].min()) * case.block.height_mm
    return 0.5 * case.compound.density_kg_m3 * DECK_DENSITY * layer


def constant_friction(coefficient: float) -> list[str]:
    """Contact with built-in Coulomb friction, to compare with."""
    return [
        comment("Variant: built-in friction at the static coefficient instead of VFRIC"),
        keyword("SURFACE INTERACTION", NAME="TREAD_ROAD"),
        keyword("FRICTION"),
        number(coefficient) + ",",
    ]


def initial_conditions(case: Case, block: BlockMesh, path: Path, velocities: FloatArray) -> list[str]:
    """Uniform temperature, and the rigid motion that everything starts with."""
    node = np.repeat(np.arange(1, block.s.size + 1), 2)
    dof = np.tile([1, 2], block.s.size)
    lines = [
        keyword("INITIAL CONDITIONS", TYPE="TEMPERATURE"),
        f"BLOCK_NODES, {number(case.temperature)}",
        keyword("INITIAL CONDITIONS", TYPE="VELOCITY"),
        ", ".join(["ROAD_REF", *_road_rate(case, path)]),
    ]
    if case.path.mount_is_rigid:
        lines.append(f"RING_REF, 6, {number(_ring_rate(path))}")
    lines.append(table([node, dof, _round(velocities.ravel(), 3)], ["%d", "%d", "%.3f"]))
    return lines


def fixed_supports(case: Case) -> list[str]:
    """Build the degrees of freedom that never move."""
    free = 1 if not case.path.mount_is_rigid else 6
    lines = [keyword("BOUNDARY")]
    lines += [f"ROAD_REF, {first}, {last}" for first, last in ((1, free - 1), (free + 1, 6)) if first <= last]
    lines.append("RING_REF, 1, 5" if case.path.mount_is_rigid else "MOUNT, 3, 3")
    return lines


def steps(case: Case, path: Path, pass_time: float, tables: Sequence[MountTable]) -> list[str]:
    """Build the lead-in and the pass: velocities and contact are set in the first step and go on in the second."""
    viscosity = ", ".join(number(value) for value in case.deck.bulk_viscosity)
    dof, rate = _road_rate(case, path)
    lines = [
        comment("Lead-in: no contact yet"),
        keyword("STEP", NAME="approach", NLGEOM="YES"),
        keyword("DYNAMIC", "EXPLICIT"),
        f", {number(LEAD_IN)}",
        keyword("BULK VISCOSITY"),
        viscosity,
        keyword("BOUNDARY", TYPE="VELOCITY"),
        f"ROAD_REF, {dof}, {dof}, {rate}",
    ]
    if case.path.mount_is_rigid:
        lines.append(f"RING_REF, 6, 6, {number(_ring_rate(path))}")
    for index in range(1, len(tables) + 1):
        for axis, direction in (("X", 1), ("Y", 2)):
            lines += [
                keyword("BOUNDARY", TYPE="VELOCITY", AMPLITUDE=f"V{axis}_{index:03d}"),
                f"MOUNT_{index:03d}, {direction}, {direction}, 1.",
            ]
    interval = number(case.deck.history_interval_us * US)
    return [
        *lines,
        keyword("CONTACT PAIR", INTERACTION="TREAD_ROAD", MECHANICAL_CONSTRAINT="KINEMATIC", CPSET="TREAD_ROAD_PAIR"),
        "FACE, ROAD",
        keyword("OUTPUT", "FIELD", NUMBER_INTERVAL=1),
        keyword("NODE OUTPUT"),
        "U,",
        keyword("END STEP"),
        comment("Pass: from the first touch until the block is clear of the road"),
        keyword("STEP", NAME="pass", NLGEOM="YES"),
        keyword("DYNAMIC", "EXPLICIT"),
        f", {number(pass_time)}",
        keyword("BULK VISCOSITY"),
        viscosity,
        keyword("OUTPUT", "HISTORY", TIME_INTERVAL=interval),
        keyword("CONTACT OUTPUT", CPSET="TREAD_ROAD_PAIR"),
        "CFN, CFS",
        keyword("NODE OUTPUT", NSET="ROAD_REF"),
        "RF, RM, U, UR, V",
        keyword("ENERGY OUTPUT"),
        ENERGIES,
        keyword("OUTPUT", "FIELD", NUMBER_INTERVAL=case.deck.field_frames),
        keyword("NODE OUTPUT"),
        "U, V",
        keyword("ELEMENT OUTPUT", ELSET="BLOCK"),
        "S, LE",
        keyword("CONTACT OUTPUT", CPSET="TREAD_ROAD_PAIR"),
        "CSTRESS, FSLIP, FSLIPR",
        keyword("END STEP"),
    ]


def _road_rate(case: Case, path: Path) -> tuple[str, str]:
    """Return the road's degree of freedom and its rate: the plane slides along x, the wheel turns about z."""
    speed = path.speed * (1.0 + (case.creep_ratio or 0.0))
    if path.road.is_plane:
        return "1", number(speed * DECK_LENGTH)
    return "6", number(-speed / path.road.radius)


def _ring_rate(path: Path) -> float:
    """Return the small wheel's angular velocity, rad/s."""
    return path.speed * float(path.line.curvature(0.0))


def _plane_reach(path: Path, creep_ratio: float, points: FloatArray, pass_time: float) -> tuple[float, float]:
    """Return where the plane must begin and end (mm, at the start) to stay under the block all through the run."""
    t = np.linspace(-LEAD_IN, pass_time, 201)[:, None]
    s = np.array([0.0, path.columns.extent])
    block = path.at(s, t).x * DECK_LENGTH
    moved = path.speed * (1.0 + creep_ratio) * (t + LEAD_IN) * DECK_LENGTH
    place = np.append((block - moved).ravel(), points[:, 0])
    return math.floor(place.min() - ROAD_MARGIN), math.ceil(place.max() + ROAD_MARGIN)


def _pairs(time: FloatArray, value: FloatArray) -> list[str]:
    """Return (time, value) pairs, four to a line."""
    text = [f"{t:.9f}, {v:.4f}" for t, v in zip(time.tolist(), _round(value, 4).tolist(), strict=True)]
    return [", ".join(text[i : i + 4]) for i in range(0, len(text), 4)]


def _round(values: FloatArray, decimals: int) -> FloatArray:
    """Round, and make -0 a 0: what is left does not hang on the last bit of another machine's sine."""
    return np.round(values, decimals) + 0.0
