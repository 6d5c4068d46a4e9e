"""The three standard uncertainties stand beside the expanded one, and one that is not known is said so."""

from __future__ import annotations

import pytest

from tread_validate.compare.quantities import SCALAR, tolerances
from tread_validate.compare.scores.assessment import Parts
from tread_validate.compare.scores.comparison import scalar_row
from tread_validate.report.models import judged


@pytest.mark.parametrize(
    ("parts", "told"),
    [
        (Parts(1.0, 0.0, 2.0), "tolerance 10 %, U 4.5 % (u: mesh 1 %, inputs 0 %, data 2 %)"),
        (Parts(1.0, None, 2.0), "tolerance 10 %, U – (u: mesh 1 %, inputs unknown, data 2 %)"),
    ],
)
def test_parts_of_the_uncertainty_are_told(parts: Parts, told: str) -> None:
    """Of 100 N measured and as much predicted: 2 sqrt(1 + 4) = 4.5 N."""
    names = ("case", "rig:measured", "model:a")
    row = scalar_row(SCALAR["peak_normal_force"], 100.0, 100.0, {}, names, parts, tolerances())
    assert " ".join(judged(row).split()).replace(".0 %", " %") == told
