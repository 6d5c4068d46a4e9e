"""How far the nearest points' errors have to be widened, and whether that holds for points that nobody looked at.

Two points in three are the rule's neighbours. Each of them is predicted from the others, and the factor on its local
scale is the conformal quantile (Lei et al., J. Am. Stat. Assoc. 113 (2018) 1094-1111, locally weighted): the
ceil(0.9 (n + 1))-th smallest of n ratios of error to scale, by itself in each of `CLASSES` (Vovk, Mach. Learn. 92
(2013) 349-376). Every third point takes no part in it and says what the limits are worth.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..spring.cautions import STRUCK
from .groups import Groups, coordinates, strike
from .table import ERRORS, Point

Array = NDArray[np.float64]

NEAREST = 8
"""Points of the same kind (path and mounting) that an expectation depends on."""
INSIDE = 0.9
"""Share of the errors that are to lie below the limit."""
EVERY = 3
"""Every third point of the design is held out."""
TIGHT = 6.0
"""R/l of a belt's arc below which errors change faster from point to point than elsewhere."""
CLASSES = ("tight arcs", "elsewhere")
"""Classes with a factor of their own."""
FEWEST = 9
"""Ratios that a quantile of nine in ten takes; a class with fewer has the factor of all."""
LEAST_SCALE = 0.002
"""Errors below this share are not told apart: the meshes' limit is not known better."""


def number_of(point: Point) -> int:
    """Return a point's place in the design."""
    return int(point.case_id.rpartition("-")[2])


def fitted(points: Sequence[Point]) -> list[Point]:
    """Return the points that the rule depends on."""
    return [point for point in points if number_of(point) % EVERY != EVERY - 1]


def held_out(points: Sequence[Point]) -> list[Point]:
    """Return the points that take no part in the rule."""
    return [point for point in points if number_of(point) % EVERY == EVERY - 1]


def basis_of(points: Sequence[Point]) -> list[Point]:
    """Return the fitted points that may be neighbours: those at which the road does not strike the face."""
    return [point for point in fitted(points) if strike(point.groups) <= STRUCK]


def class_of(kind: str, groups: Groups) -> str:
    """Return which of `CLASSES` a place belongs to."""
    return CLASSES[0] if kind.startswith("belt") and groups.radius < TIGHT else CLASSES[1]


@dataclass(frozen=True)
class Neighbours:
    """The nearest points of a place among those of its kind.

    Attributes
    ----------
    points : sequence of Point
        The nearest, at most `NEAREST`.
    weights : (n,) array
        By distance; their sum is 1.
    """

    points: Sequence[Point]
    weights: Array

    def expected(self, model: str, quantity: str) -> float:
        """Return the root mean square of the errors."""
        errors = np.array([point.errors[model][quantity] for point in self.points])
        return float(np.sqrt(self.weights @ errors**2))

    def scale(self, model: str, quantity: str) -> float:
        """Return what errors here are measured in: the weighted and the plain root mean square, the larger."""
        errors = np.array([point.errors[model][quantity] for point in self.points])
        return max(self.expected(model, quantity), float(np.sqrt(np.mean(errors**2))), LEAST_SCALE)

    def worst(self, model: str, quantity: str) -> float:
        """Return the largest error."""
        return max(abs(point.errors[model][quantity]) for point in self.points)


def neighbours(here: Array, known: Sequence[Point], size: Array) -> Neighbours:
    """Return the nearest of the points; distances in the groups' coordinates over their ranges `size`."""
    places = np.array([coordinates(point.groups) for point in known])
    distance = np.sqrt(np.mean(((places - here) / size) ** 2, axis=1))
    nearest = np.argsort(distance, kind="stable")[:NEAREST]
    weight = 1.0 / np.maximum(distance[nearest], 0.02)
    return Neighbours([known[k] for k in nearest], weight / weight.sum())


def ranges(known: Sequence[Point]) -> tuple[Array, Array, Array]:
    """Return the least and largest coordinates of the points, and the sizes of their ranges."""
    places = np.array([coordinates(point.groups) for point in known])
    low, high = places.min(axis=0), places.max(axis=0)
    return low, high, np.maximum(high - low, 1e-9)


def conformal(ratios: Sequence[float]) -> float:
    """Return the ceil(0.9 (n + 1))-th smallest ratio; infinity where there are too few for it."""
    rank = math.ceil(INSIDE * (len(ratios) + 1))
    return math.inf if rank > len(ratios) else float(sorted(ratios)[rank - 1])


def _of_kind(points: Sequence[Point], kind: str, model: str) -> list[Point]:
    return [point for point in points if point.kind == kind and model in point.errors]


def factors(points: Sequence[Point], model: str) -> dict[str, dict[str, float]]:
    """Return the factor on the local scale in each of `CLASSES` for each of `ERRORS`.

    From the points of the rule, one left out at a time.
    """
    basis = basis_of(points)
    ratios: dict[str, dict[str, list[float]]] = {name: {each: [] for each in ERRORS} for name in CLASSES}
    for kind in dict.fromkeys(point.kind for point in basis):
        known = _of_kind(basis, kind, model)
        if len(known) <= NEAREST:
            continue
        size = ranges(known)[2]
        for point in known:
            near = neighbours(coordinates(point.groups), [each for each in known if each is not point], size)
            own = ratios[class_of(kind, point.groups)]
            for each in ERRORS:
                own[each].append(abs(point.errors[model][each]) / near.scale(model, each))
    pooled = {each: [ratio for name in CLASSES for ratio in ratios[name][each]] for each in ERRORS}
    return {
        name: {each: conformal(own[each] if len(own[each]) >= FEWEST else pooled[each]) for each in ERRORS}
        for name, own in ratios.items()
    }


@dataclass(frozen=True)
class Coverage:
    """How many held-out errors lie below their limit, and the 95 % interval of that share (Clopper and Pearson)."""

    inside: int
    count: int

    @property
    def interval(self) -> tuple[float, float]:
        """Return both ends of the interval of the share."""
        from scipy.stats import beta

        low = float(beta.ppf(0.025, self.inside, self.count - self.inside + 1)) if self.inside else 0.0
        high = float(beta.ppf(0.975, self.inside + 1, self.count - self.inside)) if self.inside < self.count else 1.0
        return low, high

    def __str__(self) -> str:
        """Say share and interval in per cent."""
        low, high = self.interval
        share = 100.0 * self.inside / self.count if self.count else math.nan
        return f"{share:.0f} % of {self.count} (95 % interval {100 * low:.0f} to {100 * high:.0f} %)"


def coverage(rows: Sequence[Mapping[str, object]]) -> dict[tuple[str, str], Coverage]:
    """Return the coverage of each model and quantity from rows with model, quantity, limit, actual."""
    found: dict[tuple[str, str], Coverage] = {}
    for row in rows:
        key = (str(row["model"]), str(row["quantity"]))
        before = found.get(key, Coverage(0, 0))
        below = float(str(row["actual"])) <= float(str(row["limit"]))
        found[key] = Coverage(before.inside + below, before.count + 1)
    return found
