"""A small deck, and what ABAQUS might return for it."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

STAND_IN = Path(__file__).parent / "stand_in"

DECK = """\
*HEADING
belt-22c-0p2mm-10mps
*NODE
1, 0., 0., 0.
2, 25., 0., 0.
3, 25., 0., 20.
4, 0., 0., 20.
5, 0., 8., 0.
6, 25., 8., 0.
7, 25., 8., 20.
8, 0., 8., 20.
900001, 0., 0., 0.
*ELEMENT, TYPE=C3D8R, ELSET=BLOCK
1, 1, 4, 3, 2, 5, 8, 7, 6
*MATERIAL, NAME=COMPOUND
*ELASTIC, MODULI=INSTANTANEOUS
36.7, 0.47
*STEP, NAME=approach, NLGEOM=YES
*DYNAMIC, EXPLICIT
, 0.002
*END STEP
*STEP, NAME=pass, NLGEOM=YES
*DYNAMIC, EXPLICIT
, 0.02
*END STEP
"""
CASE = "belt-22c-0p2mm-10mps"
DURATION = 0.02
PEAK = 200.0


def forces(time: float) -> tuple[float, float]:
    """Normal and tangential force (our signs): half a sine over the first three quarters of the pass."""
    end = 0.75 * DURATION
    if not 0.0 < time < end:
        return 0.0, 0.0
    return PEAK * math.sin(math.pi * time / end), 60.0 * math.sin(2 * math.pi * time / end)


def times(samples: int = 101) -> list[float]:
    return [DURATION * i / (samples - 1) for i in range(samples)]


def odb(sign: float = 1.0, pair: str = "ASSEMBLY_FACE/ASSEMBLY_ROAD") -> dict[str, Any]:
    """The object model of a run; `sign` -1: forces on the road."""
    at = times()
    rows = {
        "CFN1": [[t, 0.0] for t in at],
        "CFN2": [[t, sign * forces(t)[0]] for t in at],
        "CFN3": [[t, 0.0] for t in at],
        "CFS1": [[t, -sign * forces(t)[1]] for t in at],
        "CFS2": [[t, 0.0] for t in at],
        "CFS3": [[t, 0.0] for t in at],
    }
    road = {
        "RF1": [[t, -forces(t)[1]] for t in at],
        "RF2": [[t, forces(t)[0]] for t in at],
        "U1": [[t, 0.0] for t in at],
    }
    frames = [
        {
            "time": DURATION * i / 10,
            "fields": {
                "CPRESS   " + pair: {"1": 0.5, "2": 0.5, "3": 0.5, "4": 0.0},
                "FSLIPR1  " + pair: {"1": 0.0, "2": 30.0 if i > 5 else 0.0, "3": 0.0, "4": 100.0},
                "FSLIPR2  " + pair: {"1": 0.0, "2": 0.0, "3": 0.0, "4": 0.0},
            },
        }
        for i in range(11)
    ]
    return {
        "version": "Abaqus/Explicit 6.14-1",
        "steps": {
            "approach": {"duration": 0.002, "regions": {}},
            "pass": {
                "duration": DURATION,
                "regions": {
                    "NodeSet ASSEMBLY.FACE": {"outputs": {f"{key}     {pair}": value for key, value in rows.items()}},
                    "Node ASSEMBLY.900001": {"description": "Node 900001 in NSET ROAD_REF", "outputs": road},
                },
                "frames": frames,
            },
        },
    }


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "deck" / f"{CASE}.inp"
    path.parent.mkdir()
    path.write_text(DECK)
    (path.parent / "vfric.f").write_text("      end\n")
    return path


@pytest.fixture
def user(deck: Path) -> Path:
    return deck.parent / "vfric.f"


@pytest.fixture
def work(tmp_path: Path) -> Path:
    """A working folder that tells the test double to succeed."""
    folder = tmp_path / "job"
    folder.mkdir()
    (folder / "stand_in.json").write_text(json.dumps({"odb": odb()}))
    return folder


@pytest.fixture
def odb_data() -> dict[str, Any]:
    return odb()


@pytest.fixture
def curve() -> list[tuple[float, float, float]]:
    """Rows of time, normal and tangential force."""
    return [(t, *forces(t)) for t in times()]
