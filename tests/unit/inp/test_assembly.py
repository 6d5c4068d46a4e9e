"""Parts, instances and coordinate systems, resolved into the flat deck that means the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.inp import Deck, expand, read_deck
from tread_validate.inp.placement import rotation
from tread_validate.inp.table import number_table

PART = """*Heading
a block on a road
*Part, name=Block
*Node
1, 0., 0., 0.
2, 2., 0., 0.
3, 2., 1., 0.
4, 0., 1., 0.
5, 0., 0., 3.
6, 2., 0., 3.
7, 2., 1., 3.
8, 0., 1., 3.
*Element, type=C3D8R
1, 1, 2, 3, 4, 5, 6, 7, 8
*Nset, nset=Top, generate
5, 8, 1
*Elset, elset=All
1,
*Solid Section, elset=All, material=Rubber
,
*End Part
"""
ASSEMBLY = """*Assembly, name=Assembly
*Instance, name=Block-1, part=Block
*End Instance
*Instance, name="Block, 2", part=Block
10., 0., 0.
10., 0., 0., 10., 1., 0., 90.
*End Instance
*Node
1, 5., 5., 5.
*Nset, nset=Ref
1,
*Nset, nset=Tops, instance=Block-1
Top, 1
*Nset, nset=Other, instance="Block, 2", generate
1, 3, 2
*Elset, elset=_Face_S2, internal, instance="Block, 2"
1,
*Surface, type=ELEMENT, name=Face
_Face_S2, S2
*End Assembly
*Material, name=Rubber
*Density
1e-9,
*Step
*Dynamic, Explicit
, 1.
*Boundary
Block-1.Top, 1, 3
"Block, 2".7, 3, 3
*End Step
"""


def deck_of(folder: Path, text: str) -> Deck:
    path = folder / "a.inp"
    path.write_text(text, encoding="utf-8")
    return read_deck(path)


def members(deck: Deck, name: str) -> list[list[str]]:
    return [
        [text for line in block.data for text in line.fields]
        for block in deck.named("NSET", "ELSET")
        if block.parameters.get(block.keyword) == name
    ]


def test_each_instance_has_the_nodes_of_its_part_where_it_is_put(tmp_path: Path) -> None:
    """Shift by 10 along x, then 90 deg about y through (10, 0, 0): (2, 1, 3) goes to (13, 1, -2)."""
    deck = deck_of(tmp_path, PART + ASSEMBLY)
    first, second, own = (number_table(block.data, 4, "node") for block in deck.named("NODE"))
    assert own.tolist() == [[1.0, 5.0, 5.0, 5.0]]
    assert first[:, 0].tolist() == [10.0 + i for i in range(1, 9)]
    assert second[6].tolist() == [27.0, 13.0, 1.0, -2.0]
    assert second[0, 1:].tolist() == [10.0, 0.0, 0.0]
    elements = [line.fields for block in deck.named("ELEMENT") for line in block.data]
    assert elements[1] == tuple(str(20 + i) for i in (1, 1, 2, 3, 4, 5, 6, 7, 8))
    assert deck.label_name(27) == "Block, 2.7"
    assert deck.label_name(12) == "BLOCK-1.2"
    assert deck.label_name(1) == "1"


def test_names_of_a_part_are_those_of_its_instances(tmp_path: Path) -> None:
    deck = deck_of(tmp_path, PART + ASSEMBLY)
    assert members(deck, "BLOCK-1.TOP") == [["15", "18", "1"]]
    assert members(deck, "Block, 2.TOP") == [["25", "28", "1"]]
    assert members(deck, "TOPS") == [['"BLOCK-1.TOP"', "11"]]
    assert members(deck, "OTHER") == [["21", "23", "2"]]
    assert members(deck, "REF") == [["1"]]
    sections = [block.value("ELSET") for block in deck.named("SOLID SECTION")]
    assert sections == ["BLOCK-1.ALL", "Block, 2.ALL"]
    held = next(deck.named("BOUNDARY")).data
    assert [line.fields for line in held] == [("Block-1.Top", "1", "3"), ("27", "3", "3")]


def test_lines_of_an_instance_keep_the_place_they_are_written_at(tmp_path: Path) -> None:
    deck = deck_of(tmp_path, PART + ASSEMBLY)
    assert {line.number for block in deck.named("ELEMENT") for line in block.data} == {14}


def test_an_expanded_assembly_expands_to_itself(tmp_path: Path) -> None:
    """The flat text needs no part and says the same when it is read again."""
    text = expand(deck_of(tmp_path, PART + ASSEMBLY))
    assert "*PART" not in text
    assert expand(deck_of(tmp_path, text)) == text


def test_one_instance_as_it_stands_is_the_part_itself(tmp_path: Path) -> None:
    """No label changes and no coordinate is rewritten."""
    single = "*Assembly, name=A\n*Instance, name=B, part=Block\n*End Instance\n*End Assembly\n"
    deck = deck_of(tmp_path, PART + single)
    assert list(next(deck.named("NODE")).data.texts)[1] == "2, 2., 0., 0."


def test_an_analytical_surface_moves_with_its_instance(tmp_path: Path) -> None:
    """Without axes of its own it lies in the part's x-y plane, swept along -z; the instance lifts and turns it."""
    text = PART + (
        "*Part, name=Road\n*End Part\n*Assembly, name=A\n*Instance, name=Road-1, part=Road\n0., 4., 0.\n"
        "0., 0., 0., 0., 0., 1., 90.\n*Node\n1, 0., 0., 0.\n*Nset, nset=RP\n1,\n"
        "*Surface, type=CYLINDER, name=Flat\nSTART, -9., 0.\nLINE, 9., 0.\n"
        "*Rigid Body, ref node=RP, analytical surface=Flat\n*End Instance\n*End Assembly\n"
    )
    deck = deck_of(tmp_path, text)
    surface = next(deck.named("SURFACE"))
    assert surface.value("NAME") == "ROAD-1.FLAT"
    axes = [float(text) for line in surface.data[:2] for text in line.fields]
    np.testing.assert_allclose(axes, [-4, 0, 0, -4, 1, 0, -4, 0, -1], atol=1e-15)
    body = next(deck.named("RIGID BODY"))
    assert (body.value("REF NODE"), body.value("ANALYTICAL SURFACE")) == ("ROAD-1.RP", "ROAD-1.FLAT")


