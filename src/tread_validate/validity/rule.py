"""What error to expect of a model's prediction, from the nearest points of the map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from ..friction import Coulomb
from ..history import History
from ..spring.cautions import STRUCK
from ..study import Case
from .calibration import NEAREST, basis_of, class_of, factors, neighbours, ranges
from .groups import NAMES, Groups, coordinates, groups_of, kind_of, strike
from .made_by import made_by_other_code
from .table import ERRORS, Point, committed

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
        What nine in ten errors stay below, for each of the three; empty outside the map, where nothing was tried.
    outside : tuple of str
        Why the case is outside the map; empty inside it.
    points : int
        How many points of its kind the rule has.
    worst : mapping of str to float
        The largest errors among the nearest points.
    stale : str
        Empty, or that model or engine have changed since the map was made.
    """

    normal: float | None
    impulse: float | None
    tangential: float | None
    likely: Mapping[str, float]
    outside: tuple[str, ...]
    points: int
    worst: Mapping[str, float]
    stale: str = ""

    def __str__(self) -> str:
        """Say it in one line."""
        stale = f" [{self.stale}]" if self.stale else ""
        if self.normal is None:
            return f"outside the map: {'; '.join(self.outside)}{stale}"
        assert self.tangential is not None
        if self.outside:
            return (
                f"outside the map ({'; '.join(self.outside)}), where no limit was tried: the nearest points err by "
                f"{100 * self.normal:.1f} % in N and {100 * self.tangential:.1f} % in T{stale}"
            )
        found = " and ".join(
            f"of {name} {100 * of:.1f} % (nine in ten below {100 * self.likely[each]:.1f} %)"
            for name, each, of in (("N", "normal", self.normal), ("T", "tangential", self.tangential))
        )
        return f"expected error {found}{stale}"


class Rule:
    """The rule of a map's points: those that may be neighbours, and how far their errors are widened."""

    def __init__(self, points: Sequence[Point]) -> None:
        self.basis = basis_of(points)
        self._factors: dict[str, dict[str, dict[str, float]]] = {}

    def factors(self, model: str) -> dict[str, dict[str, float]]:
        """Return the factor on the local scale by class, for each of `ERRORS`."""
        if model not in self._factors:
            self._factors[model] = factors(self.basis, model)
        return self._factors[model]

    def expect(self, case: Case, model: str, stale: str = "") -> Expectation:
        """Return what error to expect of a model's prediction of a case whose creep ratio is known."""
        kind = kind_of(case)
        known = [point for point in self.basis if point.kind == kind and model in point.errors]
        outside = ("sipes",) if case.block.sipes else ()
        if len(known) <= NEAREST:
            said = f"{len(known)} points of kind {kind} for {model}"
            return Expectation(None, None, None, {}, (*outside, said), len(known), {}, stale)
        here = groups_of(case)
        near = neighbours(coordinates(here), known, ranges(known)[2])
        expected = {each: near.expected(model, each) for each in ERRORS}
        widened = self.factors(model)[class_of(kind, here)]
        outside = (*outside, *_beyond(case, here, known))
        return Expectation(
            normal=expected["normal"],
            impulse=expected["impulse"],
            tangential=expected["tangential"],
            likely={} if outside else {each: widened[each] * near.scale(model, each) for each in ERRORS},
            outside=outside,
            points=len(known),
            worst={each: near.worst(model, each) for each in ERRORS},
            stale=stale,
        )


def _beyond(case: Case, groups: Groups, known: Sequence[Point]) -> list[str]:
    """Return the groups that lie beyond the points, and whether the law of slip matters."""
    steady = isinstance(case.friction, Coulomb) and (
        case.friction.kinetic_coefficient >= case.friction.static_coefficient
    )
    found = []
    if not steady and abs(groups.creep) > SLIDES:
        found.append("much slip under a friction law that depends on it")
    if strike(groups) > STRUCK:
        found.append("the road strikes the face")
    low, high, size = ranges(known)
    for name, at, least, most, range_ in zip(NAMES, coordinates(groups), low, high, size, strict=True):
        slack = SLACK * range_
        below = at < least - slack and name not in ("relaxation", "speed", "skew")
        if below or at > most + slack:
            found.append(name)
    return found


def expected_error(case: Case, model: str, points: Sequence[Point] | None = None) -> Expectation:
    """Return what error to expect of a model's prediction of a case whose creep ratio is known.

    Parameters
    ----------
    points : sequence of Point, optional
        The map, points held out among them; the committed one where left out.
    """
    if points is not None:
        return Rule(points).expect(case, model)
    return _committed_rule().expect(case, model, made_by_other_code(model))


@cache
def _committed_rule() -> Rule:
    return Rule(committed())


def with_expectation(history: History, case: Case, model: str) -> History:
    """Return a prediction that says what error to expect of it (``expected_error`` in its provenance)."""
    said = str(expected_error(case, model))
    return history.with_provenance({**history.provenance, "expected_error": said})
