"""Small decks of the elastic-Coulomb subset, written by hand."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest


def block_text(nx: int, ny: int, nz: int) -> str:
    """Nodes, elements and sets of a 25 x 8 x 20 mm block whose face stands 0.02 mm above the road."""
    xs, ys, zs = np.linspace(-12.5, 12.5, nx + 1), np.linspace(0.02, 8.02, ny + 1), np.linspace(-10, 10, nz + 1)
    number = {}
    lines = ["*NODE, NSET=BLOCK_NODES"]
    for j, y in enumerate(ys):
        for i, x in enumerate(xs):
            for k, z in enumerate(zs):
                number[i, j, k] = len(number) + 1
                lines.append(f"{number[i, j, k]}, {x:.9g}, {y:.9g}, {z:.9g}")
    lines.append("*ELEMENT, TYPE=C3D8R, ELSET=BLOCK")
    face, count = [], 0
    for j in range(ny):
        for i in range(nx):
            for k in range(nz):
                count += 1
                corners = [(0, 0), (0, 1), (1, 1), (1, 0)]
                low = [number[i + a, j, k + b] for a, b in corners]
                high = [number[i + a, j + 1, k + b] for a, b in corners]
                lines.append(", ".join(str(n) for n in [count, *low, *high]))
                if j == 0:
                    face.append(count)
    lines += ["*ELSET, ELSET=FACE_ELEMENTS, GENERATE", f"{face[0]}, {face[-1]}, 1"]
    top = [number[i, ny, k] for i in range(nx + 1) for k in range(nz + 1)]
    lines.append("*NSET, NSET=MOUNT")
    lines += [", ".join(str(n) for n in top[i : i + 16]) for i in range(0, len(top), 16)]
    return "\n".join(lines)


PRESS = """\
*HEADING
press
{block}
*SURFACE, TYPE=ELEMENT, NAME=FACE
FACE_ELEMENTS, S1
*SOLID SECTION, ELSET=BLOCK, MATERIAL=COMPOUND
,
*MATERIAL, NAME=COMPOUND
*DENSITY
1e-09,
*ELASTIC
16., 0.47
*NODE, NSET=ROAD_REF
900001, 0., 0., 0.
*SURFACE, TYPE=CYLINDER, NAME=ROAD
0., 0., 0., 1., 0., 0.
0., 0., -1.
START, -50., 0.
LINE, 50., 0.
*RIGID BODY, REF NODE=ROAD_REF, ANALYTICAL SURFACE=ROAD
*AMPLITUDE, NAME=DOWN, TIME=TOTAL TIME
0., -20., 0.002, -20., 0.003, 0., 0.004, 0.
0.005, 60., 0.006, 60.
*SURFACE INTERACTION, NAME=TREAD_ROAD
*FRICTION
{friction},
*BOUNDARY
ROAD_REF, 1, 6
*STEP, NAME=approach, NLGEOM=YES
*DYNAMIC, EXPLICIT
, 0.001
*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=DOWN
MOUNT, 2, 2, {speed}
*CONTACT PAIR, INTERACTION=TREAD_ROAD, MECHANICAL CONSTRAINT=KINEMATIC, CPSET=PAIR
FACE, ROAD
*END STEP
*STEP, NAME=pass, NLGEOM=YES
*DYNAMIC, EXPLICIT
, 0.005
*END STEP
"""


@pytest.fixture
def press(tmp_path: Path) -> Callable[..., Path]:
    """Write the press: down by (0.02 + depth) mm until 3 ms, held until 4 ms, up again."""

    def write(friction: float = 0.0, depth: float = 0.02, mesh: tuple[int, int, int] = (10, 4, 8)) -> Path:
        # before the pass the mount falls 20 mm/s * 1 ms, in it 20 * 1.5 ms: 50 um for a speed of 1
        text = PRESS.format(block=block_text(*mesh), friction=friction, speed=(0.02 + depth) / 0.05)
        path = tmp_path / "press.inp"
        path.write_text(text)
        return path

    return write
