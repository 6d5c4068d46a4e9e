"""The lint: clean decks are clean, broken ones are caught at the line that is broken."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tread_validate import deck
from tread_validate.deck.lint import lint
from tread_validate.deck.model import INCLUDED
from tread_validate.errors import InputError
from tread_validate.study import Case

Edit = tuple[str, str]

# name, text to find (regular expression, first match), its replacement, rule that must fire, what its line must hold
BROKEN_RIG: list[tuple[str, str, str, str, str]] = [
    ("misspelt keyword", r"\*DENSITY", "*DENSTY", "unknown-keyword", "*DENSTY"),
    ("misspelt parameter", "NSET=MOUNT\n", "NSET=MOUNT, GENRATE\n", "unknown-parameter", "GENRATE"),
    ("value not in the list", "HOURGLASS=STIFFNESS", "HOURGLASS=STIFFENED", "parameter-value", "HOURGLASS=STIFFENED"),
    ("missing parameter", "REF NODE=RING_REF, ", "", "missing-parameter", "TIE NSET=MOUNT"),
    ("dangling node set", "TIE NSET=MOUNT", "TIE NSET=MONT", "dangling-nset", "TIE NSET=MONT"),
    ("dangling node set in a condition", "RING_REF, 6, 6", "RING, 6, 6", "dangling-nset", "RING, 6, 6"),
    ("dangling element set", "FACE_ELEMENTS, S1", "FACE_ELEMENT, S1", "dangling-elset", "FACE_ELEMENT, S1"),
    ("dangling section set", "ELSET=BLOCK, MATERIAL", "ELSET=BLOK, MATERIAL", "dangling-elset", "ELSET=BLOK"),
    ("dangling surface in a pair", "FACE, ROAD\n", "FACE, ROADS\n", "dangling-surface", "FACE, ROADS"),
    ("dangling surface of a body", "SURFACE=ROAD\n", "SURFACE=RD\n", "dangling-surface", "SURFACE=RD"),
    ("dangling material", "MATERIAL=COMPOUND", "MATERIAL=RUBBER", "dangling-material", "MATERIAL=RUBBER"),
    ("dangling controls", "CONTROLS=BLOCK_CONTROLS", "CONTROLS=NONE_SUCH", "dangling-controls", "NONE_SUCH"),
    ("dangling interaction", "INTERACTION=TREAD_ROAD,", "INTERACTION=TREAD,", "dangling-interaction", "=TREAD,"),
    ("dangling contact pair set", r"OUTPUT, CPSET=TREAD_ROAD_PAIR", "OUTPUT, CPSET=PAIR", "dangling-cpset", "=PAIR"),
    ("contact output without a set", r"OUTPUT, CPSET=TREAD_ROAD_PAIR", "OUTPUT", "no-cpset", "*CONTACT OUTPUT"),
    ("node given twice", "\n2, ", "\n1, ", "duplicate-node", "1, "),
    ("element given twice", r"(ELSET=BLOCK\n1, .*\n)2, ", r"\g<1>1, ", "duplicate-element", "1, "),
    ("element with a node that is not there", r"(ELSET=BLOCK\n1, )\d+", r"\g<1>77777", "undefined-node", "77777"),
    ("element with a node too few", r"(ELSET=BLOCK\n1, .*), \d+\n", r"\g<1>\n", "element-nodes", "1, "),
    ("unknown element type", "TYPE=C3D8R", "TYPE=C3D8Q", "element-type", "C3D8Q"),
    (
        "element inside out",
        r"(ELSET=BLOCK\n1), (\d+), (\d+), (\d+), (\d+), (\d+), (\d+), (\d+), (\d+)",
        r"\1, \6, \7, \8, \9, \2, \3, \4, \5",
        "negative-jacobian",
        "1, ",
    ),
    ("node in two rigid bodies", "ANALYTICAL SURFACE=ROAD", "ANALYTICAL SURFACE=ROAD, PIN NSET=MOUNT",
     "two-rigid-bodies",
     "TIE NSET=MOUNT"),
    ("rigid body's node held as well", "RING_REF, 1, 5", "RING_REF, 1, 5\nMOUNT, 1, 3", "rigid-body-support",
     "MOUNT, 1, 3"),
    ("reference node free to move", "ROAD_REF, 1, 5", "ROAD_REF, 2, 5", "massless-body",
     "*RIGID BODY, REF NODE=ROAD_REF"),
    ("analytical surface in no body", r"\*RIGID BODY, REF NODE=ROAD_REF.*\n", "", "loose-surface", "NAME=ROAD"),
    ("arc of 180 deg", r"CIRCL, -259.807621, 150., 0., 0.", "CIRCL, 0., 300., 0., 0.", "arc-angle", "CIRCL, 0., 300."),
    ("arc off its circle", r"CIRCL, 259.807621", "CIRCL, 260.5", "profile", "CIRCL, 260.5"),
    ("no density", r"\*DENSITY\n.*\n", "", "no-density", "*MATERIAL"),
    ("no stiffness", r"\*ELASTIC.*\n.*\n", "", "no-stiffness", "*MATERIAL"),
    ("incompressible", r"(MODULI=INSTANTANEOUS\n.*), 0.47", r"\1, 0.5", "material-value", ", 0.5"),
    ("Prony ratios above one", r"(TIME=PRONY\n)[0-9.]+", r"\g<1>0.99", "prony", "*VISCOELASTIC"),
    ("negative relaxation time", r"(TIME=PRONY\n.*, )([0-9.]+\n)", r"\1-\2", "prony", ", -"),
    ("shift without temperature", r"\*INITIAL CONDITIONS, TYPE=TEMPERATURE\n.*\n", "", "no-temperature", "*TRS"),
    ("shift below nothing", r"\*VISCOELASTIC.*\n(?:[0-9.].*\n)+", "", "wrong-place", "*TRS"),
    ("word for a number", "0.06, 1.2", "0.06, big", "not-a-number", "big"),
    ("too many fields", "ROAD_REF, 1, 5", "ROAD_REF, 1, 5, 0., 0.", "field-count", "ROAD_REF, 1, 5, 0., 0."),
    ("degree of freedom 7", "RING_REF, 1, 5", "RING_REF, 1, 7", "dof", "RING_REF, 1, 7"),
    ("material in a step", r"\*BULK VISCOSITY\n", "*MATERIAL, NAME=LATE\n*BULK VISCOSITY\n", "wrong-place",
     "NAME=LATE"),
    ("pair before the steps", r"\*BOUNDARY\n", "*CONTACT PAIR, INTERACTION=TREAD_ROAD\nFACE, ROAD\n*BOUNDARY\n",
     "wrong-place", "*CONTACT PAIR, INTERACTION=TREAD_ROAD\n"),
    ("step never ended", r"\*END STEP\n\*\* Pass", "** Pass", "step-order", "NAME=pass"),
    ("step of no time", r"EXPLICIT\n, 0.002", "EXPLICIT\n, 0.", "step-time", ", 0."),
    ("step without a procedure", r"\*DYNAMIC, EXPLICIT\n, 0.002\n", "", "no-procedure", "NAME=approach"),
    ("VFRIC with a penalty", "CONSTRAINT=KINEMATIC", "CONSTRAINT=PENALTY", "vfric-penalty", "PENALTY"),
    ("VFRIC in general contact", r"\*CONTACT PAIR.*\nFACE, ROAD\n",
     "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , TREAD_ROAD\n",
     "vfric-general-contact", "USER=FRIC"),
    ("the other friction routine in a pair", "USER=FRIC,", "USER=COEFFICIENT,", "vfric-general-contact", "COEFFICIENT"),
    ("softened contact with VFRIC", r"(\*FRICTION)",
     r"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n0.1, 1.\n\1", "vfric-softened", "EXPONENTIAL"),
    ("elastic slip with VFRIC", "USER=FRIC,", "USER=FRIC, ELASTIC SLIP=0.1,", "vfric-softened", "ELASTIC SLIP"),
    ("properties that do not add up", "PROPERTIES=11", "PROPERTIES=9", "vfric-properties", "PROPERTIES=9"),
    ("properties without a count", ", PROPERTIES=11", "", "vfric-properties", "USER=FRIC"),
    ("displacement without amplitude", r"(NAME=pass.*\n.*\n.*\n)", r"\1*BOUNDARY\nRING_REF, 1, 1, 0.5\n",
     "displacement-jump", "RING_REF, 1, 1, 0.5"),
    ("analytical surface as slave", "FACE, ROAD\n", "ROAD, FACE\n", "contact-pair", "ROAD, FACE"),
    ("face that no brick has", "FACE_ELEMENTS, S1", "FACE_ELEMENTS, S7", "surface-face", "S7"),
    ("data before the first keyword", r"\A", "1, 2, 3\n", "syntax", "1, 2, 3"),
    ("parameter given twice", "TYPE=C3D8R, ", "TYPE=C3D8R, TYPE=C3D8, ", "syntax", "TYPE=C3D8, "),
]  # fmt: skip

BROKEN_BELT: list[tuple[str, str, str, str, str]] = [
    ("dangling amplitude", "AMPLITUDE=VX_001", "AMPLITUDE=VX_999", "dangling-amplitude", "VX_999"),
    ("amplitude out of order", r"(NAME=VX_002, TIME=TOTAL TIME\n)0.000000000", r"\g<1>0.000030000", "amplitude",
     "0.000030000"),
    ("amplitude of an odd count", r"(NAME=VX_001, TIME=TOTAL TIME\n)0.000000000, ", r"\1", "amplitude", "16"),
    ("amplitude given twice", "NAME=VY_001", "NAME=VX_001", "duplicate-name", "NAME=VX_001"),
    ("jump of displacement", r"TYPE=VELOCITY, AMPLITUDE=VX_001", "AMPLITUDE=VX_001", "displacement-jump",
     "MOUNT_001, 1, 1, 1."),
    ("section's elements in two sections", r"(\*MATERIAL)",
     r"*SOLID SECTION, ELSET=FACE_ELEMENTS, MATERIAL=COMPOUND\n,\n\1", "two-sections", "ELSET=FACE_ELEMENTS"),
    ("elements without a section", r"\*SOLID SECTION, ELSET=BLOCK", "*SOLID SECTION, ELSET=FACE_ELEMENTS", "no-section",
     ", "),
]  # fmt: skip


CUBE = """*Heading
** like a CAE job without parts
*Preprint, echo=NO, model=NO, history=NO, contact=NO
*Node
      1,           0.,           0.,           0.
      2,           1.,           0.,           0.
      3,           1.,           1.,           0.
      4,           0.,           1.,           0.
      5,           0.,           0.,           1.
      6,           1.,           0.,           1.
      7,           1.,           1.,           1.
      8,           0.,           1.,           1.
      9,           0.5,           0.5,           2.
