"""Width profiles of block shapes against areas and chords worked out by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.geometry import block_profile
from tread_validate.study import Block, Sipe


def block(**changes: Any) -> Block:
    """Return the paper's rectangle with changes."""
    given_keys: dict[str, Any] = {
        "origin": "assumed", "source": "a test", "shape": "rectangle", "length_mm": 25.0, "width_mm": 20.0,
        "height_mm": 8.0,
    }  # fmt: skip
    return Block(**{**given_keys, **changes})


def test_rectangle_is_as_wide_everywhere() -> None:
    """20 mm from 0 to 25 mm, nothing outside; area 500 mm2. Exact."""
    profile = block_profile(block())
    assert profile.width([-1e-3, 0.0, 0.0125, 0.025, 0.026]) == pytest.approx([0.0, 0.02, 0.02, 0.02, 0.0], abs=1e-15)
    assert profile.area == pytest.approx(5e-4, rel=1e-14)
    assert profile.extent == 0.025


def test_parallelogram_has_the_rectangles_area_and_a_trapezium_for_profile() -> None:
    """At 30 deg the edges sweep 20 tan 30 = 11.547 mm: a ramp up, a plateau of 20 mm, a ramp down. Exact."""
    profile = block_profile(block(shape="parallelogram", skew_deg=30.0))
    sweep = 0.02 * math.tan(math.radians(30.0))
    assert profile.extent == pytest.approx(0.025 + sweep, rel=1e-14)
    assert profile.area == pytest.approx(5e-4, rel=1e-12)
    assert profile.width([0.5 * sweep, 0.018, 0.025 + 0.75 * sweep]) == pytest.approx([0.01, 0.02, 0.005], rel=1e-12)


def test_strongly_skewed_parallelogram_never_reaches_its_full_width() -> None:
    """At 60 deg the sweep, 34.6 mm, exceeds the length: the chord is at most 25 / tan 60 = 14.43 mm. Exact."""
    profile = block_profile(block(shape="parallelogram", skew_deg=60.0))
    assert profile.area == pytest.approx(5e-4, rel=1e-12)
    assert profile.width(np.linspace(0, profile.extent, 999)).max() == pytest.approx(
        0.025 / math.tan(math.radians(60.0)), rel=1e-12
    )


def test_sipes_are_gaps() -> None:
    """Two gaps of 1 and 2 mm take 3 x 20 mm2 away, and the width is zero in them. Exact."""
    profile = block_profile(block(sipes=(Sipe(position_mm=8.0, width_mm=1.0), Sipe(position_mm=15.0, width_mm=2.0))))
    assert profile.area == pytest.approx(4.4e-4, rel=1e-13)
    assert profile.width([8.5e-3, 16e-3]) == pytest.approx([0.0, 0.0], abs=1e-15)
    assert profile.width([7e-3, 10e-3, 20e-3]) == pytest.approx([0.02] * 3, rel=1e-13)


def test_sipe_at_an_end_shortens_the_block() -> None:
    """A gap from 0 to 2 mm leaves 23 mm, which begin at 2 mm; one to the very end, likewise. Exact."""
    front = block_profile(block(sipes=(Sipe(position_mm=0.0, width_mm=2.0),)))
    back = block_profile(block(sipes=(Sipe(position_mm=23.0, width_mm=2.0),)))
    assert front.area == back.area == pytest.approx(4.6e-4, rel=1e-13)
    assert back.extent == pytest.approx(0.023, rel=1e-14)
    assert front.positions[0] == pytest.approx(0.002, rel=1e-14)


@given(
    length=st.floats(5.0, 60.0),
    width=st.floats(5.0, 60.0),
    skew=st.floats(1.0, 75.0),
    gap=st.floats(0.05, 0.4),
    place=st.floats(0.0, 0.5),
)
def test_area_is_that_of_the_rubber_whatever_the_skew(
    length: float, width: float, skew: float, gap: float, place: float
) -> None:
    """(length - gap) x width: skewing moves rubber along the rows and takes none away. Round-off, 1e-9."""
    sipe = Sipe(position_mm=place * length, width_mm=gap * length)
    shape = block(shape="parallelogram", skew_deg=skew, length_mm=length, width_mm=width, sipes=(sipe,))
    profile = block_profile(shape)
    expected = (1.0 - gap) * length * width * 1e-6
    assert profile.area == pytest.approx(expected, rel=1e-9)
    cells = profile.cell_areas(np.linspace(0.0, profile.extent, 38))
    assert cells.sum() == pytest.approx(expected, rel=1e-9)
    assert cells.min() > -1e-12
