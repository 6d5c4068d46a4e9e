"""The validity map: groups that know no scale, a design that grows, a rule that says where it ends."""

import math
from dataclasses import asdict, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.spring.cautions import STRUCK
from tread_validate.study import load_study
from tread_validate.validity import store
from tread_validate.validity.build import tried
from tread_validate.validity.calibration import (
    CLASSES,
    TIGHT,
    Coverage,
    conformal,
    coverage,
    factors,
    fitted,
    held_out,
)
from tread_validate.validity.design import RANGES, design
from tread_validate.validity.groups import coordinates, groups_of, kind_of, strike
from tread_validate.validity.points import DAMPING_US, MESHES, MODELS, meshed
from tread_validate.validity.rule import NEAREST, expected_error
from tread_validate.validity.summary import summary
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
    kind = kind_of(case)
    return Point(case.case_id, kind, groups_of(case), dict.fromkeys(found, 0.0), {"condensed": found})


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
    case = next(case for case in cases if case.path.family != "rig" and case.creep_ratio > 0)
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
        assert two.errors["condensed"] == pytest.approx(one.errors["condensed"], abs=1e-4)
    with pytest.raises(InputError, match="map"):
        read_table("a,b\n1,2\n")


def test_errors_are_relative_to_the_limit_of_the_meshes():
    limit = {"normal": 100.0, "impulse": 2.0, "positive": 20.0, "negative": -10.0}
    found = relative({"normal": 102.0, "impulse": 1.9, "positive": 21.0, "negative": -12.0}, limit)
    assert found == pytest.approx({"normal": 0.02, "impulse": -0.05, "tangential": 0.1})


def test_a_refused_point_is_none(cases):
    assert point_of({"refused": "why"}, 6) is None


@pytest.mark.parametrize(
    "fault",
    [
        {"residual_6": 0.02},
        {"artificial_6": 0.03},
        {"impact_6": 0.03},
        {"unsteadiness_6": 0.01},
        {"alternation_6": 0.03},
        {"fe_6": {"normal": 90.0}},
        {},
    ],
)
def test_an_fe_run_that_is_no_reference_makes_no_point(fault):
    """Energy residual above 1 %, hourglass energy or impacts above 2 %, scattering T, chatter, 5 % from the limit."""
    data = {
        "residual_6": 0.0,
        "artificial_6": 0.001,
        "impact_6": 0.001,
        "unsteadiness_6": 0.001,
        "alternation_6": 0.0,
        "fe_6": {"normal": 99.0},
        "limit": {"normal": 100.0},
    }
    assert is_reference({**data, **fault}, 6) == (not fault)


def test_faces_of_the_maps_decks_are_damped_where_they_slide(cases):
    """At least 1 us, more where the study asks for more."""
    assert meshed(cases[0], 4).deck.stiffness_damping_us == DAMPING_US
    damped = replace(cases[0], deck=cases[0].deck.model_copy(update={"stiffness_damping_us": 5.0}))
    assert meshed(damped, 4).deck.stiffness_damping_us == 5.0


def test_a_contact_shorter_than_three_elements_of_the_finer_mesh_makes_no_point(cases):
    """2 sqrt(2 D R) on the rig: D/h = 0.01, R/h = 2.7 and 3.5: 2.8 and 3.2 elements. A belt has a patch."""
    forces = {"normal": 100.0, "impulse": 2.0, "positive": 20.0, "negative": -10.0}
    shares = dict.fromkeys(("residual_6", "artificial_6", "impact_6", "unsteadiness_6", "alternation_6"), 0.0)
    groups = asdict(groups_of(cases[0])) | {"interference": 0.01, "length": 1.0}
    data = {**shares, "case_id": "map-000", "fe_6": forces, "limit": forces, "models": {"paper": forces}}
    for kind, radius, made in (("rig, flat", 2.7, False), ("rig, flat", 3.5, True), ("belt, flat", 2.7, True)):
        found = point_of({**data, "kind": kind, "groups": {**groups, "radius": radius}}, 6)
        assert (found is not None) == made


def test_the_rule_finds_an_error_that_depends_on_the_groups(cases):
    """Errors that grow with D/h are predicted from the neighbours: nine in ten held-out ones below the stated limit."""
    points = [point(case, normal=2.0 * case.interference / case.height, impulse=0.01) for case in cases]
    rows = tried(cases, points)
    assert len(rows) > 20
    assert coverage(rows)["condensed", "normal"].interval[1] > 0.9
    assert {row["case_id"] for row in rows} <= {each.case_id for each in held_out(points)}


