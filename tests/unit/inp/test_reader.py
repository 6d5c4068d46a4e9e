"""Unit tests of the keyword reader: what the language says about lines, case, continuation and includes."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.inp import read_deck


def deck_of(folder: Path, text: str, name: str = "a.inp") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_keywords_and_parameters_do_not_depend_on_case_or_blanks(tmp_path: Path) -> None:
    """``*Solid   Section, elset = Body`` is SOLID SECTION with ELSET=BODY, on line 2."""
    deck = read_deck(deck_of(tmp_path, "** comment\n*Solid   Section, elset = Body , CONTROLS\n 1. , 2.,\n"))
    (block,) = deck.blocks
    assert block.keyword == "SOLID SECTION"
    assert dict(block.parameters) == {"ELSET": "BODY", "CONTROLS": None}
    assert (block.line, block.data[0].number, block.data[0].fields) == (2, 3, ("1.", "2."))


def test_a_keyword_line_goes_on_after_a_trailing_comma(tmp_path: Path) -> None:
    """The continued line counts from its first line."""
    deck = read_deck(deck_of(tmp_path, '*FRICTION, USER=FRIC,\n** why\n  PROPERTIES=2\n0.9, "aB"\n'))
    assert dict(deck.blocks[0].parameters) == {"USER": "FRIC", "PROPERTIES": "2"}
    assert deck.blocks[0].line == 1
    assert deck.blocks[0].data[0].number == 4


def test_quoted_values_keep_their_case_and_commas(tmp_path: Path) -> None:
    """Only a quoted name is as written."""
    deck = read_deck(deck_of(tmp_path, '*MATERIAL, NAME="Rubber, soft"\n*MATERIAL, NAME=steel\n'))
    assert [b.value("NAME") for b in deck.blocks] == ["Rubber, soft", "STEEL"]


def test_an_included_file_stands_where_its_include_does(tmp_path: Path) -> None:
    """Blocks come in text order and name their own file and line."""
    (tmp_path / "mesh").mkdir()
    deck_of(tmp_path / "mesh", "*ELEMENT\n1, 2\n", "el.inp")
    deck = read_deck(deck_of(tmp_path, "*NODE\n1, 0.\n*INCLUDE, INPUT=mesh/el.inp\n*STEP\n"))
    assert [b.keyword for b in deck.blocks] == ["NODE", "ELEMENT", "STEP"]
    assert deck.blocks[1].where == "mesh/el.inp:1"
    assert "1, 2" in deck.text


@pytest.mark.parametrize("target", ["../secret.inp", "/etc/hostname", "a.inp", "absent.inp"])
def test_an_include_that_leaves_the_folder_or_loops_is_refused(tmp_path: Path, target: str) -> None:
    """The message names the line."""
    folder = tmp_path / "in"
    folder.mkdir()
    (tmp_path / "secret.inp").write_text("*NODE\n")
    with pytest.raises(InputError, match=r"a\.inp:1"):
        read_deck(deck_of(folder, f"*INCLUDE, INPUT={target}\n*NODE\n"))


def test_an_include_through_a_symbolic_link_out_of_the_folder_is_refused(tmp_path: Path) -> None:
    """The link's target decides, not its name."""
    folder = tmp_path / "in"
    folder.mkdir()
    (tmp_path / "secret.inp").write_text("*NODE\n")
    (folder / "link.inp").symlink_to(tmp_path / "secret.inp")
    with pytest.raises(InputError, match="inside the folder"):
        read_deck(deck_of(folder, "*INCLUDE, INPUT=link.inp\n"))


def test_keywords_parameters_and_values_may_be_short_and_blanks_do_not_count(tmp_path: Path) -> None:
    """As long as one name is left; an exact name comes first (*NODE beside *NODE OUTPUT)."""
    deck = read_deck(
        deck_of(
            tmp_path,
            "*NODE,NS=A\n*solidsec, els=a, mat=m\n*SECTIONCONTROLS, NAME=C, HOUR=RELAX\n"
            "*OUTPUT, HIST, TIMEINTERVAL=1e-5, TIMEMARKS=YES\n*TRANSVERSE SHEAR\n*INITIAL COND, TYPE=ROTATINGVEL\n",
        )
    )
    assert [block.keyword for block in deck.blocks] == [
        "NODE", "SOLID SECTION", "SECTION CONTROLS", "OUTPUT", "TRANSVERSE SHEAR", "INITIAL CONDITIONS",
    ]  # fmt: skip
    assert dict(deck.blocks[1].parameters) == {"ELSET": "A", "MATERIAL": "M"}
    assert deck.blocks[2].value("HOURGLASS") == "RELAX STIFFNESS"
    assert set(deck.blocks[3].parameters) == {"HISTORY", "TIME INTERVAL", "TIME MARKS"}
    assert deck.blocks[5].value("TYPE") == "ROTATING VELOCITY"


