"""The validity map: groups that know no scale, a design that grows, a rule that says where it ends."""

import math
from dataclasses import asdict, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.study import load_study
from tread_validate.validity.build import coverage, held_out
from tread_validate.validity.design import RANGES, design
from tread_validate.validity.groups import coordinates, groups_of
from tread_validate.validity.rule import NEAREST, expected_error
from tread_validate.validity.table import Point, committed, is_reference, point_of, read_table, relative, table_text

COUNT = 96


@pytest.fixture(scope="module")
def base(paper_study):
    return load_study(paper_study).cases()[0]


@pytest.fixture(scope="module")
def cases(base):
    return design(base, COUNT)


def point(case, **errors):
    found = {"normal": 0.0, "impulse": 0.0, "tangential": 0.0, **errors}
    kind = f"{'rig' if case.is_rig else 'belt'}, {case.block.mounting}"
    return Point(case.case_id, kind, groups_of(case), dict.fromkeys(found, 0.0), {"coupled": found})


def test_a_longer_design_begins_with_the_shorter_one(base, cases):
    assert [case.digest() for case in design(base, 12)] == [case.digest() for case in cases[:12]]
    assert [case.digest() for case in design(base, 300)[:12]] == [case.digest() for case in cases[:12]]
    with pytest.raises(InputError, match="runs"):
        design(base, 0)


def test_the_design_fills_its_ranges(cases):
    """Quarters of the range of D/h and of the friction coefficient hold 15 to 35 % of the points each."""
    for values, (low, high) in (
        (np.log([case.interference / case.height for case in cases]), np.log(RANGES["interference"])),
        ([case.friction.static_coefficient for case in cases], RANGES["friction"]),
    ):
        counts = np.histogram(values, bins=4, range=(low, high))[0] / len(cases)
        assert counts.sum() == pytest.approx(1.0)
        assert 0.15 < counts.min() <= counts.max() < 0.35


@settings(max_examples=20, deadline=None)
@given(scale=st.floats(0.2, 5.0), number=st.integers(0, 40))
def test_groups_know_no_scale(cases, scale, number):
    """Every length times one factor, the speed as it is (V tau/l goes with 1/l), changes no other group."""
    case = cases[number]
    block = case.block
    lengths = {name: scale * getattr(block, name) for name in ("length_mm", "width_mm", "height_mm")}
    path = case.path
    names = [name for name in type(path).model_fields if name.endswith("_mm")]
    scaled = replace(
        case,
        block=block.model_copy(update=lengths),
        path=path.model_copy(update={name: scale * getattr(path, name) for name in names}),
        interference=scale * case.interference,
    )
    one, two = asdict(groups_of(case)), asdict(groups_of(scaled))
    assert two.pop("relaxation") == pytest.approx(one.pop("relaxation") / scale, rel=1e-6)
    assert two == pytest.approx(one, rel=1e-6)


def test_the_sticking_limit_is_one_where_creep_strain_reaches_it(cases):
    """eps l_c/h = mu p/G with p = E D/h, l_c V times the time that a column touches: by hand for a belt."""
    case = next(case for case in cases if not case.is_rig and case.creep_ratio > 0)
    found = groups_of(case)
    limit = case.friction.static_coefficient * 2 * (1 + case.compound.poissons_ratio) * case.interference / case.height
    from tread_validate.geometry import path_of

    path = path_of(case)
    column = path.speed * path.contact_duration - path.columns.extent
    assert found.creep == pytest.approx(case.creep_ratio * column / case.height / limit, rel=1e-9)


def test_a_table_comes_back_as_it_was_written(cases):
    points = [point(case, normal=0.01 * k, tangential=0.2) for k, case in enumerate(cases[:5])]
    again = read_table(table_text(points))
    assert [each.case_id for each in again] == [each.case_id for each in points]
    for one, two in zip(points, again, strict=True):
        assert coordinates(two.groups) == pytest.approx(coordinates(one.groups), abs=1e-4)
        assert two.errors["coupled"] == pytest.approx(one.errors["coupled"], abs=1e-4)
    with pytest.raises(InputError, match="map"):
        read_table("a,b\n1,2\n")


def test_errors_are_relative_to_the_limit_of_the_meshes():
    limit = {"normal": 100.0, "impulse": 2.0, "positive": 20.0, "negative": -10.0}
    found = relative({"normal": 102.0, "impulse": 1.9, "positive": 21.0, "negative": -12.0}, limit)
    assert found == pytest.approx({"normal": 0.02, "impulse": -0.05, "tangential": 0.1})


def test_a_refused_point_is_none(cases):
    assert point_of({"refused": "why"}, 6) is None


@pytest.mark.parametrize("fault", [{"residual_6": 0.02}, {"artificial_6": 0.03}, {"fe_6": {"normal": 90.0}}, {}])
def test_an_fe_run_that_is_no_reference_makes_no_point(fault):
    """Energy residual above 1 %, hourglass energy above 2 %, or 5 % from the limit of its meshes."""
    data = {"residual_6": 0.0, "artificial_6": 0.001, "fe_6": {"normal": 99.0}, "limit": {"normal": 100.0}}
    assert is_reference({**data, **fault}, 6) == (not fault)


def test_the_rule_finds_an_error_that_depends_on_the_groups(cases):
    """Errors that grow with D/h are predicted from the neighbours: nine in ten held-out ones below the stated limit."""
    points = [point(case, normal=2.0 * case.interference / case.height, impulse=0.01) for case in cases]
    rows = held_out(cases, points)
    assert len(rows) > 20
    assert coverage(rows)["coupled"] >= 0.9


def test_the_rule_says_where_it_ends(cases, base):
    points = [point(case, normal=0.01) for case in cases]
    inside = next(case for case in cases[8:] if case.block.mounting == "flat" and not case.is_rig)
    found = expected_error(inside, "coupled", points)
    assert found.outside == ()
    assert found.normal == pytest.approx(0.01)
    assert "expected error of N 1.0 %" in str(found)
    rubbery = replace(inside, compound=inside.compound.model_copy(update={"poissons_ratio": 0.4999}))
    assert "poisson" in expected_error(rubbery, "coupled", points).outside
    deep = replace(inside, interference=0.3 * inside.height)
    assert "interference" in expected_error(deep, "coupled", points).outside
    huemer = replace(inside, friction=base.friction, creep_ratio=0.2)
    assert any("law" in why for why in expected_error(huemer, "coupled", points).outside)
    few = expected_error(inside, "coupled", points[:NEAREST])
    assert few.normal is None
    assert "outside the map" in str(few)
    assert expected_error(inside, "unknown", points).normal is None


def test_the_committed_map_is_whole():
    """Every point of the table is finite, and every model has its errors."""
    for each in committed():
        assert all(math.isfinite(value) for value in coordinates(each.groups))
        assert {"paper", "bonded", "coupled_coarse", "coupled"} <= set(each.errors)
