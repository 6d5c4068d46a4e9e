"""Where the deck sends the mount and the road: velocities integrated exactly, rigid bodies turned about their axles."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import Deck, KeywordBlock, label
from ..inp.amplitude import amplitude_table

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Velocity:
    """A velocity linear between tabled times, constant beyond them (mm/s or rad/s)."""

    time: Array
    value: Array

    def integral(self, time: Array) -> Array:
        """Return the integral from 0 to each time: exact, since the table is linear between its points."""
        if self.time.size == 1:
            return np.asarray(self.value[0] * time, dtype=np.float64)
        area = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(self.time) * (self.value[1:] + self.value[:-1]))])

        def primitive(at: Array) -> Array:
            inside = np.clip(at, self.time[0], self.time[-1])
            index = np.clip(np.searchsorted(self.time, inside, side="right") - 1, 0, self.time.size - 2)
            step = inside - self.time[index]
            slope = (self.value[index + 1] - self.value[index]) / (self.time[index + 1] - self.time[index])
            total = area[index] + step * (self.value[index] + 0.5 * slope * step)
            before = np.minimum(at - self.time[0], 0.0) * self.value[0]
            after = np.maximum(at - self.time[-1], 0.0) * self.value[-1]
            return np.asarray(total + before + after, dtype=np.float64)

        return primitive(time) - primitive(np.zeros(1))


@dataclass(frozen=True)
class PlaneMotion:
    """A rigid motion in the x-y plane: a reference point that travels and a turn about it.

    Attributes
    ----------
    reference : (2,) array, mm
    travel : pair of Velocity
    turn : Velocity
    """

    reference: Array
    travel: tuple[Velocity, Velocity]
    turn: Velocity

    def angle(self, time: Array) -> Array:
        """Return the turn since time 0, rad."""
        return self.turn.integral(time)

    def place(self, point: Array, time: Array) -> Array:
        """Return where a point of the body is, (n, 2)."""
        angle = self.angle(time)
        arm = point - self.reference
        turned = np.column_stack(
            [np.cos(angle) * arm[0] - np.sin(angle) * arm[1], np.sin(angle) * arm[0] + np.cos(angle) * arm[1]]
        )
        moved = np.column_stack([velocity.integral(time) for velocity in self.travel])
        return np.asarray(self.reference + moved + turned, dtype=np.float64)

    def seen_from(self, points: Array, time: Array) -> Array:
        """Return points (n, 2) at times (n,) in the frame of this body, which coincides with space at time 0."""
        angle = -self.angle(time)
        moved = np.column_stack([velocity.integral(time) for velocity in self.travel])
        arm = points - self.reference - moved
        return np.asarray(
            self.reference
            + np.column_stack(
                [
                    np.cos(angle) * arm[:, 0] - np.sin(angle) * arm[:, 1],
                    np.sin(angle) * arm[:, 0] + np.cos(angle) * arm[:, 1],
                ]
            ),
            dtype=np.float64,
        )

    def into_space(self, vectors: Array, time: Array) -> Array:
        """Return vectors (n, 2) given in this body's frame as seen in space."""
        angle = self.angle(time)
        return np.column_stack(
            [
                np.cos(angle) * vectors[:, 0] - np.sin(angle) * vectors[:, 1],
                np.sin(angle) * vectors[:, 0] + np.cos(angle) * vectors[:, 1],
            ]
        )


def still() -> Velocity:
    """Return no motion."""
    return Velocity(np.zeros(1), np.zeros(1))


@dataclass
class _Prescribed:
    """Velocities by (set name or node number, degree of freedom)."""

    by_target: dict[tuple[str, int], Velocity] = field(default_factory=dict)

    def of(self, target: str, freedom: int) -> Velocity:
        return self.by_target.get((target, freedom), still())


