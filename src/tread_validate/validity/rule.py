"""What error to expect of a model's prediction, from the nearest points of the map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..friction import Coulomb
from ..history import History
from ..study import Case
from .groups import NAMES, coordinates, groups_of
from .table import ERRORS, Point, committed

NEAREST = 8
"""Points of the same kind (path and mounting) that an expectation rests on."""
WIDENED = 2.0
"""Factor on the limit for nine in ten: leaving one point out asks for 1.3, the points held out together for 2."""
SLIDES = 0.5
"""Creep over the sticking limit up to which the law of slip hardly matters: the map's friction is constant."""
SLACK = 0.05
"""A group may lie outside the points by this share of their range."""


@dataclass(frozen=True)
class Expectation:
    """What to expect of a prediction.

    Attributes
    ----------
    normal, impulse, tangential : float or None
        Expected size of the error (root mean square of the nearest points, weighted by distance), relative; of T over
        the larger of its peaks. None where the map says nothing.
    likely : mapping of str to float
        What nine in ten errors stay below, for each of the three.
    outside : tuple of str
        Why the case is outside the map; empty inside it.
    points : int
        How many points of its kind the map has.
    """

    normal: float | None
    impulse: float | None
    tangential: float | None
    likely: Mapping[str, float]
    outside: tuple[str, ...]
    points: int

    def __str__(self) -> str:
        """Say it in one line."""
        if self.normal is None:
            return f"outside the map: {'; '.join(self.outside)}"
        assert self.tangential is not None
        found = f"expected error of N {100 * self.normal:.1f} %, of T {100 * self.tangential:.1f} %"
        return found if not self.outside else f"outside the map ({'; '.join(self.outside)}): nearest points {found}"


def expected_error(case: Case, model: str, points: Sequence[Point] | None = None) -> Expectation:
    """Return what error to expect of a model's prediction of a case whose creep ratio is known.

    Parameters
    ----------
    points : sequence of Point, optional
        The map; the committed one where left out.
    """
    points = committed() if points is None else points
    kind = f"{'rig' if case.is_rig else 'belt'}, {case.block.mounting}"
    known = [point for point in points if point.kind == kind and model in point.errors]
    outside: list[str] = []
    if case.block.sipes:
        outside.append("sipes")
    if len(known) <= NEAREST:
        said = f"{len(known)} points of kind {kind} for {model}"
        return Expectation(None, None, None, {}, (*outside, said), len(known))
    groups = groups_of(case)
    steady = isinstance(case.friction, Coulomb) and (
        case.friction.kinetic_coefficient >= case.friction.static_coefficient
    )
    if not steady and abs(groups.creep) > SLIDES:
        outside.append("much slip under a friction law that depends on it")
    here = coordinates(groups)
    places = np.array([coordinates(point.groups) for point in known])
    low, high = places.min(axis=0), places.max(axis=0)
    size = np.maximum(high - low, 1e-9)
    for name, at, least, most, range_ in zip(NAMES, here, low, high, size, strict=True):
        slack = SLACK * range_
        below = at < least - slack and name not in ("relaxation", "speed", "skew")
        if below or at > most + slack:
            outside.append(name)
    distance = np.sqrt(np.mean(((places - here) / size) ** 2, axis=1))
    nearest = np.argsort(distance)[:NEAREST]
    weight = 1.0 / np.maximum(distance[nearest], 0.02)
    weight /= weight.sum()
    values = {each: np.array([known[k].errors[model][each] for k in nearest]) for each in ERRORS}
    expected = {each: float(np.sqrt(weight @ found**2)) for each, found in values.items()}
    ninth = {each: float(np.quantile(np.abs(found), 0.9)) for each, found in values.items()}
    likely = {each: WIDENED * max(ninth[each], 1.64 * expected[each]) for each in ERRORS}
    return Expectation(
        expected["normal"], expected["impulse"], expected["tangential"], likely, tuple(outside), len(known)
    )


def with_expectation(history: History, case: Case, model: str) -> History:
    """Return a prediction that says what error to expect of it (``expected_error`` in its provenance)."""
    said = str(expected_error(case, model))
    return history.with_provenance({**history.provenance, "expected_error": said})
