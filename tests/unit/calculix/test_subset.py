"""What CalculiX would silently ignore is refused by name and line."""

from __future__ import annotations

import numpy as np
import pytest

from tread_validate.calculix import dialect, read_elastic_deck
from tread_validate.calculix.motion import PlaneMotion, Velocity, still
from tread_validate.errors import InputError

COULOMB = "      function fricmu(nProps, props, press, speed)\n      fricmu = props(2)\n      end\n"


@pytest.mark.parametrize(
    ("after", "keyword", "says"),
    [
        ("16., 0.47", "*VISCOELASTIC, TIME=PRONY\n0.3, 0.3, 0.001", "*VISCOELASTIC"),
        ("16., 0.47", "*TRS\n22., 7.9, 113.6", "*TRS"),
        (", 0.005", "*FIXED MASS SCALING, FACTOR=4", "*FIXED MASS SCALING"),
        (", 0.005", "*DLOAD\nBLOCK, P1, 1.", "*DLOAD"),
        ("16., 0.47", "*CONDUCTIVITY\n0.2", "*CONDUCTIVITY"),
    ],
)
def test_keyword_that_would_be_ignored_is_refused_by_name(press, after, keyword, says):
    path = press()
    text = path.read_text()
    line = text[: text.index(after)].count("\n") + 2
    path.write_text(text.replace(after, f"{after}\n{keyword}", 1))
    with pytest.raises(InputError) as fault:
        read_elastic_deck(path)
    assert f"press.inp:{line}: {says}" in str(fault.value)


def test_user_friction_is_refused_unless_it_is_coulombs_law(press, tmp_path):
    path = press(friction=0.9)
    user = "*FRICTION, USER=FRIC, PROPERTIES=2\n0.9, 0.9\n"
    path.write_text(path.read_text().replace("*FRICTION\n0.9,\n", user))
    routine = tmp_path / "vfric.f"
    with pytest.raises(InputError, match="USER"):
        read_elastic_deck(path)
    routine.write_text(COULOMB.replace("props(2)", "props(2)*press**(-0.1)"))
    with pytest.raises(InputError, match="USER"):
        read_elastic_deck(path, routine)
    routine.write_text(COULOMB)
    assert read_elastic_deck(path, routine).friction == 0.9
    path.write_text(path.read_text().replace("0.9, 0.9", "0.9, 0.7"))
    with pytest.raises(InputError, match=r"static 0.9, kinetic 0.7"):
        read_elastic_deck(path, routine)


def test_what_a_quasi_static_run_has_no_use_for_is_listed(press):
    assert "inertia (the run is quasi-static)" in read_elastic_deck(press()).dropped


def test_integral_of_a_tabled_velocity_is_exact():
    """Trapezoids of a piecewise-linear table: up to 2 in 1 s, back to 0 in another."""
    velocity = Velocity(np.array([0.0, 1.0, 2.0]), np.array([0.0, 2.0, 0.0]))
    found = velocity.integral(np.array([0.0, 0.5, 1.0, 1.5, 2.0, 3.0]))
    np.testing.assert_allclose(found, [0.0, 0.25, 1.0, 1.75, 2.0, 2.0], rtol=1e-15)


def test_point_fixed_to_the_road_rests_in_the_frame_of_the_road():
    """The frame of a turning and travelling body leaves its own points where they were, to rounding (1e-11 mm)."""
    one = Velocity(np.zeros(1), np.array([3.0]))
    road = PlaneMotion(np.array([1.0, -300.0]), (one, still()), Velocity(np.zeros(1), np.array([-5.0])))
    time = np.linspace(0.0, 0.7, 9)
    point = np.array([4.0, 0.5])
    seen = road.seen_from(road.place(point, time), time)
    np.testing.assert_allclose(seen, np.broadcast_to(point, (9, 2)), atol=1e-11)


def test_dialect_is_deterministic_and_holds_no_comment_or_foreign_keyword(press):
    deck = read_elastic_deck(press(friction=0.9))
    first, second = dialect(deck), dialect(deck)
    assert first == second
    keywords = {line.split(",")[0] for line in first.splitlines() if line.startswith("*")}
    assert keywords == {
        "*HEADING", "*NODE", "*ELEMENT", "*ELSET", "*NSET", "*SURFACE", "*MATERIAL", "*HYPERELASTIC", "*SOLID SECTION",
        "*SURFACE INTERACTION", "*SURFACE BEHAVIOR", "*FRICTION", "*CONTACT PAIR", "*AMPLITUDE", "*BOUNDARY", "*STEP",
        "*STATIC", "*NODE PRINT", "*END STEP",
    }  # fmt: skip


def test_block_that_stays_clear_of_the_road_is_said(press):
    path = press()
    path.write_text(
        path.read_text()
        .replace("0., 0., 0., 1., 0., 0.", "0., -50., 0., 1., -50., 0.")
        .replace("900001, 0., 0., 0.", "900001, 0., -50., 0.")
    )
    with pytest.raises(InputError, match="clear of the road"):
        dialect(read_elastic_deck(path))