*Element, type=C3D8R
1, 1, 2, 3, 4, 5, 6, 7, 8
*Nset, nset=Bottom, generate
 1,  4,  1
*Elset, elset=All
 1,
*Nset, nset=RP
 9,
*Elset, elset=_Top_S2, internal
 1,
*Surface, type=ELEMENT, name=Top
_Top_S2, S2
*Orientation, name=Ori-1
          1.,           0.,           0.,           0.,           1.,           0.
1, 0.
*Solid Section, elset=All, controls=EC-1, material=Steel
,
*Section Controls, name=EC-1, hourglass=ENHANCED
1., 1., 1.
*Amplitude, name=Amp-1, definition=SMOOTH STEP
0., 0., 1., 1.
*Material, name=Steel
*Damping, alpha=1.
*Density
7.8e-09,
*Elastic
210000., 0.3
*Plastic
200., 0.
*Surface Interaction, name=IntProp-1
*Friction
0.2,
*Surface Behavior, pressure-overclosure=HARD
*Step, name=Step-1, nlgeom=YES
*Dynamic, Explicit
, 1.
*Bulk Viscosity
0.06, 1.2
*Boundary
Bottom, ENCASTRE
*Boundary, amplitude=Amp-1
5, 3, 3, -0.1
*Contact, op=NEW
*Contact Inclusions, ALL EXTERIOR
*Contact Property Assignment
 ,  , IntProp-1
