"""What the engine refuses: every keyword, parameter, set or value outside its subset, with file and line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tread_validate.errors import InputError
from tread_validate.fe.model import read_model

GOOD = """*HEADING
one brick on a plane
*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*NODE, NSET=REF
9, 0., 0., 0.
*ELEMENT, TYPE=C3D8R, ELSET=E
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=TOP, GENERATE
5, 8, 1
*SURFACE, TYPE=ELEMENT, NAME=FACE
E, S1
*SOLID SECTION, ELSET=E, MATERIAL=M
,
*MATERIAL, NAME=M
*DENSITY
1.E-9,
*ELASTIC, MODULI=INSTANTANEOUS
30., 0.47
*VISCOELASTIC, TIME=PRONY
0.5, 0.5, 1e-3
*SURFACE, TYPE=CYLINDER, NAME=ROAD
0., 0., 0., 1., 0., 0.
0., 1., 0.
START, -10., 0.
LINE, 10., 0.
*RIGID BODY, REF NODE=9, ANALYTICAL SURFACE=ROAD
*SURFACE INTERACTION, NAME=TOUCH
*FRICTION
0.5,
*AMPLITUDE, NAME=A, TIME=TOTAL TIME
0., 0., 1e-5, 1.
*BOUNDARY
REF, 1, 6
TOP, 1, 2
*STEP, NAME=only, NLGEOM=YES
*DYNAMIC, EXPLICIT
, 2e-5
*BOUNDARY, AMPLITUDE=A
TOP, 3, 3, -0.01
*CONTACT PAIR, INTERACTION=TOUCH, MECHANICAL CONSTRAINT=KINEMATIC, CPSET=C
FACE, ROAD
*OUTPUT, HISTORY, TIME INTERVAL=1e-6
*CONTACT OUTPUT, CPSET=C
CFN, CFS
*END STEP
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    return path


def test_good_deck_is_read(tmp_path: Path) -> None:
    """The deck that the cases below spoil."""
    model = read_model(written(tmp_path, GOOD))
    assert model.steps[0].period == 2e-5
    assert model.sections[0].material.prony.tolist() == [[0.5, 0.5, 1e-3]]
    assert model.mesh.faces["FACE"].tolist() == [[0, 1, 2, 3]]
    assert not model.needs_user_routine


ROAD = GOOD[GOOD.index("*SURFACE, TYPE=CYLINDER") : GOOD.index("*SURFACE INTERACTION")]
BLOCK = (
    GOOD[GOOD.index("*NODE, NSET=ALL") : GOOD.index("*NODE, NSET=REF")]
    + (GOOD[GOOD.index("*ELEMENT") : GOOD.index("*MATERIAL")])
)


def test_a_deck_of_parts_is_the_model_of_the_flat_deck(tmp_path: Path) -> None:
    """Block and road as part instances, lowered by 4 and turned twice by half a turn: the same nodes, faces, road."""
    parts = f"*PART, NAME=BLOCK\n{BLOCK}*END PART\n*PART, NAME=ROAD\n*NODE, NSET=REF\n9, 0., 0., 4.\n{ROAD}*END PART\n"
    parts = parts.replace("0., 0., 0., 1., 0., 0.\n0., 1., 0.", "0., 0., 4., 1., 0., 4.\n0., 1., 4.")
    placed = "*INSTANCE, NAME=B, PART=BLOCK\n*END INSTANCE\n*INSTANCE, NAME=R, PART=ROAD\n0., 0., -4.\n*END INSTANCE\n"
    rest = GOOD[GOOD.index("*MATERIAL") :].replace(ROAD, "")
    for old, new in (("REF,", "R.REF,"), ("TOP,", "B.TOP,"), ("FACE, ROAD", "B.FACE, R.ROAD")):
        rest = rest.replace(old, new)
    text = f"*HEADING\nparts\n{parts}*ASSEMBLY, NAME=A\n{placed}*END ASSEMBLY\n{rest}"
    (flat, built) = (read_model(written(tmp_path, one)) for one in (GOOD, text))
    assert built.mesh.coordinates.tolist() == flat.mesh.coordinates.tolist()
    assert built.mesh.connectivity.tolist() == flat.mesh.connectivity.tolist()
    assert built.mesh.faces["B.FACE"].tolist() == flat.mesh.faces["FACE"].tolist()
    road, same = built.mesh.rigid_surfaces["R.ROAD"], flat.mesh.rigid_surfaces["ROAD"]
    assert road.origin.tolist() == same.origin.tolist()
    assert road.frame.tolist() == same.frame.tolist()
    assert [sorted(step.conditions) for step in built.steps] == [sorted(step.conditions) for step in flat.steps]


