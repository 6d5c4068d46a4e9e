"""The CalculiX dialect of an elastic-Coulomb deck: one quasi-static pass in the frame of the road."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from .motion import Array
from .subset import ElasticDeck

REACH = 1.0  # mm beyond the block's height within which the road is meshed
MARGIN = 4.0  # mm of road beyond where the block can touch
THICKNESS = 2.0  # mm of the road's layer


@dataclass(frozen=True)
class Resolution:
    """How finely the quasi-static pass is solved.

    Attributes
    ----------
    pass_increments, lead_in_increments : int
        Largest increments are the step's duration over these.
    contact_stiffness : float, 1/mm
        Penalty stiffness (MPa/mm) over Young's modulus: the overclosure is p / (contact_stiffness E).
    stick_ratio : float
        Tangential over normal penalty stiffness while sticking.
    facet : float, mm
        Length of the flat facets of a wheel.
    """

    pass_increments: int = 400
    lead_in_increments: int = 5
    contact_stiffness: float = 50.0
    stick_ratio: float = 0.2
    facet: float = 0.5


def dialect(deck: ElasticDeck, resolution: Resolution | None = None) -> str:
    """Return the CalculiX input of a deck (mm, MPa, s, N).

    Raises
    ------
    InputError
        A block that stays clear of the road, or a contact face that is not one of a hexahedron.
    """
    choice = resolution or Resolution()
    times = _times(deck, choice)
    rows = {row: _seen(deck, row, times) for row in deck.mount}
    base = 10 ** len(str(max(deck.nodes)))
    road_nodes, road_elements = _road(deck, rows, choice)
    lines: list[str] = ["*HEADING", deck.case_id, "*NODE, NSET=BLOCK_NODES"]
    lines += [f"{n}, {x:.10g}, {y:.10g}, {z:.10g}" for n, (x, y, z) in deck.nodes.items()]
    lines.append(f"*ELEMENT, TYPE={deck.kind}, ELSET=BLOCK")
    lines += [", ".join(str(v) for v in row) for row in deck.elements.tolist()]
    lines.append("*NODE, NSET=ROAD_NODES")
    lines += [f"{base + i}, {x:.10g}, {y:.10g}, {z:.10g}" for i, (x, y, z) in enumerate(road_nodes)]
    first = int(deck.elements[:, 0].max()) + 1
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=ROAD")
    lines += [f"{first + i}, " + ", ".join(str(base + n) for n in row) for i, row in enumerate(road_elements)]
    lines += [*_set("ELSET", "FACE_ELEMENTS", deck.face[0])]
    for row, nodes in deck.mount.items():
        lines += _set("NSET", f"ROW_{row}", nodes)
    lines += _set("NSET", "MOUNT", (n for nodes in deck.mount.values() for n in nodes))
    lines += ["*SURFACE, NAME=FACE, TYPE=ELEMENT", f"FACE_ELEMENTS, {deck.face[1]}"]
    lines += ["*SURFACE, NAME=ROAD_TOP, TYPE=ELEMENT", "ROAD, S2"]
    stiffness = choice.contact_stiffness * deck.young
    shear, bulk = deck.young / (2 * (1 + deck.poisson)), deck.young / (3 * (1 - 2 * deck.poisson))
    lines += ["*MATERIAL, NAME=COMPOUND", "*HYPERELASTIC, NEO HOOKE", f"{0.5 * shear:.9g}, {2.0 / bulk:.9g}"]
    lines += ["*SOLID SECTION, ELSET=BLOCK, MATERIAL=COMPOUND", "*SOLID SECTION, ELSET=ROAD, MATERIAL=COMPOUND"]
    lines += ["*SURFACE INTERACTION, NAME=TREAD_ROAD", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"]
    lines += [f"{stiffness:.9g}"]
    if deck.friction > 0.0:
        lines += ["*FRICTION", f"{deck.friction:.9g}, {choice.stick_ratio * stiffness:.9g}"]
    lines += ["*CONTACT PAIR, INTERACTION=TREAD_ROAD, TYPE=SURFACE TO SURFACE", "FACE, ROAD_TOP"]
    for row, seen in rows.items():
        start = np.array(deck.nodes[deck.mount[row][0]][:2])
        for axis in (0, 1):
            lines.append(f"*AMPLITUDE, NAME=A{row}_{axis + 1}, TIME=TOTAL TIME")
            moved = seen[:, axis] - start[axis]
            lines += [f"{t:.12g}, {d:.10g}" for t, d in zip(times, moved, strict=True)]
    lines += ["*BOUNDARY", "ROAD_NODES, 1, 3", "MOUNT, 3, 3"]
    if deck.symmetry:
        lines += [*_set("NSET", "SYMMETRY_PLANE", deck.symmetry), "*BOUNDARY", "SYMMETRY_PLANE, 3, 3"]
    counts = [choice.lead_in_increments] * (len(deck.durations) - 1) + [choice.pass_increments]
    for duration, count in zip(deck.durations, counts, strict=True):
        step = duration / count
        lines += ["*STEP, NLGEOM, INC=100000", "*STATIC", f"{step:.9g}, {duration:.9g}, {step * 1e-5:.3g}, {step:.9g}"]
        for row in rows:
            lines += [
                f"*BOUNDARY, AMPLITUDE=A{row}_1",
                f"ROW_{row}, 1, 1, 1.",
                f"*BOUNDARY, AMPLITUDE=A{row}_2",
                f"ROW_{row}, 2, 2, 1.",
            ]
        for name in ("ROAD_NODES", "MOUNT"):
            lines += [f"*NODE PRINT, NSET={name}, TOTALS=ONLY, FREQUENCY=1", "RF"]
        lines.append("*END STEP")
    return "\n".join(lines) + "\n"


def _times(deck: ElasticDeck, choice: Resolution) -> Array:
    """Return the times at which the motion is tabled: four to an increment of the pass."""
    counts = [4 * choice.lead_in_increments] * (len(deck.durations) - 1) + [4 * choice.pass_increments]
    start, parts = 0.0, [np.zeros(1)]
    for duration, count in zip(deck.durations, counts, strict=True):
        parts.append(start + duration * np.arange(1, count + 1) / count)
        start += duration
    return np.concatenate(parts)


def _seen(deck: ElasticDeck, row: int, times: Array) -> Array:
    """Return where a mount row is in the frame of the road, (n, 2) mm."""
    start = np.array(deck.nodes[deck.mount[row][0]][:2])
    return deck.road.seen_from(deck.motions[row].place(start, times), times)


def _road(
    deck: ElasticDeck, rows: dict[int, Array], choice: Resolution
) -> tuple[list[tuple[float, float, float]], list[list[int]]]:
    """Return nodes and elements of the piece of road that the block can touch; side S2 is the running surface."""
    places = np.array(list(deck.nodes.values()))
    height = float(np.ptp(places[:, 1]))
    path = np.concatenate([rows[row] + offset for row in rows for offset in _offsets(deck, row)])
    low, high = float(places[:, 2].min()) - MARGIN, float(places[:, 2].max()) + MARGIN
    reference = deck.road.reference
    if deck.wheel_radius is None:
        near = path[path[:, 1] - reference[1] < height + REACH, 0]
        if near.size == 0:
            raise InputError(deck.case_id, "a block that stays clear of the road", "contact within the pass")
        along = np.array([near.min() - MARGIN - height, near.max() + MARGIN + height])
        top = np.column_stack([along, np.full(2, reference[1])])
        below = top - np.array([0.0, THICKNESS])
    else:
        arm = path - reference
        near_arm = arm[np.hypot(arm[:, 0], arm[:, 1]) < deck.wheel_radius + height + REACH]
        if near_arm.size == 0:
            raise InputError(deck.case_id, "a block that stays clear of the road", "contact within the pass")
        angle = np.unwrap(np.sort(np.arctan2(near_arm[:, 0], near_arm[:, 1])))
        room = (MARGIN + height) / deck.wheel_radius
        first, last = float(angle.min()) - room, float(angle.max()) + room
        count = max(2, int(np.ceil((last - first) * deck.wheel_radius / choice.facet)))
        turn = np.linspace(first, last, count + 1)
        unit = np.column_stack([np.sin(turn), np.cos(turn)])
        top = reference + deck.wheel_radius * unit
        below = reference + (deck.wheel_radius - THICKNESS) * unit
    nodes: list[tuple[float, float, float]] = []
    for under, upper in zip(below.tolist(), top.tolist(), strict=True):
        nodes += [(under[0], under[1], low), (under[0], under[1], high)]
        nodes += [(upper[0], upper[1], low), (upper[0], upper[1], high)]
    elements = []
    for i in range(len(top) - 1):
        a, b = 4 * i, 4 * (i + 1)
        # bottom face 1-4, top face 5-8: S2 is the running surface
        elements.append([a, a + 1, b + 1, b, a + 2, a + 3, b + 3, b + 2])
    return nodes, elements


def _offsets(deck: ElasticDeck, row: int) -> Array:
    """Return where the nodes of a row lie from its first node in the x-y plane, (n, 2) mm, each place once."""
    places = np.array([deck.nodes[node][:2] for node in deck.mount[row]])
    return np.unique(places - places[0], axis=0)


def _set(kind: str, name: str, members: Iterable[int]) -> list[str]:
    words = [str(member) for member in members]
    lines = [f"*{kind}, {kind}={name}"]
    lines += [", ".join(words[i : i + 12]) for i in range(0, len(words), 12)]
    return lines
