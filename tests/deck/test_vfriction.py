"""VFRICTION, the routine of general contact, compiled and called through the arguments of ABAQUS/Explicit."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate.deck.vfric import GENERAL, properties, source
from tread_validate.friction import FORMS, coulomb_law, huemer_law

Array = NDArray[np.float64]
INCLUDE = "c     in place of the file that comes with ABAQUS, double precision\n      implicit real*8 (a-h,o-z)\n"
WARNINGS = ["-Wall", "-Wextra", "-Werror", "-std=legacy", "-ffixed-form", "-ffixed-line-length-72"]
DT = 1.3e-6
HUEMER = huemer_law(0.8212, 0.0, 0.9, 10.0, 3.729, -4.495, 1.785)


class Vfriction:
    """A compiled VFRICTION against an analytical main surface: nBlockAnal 1, one node a point."""

    def __init__(self, library: Path) -> None:
        self._routine = ctypes.CDLL(str(library)).vfriction_

    def __call__(
        self, props: Array, stick: Array, normal: Array, slip: Array, area: Array, dt: float = DT,
        increment: int = 7, state: Array | None = None, directions: int = 2,
    ) -> Array:  # fmt: skip
        """Return fTangential (directions, points); `slip` is (points, 3), `state` (points, 2) is written."""
        points = stick.size
        tangential = np.full((points, directions), np.nan)
        state = np.zeros((points, 2)) if state is None else state
        flags, data = np.array([1, increment, 0], dtype=np.int32), np.array([0.1, 0.2, dt, 0.0])
        read_only = [np.ascontiguousarray(v, dtype=np.float64) for v in (props, slip, stick, normal, area, data)]
        copies = [v.copy() for v in read_only]
        spare, ispare = np.zeros(64 * points), np.zeros(64 * points, dtype=np.int32)
        name = ctypes.create_string_buffer(b"FACE".ljust(80))

        def i(value: int) -> object:
            return ctypes.byref(ctypes.c_int(value))

        def a(values: NDArray[Any]) -> object:
            return values.ctypes.data_as(ctypes.c_void_p)

        given = dict(zip(("props", "slip", "stick", "normal", "area", "data"), read_only, strict=True))
        self._routine(
            a(tangential), a(state), i(points), i(1), i(1), i(1), i(1), i(1), i(directions), i(3), i(2),
            i(props.size), i(1), i(1), a(flags), a(given["data"]), name, name, name, a(ispare), a(ispare),
            a(given["props"]), a(given["slip"]), a(given["stick"]), a(spare), a(given["normal"]), a(given["area"]),
            a(spare), a(spare), a(spare), a(spare), a(spare), a(spare), a(spare), a(spare), a(spare), a(spare),
            a(spare), a(spare), ctypes.c_size_t(80), ctypes.c_size_t(80), ctypes.c_size_t(80),
        )  # fmt: skip
        for before, after in zip(copies, read_only, strict=True):
            np.testing.assert_array_equal(before, after)
        return tangential.T


@pytest.fixture(scope="module")
def vfriction(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Vfriction]:
    compiled: dict[str, Vfriction] = {}

    def load(kind: str) -> Vfriction:
        if kind not in compiled:
            folder = tmp_path_factory.mktemp(f"vfriction_{kind}")
            (folder / "vfriction.f").write_text(source(kind, GENERAL))
            (folder / "vaba_param.inc").write_text(INCLUDE)
            command = ["gfortran", *WARNINGS, "-O2", "-fPIC", "-shared", "-o", "v.so", "vfriction.f"]
            subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=60)
            compiled[kind] = Vfriction(folder / "v.so")
        return compiled[kind]

    return load


def test_sliding_points_feel_the_python_law_on_a_grid_of_pressure_and_slip_speed(vfriction: Any) -> None:
    """Without a mass the law is taken at the speed of the increment: 1e-12, as for VFRIC."""
    p, v = (g.ravel() for g in np.meshgrid(np.geomspace(1e2, 1e7, 21), np.geomspace(1e-5, 1e2, 29), indexing="ij"))
    normal = p * 1e-6 * 1.25
    slip = np.column_stack([0.6 * v * 1e3 * DT, np.zeros(v.size), -0.8 * v * 1e3 * DT])
    force = vfriction("huemer")(np.array(properties(HUEMER)), np.full(p.size, 1e6), normal, slip, np.full(p.size, 1.25))
    np.testing.assert_allclose(-force[0] / normal, HUEMER.kinetic(p, v), rtol=1e-12)
    np.testing.assert_array_equal(force[1], 0.0)


@pytest.mark.parametrize("kind", sorted(FORMS))
def test_source_is_fixed_form_of_72_columns_and_compiles_without_a_warning(kind: str, vfriction: Any) -> None:
    assert max(map(len, source(kind, GENERAL).splitlines())) <= 72
    assert source(kind, GENERAL).isascii()
    vfriction(kind)


def test_both_routines_give_one_force(vfriction: Any, vfric: Any) -> None:
    """Pairs and general contact: bit for bit, sticking, slipping, with and without the face's mass."""
    random = np.random.default_rng(3)
    n = 200
    normal, area = random.uniform(0.0, 1.0, n), random.uniform(0.5, 2.0, n)
    stick = random.uniform(0.0, 2.0, n) * normal
    slip = np.column_stack([random.uniform(-1.0, 1.0, n) * 3e3 * DT, np.zeros((n, 2))])
    for mass in (0.0, 5e-10):
        props = np.array(properties(HUEMER, mass))
        general = vfriction("huemer")(props, stick, normal, slip, area)
        pairs = vfric("huemer")(props, stick, normal, slip[:, :2], area, np.arange(1, n + 1), DT)
        np.testing.assert_array_equal(general, pairs)


def test_a_point_that_slips_goes_on_slipping_until_friction_can_stop_it_and_rests_after_a_gap(vfriction: Any) -> None:
    """mu 0.5, mu_s 0.9, N 1: a stick force of 0.7 is held from rest, not while slipping; 0.4 ends the slip."""
    props = np.array(properties(coulomb_law(0.5, 0.9)))
    one, slip, state = np.ones(1), np.array([[1e-3, 0.0, 0.0]]), np.zeros((1, 2))
    forces = []
    for increment, stick in ((2, 0.7), (3, 1.5), (4, 0.7), (5, 0.4), (6, 0.7), (7, 1.5), (9, 0.7)):
        forces.append(-vfriction("coulomb")(props, stick * one, one, slip, one, DT, increment, state)[0, 0])
    assert forces == [0.7, 0.5, 0.5, 0.4, 0.7, 0.5, 0.7]


@pytest.mark.parametrize("directions", [1, 2])
def test_guards_keep_the_force_finite(directions: int, vfriction: Any) -> None:
    """No normal force, no stick force: nothing. No time, no slip, no area: the law at its slowest or lightest."""
    props = np.array(properties(HUEMER))
    one, slip = np.ones(1), np.array([[1e-3, 0.0, 0.0]])
    routine, rest = vfriction("huemer"), {"directions": directions}
    np.testing.assert_array_equal(routine(props, 5 * one, 0 * one, slip, one, **rest), 0.0)
    np.testing.assert_array_equal(routine(props, 0 * one, one, slip, one, **rest), 0.0)
    for arguments in ((slip, one, 0.0), (0 * slip, one, DT), (slip, 0 * one, DT)):
        force = routine(props, 9 * one, one, *arguments, **rest)
        assert np.isfinite(force).all()
        assert force[0, 0] < 0.0
