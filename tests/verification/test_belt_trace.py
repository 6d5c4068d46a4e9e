"""Levelling, smoothing and curvature of belt traces against the exact line behind them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.geometry.trace import RidgeHeights, level, smoothed_line
from tread_validate.geometry.trace_curvature import three_point_curvature
from tread_validate.geometry.trace_fit import fit_patch
from tread_validate.geometry.trace_synthetic import RIDGES, SPIKE, SyntheticRidges, synthetic_ridges

CENTRE = 0.2507  # middle of the synthetic patches in the machine's coordinate


@pytest.fixture(scope="module")
def ridges() -> SyntheticRidges:
    return synthetic_ridges()


@given(radius=st.floats(0.05, 50), centre=st.floats(-1, 1), pitch=st.floats(1e-4, 5e-3), up=st.booleans())
def test_curvature_of_a_noise_free_circle_is_exact(radius: float, centre: float, pitch: float, up: bool) -> None:
    """Three points of a circle give 1/R with its sign, at any pitch.

    Rounding: heights near R carry 1e-16 R, divided by pitch^2: 20 R^2 eps/pitch^2 relative at most.
    """
    x = centre + np.arange(-8, 9) * min(pitch, radius / 20)
    sagitta = radius - np.sqrt(radius**2 - (x - centre) ** 2)
    found = three_point_curvature(x, sagitta if up else -sagitta)[1:-1]
    step = min(pitch, radius / 20)
    bound = 1e-12 + 20 * radius**2 * np.finfo(float).eps / step**2
    np.testing.assert_allclose(found, (1 if up else -1) / radius, rtol=bound)


@pytest.mark.parametrize("name", list(RIDGES))
def test_patch_edges_are_found_within_one_point(ridges: SyntheticRidges, name: str) -> None:
    """True edges at half the patch length from the middle (curvature rises from 0 to 2 1/m over 4 mm there).

    Within 2 mm, the pitch: what the machine resolves. The edge radius of 0.5 m within the 95 % interval, and the
    line itself within the 10 um resolution everywhere.
    """
    fit = fit_patch(ridges.position, ridges.heights[name], name)
    half = 0.5 * RIDGES[name]
    assert fit.edges == pytest.approx((CENTRE - half, CENTRE + half), abs=2e-3)
    assert np.max(np.abs(fit.height(ridges.position) - ridges.exact[name])) < 10e-6
    for curvature, deviation in zip(fit.edge_curvatures, fit.edge_curvature_deviations, strict=True):
        assert abs(curvature - 2.0) < 3.0 * deviation


def test_nothing_of_the_noise_is_left_inside_the_patch(ridges: SyntheticRidges) -> None:
    """The patch is flat by construction: height and curvature exactly 0 where the raw curvature scatters by > 1 1/m."""
    trace = next(t for t in level(RidgeHeights(ridges.position, ridges.heights, "test")) if t.name == "mid_top")
    inside = (trace.x > trace.edges[0] + 2e-3) & (trace.x < trace.edges[1] - 2e-3)
    assert np.all(trace.height[inside] == 0.0)
    assert np.all(trace.curvature[inside] == 0.0)
    raw = (trace.measured_x > trace.edges[0]) & (trace.measured_x < trace.edges[1])
    assert np.std(trace.measured_curvature[raw]) > 1.0


def test_spike_is_set_aside_and_moves_no_edge(ridges: SyntheticRidges) -> None:
    """The one bad point inside the patch is found where it was put; with and without it the edges differ < 0.2 mm.

    0.2 mm is a tenth of the pitch. A spike four times as high is set aside just as well: then the same heights are
    fitted, and the edges agree to 10 um, to which their search repeats itself from another start.
    """
    x, y = ridges.position, ridges.heights["mid_top"]
    fit = fit_patch(x, y, "mid_top")
    assert [round(v, 4) for v in x[~fit.used] - CENTRE] == pytest.approx([SPIKE[1]], abs=1e-3)
    worse = y.copy()
    worse[~fit.used] += 75e-6
    again = fit_patch(x, worse, "mid_top")
    assert again.edges == pytest.approx(fit.edges, abs=10e-6)
    assert fit_patch(x, y, "mid_top", keep_spikes=True).edges == pytest.approx(fit.edges, abs=0.2e-3)


@settings(max_examples=8, deadline=None)
@given(tilt=st.floats(-0.03, 0.03), offset=st.floats(-0.1, 0.1))
def test_tilt_and_offset_of_the_cast_do_not_matter(tilt: float, offset: float) -> None:
    """Any straight line added to the heights is taken off again: the levelled points agree to 1 um.

    Exact in the linear part; the edges are searched to 1 um, which is what the tolerance is.
    """
    exact = synthetic_ridges()
    x, y = exact.position, exact.heights["mid_bottom"]
    plain, tilted = fit_patch(x, y, "plain"), fit_patch(x, y + tilt * x + offset, "tilted")
    assert tilted.edges == pytest.approx(plain.edges, abs=0.1e-3)
    levelled = tilted.level(x, y + tilt * x + offset)
    np.testing.assert_allclose(levelled, plain.level(x, y), atol=1e-6)


def test_gaps_cost_nothing_but_their_points(ridges: SyntheticRidges) -> None:
    """Ten of 251 heights missing outside the patch: patch length within 1 mm (half a pitch) of that with them."""
    y = ridges.heights["mid_top"].copy()
    y[[10, 11, 12, 30, 31, 200, 201, 202, 203, 240]] = np.nan
    whole = fit_patch(ridges.position, ridges.heights["mid_top"], "whole").patch_length
    assert fit_patch(ridges.position, y, "gaps").patch_length == pytest.approx(whole, abs=1e-3)


def test_quick_line_for_a_study_is_the_imported_line(ridges: SyntheticRidges) -> None:
    """A study that names raw heights gets the trace that `import-belt` writes, to the last bit."""
    raw = RidgeHeights(ridges.position, ridges.heights, "test")
    trace = next(t for t in level(raw) if t.name == "mid_top")
    x, height = smoothed_line(raw, "mid_top")
    np.testing.assert_array_equal(x, trace.x)
    np.testing.assert_array_equal(height, trace.height)