BALL = (
    "*Part, name=Ball\n*End Part\n*Assembly, name=A\n*Instance, name=B-1, part=Ball\n0., 4., 0.\n"
    "0., 0., 0., 0., 0., 1., 90.\n*Surface, type=REVOLUTION, name=Ball\n1., 0., 0., 1., 2., 0.\nSTART, 0., 5.\n"
    "CIRCL, 5., 0., 0., 0.\n*End Instance\n*End Assembly\n"
)


def test_the_axis_of_a_surface_of_revolution_moves_with_its_instance(tmp_path: Path) -> None:
    """Lifted by 4 along y, turned by 90 degrees about z: (1, 0, 0) goes to (-4, 1, 0) and (1, 2, 0) to (-6, 1, 0)."""
    surface = next(deck_of(tmp_path, PART + BALL).named("SURFACE"))
    axis = [float(text) for text in surface.data[0].fields]
    np.testing.assert_allclose(axis, [-4, 1, 0, -6, 1, 0], atol=1e-15)
    assert [line.fields[0] for line in surface.data[1:]] == ["START", "CIRCL"]


def test_a_surface_of_revolution_without_its_axis_stops_at_its_line(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"a\.inp:\d+.*without its axis"):
        deck_of(tmp_path, PART + BALL.replace("1., 0., 0., 1., 2., 0.\n", ""))


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        ("part=Block\n*End", "part=Blok\n*End", 23, "part BLOK"),
        ("*End Part\n", "", 3, "END PART"),
        ("*End Instance\n*Inst", "*Inst", 23, "line 24 before \\*END INSTANCE"),
        ("*End Assembly\n", "", 22, "END ASSEMBLY"),
        ("instance=Block-1", "instance=Blok-1", 33, "instance BLOK-1"),
        ('name="Block, 2"', "name=Block-1", 25, "BLOCK-1 twice"),
        ("1., 0., 90.", "0., 0., 90.", 27, "axis"),
        ("*End Part\n", "*End Part\n*End Part\n", 22, "no \\*PART open"),
    ],
)
def test_an_assembly_that_does_not_hold_together_stops_at_its_line(
    old: str, new: str, line: int, says: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=rf"a\.inp:{line}\b.*{says}"):
        deck_of(tmp_path, (PART + ASSEMBLY).replace(old, new, 1))


def test_a_coordinate_system_holds_for_the_nodes_after_it(tmp_path: Path) -> None:
    """Local x along global y, local y along -x, origin (1, 2, 3); a *SYSTEM without data ends it."""
    deck = deck_of(
        tmp_path,
        "*SYSTEM\n1., 2., 3., 1., 5., 3.\n-4., 2., 3.\n*NODE, NSET=A\n1, 1., 0., 0.\n*SYSTEM\n*NODE\n2, 1., 0., 0.\n"
        "*NODE, SYSTEM=C\n3, 2., 90., 5.\n",
    )
    places = [number_table(block.data, 4, "node")[0].tolist() for block in deck.blocks]
    assert places[0] == [1.0, 1.0, 3.0, 3.0]
    assert places[1] == [2.0, 1.0, 0.0, 0.0]
    np.testing.assert_allclose(places[2], [3.0, 0.0, 2.0, 5.0], atol=1e-15)


@given(
    st.tuples(*[st.floats(-1, 1) for _ in range(3)]).filter(lambda v: np.linalg.norm(v) > 0.1),
    st.floats(-400.0, 400.0),
)
def test_a_rotation_keeps_lengths_and_its_axis(axis: tuple[float, float, float], degrees: float) -> None:
    turn = rotation(np.array(axis), np.radians(degrees))
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-14)
    np.testing.assert_allclose(turn @ np.array(axis), axis, atol=1e-14)
    assert np.linalg.det(turn) == pytest.approx(1.0)
