"""VFRIC against the Python law it stands for."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tread_validate import deck
from tread_validate.deck.vfric import properties, source
from tread_validate.friction import (
    ENTRIES,
    FORMS,
    FrictionLaw,
    coulomb_law,
    huemer_law,
    kinetic_kernel,
    law,
    table_law,
)
from tread_validate.inp import read_deck
from tread_validate.study import Case

AREA = 1.25  # mm2
DT = 1.3e-6  # s
TABLE = table_law(
    np.array([5e4, 2e5, 6e5]),
    np.array([0.01, 0.1, 1.0, 5.0]),
    np.array([[0.9, 1.2, 1.1, 0.8], [0.8, 1.0, 0.95, 0.7], [0.7, 0.85, 0.8, 0.6]]),
    0.95,
)
DRAWN = {
    "coulomb": coulomb_law(0.73, 0.9),
    "huemer": huemer_law(0.8212, 0.0, 0.9, 10.0, 3.729, -4.495, 1.785),
    "table": TABLE,
}
EXAMPLES = [
    law(entry.model_validate({"kind": kind, "origin": "assumed", "source": "example"} | dict(entry.example)))
    for entry in ENTRIES
    if (kind := entry.model_fields["kind"].annotation.__args__[0]) in FORMS and "file" not in entry.example
]
LAWS = {friction.kind: friction for friction in EXAMPLES} | DRAWN  # the example of every law that is there
Load = Callable[[str], Any]


def _slide(routine: Any, friction: FrictionLaw, pressure: Any, speed: Any, stick: float = 1e6) -> Any:
    """Return mu as VFRIC gives it at pressures (Pa) and slip speeds (m/s): all points slide."""
    p, v = (np.ravel(x) for x in np.broadcast_arrays(pressure, speed))
    n = p.size
    normal = p * 1e-6 * AREA
    force = routine(
        np.array(properties(friction)),
        stick * np.ones(n),
        normal,
        np.column_stack([v * 1e3 * DT, np.zeros(n)]),
        np.full(n, AREA),
        np.arange(1, n + 1),
        DT,
    )
    np.testing.assert_array_equal(force[1:], 0.0)
    return -force[0] / normal


def test_compiled_choice_among_the_laws_knows_every_form() -> None:
    """A law reached by its code is the law itself, to the last bit; an unknown code is no number."""
    assert set(LAWS) == set(FORMS)
    assert len({form.code for form in FORMS.values()}) == len(FORMS)
    for friction in LAWS.values():
        for pressure, speed in ((4e5, 0.3), (1.0, 0.0), (1e7, 50.0)):
            assert kinetic_kernel(*friction.kernel_arguments, pressure, speed) == friction.kinetic(pressure, speed)
    assert np.isnan(kinetic_kernel(99, *LAWS["table"].kernel_arguments[1:], 4e5, 0.3))


@pytest.mark.parametrize("kind", LAWS)
def test_fortran_law_is_the_python_law_on_a_grid_of_pressure_and_slip_speed(kind: str, vfric: Load) -> None:
    """Same formula in double precision: 1e-12, some 5000 units of rounding, leaves room for powers and units alone.

    The grid runs beyond both floors of the Huemer form and both ends of the table.
    """
    pressure = np.geomspace(1e2, 1e7, 41)[:, None]
    speed = np.concatenate([[0.0], np.geomspace(1e-5, 1e2, 57)])[None, :]
    friction = LAWS[kind]
    expected = friction.kinetic(pressure, speed).ravel()
    np.testing.assert_allclose(_slide(vfric(kind), friction, pressure, speed), expected, rtol=1e-12)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    alpha=st.floats(0.1, 3.0),
    beta=st.floats(0.0, 1.0),
    n=st.floats(0.5, 1.0),
    m=st.floats(2.0, 20.0),
    a=st.floats(0.5, 4.0),
    c=st.floats(0.5, 4.0),
    share=st.floats(-0.95, 0.5),
    pressure=st.floats(1e2, 1e7),
    speed=st.floats(0.0, 50.0),
)
def test_fortran_huemer_law_is_the_python_law_for_any_constants(
    vfric: Load, alpha: float, beta: float, n: float, m: float, a: float, c: float, share: float, pressure: float,
    speed: float,
) -> None:  # fmt: skip
    """b = 2 share sqrt(ac) keeps the denominator positive. 1e-12 as above."""
    friction = huemer_law(alpha, beta, n, m, a, 2.0 * share * np.sqrt(a * c), c)
    expected = friction.kinetic(pressure, speed)
    np.testing.assert_allclose(_slide(vfric("huemer"), friction, pressure, speed), expected, rtol=1e-12)


@pytest.mark.parametrize("kind", LAWS)
def test_a_point_sticks_up_to_the_static_limit_and_slides_beyond_it(kind: str, vfric: Load) -> None:
    """Stick force mu_s N (1 -+ 1e-9): at the lower the whole stick force is returned exactly, at the upper mu_k N."""
    friction = LAWS[kind]
    normal = 0.4 * AREA
    limit = friction.static_coefficient * normal
    stick = limit * np.array([0.0, 0.3, 1.0 - 1e-9, 1.0 + 1e-9, 3.0])
    slip = np.tile([[2e3 * DT, 0.0]], (5, 1))
    force = vfric(kind)(
        np.array(properties(friction)), stick, np.full(5, normal), slip, np.full(5, AREA), np.arange(1, 6), DT
    )[0]
    kinetic = float(friction.kinetic(0.4e6, 2.0)) * normal
    np.testing.assert_array_equal(force[:3], -stick[:3])
    np.testing.assert_allclose(force[3:], -np.minimum(kinetic, stick[3:]), rtol=1e-12)


def test_friction_never_exceeds_the_force_that_stops_the_slip(vfric: Load) -> None:
    """A kinetic coefficient above the static one (0.9 against 2.0) is cut at the stick force, exactly."""
    friction = coulomb_law(2.0, 0.9)
    stick = np.array([0.95, 1.5, 1.99, 2.5]) * AREA
    force = vfric("coulomb")(
        np.array(properties(friction)), stick, np.full(4, AREA), np.full((4, 2), 1e-3), np.full(4, AREA),
        np.arange(1, 5), DT,
    )[0]  # fmt: skip
    np.testing.assert_allclose(force, -np.array([0.95, 1.5, 1.99, 2.0]) * AREA, rtol=1e-15)


def test_force_opposes_the_slip_whatever_its_direction(vfric: Load) -> None:
    """Local axis 1 is the slip direction, so that only the size of the slip counts: equal to the last bit."""
    friction = LAWS["huemer"]
    size = 3e3 * DT
    slip = size * np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    force = vfric("huemer")(
        np.array(properties(friction)), np.full(4, 9.0), np.full(4, 0.5), slip, np.full(4, AREA), np.arange(1, 5), DT
    )
    assert np.all(force[0] == force[0, 0])
    assert force[0, 0] < 0.0
    np.testing.assert_array_equal(force[1], 0.0)


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("directions", [1, 2])
def test_guards_keep_the_force_finite(kind: str, directions: int, vfric: Load) -> None:
    """No normal force: no friction. No time increment or no slip: the law at its slowest. No area: at its lightest."""
    friction = LAWS[kind]
    props = np.array(properties(friction))
    one, slip = np.ones(1), np.array([[1e-3, 0.0]])
    first = np.array([1])
    rest = {"friction_directions": directions}
    none = vfric(kind)(props, 5 * one, 0 * one, slip, AREA * one, first, DT, **rest)
    pulled = vfric(kind)(props, 5 * one, -one, slip, AREA * one, first, DT, **rest)
    unforced = vfric(kind)(props, 0 * one, one, slip, AREA * one, first, DT, **rest)
    for force in (none, pulled, unforced):
        np.testing.assert_array_equal(force, 0.0)
    slow = float(friction.kinetic(1e6 / AREA, 0.0))
    light = float(friction.kinetic(0.0, 1.0))
    for expected, arguments in (
        (slow, (slip, AREA * one, first, 0.0)),
        (slow, (0 * slip, AREA * one, first, DT)),
        (light, (np.array([[1e3 * DT, 0.0]]), 0 * one, first, DT)),
    ):
        force = vfric(kind)(props, 9 * one, one, *arguments, **rest)
        np.testing.assert_allclose(force[0, 0], -expected, rtol=1e-12)


def test_each_contact_point_takes_the_area_of_its_own_slave_node(vfric: Load) -> None:
    """jConSlvid numbers the slave nodes: three points on nodes 4, 1, 3 of four."""
    friction = LAWS["huemer"]
    area = np.array([0.5, 9.9, 2.0, 1.0])
    slave = np.array([4, 1, 3])
    force = vfric("huemer")(
        np.array(properties(friction)), np.full(3, 9.0), np.full(3, 0.4), np.full((3, 2), [1e3 * DT, 0.0]), area,
        slave, DT,
    )[0]  # fmt: skip
    expected = friction.kinetic(0.4e6 / area[slave - 1], 1.0) * 0.4
    np.testing.assert_allclose(force, -expected, rtol=1e-12)


@pytest.mark.parametrize("kind", LAWS)
def test_source_is_fixed_form_of_72_columns_in_plain_ascii(kind: str) -> None:
    lines = source(kind).splitlines()
    assert max(map(len, lines)) <= 72
    assert source(kind).isascii()
    assert "\t" not in source(kind)


def test_properties_in_the_deck_are_those_of_the_law(
    rig_case: Case, coarse: Callable[[Case], Case], tmp_path: Path
) -> None:
    """Written with 13 digits, read back as numbers: 1e-12. The last: half of a layer of 3.2 mm of 1e-9 t/mm3."""
    case = coarse(rig_case)
    deck.write(case, tmp_path)
    block = next(read_deck(tmp_path / f"{case.case_id}.inp").named("FRICTION"))
    numbers = [float(text) for line in block.data for text in line.fields]
    assert block.parameters["USER"] == "FRIC"
    assert int(block.value("PROPERTIES")) == len(numbers)
    np.testing.assert_allclose(numbers, properties(law(case.friction, case.root), 1.6e-9), rtol=1e-12)


MASS_PER_AREA = 4e-10  # t/mm2: half of a layer of 0.8 mm


@pytest.mark.parametrize("kind", LAWS)
def test_a_sliding_point_feels_the_law_at_the_speed_that_friction_leaves_it(kind: str, vfric: Load) -> None:
    """F = mu(p, v) N and v = (stick - F) dt/m hold together to 1e-9 of N, or F = stick and the point is at rest.

    Stick forces from the static limit to a hundred times as much, and a point that slipped before below that limit.
    """
    friction = LAWS[kind]
    normal = 0.4 * AREA
    stick = friction.static_coefficient * normal * np.concatenate([[0.2, 0.5, 0.9], np.geomspace(1.01, 100.0, 40)])
    state = np.ones((stick.size, 1))
    nodes = np.arange(1, stick.size + 1)
    force = -vfric(kind)(
        np.array(properties(friction, MASS_PER_AREA)), stick, np.full(stick.size, normal),
        np.tile([[5e3 * DT, 0.0]], (stick.size, 1)), np.full(stick.size, AREA), nodes, DT, state=state,
    )[0]  # fmt: skip
    speed = (stick - force) * DT / (MASS_PER_AREA * AREA) * 1e-3
    law_force = np.array([float(friction.kinetic(0.4e6, v)) for v in speed]) * normal
    stopped = force == stick
    np.testing.assert_array_equal(state[:, 0], np.where(stopped, 0.0, 1.0))
    assert (law_force[stopped] >= stick[stopped]).all()
    np.testing.assert_allclose(force[~stopped], law_force[~stopped], atol=1e-9 * normal)


def test_one_point_pulled_by_a_spring_over_a_moving_road_slips_by_the_rule(vfric: Load) -> None:
    """A massless pull that grows from 0: it holds to mu_s N, drops to mu_k N, and slips until it can be stopped.

    mu_s 0.9, mu_k 0.5, N = 1 N: a stick force of 0.9 holds; 0.91 slips at 0.5; then 0.8, below the static limit, still
    slips at 0.5, for the point has not come to rest; 0.4 stops it; and 0.8 holds again.
    """
    friction = coulomb_law(0.5, 0.9)
    props = np.array(properties(friction, MASS_PER_AREA))
    state = np.zeros((1, 1))
    found = []
    for stick in (0.9, 0.91, 0.8, 0.4, 0.8):
        force = vfric("coulomb")(
            props, np.array([stick]), np.ones(1), np.array([[DT, 0.0]]), np.array([AREA]), np.array([1]), DT,
            state=state,
        )  # fmt: skip
        found.append((-force[0, 0], state[0, 0]))
    assert found == [(0.9, 0.0), (0.5, 1.0), (0.5, 1.0), (0.4, 0.0), (0.8, 0.0)]


def test_a_point_that_left_the_road_is_at_rest_when_it_comes_back(vfric: Load) -> None:
    """Of three slipping nodes only the second touches: the others' state is 0 afterwards."""
    state = np.ones((3, 1))
    vfric("coulomb")(
        np.array(properties(coulomb_law(0.5, 0.9), MASS_PER_AREA)), np.array([2.0]), np.ones(1),
        np.array([[DT, 0.0]]), np.full(3, AREA), np.array([2]), DT, state=state,
    )  # fmt: skip
    np.testing.assert_array_equal(state[:, 0], [0.0, 1.0, 0.0])
