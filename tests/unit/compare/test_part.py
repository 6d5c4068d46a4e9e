"""A part of a study's comparison."""

from __future__ import annotations

import pytest

from tread_validate.compare.part import StudyPart
from tread_validate.compare.tables import Coefficient

ORDER = ("fe:embedded", "spring:paper", "spring:shape_factor", "spring:condensed")


def coefficient(source: str) -> Coefficient:
    return Coefficient(
        source, "rectangle", "a_v", "mean", 0.04, "s/m", 0.001, "sd", None, None, None, None, 0.95, 4, "current"
    )


@pytest.mark.parametrize("asked", ["paper", "shape_factor", "condensed"])
def test_models_keep_the_study_s_order_whichever_is_asked_for(asked: str) -> None:
    """A pair of sources is named by their order: it must not depend on which of them ran now."""
    others = tuple(coefficient(source) for source in ORDER[1:] if source != f"spring:{asked}")
    part = StudyPart((asked,), (), None, others)
    found = [coefficient("fe:embedded"), coefficient(f"spring:{asked}")]
    assert [row.source for row in part.coefficients(found, (*ORDER, *part.sources))] == list(ORDER)