def test_a_rotating_start_is_a_turn_about_an_axis_and_a_shift(tmp_path: Path) -> None:
    """100 rad/s about the line x = 1, y = 0 along z and 5 mm/s along x: v = (5 - 100 y, 100 (x - 1), 0)."""
    start = "*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\nALL, 100., 5., 0., 0.\n1., 0., 0., 1., 0., 7.\n"
    model = read_model(written(tmp_path, GOOD.replace("*STEP, NAME=only", start + "*STEP, NAME=only")))
    x, y = model.mesh.coordinates[:8, 0], model.mesh.coordinates[:8, 1]
    assert model.velocity[:8, 0].tolist() == (5.0 - 100.0 * y).tolist()
    assert model.velocity[:8, 1].tolist() == (100.0 * (x - 1.0)).tolist()


def test_an_amplitude_may_be_scaled_in_time_and_value(tmp_path: Path) -> None:
    text = GOOD.replace("NAME=A, TIME=TOTAL TIME", "NAME=A, TIME=TOTAL TIME, SCALEX=0.5, SCALEY=3.")
    amplitude = read_model(written(tmp_path, text)).steps[0].conditions[(4, 3)].amplitude
    assert amplitude is not None
    assert amplitude.times.tolist() == [0.0, 5e-6]
    assert amplitude.values.tolist() == [0.0, 3.0]


def test_op_new_takes_away_what_stood_before_its_step_once(tmp_path: Path) -> None:
    """Two blocks with OP=NEW in one step add up: the second does not take away the first."""
    text = GOOD.replace("*BOUNDARY, AMPLITUDE=A\n", "*BOUNDARY, OP=NEW\nREF, 1, 6\n*BOUNDARY, OP=NEW, AMPLITUDE=A\n")
    conditions = read_model(written(tmp_path, text)).steps[0].conditions
    assert sorted(conditions) == [(node, 3) for node in (4, 5, 6, 7)] + [(8, dof) for dof in range(1, 7)]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("*DENSITY", "*PLASTIC\n1., 0.\n*DENSITY", r"deck\.inp:\d+: \*PLASTIC: .*outside the engine's subset"),
        ("TYPE=C3D8R", "TYPE=C3D20R", r"deck\.inp:14: \*ELEMENT, TYPE: got C3D20R"),
        ("*DENSITY", "*DENSITY, DEPENDENCIES=1", r"\*DENSITY: got parameter DEPENDENCIES"),
        ("*FRICTION\n0.5,", "*FRICTION, TAUMAX=1.\n0.5,", r"\*FRICTION: got parameter TAUMAX"),
        ("*FRICTION\n0.5,", "*FRICTION, USER=COEFFICIENT", r"\*FRICTION, USER: got COEFFICIENT"),
        ("*FRICTION\n0.5,", "*FRICTION, USER=FRIC, PROPERTIES=2\n0.5,", "PROPERTIES=2"),
        ("*FRICTION\n0.5,", "*FRICTION\n0.5, 1.", "one constant coefficient"),
        ("MECHANICAL CONSTRAINT=KINEMATIC", "MECHANICAL CONSTRAINT=PENALTY", "got PENALTY, expected KINEMATIC"),
        ("*MATERIAL", "*SECTION CONTROLS, NAME=C, HOURGLASS=ENHANCED\n*MATERIAL", "got ENHANCED"),
        ("NLGEOM=YES", "NLGEOM=NO", "got NO, expected YES"),
        ("TOP, 3, 3, -0.01", "NOWHERE, 3, 3, -0.01", r"deck\.inp:\d+: got node set NOWHERE"),
        ("TOP, 3, 3, -0.01", "TOP, 3, 7, -0.01", "degrees of freedom 1 to 6"),
        ("*BOUNDARY, AMPLITUDE=A", "*BOUNDARY, AMPLITUDE=B", "got amplitude B"),
        ("*BOUNDARY, AMPLITUDE=A", "*BOUNDARY", "a displacement without an amplitude"),
        ("FACE, ROAD", "FACE, STREET", "master surface STREET"),
        ("INTERACTION=TOUCH, MECH", "INTERACTION=SLIDE, MECH", "interaction SLIDE"),
        ("1, 1, 2, 3, 4, 5, 6, 7, 8", "1, 1, 2, 3, 4, 5, 6, 7, 77", "node 77"),
        ("1, 1, 2, 3, 4, 5, 6, 7, 8", "1, 1, 2, 3, 4, 5, 6, 7", "8 fields"),
        ("8, 0., 1., 1.", "7, 0., 1., 1.", "node 7 twice"),
        ("30., 0.47", "30., 0.5", "-1 < nu < 0.5"),
        ("0.5, 0.5, 1e-3", "1.0, 1.0, 1e-3", "less than 1"),
        ("*DENSITY\n1.E-9,\n", "", r"without \*DENSITY"),
        ("*SOLID SECTION, ELSET=E, MATERIAL=M\n,\n", "", "solid sections"),
        ("0., 0., 1e-5, 1.", "0., 0., 0., 1.", "increasing times"),
        ("LINE, 10., 0.", "CIRCL, 10., 0., 0., 0.", "180 degrees"),
        ("LINE, 10., 0.", "PARAB, 0., 1., 10., 0.", "LINE or CIRCL"),
        ("*DYNAMIC, EXPLICIT\n, 2e-5", "*DYNAMIC, EXPLICIT\n1e-7, 2e-5", "automatic increments"),
        ("*END STEP\n", "", "END STEP"),
        ("REF NODE=9, ANALYTICAL", "REF NODE=5, TIE NSET=TOP, ANALYTICAL", "also in the rigid body"),
        ("*MATERIAL, NAME=M\n", "*MATERIAL, NAME=M\n*TRS\n22., 8., 100.\n", "nodes without a temperature"),
    ],
)
def test_anything_outside_the_subset_stops_with_its_place(tmp_path: Path, old: str, new: str, message: str) -> None:
    """Nothing that changes the answer is skipped."""
    assert GOOD.count(old) >= 1
    with pytest.raises(InputError, match=message):
        read_model(written(tmp_path, GOOD.replace(old, new, 1)))


