"""Two decks pose one problem, or differ in a line that can be named."""

from __future__ import annotations

from pathlib import Path

import pytest

from tread_validate.inp import agree, differences, problem_of

NODES = [f"{i + 1}, {0.5 * i:.5f}, {1e-3 * (i % 3):.5f}, 10.0" for i in range(30)]
DECK = (
    "*HEADING\ncase one\n** made today\n*NODE, NSET=ALL\n"
    + "\n".join(NODES)
    + "\n*MATERIAL, NAME=COMPOUND\n*ELASTIC\n5.25, 0.47\n"
    "*AMPLITUDE, NAME=A\n"
    + "".join(f"{i}.0, {4.0 * (i % 2)}\n" for i in range(24))
    + "*STEP, NAME=pass, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.0158\n*END STEP\n"
)
ROUTINE = "c     friction\n      subroutine vfric\n      x = 0.9d0\n      end\n"


def deck_of(folder: Path, text: str, name: str = "a.inp") -> Path:
    folder.mkdir(exist_ok=True)
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("** made today\n", "** made tomorrow\n** by another version\n"),
        ("case one", "case two"),
        ("*ELASTIC\n5.25, 0.47", "*Elastic\n  5.25 ,0.47,"),
        ("NAME=pass, NLGEOM=YES", "nlgeom=yes, name=pass"),
    ],
)
def test_what_is_not_the_problem_does_not_change_its_digest(old: str, new: str, tmp_path: Path) -> None:
    """Comments, heading, blanks, case and the order of parameters."""
    a = problem_of(deck_of(tmp_path, DECK), ROUTINE)
    b = problem_of(deck_of(tmp_path, DECK.replace(old, new), "b.inp"), ROUTINE.replace("friction", "the law"))
    assert a.digest == b.digest
    assert list(differences(a, b)) == []


def test_a_deck_in_one_file_and_in_several_pose_one_problem(tmp_path: Path) -> None:
    """*INCLUDE is expanded before anything is compared."""
    whole = problem_of(deck_of(tmp_path / "one", DECK))
    table = "\n".join(NODES)
    deck_of(tmp_path / "two", f"** the mesh\n*NODE, NSET=ALL\n{table}\n", "mesh.inp")
    split = deck_of(tmp_path / "two", DECK.replace(f"*NODE, NSET=ALL\n{table}", "*INCLUDE, INPUT=mesh.inp"))
    assert problem_of(split).digest == whole.digest


@pytest.mark.parametrize(
    ("old", "new", "equal"),
    [
        ("5.25, 0.47", "5.25002, 0.47", True),  # 4e-6 apart
        ("5.25, 0.47", "5.2502, 0.47", False),  # 4e-5 apart
        ("2, 0.50000, 0.00100", "2, 0.50001, 0.00100", True),  # mm: the last digit of a coordinate
        ("2, 0.50000, 0.00100", "2, 0.50002, 0.00100", False),
        ("2, 0.50000,", "3, 0.50000,", False),  # a label
        ("2.0, 0.0\n", "2.0, 3e-6\n", True),  # a table's column that reaches 4
        ("2.0, 0.0\n", "2.0, 5e-6\n", False),
        ("5.25,", "5.25,1.0,", False),
    ],
)
def test_numbers_agree_to_the_stated_tolerances(old: str, new: str, equal: bool, tmp_path: Path) -> None:
    """Relative for single numbers, of the column's largest in a table, absolute for coordinates; labels exactly."""
    a = problem_of(deck_of(tmp_path, DECK))
    b = problem_of(deck_of(tmp_path, DECK.replace(old, new), "b.inp"))
    assert a.digest != b.digest
    assert (not list(differences(a, b))) is equal
    assert agree(a, b) is equal


def test_the_differing_line_is_named_with_both_numbers_and_their_distance(tmp_path: Path) -> None:
    """File and line of today's deck; the structure is the same."""
    a = problem_of(deck_of(tmp_path, DECK), ROUTINE)
    b = problem_of(deck_of(tmp_path, DECK.replace("0.0158", "0.0160"), "b.inp"), ROUTINE)
    (found,) = differences(a, b)
    assert a.structure == b.structure
    line = DECK.splitlines().index(", 0.0158") + 1
    assert str(found) == f"b.inp:{line}: 0.0158 when it was run, 0.0160 today (0.012 apart)"


def test_another_keyword_and_another_routine_are_differences(tmp_path: Path) -> None:
    """Words are compared as they are, the routine's code like the deck's."""
    deck = deck_of(tmp_path, DECK)
    other = deck_of(tmp_path, DECK.replace("*ELASTIC", "*HYPERELASTIC"), "b.inp")
    (found,) = differences(problem_of(deck), problem_of(other))
    assert (found.filed, found.today) == ("*ELASTIC", "*HYPERELASTIC")
    (found,) = differences(problem_of(deck, ROUTINE), problem_of(deck, ROUTINE.replace("0.9d0", "0.8d0")))
    assert (found.filed, found.today) == ("0.9d0", "0.8d0")
    (found,) = differences(problem_of(deck, ROUTINE), problem_of(deck))
    assert found.today == "nothing"
