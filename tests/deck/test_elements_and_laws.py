"""Study options of the block's elements and elasticity: the default deck, C3D8, and neo-Hookean rubber."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate import deck
from tread_validate.calculix import dialect, read_elastic_deck
from tread_validate.deck.lint import lint
from tread_validate.fe import run_deck
from tread_validate.fe.model import read_model
from tread_validate.inp import read_deck
from tread_validate.spring.cautions import cautions
from tread_validate.study import Case, Coulomb, DeckSettings, PronyCompound

COARSE = DeckSettings(element_size_mm=5.0, layers=2)
RUN = DeckSettings(element_size_mm=2.5, layers=3)
PARTS = """*HEADING
a bar under its own weight
*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8R, ELSET=BAR
1, 1, 2, 3, 4, 5, 6, 7, 8
*SOLID SECTION, ELSET=BAR, MATERIAL=RUBBER
,
*MATERIAL, NAME=RUBBER
*DENSITY
1e-9,
{law}
*STEP
*DYNAMIC, EXPLICIT
, 1e-3
*END STEP
"""


def neo_hookean(case: Case) -> Case:
    return replace(case, compound=case.compound.model_copy(update={"elasticity": "neo_hooke"}))


def with_element(case: Case, element: str) -> Case:
    return replace(case, deck=case.deck.model_copy(update={"element": element}))


def written(case: Case, folder: Path) -> Path:
    deck.write(case, folder)
    return folder / f"{case.case_id}.inp"


def peak(case: Case, folder: Path) -> float:
    return float(run_deck(written(case, folder), folder / "vfric.f").history.normal_force.max())


def test_naming_the_default_element_and_law_changes_neither_deck_nor_digest(rig_case: Case) -> None:
    case = replace(rig_case, deck=COARSE)
    named = replace(
        case,
        deck=DeckSettings.model_validate({**COARSE.model_dump(exclude_unset=True), "element": "C3D8R"}),
        compound=type(case.compound).model_validate({**case.compound.model_dump(), "elasticity": "linear"}),
    )
    assert named.digest() == case.digest()
    assert deck.build(named).files == deck.build(case).files
    assert with_element(case, "C3D8").digest() != case.digest()
    assert with_element(case, "C3D8").problem_digest() == case.problem_digest()
    assert neo_hookean(case).problem_digest() != case.problem_digest()


def test_neo_hookean_constants_are_the_moduli_of_the_linear_deck_at_no_strain(rig_case: Case, tmp_path: Path) -> None:
    """C10 = G_0/2 and D1 = 2/K_0 to the ten digits of a deck; the Prony series is the same."""
    case = replace(rig_case, deck=COARSE)
    linear, hyper = (
        read_model(written(one, tmp_path / name)).sections[0].material
        for one, name in ((case, "linear"), (neo_hookean(case), "hyper"))
    )
    assert hyper.neo_hookean
    assert not linear.neo_hookean
    np.testing.assert_allclose(hyper.shear_and_bulk(), linear.shear_and_bulk(), rtol=1e-9)
    np.testing.assert_array_equal(hyper.prony, linear.prony)
    assert hyper.trs == linear.trs
    text = read_deck(tmp_path / "hyper" / f"{case.case_id}.inp")
    assert not list(text.named("ELASTIC"))
    (block,) = text.named("HYPERELASTIC")
    assert block.parameters == {"NEO HOOKE": None, "MODULI": "INSTANTANEOUS"}


@pytest.mark.parametrize("single_file", [False, True])
@pytest.mark.parametrize("kind", ["rig_case", "belt_case"])
def test_decks_of_either_element_and_law_are_clean(
    kind: str, single_file: bool, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    case = neo_hookean(with_element(replace(request.getfixturevalue(kind), deck=COARSE), "C3D8"))
    deck.write(case, tmp_path, single_file=single_file, general_contact=True)
    for path in (p for p in tmp_path.glob("*.inp") if p.stem.startswith(case.case_id)):
        assert [str(one) for one in lint(path)] == []
        elements = list(read_deck(path).named("ELEMENT"))
        assert [block.value("TYPE") for block in elements] == ["C3D8"]


def test_neo_hookean_rubber_carries_less_the_deeper_it_is_pressed(rig_case: Case, tmp_path: Path) -> None:
    """Peak N on the rig, coarse mesh: below 0.5 % at D/h = 0.0125, 1 to 3.5 % less at 0.1 (docs: -0.32, -2.07 %)."""
    change = {}
    for depth in (0.1e-3, 0.8e-3):
        case = replace(rig_case, deck=RUN, interference=depth)
        change[depth] = (
            peak(neo_hookean(case), tmp_path / f"hyper{depth}") / peak(case, tmp_path / f"linear{depth}") - 1.0
        )
    assert -0.005 < change[0.1e-3] < 0.0
    assert -0.035 < change[0.8e-3] < -0.01


def test_fully_integrated_elements_store_no_artificial_energy_and_are_a_little_stiffer(
    rig_case: Case, tmp_path: Path
) -> None:
    """C3D8 on the same coarse mesh: no hourglass energy, peak N up to a tenth higher."""
    case = replace(rig_case, deck=RUN)
    results = {}
    for kind in ("C3D8R", "C3D8"):
        path = written(with_element(case, kind), tmp_path / kind)
        results[kind] = run_deck(path, path.parent / "vfric.f")
    full, one = (results[kind].history.normal_force.max() for kind in ("C3D8", "C3D8R"))
    assert 1.0 < full / one < 1.1
    assert results["C3D8"].record["energy_balance"]["artificial_share"] == 0.0
    assert results["C3D8R"].record["energy_balance"]["artificial_share"] > 0.0


def elastic(case: Case) -> Case:
    compound = PronyCompound(
        origin="assumed", source="test", kind="prony", long_term_modulus_MPa=16.0, poissons_ratio=0.45
    )
    law = Coulomb(origin="assumed", source="test", kind="coulomb", static_coefficient=0.5, kinetic_coefficient=0.5)
    return replace(case, compound=compound, friction=law, deck=COARSE)


def test_calculix_is_given_the_constants_and_the_elements_of_the_deck(rig_case: Case, tmp_path: Path) -> None:
    """The linear deck is translated with the neo-Hookean law of its moduli; the other deck names that law itself."""
    case = elastic(rig_case)
    texts = {}
    for name, one in (("linear", case), ("hyper", neo_hookean(case)), ("full", with_element(case, "C3D8"))):
        path = written(one, tmp_path / name)
        found = read_elastic_deck(path, path.parent / "vfric.f")
        texts[name] = dialect(found)
        assert found.neo_hookean == (name == "hyper")
        assert found.kind == ("C3D8" if name == "full" else "C3D8R")
    assert texts["hyper"] == texts["linear"]
    assert texts["full"] == texts["linear"].replace("TYPE=C3D8R", "TYPE=C3D8")
    constants = texts["hyper"].split("NEO HOOKE\n")[1].splitlines()[0]
    shear, bulk = 16.0 / 2.9, 16.0 / 0.3
    np.testing.assert_allclose([float(v) for v in constants.split(",")], [0.5 * shear, 2.0 / bulk], rtol=1e-8)


def test_spring_models_say_that_they_stay_linear(rig_case: Case) -> None:
    assert not [text for text in cautions(rig_case, "condensed") if "neo-Hookean" in text]
    for variant in ("paper", "shape_factor", "condensed"):
        assert any("linear viscoelastic" in text for text in cautions(neo_hookean(rig_case), variant))


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        ("*HYPERELASTIC, NEO HOOKE\n2., 0.06", set()),
        ("*Hyperelastic, neohooke, moduli=instantaneous\n2., 0.06\n*VISCOELASTIC, TIME=PRONY\n.2, .2, .1", set()),
        ("*HYPERELASTIC, NEO HOOKE\n-2., 0.06", {("TV305", 20, "error")}),
        ("*HYPERELASTIC, NEO HOOKE\n2., -0.06", {("TV305", 20, "error")}),
        ("*HYPERELASTIC, NEO HOOKE\n2.,", {("TV309", 20, "warning")}),
        ("*HYPERELASTIC, NEO HOOKE\n2., 0.001", {("TV309", 20, "warning")}),
        ("*HYPERELASTIC, NEO HOOKE\n2., 1.", {("TV309", 20, "warning")}),
        ("*HYPERELASTIC, NEO HOOKE\n2., 0.06\n*VISCOELASTIC, TIME=PRONY\n.2, .2, .1", {("TV310", 19, "note")}),
        ("*ELASTIC\n6., .47\n*HYPERELASTIC, NEO HOOKE\n2., 0.06", {("TV308", 21, "error")}),
        ("*HYPERELASTIC, NEO HOOK E\n2., word", {("TV009", 20, "error")}),
    ],
)
def test_constants_of_a_hyperelastic_law_are_judged_at_their_line(
    law: str, expected: set[tuple[str, int, str]], tmp_path: Path
) -> None:
    path = tmp_path / "bar.inp"
    path.write_text(PARTS.format(law=law))
    assert {(one.code, one.line, one.severity) for one in lint(path)} == expected