@pytest.mark.parametrize("ends", ["\n", "\r\n", "\r"])
def test_line_ends_marks_and_latin_letters_do_not_matter(ends: str, tmp_path: Path) -> None:
    """CR LF, CR, a byte order mark, a Latin-1 byte in a comment; line numbers count the same."""
    text = ends.join(["*NODE", "** Gr\xf6\xdfe 5\x85 mm", "1, 0.", "*STEP"])
    for data in (b"\xef\xbb\xbf" + text.encode("utf-8"), text.encode("latin-1")):
        (tmp_path / "a.inp").write_bytes(data)
        deck = read_deck(tmp_path / "a.inp")
        assert [(block.keyword, block.line) for block in deck.blocks] == [("NODE", 1), ("STEP", 4)]
        assert deck.blocks[0].data[0].number == 3


def test_an_include_is_looked_for_beside_the_file_it_stands_in(tmp_path: Path) -> None:
    """A file of data lines alone goes on with the keyword above its *INCLUDE; so does what follows it."""
    (tmp_path / "mesh").mkdir()
    deck_of(tmp_path / "mesh", "*NODE\n*INCLUDE, INPUT=more.txt\n9, 9.\n", "nodes.inp")
    deck_of(tmp_path / "mesh", "2, 0.5\n", "more.txt")
    deck = read_deck(deck_of(tmp_path, "*INCLUDE, INPUT=mesh\\nodes.inp\n"))
    assert [(line.where, line.text) for line in deck.blocks[0].data] == [
        ("mesh/more.txt:1", "2, 0.5"),
        ("mesh/nodes.inp:3", "9, 9."),
    ]


def test_data_lines_may_stand_in_a_file_of_their_own(tmp_path: Path) -> None:
    deck_of(tmp_path, "** nodes\n1, 0., 1.\n", "nodes.txt")
    (block,) = read_deck(deck_of(tmp_path, "*NODE, INPUT=nodes.txt, NSET=A\n")).blocks
    assert [line.where for line in block.data] == ["nodes.txt:2"]


@pytest.mark.parametrize(
    ("files", "says"),
    [
        ({"a.inp": "*INCLUDE, INPUT=b.inp\n", "b.inp": "*INCLUDE, INPUT=a.inp\n"}, r"b\.inp:1.*itself"),
        ({"a.inp": "*INCLUDE, INPUT=b.inp\n" * 2000, "b.inp": "*NODE\n"}, r"a\.inp:1001.*1000"),
        ({f"{i}.inp" if i else "a.inp": f"*INCLUDE, INPUT={i + 1}.inp\n" * 10 for i in range(5)} | {"5.inp": "*NODE\n"},
         "1000|deep"),
        ({"a.inp": "*INCLUDE, INPUT=\n"}, r"a\.inp:1"),
        ({"a.inp": "*INCLUDE, INPUT=b\0.inp\n"}, "binary"),
        ({"a.inp": "*INCLUDE, INPUT=" + "x" * 5000 + "\n"}, "file name"),
    ],
)  # fmt: skip
def test_includes_that_never_end_are_cut_short(files: dict[str, str], says: str, tmp_path: Path) -> None:
    """A circle, a thousand and one, ten each on five levels."""
    for name, text in files.items():
        deck_of(tmp_path, text, name)
    with pytest.raises(InputError, match=says) as fault:
        read_deck(tmp_path / "a.inp")
    assert "\n" not in str(fault.value)


def test_a_file_of_two_gigabytes_and_one_that_is_none_are_refused_unread(tmp_path: Path) -> None:
    """The size is looked at first (the file here is a hole); a folder or a pipe is no deck."""
    with (tmp_path / "a.inp").open("wb") as file:
        file.truncate(2 * 1024**3)
    with pytest.raises(InputError, match="2147483648 bytes"):
        read_deck(tmp_path / "a.inp")
    (tmp_path / "d.inp").mkdir()
    os.mkfifo(tmp_path / "p.inp")
    for name in ("d.inp", "p.inp"):
        with pytest.raises(InputError, match="regular file"):
            read_deck(tmp_path / name)


