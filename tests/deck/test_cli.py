"""The verbs `deck` and `lint`: files, messages and exit codes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tread_validate.cli import app

COARSE = {"deck.element_size_mm": 5.0, "deck.layers": 2}
RIG = "rig-rectangle-22c-0p2mm-300rpm"


@pytest.fixture(autouse=True)
def _verbs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(app.VERBS, "deck", "deck")
    monkeypatch.setitem(app.VERBS, "lint", "lint")


def test_one_case_gets_a_folder_of_its_own(altered_study: Callable[..., Path], tmp_path: Path) -> None:
    out = tmp_path / "fe_inputs"
    assert app.run(["deck", str(altered_study(COARSE)), "--case", RIG, "-o", str(out)]) == 0
    names = sorted(path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file())
    files = [f"{RIG}-constant-friction.inp", f"{RIG}.inp", "mesh.vtu", "vfric.f"]
    (mesh,) = (name for name in names if "/mesh-rectangle-" in name)
    assert names == sorted([mesh, *(f"{RIG}/{name}" for name in files)])
    assert app.run(["lint", str(out / RIG / f"{RIG}.inp")]) == 0


def test_free_rolling_case_gets_the_creep_that_the_spring_model_finds(
    altered_study: Callable[..., Path], tmp_path: Path
) -> None:
    """The road's speed in the deck is V0 (1 + eps), eps rounded to 1e-5: one unit in the fifth digit of speed."""
    from tread_validate.inp import expand
    from tread_validate.spring import resolve_creep
    from tread_validate.study import load_study

    study = altered_study(COARSE)
    case = "belt-simplified-60c-0p2mm-16p7mps-free"
    assert app.run(["deck", str(study), "--case", case, "-o", str(tmp_path / "out")]) == 0
    text = expand(tmp_path / "out" / case / f"{case}.inp")
    speed = float(text.split("ROAD_REF, 1, 1, ")[1].split()[0])
    (resolved,) = resolve_creep((load_study(study).case(case),))
    assert resolved.creep_ratio is not None
    assert speed == pytest.approx(16700.0 * (1.0 + resolved.creep_ratio), rel=1e-8)


def test_one_file_and_general_contact_are_options(altered_study: Callable[..., Path], tmp_path: Path) -> None:
    """All variants lint clean; in one file there is nothing to include."""
    out = tmp_path / "out"
    options = ["--single-file", "--general-contact"]
    assert app.run(["deck", str(altered_study(COARSE)), "--case", RIG, "-o", str(out), *options]) == 0
    names = sorted(path.name for path in (out / RIG).iterdir())
    variants = [f"{RIG}{kind}.inp" for kind in ("", "-constant-friction", "-general-contact")]
    assert names == sorted([*variants, "mesh.vtu", "vfric.f", "vfriction.f"])
    assert app.run(["lint", *(str(out / RIG / name) for name in variants)]) == 0
    assert "INCLUDE" not in (out / RIG / f"{RIG}.inp").read_text()
    for kind, user in (("", "vfric"), ("-constant-friction", None), ("-general-contact", "vfriction")):
        said = [line for line in (out / RIG / f"{RIG}{kind}.inp").read_text().splitlines() if "abaqus job=" in line]
        routine = "" if user is None else f" user={user}.f"
        rename = "" if user is None else f" (on Windows rename {user}.f to {user}.for)"
        assert "** HALF the block" in (out / RIG / f"{RIG}{kind}.inp").read_text()[:2000]
        assert said == [f"** Run: abaqus job={RIG}{kind}{routine} double=both{rename}"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "one of the two"),
        (["--all", "--case", RIG], "one of the two"),
        (["--case", "no-such-case"], "no such case"),
        (["--case", "../../etc"], "no such case"),
    ],
)
def test_wrong_choice_of_cases_ends_with_code_2_and_writes_nothing(
    arguments: list[str], message: str, altered_study: Callable[..., Path], tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    out = tmp_path / "out"
    assert app.run(["deck", str(altered_study(COARSE)), *arguments, "-o", str(out)]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not out.exists()


def test_lint_ends_with_code_1_for_errors_and_names_their_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "bad.inp"
    file.write_text(
        "*HEADING\nbad\n*NODE\n1, 0., 0., 0.\n*NSET, NSET=A\n1, 2\n*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n*END STEP\n"
    )
    assert app.run(["lint", str(file)]) == 1
    assert "bad.inp:6: error:" in capsys.readouterr().out


def test_lint_of_a_missing_file_ends_with_code_2(tmp_path: Path) -> None:
    assert app.run(["lint", str(tmp_path / "none.inp")]) == 2
