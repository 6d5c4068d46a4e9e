"""CalculiX reads the mesh, the sets and the surface of a deck and presses the block."""

from __future__ import annotations

import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate import deck
from tread_validate.study import Case, DeckSettings

STEP = """*MATERIAL, NAME=COMPOUND
*ELASTIC
16., 0.47
*SOLID SECTION, ELSET=BLOCK, MATERIAL=COMPOUND
*BOUNDARY
MOUNT, 1, 3
{sides}*STEP
*STATIC
*BOUNDARY
FACE_NODES, 2, 2, 0.2
*NODE PRINT, NSET=FACE_NODES, TOTALS=ONLY
RF
*END STEP
"""


@pytest.mark.parametrize(
    ("sides", "force"), [("", 261.7), ("FACE_NODES, 1, 1\nFACE_NODES, 3, 3\n", 369.7)], ids=["sliding", "bonded"]
)
def test_calculix_presses_the_deck_mesh_to_the_known_force(
    sides: str, force: float, belt_case: Case, tmp_path: Path
) -> None:
    """25 x 20 x 8 mm, 20 x 16 x 8 C3D8R, E = 16 MPa, nu = 0.47, mount bonded, face pressed by 0.2 mm, linear.

    Known: 261.7 N with a face free to slide and 369.7 N with a bonded one (E A d / h = 200 N), from another mesher's
    block of the same elements; 0.1 % covers its last printed digit. The deck's own nodes, elements and sets are used
    as they stand; turning of the block by its starting slope is taken out of the nodes first.
    """
    if shutil.which("ccx") is None:
        pytest.fail("CalculiX (ccx) is not installed: apt-get install calculix-ccx")
    settings = DeckSettings(element_size_mm=1.25, layers=8, refinement=1.0, symmetry="full")
    built = deck.build(replace(belt_case, deck=settings), single_file=True)
    text = built.input_text
    section = re.search(r"\*ELEMENT.*?(?=\*SURFACE)", text, re.DOTALL)
    assert section is not None
    nodes = "\n".join(f"{i}, {x:.12g}, {y:.12g}, {z:.12g}" for i, (x, y, z) in enumerate(_upright(built.points), 1))
    (tmp_path / "press.inp").write_text(f"*NODE, NSET=BLOCK_NODES\n{nodes}\n{section[0]}" + STEP.format(sides=sides))
    subprocess.run(["ccx", "press"], cwd=tmp_path, check=True, capture_output=True, timeout=120)
    totals = (tmp_path / "press.dat").read_text().split()
    assert abs(float(totals[-2])) == pytest.approx(force, rel=1e-3)


def _upright(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn the straight block so that its face lies along x: the face's first and last rows give the slope."""
    face = points[: points.shape[0] // 9]
    along = face[np.argmin(face[:, 0])] - face[np.argmax(face[:, 0])]
    c, s = -along[:2] / np.hypot(*along[:2])
    turned = points.copy()
    turned[:, 0], turned[:, 1] = c * points[:, 0] + s * points[:, 1], -s * points[:, 0] + c * points[:, 1]
    return turned