*Dsload, amplitude=Amp-1
Top, P, 1.
*Restart, write, number interval=1, time marks=NO
*Output, field, variable=PRESELECT
*Output, history, variable=PRESELECT
*End Step
"""


@pytest.fixture(scope="module")
def texts(rig_case: Case, belt_case: Case, coarse: Callable[[Case], Case]) -> dict[str, str]:
    return {
        "rig": deck.build(coarse(rig_case), single_file=True).input_text,
        "belt": deck.build(coarse(belt_case), single_file=True).input_text,
    }


def test_files_to_be_included_are_linted_for_what_they_hold(rig_case: Case, belt_case: Case, tmp_path: Path) -> None:
    """Sections, parameters and sets may stand in the deck that includes them; a node given twice stands here."""
    for case in (rig_case, belt_case):
        folder = tmp_path / case.case_id
        deck.write(case, folder)
        for file in folder.glob("m*.inp"):
            assert [one.rule for one in lint(file)] == ["no-step"]
    mesh = next((tmp_path / rig_case.case_id).glob("mesh-*.inp"))
    mesh.write_text(mesh.read_text().replace("\n2, ", "\n1, ", 1))
    assert "duplicate-node" in [one.rule for one in lint(mesh)]


def test_every_deck_of_the_study_is_clean(
    cases: tuple[Case, ...], coarse: Callable[[Case], Case], tmp_path: Path
) -> None:
    """No finding of any severity in all 52 cases and their constant-friction variants, on a coarse mesh."""
    for case in cases:
        deck.write(coarse(case), tmp_path / case.case_id)
    files = [path for path in sorted(tmp_path.glob("*/*.inp")) if not INCLUDED.fullmatch(path.name)]
    assert len(files) == 2 * len(cases)
    for file in files:
        assert lint(file) == []


def test_decks_at_the_mesh_of_the_study_are_clean(
    rig_case: Case, belt_case: Case, trace_case: Case, tmp_path: Path
) -> None:
    for case in (rig_case, belt_case, trace_case):
        deck.write(case, tmp_path)
        assert lint(tmp_path / f"{case.case_id}.inp") == []


@pytest.mark.parametrize(
    ("kind", "pattern", "replacement", "rule", "holds"),
    [pytest.param("rig", *row[1:], id=row[0]) for row in BROKEN_RIG]
    + [pytest.param("belt", *row[1:], id=row[0]) for row in BROKEN_BELT],
)
def test_broken_deck_is_caught_at_its_line(
    kind: str, pattern: str, replacement: str, rule: str, holds: str, texts: dict[str, str], tmp_path: Path
) -> None:
    """The rule fires, and on a line that holds what was broken."""
    broken, count = re.subn(pattern, replacement, texts[kind], count=1)
    assert count == 1, "the deck no longer has what this test breaks"
    file = tmp_path / "broken.inp"
    file.write_text(broken)
    findings = [finding for finding in lint(file) if finding.rule == rule]
    assert findings, f"{rule} did not fire"
    lines = broken.splitlines(keepends=True)
    assert any(holds in lines[finding.line - 1] for finding in findings)
    assert all(finding.severity == "error" for finding in findings)


def test_jump_of_velocity_by_a_piecewise_linear_displacement_is_a_warning(
    texts: dict[str, str], tmp_path: Path
) -> None:
    text = texts["belt"].replace(
        "*INITIAL CONDITIONS, TYPE=TEMPERATURE",
        "*AMPLITUDE, NAME=KINK\n0., 0., 0.001, 1., 0.002, 1.\n*INITIAL CONDITIONS, TYPE=TEMPERATURE",
    )
    text = text.replace("*BULK VISCOSITY", "*BOUNDARY, AMPLITUDE=KINK\nMOUNT_001, 1, 1, 0.1\n*BULK VISCOSITY", 1)
    file = tmp_path / "kink.inp"
    file.write_text(text)
    assert [(one.rule, one.severity) for one in lint(file)] == [("velocity-jump", "warning")]


def test_deck_in_the_manner_of_a_graphical_preprocessor_is_clean(tmp_path: Path) -> None:
    """Blanks, empty fields, generated and internal sets, general contact, a smooth step, an orientation."""
    file = tmp_path / "cube.inp"
    file.write_text(CUBE)
    assert lint(file) == []


def test_case_blanks_comments_and_continued_lines_do_not_matter(texts: dict[str, str], tmp_path: Path) -> None:
    """The language does not tell upper from lower case and lets keyword lines go on after a comma."""
    text = texts["rig"].replace("*CONTACT PAIR, ", "*Contact  Pair,\n** a remark\n  ").replace("*NODE,", "*node ,")
    text = text.replace("TIE NSET=MOUNT", "tie nset = mount").lower()
    file = tmp_path / "lower.inp"
    file.write_text(text)
    assert lint(file) == []


def test_sets_by_generate_and_of_sets_are_followed(texts: dict[str, str], tmp_path: Path) -> None:
    text = texts["rig"].replace(
        "*SECTION CONTROLS",
        "*NSET, NSET=SOME, GENERATE\n1, 10, 1\n*NSET, NSET=BOTH\nSOME, MOUNT\n*ELSET, ELSET=ODD, GENERATE\n1, 9, 2\n"
        "*NSET, NSET=OF_ODD, ELSET=ODD\n*SECTION CONTROLS",
        1,
    )
    file = tmp_path / "sets.inp"
    file.write_text(text)
    assert lint(file) == []
    file.write_text(text.replace("SOME, MOUNT", "SOME, MONT"))
    assert [one.rule for one in lint(file)] == ["dangling-nset"]


def test_a_surface_of_revolution_has_one_line_for_its_axis(tmp_path: Path) -> None:
    """A ball on its axis is a sound profile; the two lines of a cylinder are not."""
    ball = "*SURFACE, TYPE=REVOLUTION, NAME=BALL\n0., 0., 0., 0., 0., 1.\nSTART, 0., 5.\nCIRCL, 5., 0., 0., 0.\n"
    file = tmp_path / "ball.inp"
    for text, expected in ((ball, 0), (ball.replace("START", "0., 1., 0.\nSTART"), 1)):
        file.write_text(f"*HEADING\na ball\n{text}", encoding="utf-8")
        assert [one.rule for one in lint(file)].count("profile") == expected


def test_deck_of_parts_is_checked_for_form_and_says_so(tmp_path: Path) -> None:
    file = tmp_path / "parts.inp"
    file.write_text("*HEADING\nparts\n*PART, NAME=A\n*NODE\n1, 0., 0., 0.\n*END PART\n*STEP\n*DYNMIC\n*END STEP\n")
    assert ("unknown-keyword", 8) in [(one.rule, one.line) for one in lint(file)]


@pytest.mark.parametrize("content", [None, b"", b"\x00\x01\x02", b"\xff\xfe*NODE"])
def test_missing_empty_or_binary_file_is_wrong_input(content: bytes | None, tmp_path: Path) -> None:
    file = tmp_path / "deck.inp"
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(InputError):
        lint(file)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_no_text_makes_the_lint_fall_over(data: st.DataObject, texts: dict[str, str], tmp_path: Path) -> None:
    """Findings or a clean deck or wrong input, never a traceback, whatever a line is replaced by."""
    lines = texts["rig"].splitlines()
    keys = [index for index, line in enumerate(lines) if line.startswith("*")]
    index = data.draw(st.sampled_from(keys)) + data.draw(st.integers(0, 2))
    junk = st.text(alphabet='*,=. 01-EABCNSDTR"', max_size=30)
    lines[min(index, len(lines) - 1)] = data.draw(junk | st.sampled_from(lines))
    file = tmp_path / "junk.inp"
    file.write_text("\n".join(lines))
    lint(file)


OTHER_PROGRAM = """*NODE, NSET=NALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=EALL
1, 1, 2, 3, 4, 5, 6, 7
8
*MATERIAL, NAME=M
*ELASTIC, TYPE=ORTHO
0., 0., 0., 0., 0., 0., 0., 0.
0., 0.
*SOLIDSECTION, ELSET=EALL, MATERIAL=M
*DESIGNVARIABLES, TYPE=COORDINATE
NALL
*INITIAL CONDITIONS, TYPE=FLUID VELOCITY
NALL, 1, 0.
*BOUNDARYF
EALL, S1, 1, 1, 0.
*STEP, INCF=100
*STATIC
*CLOAD
7, 3, 1., 0.
"""


def test_forms_that_calculix_takes_are_no_errors_in_its_dialect(tmp_path: Path) -> None:
    """Elements that go on without a comma, longer keywords, its own values, no *END STEP; ABAQUS stops at some."""
    file = tmp_path / "other.inp"
    file.write_text(OTHER_PROGRAM)
    assert [str(one) for one in lint(file, "calculix") if one.severity == "error"] == []
    assert {"element-nodes", "parameter-value", "step-order"} <= {one.rule for one in lint(file)}
    file.write_text(OTHER_PROGRAM.replace("*MATERIAL", "*MATERAIL"))
    assert "unknown-keyword" in {one.rule for one in lint(file, "calculix")}


def test_element_line_that_ends_with_a_comma_goes_on_whatever_its_length(tmp_path: Path) -> None:
    file = tmp_path / "beams.inp"
    nodes = "".join(f"{n}, {n % 2}., {n // 2}., 0.\n" for n in range(1, 5))
    head = f"*HEADING\nplate\n*NODE\n{nodes}*ELEMENT, TYPE=CPS4, ELSET=P\n7, 1, 3, 4,\n2\n"
    file.write_text(
        head
        + "*SOLID SECTION, ELSET=P, MATERIAL=M\n1.,\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n*STEP\n*STATIC\n*END STEP\n"
    )
    assert "field-count" not in {one.rule for one in lint(file)}