def read_motions(
    deck: Deck, sets: dict[str, tuple[int, ...]], places: dict[int, tuple[float, float, float]]
) -> tuple[dict[int, tuple[int, ...]], dict[int, PlaneMotion], PlaneMotion, float | None]:
    """Return mount rows, their motions, the road's motion and the wheel's radius (None: plane).

    Raises
    ------
    InputError
        No road, no moved mount, velocities that change from step to step.
    """
    prescribed = _velocities(deck)
    road_name, radius = _road(deck)
    tied: list[tuple[str, str]] = []
    road_reference = None
    for block in deck.named("RIGID BODY"):
        reference = block.value("REF NODE")
        if "ANALYTICAL SURFACE" in block.parameters and block.value("ANALYTICAL SURFACE") == road_name:
            road_reference = reference
        elif "TIE NSET" in block.parameters:
            tied.append((reference, block.value("TIE NSET")))
        else:
            raise InputError(f"{block.where}: *RIGID BODY", ", ".join(block.parameters), "the road or TIE NSET")
    if road_reference is None:
        raise InputError(deck.path, f"no rigid body for surface {road_name}", "a rigid road")

    def motion(reference: str) -> PlaneMotion:
        nodes = sets.get(reference) or ((int(reference),) if reference.isdigit() else ())
        if len(nodes) != 1 or nodes[0] not in places:
            raise InputError(f"{deck.path}: *RIGID BODY, REF NODE", reference, "one node of the deck, or a set of one")
        place = np.array(places[nodes[0]][:2])
        return PlaneMotion(
            place, (prescribed.of(reference, 1), prescribed.of(reference, 2)), prescribed.of(reference, 6)
        )

    road = motion(road_reference)
    mount: dict[int, tuple[int, ...]] = {}
    motions: dict[int, PlaneMotion] = {}
    for reference, name in tied:
        body = motion(reference)
        rows: dict[tuple[float, float], list[int]] = {}
        for node in sets[name]:
            rows.setdefault((places[node][0], places[node][1]), []).append(node)
        for nodes in rows.values():
            row = len(mount) + 1
            mount[row], motions[row] = tuple(nodes), body
    for target in dict.fromkeys(name for name, _ in prescribed.by_target):
        if sets.get(target) and target != road_reference and target not in {reference for reference, _ in tied}:
            row = len(mount) + 1
            mount[row] = sets[target]
            travel = (prescribed.of(target, 1), prescribed.of(target, 2))
            motions[row] = PlaneMotion(np.array(places[sets[target][0]][:2]), travel, still())
    if not mount:
        raise InputError(deck.path, "no mount that is tied or moved", "*RIGID BODY, TIE NSET or velocities")
    return mount, motions, road, radius


def _road(deck: Deck) -> tuple[str, float | None]:
    """Return the name of the road's surface and its radius: arcs make a wheel, a line a plane."""
    for block in deck.named("SURFACE"):
        if block.value("TYPE", "ELEMENT") != "CYLINDER":
            continue
        kinds = [line.fields[0].upper() for line in block.data]
        if "CIRCL" in kinds:
            start = block.data[kinds.index("START")]
            arc = block.data[kinds.index("CIRCL")]
            centre = np.array([arc.number_at(3, "a centre"), arc.number_at(4, "a centre")])
            begin = np.array([start.number_at(1, "a start"), start.number_at(2, "a start")])
            return block.value("NAME"), float(np.hypot(*(begin - centre)))
        return block.value("NAME"), None
    raise InputError(deck.path, "no *SURFACE, TYPE=CYLINDER", "a rigid road")


def _velocities(deck: Deck) -> _Prescribed:
    tables = {block.value("NAME"): _table(block) for block in deck.named("AMPLITUDE")}
    found = _Prescribed()
    step = 0
    for block in deck.blocks:
        if block.keyword == "STEP":
            step += 1
        if block.keyword != "BOUNDARY" or block.parameters.get("TYPE") != "VELOCITY":
            if block.keyword == "BOUNDARY" and step > 0:
                raise InputError(f"{block.where}: *BOUNDARY", "displacements in a step", "TYPE=VELOCITY")
            continue
        if step > 1:
            raise InputError(f"{block.where}: *BOUNDARY", "velocities that change in a later step", "those of step 1")
        for line in block.data:
            target = label(line.fields[0])
            first = line.integer_at(1, "a degree of freedom")
            size = line.number_at(3, "a velocity", 0.0)
            for freedom in range(first, line.integer_at(2, "a degree of freedom", first) + 1):
                name = block.parameters.get("AMPLITUDE")
                if name is None:
                    found.by_target[target, freedom] = Velocity(np.zeros(1), np.array([size]))
                elif name in tables:
                    time, value = tables[name]
                    found.by_target[target, freedom] = Velocity(time, size * value)
                else:
                    raise InputError(f"{block.where}: *BOUNDARY, AMPLITUDE", name, "an amplitude of the deck")
    return found


def _table(block: KeywordBlock) -> tuple[Array, Array]:
    if block.value("TIME", "STEP TIME") != "TOTAL TIME" or block.value("DEFINITION", "TABULAR") != "TABULAR":
        raise InputError(f"{block.where}: *AMPLITUDE", str(dict(block.parameters)), "TABULAR against TIME=TOTAL TIME")
    table = amplitude_table(block)
    if table.shape[0] < 2:
        raise InputError(f"{block.where}: *AMPLITUDE", "one point", "two or more")
    return table[:, 0], table[:, 1]
