"""Compound and friction law of a case, worked out once for all cases that share them."""

from __future__ import annotations

from functools import lru_cache

from ..friction import Friction, FrictionLaw, law
from ..material import PronySeries, prony_series
from ..study import Case, Compound


def series_of(case: Case) -> PronySeries:
    """Return the compound's series at the case's temperature; one without a data file is worked out once."""
    if _reads(case.compound):
        return prony_series(case.compound, case.root).at_temperature(case.temperature, case.compound.time_shift)
    return _series(case.compound, case.temperature)


def law_of(case: Case) -> FrictionLaw:
    """Return the friction law; one without a data file is worked out once."""
    return law(case.friction, case.root) if _reads(case.friction) else _law(case.friction)


def _reads(item: Compound | Friction) -> bool:
    return getattr(item, "file", None) is not None


@lru_cache(maxsize=256)
def _series(compound: Compound, temperature: float) -> PronySeries:
    return prony_series(compound).at_temperature(temperature, compound.time_shift)


@lru_cache(maxsize=256)
def _law(friction: Friction) -> FrictionLaw:
    return law(friction)
