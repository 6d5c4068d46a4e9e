"""`tread-validate fe` from the outside: what a user meets with decks of his own."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import pandas as pd
import pytest

from tread_validate.cli.app import run

RAMP = "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., 2e-3, 1.\n"


def held(fe: ModuleType) -> str:
    """A cube of 2 mm on smooth supports, its crown free."""
    return (
        fe.brick(1, 1, 1, 2.0, 2.0, 2.0).text() + fe.elastic(10.0, 0.0, 1e-9, "*DAMPING, BETA=2e-5\n")
        + "*ELSET, ELSET=HIGH\n1,\n*SURFACE, TYPE=ELEMENT, NAME=CROWN\nHIGH, S2\n" + RAMP
        + "*BOUNDARY\nBOT, 3, 3\nALL, 1, 2\n"
    )  # fmt: skip


def pressed(fe: ModuleType, friction: str) -> str:
    """A cube of 2 mm pressed by 0.1 mm on a plane."""
    return (
        fe.brick(1, 1, 1, 2.0, 2.0, 2.0).text() + fe.elastic(10.0, 0.0, 1e-9) + fe.plane() + friction + RAMP
        + "*BOUNDARY\nROADREF, 1, 6\nTOP, 1, 2\n"
        + fe.step(2e-3, "*BOUNDARY, AMPLITUDE=A\nTOP, 3, 3, -0.1\n", fe.CONTACT)
    )  # fmt: skip


def call(folder: Path, text: str, *more: str) -> int:
    """Run the verb on a deck's text."""
    (folder / "deck.inp").write_text(text, encoding="utf-8")
    return run(["fe", str(folder / "deck.inp"), "-o", str(folder / "out.csv"), *more])


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("*DSLOAD, AMPLITUDE=A\nCROWN, P, 1e-3\n", "*DSLOAD\nCROWN, P, 2e-3\n"),
        ("*DLOAD, AMPLITUDE=A\nHIGH, P2, 1e-3\n", "*DLOAD\nHIGH, P2, 2e-3\n"),
        ("*CLOAD, AMPLITUDE=A\nTOP, 3, -1e-3\n", "*CLOAD\nTOP, 3, -2e-3\n"),
        ("*DSLOAD, AMPLITUDE=A\nCROWN, P, 1e-3\n", "*DSLOAD, AMPLITUDE=A\nCROWN, P, 2e-3\n"),
    ],
    ids=["DSLOAD", "DLOAD", "CLOAD", "amplitude in step time in both"],
)
def test_load_of_a_later_step_replaces_the_first_and_the_support_carries_the_second_alone(
    tmp_path: Path, fe: ModuleType, first: str, second: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """2e-3 MPa on 4 mm2, or 2e-3 N at four nodes: 8e-3 N at the support, within 0.1 %; not the sum of 12e-3."""
    assert call(tmp_path, held(fe) + fe.step(1e-2, first) + fe.step(1e-2, second)) == 0
    last = pd.read_csv(tmp_path / "out_reactions.csv").iloc[-1]
    assert last.reaction_z_N == pytest.approx(8e-3, rel=1e-3)
    assert "no contact in the last step" in capsys.readouterr().out


def test_normal_force_of_a_deck_upright_in_z_is_found_on_its_road(
    tmp_path: Path, fe: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    """N in the file is the contact force along z, E A d/h = 2 N in the end, within 5 % (finite strain)."""
    assert call(tmp_path, pressed(fe, fe.coulomb(0.5))) == 0
    assert "along +z (travel +x)" in capsys.readouterr().out
    history = pd.read_csv(tmp_path / "out.csv", comment="#")
    contact = pd.read_csv(tmp_path / "out_contact.csv")
    assert history.iloc[:, 1].to_numpy() == pytest.approx(contact.cfn_z_N.to_numpy(), abs=1e-4)
    assert contact.cfn_z_N.iloc[-1] == pytest.approx(2.0, rel=0.05)


def test_a_missing_friction_routine_is_refused_with_its_line(
    tmp_path: Path, fe: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    """The line of *FRICTION, and nothing written."""
    text = pressed(fe, fe.user_friction(0.5))
    line = text[: text.index("*FRICTION")].count("\n") + 1
    assert call(tmp_path, text) == 2
    assert f"deck.inp:{line}: got *FRICTION, USER and no user routine" in capsys.readouterr().err
    assert not (tmp_path / "out.csv").exists()
