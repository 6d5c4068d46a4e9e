"""The two forms of a deck: with parameters and include files, and in one file."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tread_validate import deck
from tread_validate.deck.lint import lint
from tread_validate.errors import InputError
from tread_validate.fe import run_deck
from tread_validate.inp import differences, problem_of, read_deck
from tread_validate.study import Case

Coarse = Callable[[Case], Case]
KINDS = ["rig_case", "belt_case", "trace_case"]


@pytest.fixture(params=KINDS)
def case(request: pytest.FixtureRequest, coarse: Coarse) -> Case:
    return coarse(request.getfixturevalue(request.param))


def test_both_forms_pose_one_problem(case: Case, tmp_path: Path) -> None:
    """The same lines with the same numbers, to 1e-6: parameters are evaluated and the block is put in place."""
    problems = []
    for form in (False, True):
        folder = tmp_path / str(form)
        deck.write(case, folder, single_file=form)
        problems.append(problem_of(folder / f"{case.case_id}.inp"))
    assert list(differences(*problems)) == []


def test_a_decks_own_part_is_short_and_the_whole_has_no_line_for_a_nodes_velocity(
    request: pytest.FixtureRequest,
) -> None:
    """At most 300 lines on the study's own mesh; mesh lines are nodes, elements and sets."""
    for kind in KINDS:
        case = request.getfixturevalue(kind)
        built = deck.build(case)
        assert built.input_text.count("\n") <= 300
        mesh = next(text for name, text in built.includes.items() if name.startswith("mesh-"))
        assert mesh.count("\n") < 1.2 * (built.points.shape[0] + built.elements.shape[0])


def test_cases_of_one_block_share_its_mesh_file(cases: tuple[Case, ...], coarse: Coarse) -> None:
    """Temperature, interference, speed and friction change nothing in it: one file a block and kind of mount."""
    meshes: dict[tuple[str, str], set[str]] = {}
    for one in cases:
        names = deck.build(coarse(one)).includes
        meshes.setdefault((one.block_name, one.path_name), set()).update(n for n in names if n.startswith("mesh-"))
    assert all(len(names) == 1 for names in meshes.values())
    assert len(meshes) == 4


@pytest.mark.parametrize("kind", ["rig_case", "belt_case"])
def test_changing_speed_and_interference_by_hand_is_the_deck_of_that_speed_and_interference(
    kind: str, request: pytest.FixtureRequest, coarse: Coarse, tmp_path: Path
) -> None:
    """10 % faster and 15 % deeper: peaks to 0.1 %, every instant to 1 % of the peak (measured 0.005 % and 0.5 %).

    What is left is the lead-in, which a change of speed shortens, and the first contact, taken to second order.
    """
    case = coarse(request.getfixturevalue(kind))
    case = replace(case, deck=case.deck.model_copy(update={"symmetry": "full"}))  # no sample meets a row's impact
    other = replace(case, speed=1.1 * case.speed, interference=1.15 * case.interference)
    deck.write(case, tmp_path / "a")
    deck.write(other, tmp_path / "b")
    text = (tmp_path / "a" / f"{case.case_id}.inp").read_text()
    for name, factor in (("speed", 1.1), ("interference", 1.15)):
        text, count = re.subn(rf"\n{name} = (.*)", lambda m, f=factor, n=name: f"\n{n} = {f * float(m[1])!r}", text)
        assert count == 1
    (tmp_path / "a" / "hand.inp").write_text(text)
    hand = run_deck(tmp_path / "a" / "hand.inp", tmp_path / "a" / "vfric.f").history
    made = run_deck(tmp_path / "b" / f"{other.case_id}.inp", tmp_path / "b" / "vfric.f").history
    peak = made.normal_force.max()
    assert hand.normal_force.max() == pytest.approx(peak, rel=1e-3)
    force = np.interp(made.time, hand.time, hand.normal_force)
    assert np.abs(force - made.normal_force).max() < 0.01 * peak


