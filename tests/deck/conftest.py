"""Decks, and VFRIC compiled and called through the arguments that ABAQUS/Explicit gives it."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate.deck.vfric import source
from tread_validate.study import Case, DeckSettings, load_study

ROOT = Path(__file__).resolve().parents[2]
CREEP = 0.0029
INCLUDE = "c     in place of the file that comes with ABAQUS, double precision\n      implicit real*8 (a-h,o-z)\n"
WARNINGS = ["-Wall", "-Wextra", "-Werror", "-std=legacy", "-ffixed-form", "-ffixed-line-length-72"]


@pytest.fixture(scope="session")
def cases() -> tuple[Case, ...]:
    """Every case of the paper's study; free rolling ones at a creep ratio that stands for the searched one."""
    found = load_study(ROOT / "config" / "study.yaml").cases()
    return tuple(case if case.creep_ratio is not None else case.with_creep(CREEP) for case in found)


@pytest.fixture(scope="session")
def rig_case(cases: tuple[Case, ...]) -> Case:
    return next(case for case in cases if case.case_id == "rig-rectangle-22c-0p2mm-300rpm")


@pytest.fixture(scope="session")
def belt_case(cases: tuple[Case, ...]) -> Case:
    return next(case for case in cases if case.path_name == "simplified" and not case.free_rolling)


@pytest.fixture(scope="session")
def trace_case(cases: tuple[Case, ...]) -> Case:
    return next(case for case in cases if case.path_name == "mid_top" and not case.free_rolling)


@pytest.fixture(scope="session")
def coarse() -> Callable[[Case], Case]:
    """Give a case a mesh of 5 x 4 x 2 elements, so that its deck is short."""
    settings = DeckSettings(element_size_mm=5.0, layers=2)
    return lambda case: replace(case, deck=settings)


class Vfric:
    """A compiled VFRIC."""

    def __init__(self, library: Path) -> None:
        self._routine = ctypes.CDLL(str(library)).vfric_

    def __call__(
        self,
        properties: NDArray[np.float64],
        stick_force: NDArray[np.float64],
        normal_force: NDArray[np.float64],
        slip: NDArray[np.float64],
        area: NDArray[np.float64],
        slave: NDArray[np.int32],
        time_increment: float,
        friction_directions: int = 2,
        state: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """Return fTangential (directions, contacts); `slip` is (contacts, 2), `slave` numbers `area` from 1.

        `state` (slaves, 1) is 1 where a slave node slips; it is written.
        """
        contacts, slaves = stick_force.size, area.size
        tangential = np.full((contacts, friction_directions), np.nan)
        integer, real = ctypes.c_int, ctypes.c_double

        def i(value: int) -> object:
            return ctypes.byref(integer(value))

        def r(value: float) -> object:
            return ctypes.byref(real(value))

        def a(values: NDArray[np.float64] | NDArray[np.int32]) -> object:
            return values.ctypes.data_as(ctypes.c_void_p)

        directions = 3
        slip3 = np.zeros((contacts, directions))
        slip3[:, : slip.shape[1]] = slip
        state = np.zeros((slaves, 1)) if state is None else state
        read_only = [np.ascontiguousarray(v, dtype=np.float64) for v in (properties, stick_force, normal_force, area)]
        copies = [v.copy() for v in read_only]
        slave = np.ascontiguousarray(slave, dtype=np.int32)
        spare, ispare = np.zeros(64 * max(contacts, slaves)), np.zeros(64 * contacts, dtype=np.int32)
        name = ctypes.create_string_buffer(b"FACE".ljust(80))
        self._routine(
            a(tangential), a(state), i(1), i(1), i(contacts), i(1), i(slaves), i(1), i(friction_directions),
            i(directions), i(1), i(properties.size), i(1), i(1), i(1), a(ispare), a(ispare), a(slave), a(ispare),
            r(0.1), r(0.2), r(time_increment), name, name, name, i(0), a(slip3), a(read_only[1]), a(spare),
            a(read_only[2]), r(0.0), a(spare), a(spare), a(spare), a(spare), a(spare), a(read_only[0]),
            a(read_only[3]), a(spare), a(spare), a(spare), a(spare),
            ctypes.c_size_t(80), ctypes.c_size_t(80), ctypes.c_size_t(80),
        )  # fmt: skip
        assert set(np.unique(state)) <= {0.0, 1.0}
        for before, after in zip(copies, read_only, strict=True):
            np.testing.assert_array_equal(before, after)
        return tangential.T


@pytest.fixture(scope="session")
def vfric(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Vfric]:
    """Compile VFRIC of a kind of law, warnings as errors, and load it."""
    compiled: dict[str, Vfric] = {}

    def load(kind: str) -> Vfric:
        if kind not in compiled:
            folder = tmp_path_factory.mktemp(f"vfric_{kind}")
            (folder / "vfric.f").write_text(source(kind))
            (folder / "vaba_param.inc").write_text(INCLUDE)
            library = folder / "vfric.so"
            command = ["gfortran", *WARNINGS, "-O2", "-fPIC", "-shared", "-o", library.name, "vfric.f"]
            subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=60)
            compiled[kind] = Vfric(library)
        return compiled[kind]

    return load