@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 10_000), scatter=st.floats(0.1, 1.5))
def test_limits_of_nine_in_ten_hold_for_points_that_the_rule_never_saw(cases, seed, scatter):
    """Log-normal errors of any scatter: over many maps the share of held-out errors below the limit is nine in ten.

    Here one map at a time, so that the binomial interval (99.99 %) of its points is what may be asked.
    """
    sizes = 0.01 * np.exp(scatter * np.random.default_rng(seed).standard_normal(len(cases)))
    points = [point(case, normal=float(size)) for case, size in zip(cases, sizes, strict=True)]
    found = coverage(tried(cases, points))["condensed", "normal"]
    assert found.inside >= found.count * 0.9 - 4.5 * math.sqrt(found.count * 0.09)


def test_fitted_and_held_out_points_share_none_and_leave_none(cases):
    points = [point(case) for case in cases]
    one, two = ([each.case_id for each in part(points)] for part in (fitted, held_out))
    assert not set(one) & set(two)
    assert len(one) + len(two) == len(points)
    assert len(two) == len(points) // 3
    # a point that is no reference moves no other from one part to the other
    assert [each.case_id for each in held_out(points[1:])] == two


def test_conformal_quantile_is_the_ceil_nine_tenths_of_n_plus_one_smallest():
    assert conformal(range(1, 20)) == 18
    assert conformal(range(1, 11)) == 10
    assert conformal(range(1, 9)) == math.inf


def test_coverage_says_its_exact_binomial_interval():
    """Clopper and Pearson, 18 of 20: 68.3 to 98.8 %."""
    low, high = Coverage(18, 20).interval
    assert (low, high) == (pytest.approx(0.6830, abs=1e-4), pytest.approx(0.9877, abs=1e-4))
    assert Coverage(0, 5).interval[0] == 0.0
    assert Coverage(5, 5).interval[1] == 1.0
    assert str(Coverage(18, 20)) == "90 % of 20 (95 % interval 68 to 99 %)"


def test_errors_of_one_size_need_no_widening(cases):
    points = [point(case, normal=0.01, impulse=0.02, tangential=0.03) for case in cases]
    for own in factors(points, "condensed").values():
        assert own == pytest.approx(dict.fromkeys(("normal", "impulse", "tangential"), 1.0))


def test_tight_arcs_have_a_factor_of_their_own(cases):
    """Errors that scatter there tenfold, and not at all elsewhere, widen the limits there alone."""
    rng = np.random.default_rng(3)
    tight = [kind_of(case).startswith("belt") and groups_of(case).radius < TIGHT for case in cases]
    points = [
        point(case, normal=0.01 * (10.0 ** rng.uniform(-0.5, 0.5) if bent else 1.0))
        for case, bent in zip(cases, tight, strict=True)
    ]
    found = factors(points, "condensed")
    assert found["tight arcs"]["normal"] > 1.3 * found["elsewhere"]["normal"]


def test_where_the_road_strikes_the_face_nothing_is_promised_and_nothing_learnt(cases):
    """Errors of struck points move no expectation, and a struck case lies outside the map."""
    struck = [strike(groups_of(case)) > STRUCK for case in cases]
    assert 3 < sum(struck) < len(cases) / 3
    points = [point(case, normal=0.5 if hit else 0.01) for case, hit in zip(cases, struck, strict=True)]
    for case, hit in zip(cases[::7], struck[::7], strict=True):
        found = expected_error(case, "condensed", points)
        assert found.normal is None or found.normal == pytest.approx(0.01)
        assert ("the road strikes the face" in found.outside) == (hit and found.normal is not None)


def test_the_summary_says_median_nine_in_ten_and_worst(cases):
    """Errors of 1 to 96 %: median 48.5 %, 86.5 % (linear between ranks), 96 %."""
    points = [point(case, normal=0.01 * (k + 1)) for k, case in enumerate(cases)]
    counts = {"points": 96, "asked_for": 96, "no_reference": 0, "refused": 0, "commit": "c"}
    worth = {
        "fitted": 64, "held_out": 32, "factors": {
            "condensed": {name: dict.fromkeys(("normal", "impulse", "tangential"), 1.5) for name in CLASSES}
        },
        "coverage": {"condensed normal": {"below": 18, "of": 20}},
    }  # fmt: skip
    text = summary(points, counts | worth)
    assert "48.5 / 86.5 / 96 %" in text
    assert "90 % of 20 (95 % interval 68 to 99 %); factor 1.5 elsewhere, 1.5 tight arcs" in text
    assert "before its limits were tried" in summary(points, counts)