def test_step_time_amplitude_is_not_carried_into_the_next_step(tmp_path: Path) -> None:
    """Its clock would start anew: the engine asks for total time or a new condition."""
    text = GOOD.replace(", TIME=TOTAL TIME", "") + "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-5\n*END STEP\n"
    with pytest.raises(InputError, match="STEP TIME carried into"):
        read_model(written(tmp_path, text))


@pytest.mark.parametrize(
    ("curve", "fault"),
    [("0., 1., 1e-5, 0.5", ""), ("0., 0., 1e-5, 1.", "jumps from -0.01 to 0"), ("0., 1., 1e-5, 2.", "")],
    ids=["goes back", "starts at rest again", "goes on"],
)
def test_displacement_given_again_in_step_time_begins_where_the_step_before_ended(
    tmp_path: Path, curve: str, fault: str
) -> None:
    """Values of a displacement are the mount's, not its change in the step: a curve from 0 would throw it back."""
    text = GOOD.replace(", TIME=TOTAL TIME", "").replace("*BOUNDARY\n", f"*AMPLITUDE, NAME=B\n{curve}\n*BOUNDARY\n", 1)
    text += "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-5\n*BOUNDARY, AMPLITUDE=B\nTOP, 3, 3, -0.01\n*END STEP\n"
    if not fault:
        assert read_model(written(tmp_path, text)).steps[1].conditions[(4, 3)].magnitude == -0.01
        return
    with pytest.raises(InputError, match=fault):
        read_model(written(tmp_path, text))


def test_conditions_and_contact_carry_over_to_the_next_step(tmp_path: Path) -> None:
    """A later condition on the same degree of freedom takes the place of the earlier one."""
    more = "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-5\n*BOUNDARY, TYPE=VELOCITY\nTOP, 3, 3, 2.\n*END STEP\n"
    model = read_model(written(tmp_path, GOOD + more))
    first, second = model.steps
    assert len(second.pairs) == len(first.pairs) == 1
    assert second.conditions[(4, 3)].magnitude == 2.0
    assert first.conditions[(4, 3)].magnitude == -0.01
    assert second.conditions[(4, 1)].kind == first.conditions[(4, 1)].kind
