"""``*PARAMETER``: arithmetic on names, and nothing else."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.inp import read_deck
from tread_validate.inp.parameters import assign, evaluate


def deck_of(folder: Path, text: str) -> Path:
    path = folder / "a.inp"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("2.5", 2.5),
        ("-width*(3 + 1)", -8.0),
        ("width**2/4.", 1.0),
        ("3.0*sin(30*pi/180.0)", 1.5),
        ("sqrt(width*8) + abs(-1.)", 5.0),
        ("6/3", 2),
        ("'rubber'", "rubber"),
        ("max(1, width)", 2.0),
    ],
)
def test_expressions_have_the_value_that_python_gives_them(expression: str, value: object) -> None:
    assert evaluate(expression, {"width": 2.0}) == pytest.approx(value)


@pytest.mark.parametrize(
    "expression",
    [
        "__import__('os').system('true')",
        "open('x')",
        "(lambda: 1)()",
        "[1, 2]",
        "width.real",
        "absent + 1",
        "1/2",
        "1./0.",
        "10**10**10",
        "9**99",
        "2.**5000",
        "width if width else 1",
        "'a'*1000000000",
        "(-1.)**0.5",
        "1 +",
        "f'{width}'",
        "True",
        "(" * 300 + "1" + ")" * 300,
        "1" * 2000,
        "sqrt(-1)",
        "sqrt(1, 2, 3)",
    ],
)
def test_whatever_is_not_simple_arithmetic_is_refused_in_a_few_words(expression: str) -> None:
    """Calls, attributes, containers, conditions, unknown names, integers whose quotient depends on the release."""
    with pytest.raises(ValueError, match=r".") as fault:
        evaluate(expression, {"width": 2.0})
    assert "\n" not in str(fault.value)
    assert len(str(fault.value)) < 200


@given(st.text(max_size=40))
def test_no_line_makes_the_evaluator_do_anything_but_refuse(text: str) -> None:
    known: dict[str, float | int | str] = {}
    try:
        assign(text, known)
    except ValueError:
        return
    assert all(isinstance(v, str) or math.isfinite(v) for v in known.values())


def test_names_in_angle_brackets_are_replaced_in_data_and_in_keyword_lines(tmp_path: Path) -> None:
    """In one definition after another; comments and the heading stay as they are."""
    deck = read_deck(
        deck_of(
            tmp_path,
            "*HEADING\n<left> alone\n*PARAMETER\nE = 5.25 # MPa\n** a remark\nnu=0.47\nname = 'soft'\n"
            "*MATERIAL, NAME=<name>\n*ELASTIC\n<E>, < nu >\n*PARAMETER\ndouble = 2*E\n*DENSITY\n<double>,\n",
        )
    )
    assert [block.keyword for block in deck.written] == [
        "HEADING", "PARAMETER", "MATERIAL", "ELASTIC", "PARAMETER", "DENSITY",
    ]  # fmt: skip
    heading, material, elastic, density = deck.blocks
    assert heading.data[0].text == "<left> alone"
    assert material.value("NAME") == "SOFT"
    assert elastic.data[0].fields == ("5.25", "0.47")
    assert density.data[0].fields == ("10.5",)
    assert deck.parameters == {"E": 5.25, "nu": 0.47, "name": "soft", "double": 10.5}


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("*PARAMETER\na = b\n", 2),
        ("*PARAMETER\na = 1\nimport os\n", 3),
        ("*PARAMETER\na = __import__('os')\n", 2),
        ("*PARAMETER\na = 1.\n*ELASTIC\n<A>, 0.3\n", 4),
        ("*MATERIAL, NAME=<what>\n", 1),
    ],
)
def test_faults_of_parameters_name_their_line(text: str, line: int, tmp_path: Path) -> None:
    """Names tell upper from lower case, as the language of their expressions does."""
    with pytest.raises(InputError, match=rf"a\.inp:{line}\b") as fault:
        read_deck(deck_of(tmp_path, text))
    assert str(fault.value).count("\n") == 0