@pytest.fixture
def counted(monkeypatch):
    """Engine and models that take no time and count how often they are asked; their code's digests can be changed."""
    asked = {"fe": 0, **dict.fromkeys(MODELS, 0)}
    code = {"engine": "e1", "decks": "d1", **{model: f"{model}1" for model in MODELS}}
    forces = {"normal": 1.0, "impulse": 1.0, "positive": 0.1, "negative": -0.1}

    def fe_point(case):
        asked["fe"] += 1
        bound = {"case_digest": case.digest(), "meshes": list(MESHES), "code": store.fe_code(), "decks": ["same"] * 2}
        return {"bound": bound, "fe_4": forces, "fe_6": forces, "seconds": 0.0}

    def model_point(case, model):
        asked[model] += 1
        return forces

    monkeypatch.setattr(store, "fe_point", fe_point)
    monkeypatch.setattr(store, "model_point", model_point)
    monkeypatch.setattr(store, "fe_code", lambda: {name: code[name] for name in ("engine", "decks")})
    monkeypatch.setattr(store, "deck_digests", lambda case: [code.get("text", "same")] * 2)
    monkeypatch.setattr(
        store, "models_bound", lambda case: {m: {"case_digest": case.digest(), "code": code[m]} for m in MODELS}
    )
    return asked, code


def run_again(cases, folder, asked, more=lambda: True):
    before = dict(asked)
    points = store.run_points(cases, folder, lambda line: None, more)
    return points, {name: asked[name] - before[name] for name in asked if asked[name] != before[name]}


def test_a_point_is_run_again_only_where_its_own_code_changed(cases, tmp_path, counted):
    """A model's code moves that model alone; the engine's moves FE alone; the same decks by other code nothing."""
    asked, code = counted
    two = cases[:2]
    assert run_again(two, tmp_path, asked)[1] == dict.fromkeys(("fe", *MODELS), 2)
    assert run_again(two, tmp_path, asked)[1] == {}
    code["condensed"] = "condensed2"
    points, ran = run_again(two, tmp_path, asked)
    assert ran == {"condensed": 2}
    assert all("refused" not in each for each in points)
    code["decks"] = "d2"
    assert run_again(two, tmp_path, asked)[1] == {}
    code["text"] = "other"
    assert run_again(two, tmp_path, asked)[1] == {"fe": 2}
    code["text"] = "same"
    code["engine"] = "e2"
    assert run_again(two, tmp_path, asked)[1] == {"fe": 2}


def test_points_of_another_engine_are_never_mixed_with_those_of_this_one(cases, tmp_path, counted):
    """Where time is up before they could run again, they are left out and not taken over."""
    asked, code = counted
    assert len(run_again(cases[:3], tmp_path, asked)[0]) == 3
    code["engine"] = "e2"
    points, ran = run_again(cases[:3], tmp_path, asked, more=lambda: asked["fe"] < 4)
    assert len(points) == 1
    assert ran == {"fe": 1}
    assert len(run_again(cases[:3], tmp_path, asked)[0]) == 3


def test_a_damaged_point_is_run_again(cases, tmp_path, counted):
    asked, _ = counted
    run_again(cases[:1], tmp_path, asked)
    (tmp_path / f"{cases[0].case_id}.fe.json").write_text('{"bound"', encoding="utf-8")
    assert run_again(cases[:1], tmp_path, asked)[1] == {"fe": 1}


def test_a_face_that_slides_from_end_to_end_is_one_place_whatever_its_creep(cases):
    """Constant friction: beyond 1.5 times the sticking limit neither distance nor range knows more creep."""
    one, two = (coordinates(replace(groups_of(cases[0]), creep=creep)) for creep in (1.5, 40.0))
    assert one.tolist() == two.tolist()
    less = coordinates(replace(groups_of(cases[0]), creep=1.2))
    assert less.tolist() != one.tolist()


def test_the_rule_says_where_it_ends(cases, base):
    points = [point(case, normal=0.01) for case in cases]
    inside = next(case for case in cases[9:] if case.block.mounting == "flat" and case.path.family != "rig")
    found = expected_error(inside, "condensed", points)
    assert found.outside == ()
    assert found.normal == pytest.approx(0.01)
    assert "expected error of N 1.0 %" in str(found)
    rubbery = replace(inside, compound=inside.compound.model_copy(update={"poissons_ratio": 0.4999}))
    assert "poisson" in expected_error(rubbery, "condensed", points).outside
    deep = replace(inside, interference=0.3 * inside.height)
    beyond = expected_error(deep, "condensed", points)
    assert "interference" in beyond.outside
    assert not beyond.likely, "outside the map no limit was tried"
    assert "nine in ten" not in str(beyond)
    huemer = replace(inside, friction=base.friction, creep_ratio=0.2)
    assert any("law" in why for why in expected_error(huemer, "condensed", points).outside)
    few = expected_error(inside, "condensed", points[:NEAREST])
    assert few.normal is None
    assert "outside the map" in str(few)
    assert expected_error(inside, "unknown", points).normal is None


def test_the_committed_map_is_whole():
    """Every point of the table is finite, and every model has its errors."""
    for each in committed():
        assert all(math.isfinite(value) for value in coordinates(each.groups))
        assert {"paper", "shape_factor", "condensed_coarse", "condensed"} <= set(each.errors)