def test_half_a_block_gives_the_forces_of_the_whole(belt_case: Case, coarse: Coarse, tmp_path: Path) -> None:
    """The plane z = 0 is one of symmetry: at one and the same increment what is left is the order of sums, 1e-9."""
    results = []
    for symmetry in ("full", "half"):
        case = coarse(belt_case)
        case = replace(case, deck=case.deck.model_copy(update={"element_size_mm": 2.5, "symmetry": symmetry}))
        deck.write(case, tmp_path / symmetry)
        file = tmp_path / symmetry / f"{case.case_id}.inp"
        assert lint(file) == []
        text = file.read_text().replace("*DYNAMIC, EXPLICIT", "*DYNAMIC, EXPLICIT, DIRECT USER CONTROL")
        file.write_text(re.sub(r"^, <(\w+)_time>", r"4.E-6, <\1_time>", text, flags=re.MULTILINE))
        results.append(run_deck(tmp_path / symmetry / f"{case.case_id}.inp", tmp_path / symmetry / "vfric.f"))
    full, half = results
    assert 2 * half.record["elements"] == full.record["elements"]
    scale = full.history.normal_force.max()
    for name in ("normal_force", "tangential_force"):
        np.testing.assert_allclose(getattr(half.history, name), getattr(full.history, name), atol=1e-8 * scale)
    np.testing.assert_allclose(half.energies.iloc[-1, 1:], full.energies.iloc[-1, 1:], rtol=1e-6, atol=1e-12)
    road = [result.nodes[["rf_x_N", "rf_y_N"]].to_numpy() for result in results]
    np.testing.assert_allclose(road[1], road[0], atol=1e-6 * scale)
    faces = [result.face.round(9).sort_values(["x_m", "z_m"]).to_numpy() for result in results]
    np.testing.assert_allclose(faces[1], faces[0], rtol=1e-5, atol=1e-5 * faces[0].max())


def test_a_study_models_rectangles_by_halves_and_parallelograms_whole(cases: tuple[Case, ...]) -> None:
    """`auto`, which the paper's study states."""
    for case in {one.block_name: one for one in cases}.values():
        whole = replace(case, deck=case.deck.model_copy(update={"symmetry": "full"}))
        elements = [deck.build(one).elements.shape[0] for one in (case, whole)]
        assert elements[1] == (1 if case.block.shape == "parallelogram" else 2) * elements[0]


@pytest.mark.parametrize("changes", [{"shape": "parallelogram", "skew_deg": 20.0}])
def test_half_of_a_block_without_a_plane_of_symmetry_is_refused(
    changes: dict[str, Any], belt_case: Case, coarse: Coarse
) -> None:
    case = coarse(belt_case)
    block = type(case.block).model_validate({**case.block.model_dump(), **changes})
    settings = case.deck.model_copy(update={"symmetry": "half"})
    with pytest.raises(InputError, match="symmetry"):
        deck.build(replace(case, block=block, deck=settings))


def test_a_deck_written_anew_leaves_no_old_include_behind(belt_case: Case, coarse: Coarse, tmp_path: Path) -> None:
    """Another mesh has another name; the old file goes, files of the user stay."""
    (tmp_path / "mesh-of-mine.inp").write_text("*NODE\n")
    for size in (5.0, 4.0):
        case = replace(belt_case, deck=belt_case.deck.model_copy(update={"element_size_mm": size, "layers": 2}))
        deck.write(case, tmp_path)
    names = [path.name for path in tmp_path.glob("mesh-*.inp")]
    assert len(names) == 2
    assert "mesh-of-mine.inp" in names


def test_general_contact_names_the_two_surfaces_and_the_other_routine(
    rig_case: Case, coarse: Coarse, tmp_path: Path
) -> None:
    case = coarse(rig_case)
    deck.write(case, tmp_path, general_contact=True)
    file = tmp_path / f"{case.case_id}-general-contact.inp"
    assert lint(file) == []
    read = read_deck(file)
    assert not list(read.named("CONTACT PAIR"))
    assert next(read.named("FRICTION")).value("USER") == "FRICTION"
    assert next(read.named("CONTACT INCLUSIONS")).data[0].fields == ("FACE", "ROAD")