@pytest.mark.parametrize(
    "text",
    [
        "1, 2\n*NODE\n",
        "*NODE, NSET=A, nset=B\n",
        "*\n",
        "** only a comment\n",
        "*NODE, =3\n",
    ],
)
def test_broken_syntax_stops_with_its_line(tmp_path: Path, text: str) -> None:
    """Data before any keyword, a parameter twice, an empty keyword, a parameter without a name."""
    with pytest.raises(InputError, match=r"a\.inp:\d"):
        read_deck(deck_of(tmp_path, text))


def test_numbers_are_read_as_fortran_writes_them(tmp_path: Path) -> None:
    """1.D-9 is 1e-9; an empty field takes the default; a word is refused."""
    line = read_deck(deck_of(tmp_path, "*DENSITY\n1.D-9, , x, nan\n")).blocks[0].data[0]
    assert line.number_at(0, "density") == 1e-9
    assert line.number_at(1, "temperature", 7.0) == 7.0
    assert line.number_at(9, "absent", 8.0) == 8.0
    for position in (1, 2, 3):
        with pytest.raises(InputError, match=r"a\.inp:2"):
            line.number_at(position, "a number")


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=8))
def test_any_row_of_floats_survives_the_deck(tmp_path_factory: pytest.TempPathFactory, row: list[float]) -> None:
    """repr of a float64 is exact, so what was written is what is read."""
    folder = tmp_path_factory.mktemp("deck")
    text = "*NODE\n" + ", ".join(repr(value) for value in row) + "\n"
    line = read_deck(deck_of(folder, text)).blocks[0].data[0]
    assert [line.number_at(i, "a number") for i in range(len(row))] == row


@pytest.mark.parametrize(
    ("text", "keyword", "parameters", "data"),
    [
        ("*BOUNDARY,\n1, 1, 3", "BOUNDARY", {}, ["1, 1, 3"]),
        ("*Boundary, \n\nTop, 1, 3\n", "BOUNDARY", {}, ["Top, 1, 3"]),
        ("*Node, nset=A,\n1, 0., 0., 0.", "NODE", {"NSET": "A"}, ["1, 0., 0., 0."]),
        ("*NODE OUTPUT,\nU,", "NODE OUTPUT", {}, ["U,"]),
        ("*ELEMENT OUTPUT,\nE, S\n", "ELEMENT OUTPUT", {}, ["E, S"]),
        ("*DENSITY,", "DENSITY", {}, []),
        ("*HEADING,\nname=of the thing", "HEADING", {}, ["name=of the thing"]),
        ("*NSET, NSET=A,\n** why\n\n generate\n1, 5, 1", "NSET", {"NSET": "A", "GENERATE": None}, ["1, 5, 1"]),
        ("*NSET, NSET=A,\ngener\n1, 5, 1", "NSET", {"NSET": "A", "GENERATE": None}, ["1, 5, 1"]),
        ("*NSET,\nNSET=A,\nunsorted\n1", "NSET", {"NSET": "A", "UNSORTED": None}, ["1"]),
    ],
)
def test_a_keyword_line_goes_on_after_a_comma_only_with_parameters(
    text: str, keyword: str, parameters: dict[str, str | None], data: list[str], tmp_path: Path
) -> None:
    """A comma too many is what decks in use have: data are data, whatever the line above ends with."""
    path = tmp_path / "a.inp"
    path.write_text(text)
    told: list[str] = []
    (block,) = read_deck(path, lambda rule, *_: told.append(rule)).blocks
    assert (block.keyword, block.parameters, list(block.data.texts)) == (keyword, parameters, data)
    assert told == ([] if "GENERATE" in parameters or "UNSORTED" in parameters else ["trailing-comma"])
    assert read_deck(path).blocks[0].parameters == parameters


def test_the_end_of_file_mark_of_dos_is_no_data(tmp_path: Path) -> None:
    path = tmp_path / "a.inp"
    path.write_bytes(b"*NODE\r\n1, 0., 0., 0.\r\n\x1a")
    (block,) = read_deck(path).blocks
    assert list(block.data.texts) == ["1, 0., 0., 0."]
