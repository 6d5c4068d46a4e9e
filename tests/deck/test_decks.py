"""What a deck says, that it says the same twice, and what it refuses."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from tread_validate import __version__, deck
from tread_validate.deck.keywords import comment, keyword, number
from tread_validate.deck.model import INCLUDED
from tread_validate.errors import InputError
from tread_validate.fe.model import read_model
from tread_validate.inp import Deck, KeywordBlock, read_deck
from tread_validate.material import prony_series
from tread_validate.study import Case, load_study

Coarse = Callable[[Case], Case]


def _back(case: Case, folder: Path) -> Deck:
    deck.write(case, folder)
    return read_deck(folder / f"{case.case_id}.inp")


def _one(text: Deck, name: str) -> KeywordBlock:
    (block,) = text.named(name)
    return block


def test_deck_opens_with_units_case_study_and_version(rig_case: Case, coarse: Coarse) -> None:
    text = deck.build(coarse(rig_case)).input_text.splitlines()
    assert text[:2] == ["*HEADING", rig_case.case_id]
    head = "\n".join(text[:16])
    for part in ("mm, tonne, s, MPa, N", rig_case.case_id, rig_case.study_digest, f"tread-validate {__version__}"):
        assert part in head
    for item in rig_case.assumed():
        assert f"** ASSUMED INPUT: {item}" in head


def test_same_study_gives_the_same_bytes(belt_case: Case, coarse: Coarse, tmp_path: Path) -> None:
    case = coarse(belt_case)
    for folder in ("one", "two"):
        deck.write(case, tmp_path / folder)
    names = sorted(path.name for path in (tmp_path / "one").iterdir())
    included = [name for name in names if INCLUDED.fullmatch(name)]
    assert [name.split("-")[0] for name in included] == ["mesh", "motion"]
    own = [f"{case.case_id}.inp", f"{case.case_id}-constant-friction.inp", "vfric.f", "mesh.vtu"]
    assert names == sorted([*included, *own])
    for name in names:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_free_text_of_a_study_never_reaches_a_deck(altered_study: Callable[..., Path], coarse: Coarse) -> None:
    """A title, a note and a source with keywords in them: no line of the deck has them, as comment or otherwise."""
    path = altered_study(
        {
            "title": "*BOUNDARY, OP=NEW",
            "notes": ["*INCLUDE, INPUT=secret"],
            "blocks.rectangle.source": "*MATERIAL, NAME=X",
            "compounds.surrogate.source": "** *STEP",
        }
    )
    text = deck.build(coarse(load_study(path).cases()[0])).input_text
    for intruder in ("OP=NEW", "secret", "NAME=X", "** *STEP"):
        assert intruder not in text


def test_comment_cannot_become_a_line_of_its_own() -> None:
    """Line breaks of every kind are folded, long text is cut below the language's 256 characters."""
    for text in ("a\n*STEP", "a\r*STEP", "a\u2028*STEP", "a\x0b*STEP", "a\x85*STEP"):
        assert len(comment(text).splitlines()) == 1
    assert len(comment("x" * 1000)) <= 256


def test_compound_is_instantaneous_with_one_ratio_for_shear_and_bulk(
    rig_case: Case, coarse: Coarse, tmp_path: Path
) -> None:
    """g_i = k_i = E_i/E_0 (10 digits), E_0 in MPa, density 1e-9 tonne/mm3, *TRS 22., 7.9241, 113.6 (four decimals)."""
    text = _back(coarse(rig_case), tmp_path)
    series = prony_series(rig_case.compound, rig_case.root)
    elastic = _one(text, "ELASTIC")
    assert elastic.parameters == {"MODULI": "INSTANTANEOUS"}
    assert [float(v) for v in elastic.data[0].fields] == pytest.approx([series.instantaneous_modulus * 1e-6, 0.47])
    assert float(_one(text, "DENSITY").data[0].fields[0]) == pytest.approx(1e-9)
    terms = np.array([[float(v) for v in line.fields] for line in _one(text, "VISCOELASTIC").data])
    np.testing.assert_array_equal(terms[:, 0], terms[:, 1])
    np.testing.assert_allclose(terms[:, 0], series.moduli / series.instantaneous_modulus, rtol=1e-9)
    np.testing.assert_allclose(terms[:, 2], series.relaxation_times, rtol=1e-8)
    assert [round(float(v), 4) for v in _one(text, "TRS").data[0].fields] == [22.0, 7.9241, 113.6]
    condition = next(block for block in text.named("INITIAL CONDITIONS") if block.value("TYPE") == "TEMPERATURE")
    assert (condition.data[0].fields[0], condition.data[0].number_at(1, "a temperature")) == ("BLOCK_NODES", 22.0)


def test_temperature_is_a_field_and_the_compound_stays_referred_to_its_data(
    cases: tuple[Case, ...], coarse: Coarse, tmp_path: Path
) -> None:
    """22 and 45 degC differ in the temperature line alone, the interference and the speed being the same."""
    cold, warm = (next(c for c in cases if c.case_id == f"rig-rectangle-{t}-0p2mm-300rpm") for t in ("22c", "45c"))
    texts = [deck.build(coarse(case)).input_text.splitlines() for case in (cold, warm)]
    differ = [(a, b) for a, b in zip(*texts, strict=True) if a != b and not a.startswith("**")]
    assert differ == [(cold.case_id, warm.case_id), ("temperature = 22.", "temperature = 45.")]


def test_constant_friction_variant_differs_in_the_friction_alone(rig_case: Case, coarse: Coarse) -> None:
    built = deck.build(coarse(rig_case))
    assert built.constant_friction_text is not None
    user, constant = (
        re.split(r"(?:\*\* Variant.*\n)?\*SURFACE INTERACTION, NAME=TREAD_ROAD\n", text)
        for text in (
            re.sub(r"(?m)^.*double=both.*\n", "", one) for one in (built.input_text, built.constant_friction_text)
        )
    )  # the line with the command that runs each names its own job
    assert user[0] == constant[0]
    ending = "*INITIAL CONDITIONS, TYPE=TEMPERATURE"
    assert user[1].split(ending, 1)[1] == constant[1].split(ending, 1)[1]
    assert constant[1].split(ending)[0] == "*FRICTION\n<friction_static>,\n"
    silent = replace(coarse(rig_case), deck=rig_case.deck.model_copy(update={"constant_friction_variant": False}))
    assert deck.build(silent).constant_friction_text is None


def test_pass_begins_at_the_first_contact_and_alone_is_recorded(
    belt_case: Case, coarse: Coarse, tmp_path: Path
) -> None:
    """Two steps, 2 ms without contact and the pass; contact, energy and reaction histories in the second only."""
    text = _back(coarse(belt_case), tmp_path)
    names = [block.keyword for block in text.blocks]
    assert [block.value("NAME") for block in text.named("STEP")] == ["APPROACH", "PASS"]
    assert float(next(text.named("DYNAMIC")).data[0].fields[1]) == 2e-3
    second = len(names) - 1 - names[::-1].index("STEP")
    history = [
        index for index, block in enumerate(text.blocks) if block.keyword == "OUTPUT" and "HISTORY" in block.parameters
    ]
    assert history
    assert min(history) > second
    requested = {field for line in text.blocks[history[0] + 1].data for field in line.fields}
    assert requested == {"CFN", "CFS"}
    pair = _one(text, "CONTACT PAIR")
    assert pair.parameters["MECHANICAL CONSTRAINT"] == "KINEMATIC"
    assert names.index("CONTACT PAIR") < second, "contact is defined in the first step and goes on in the second"


def test_mesh_file_holds_the_nodes_and_bricks_of_the_deck(rig_case: Case, coarse: Coarse, tmp_path: Path) -> None:
    built = deck.write(coarse(rig_case), tmp_path)
    grid = meshio.read(tmp_path / "mesh.vtu")
    np.testing.assert_allclose(grid.points, built.points, rtol=0.0, atol=5.1e-7)  # written to 1e-6 mm
    np.testing.assert_array_equal(grid.cells_dict["hexahedron"], built.elements)


def test_meshio_reads_nodes_and_sets_back_from_the_deck(rig_case: Case, coarse: Coarse, tmp_path: Path) -> None:
    """An open reader finds the same coordinates (written to 1e-5 mm) and the same bricks."""
    case = coarse(rig_case)
    built = deck.build(case, single_file=True)
    only_mesh = built.input_text.split("*SURFACE, TYPE=ELEMENT")[0]
    (tmp_path / "mesh.inp").write_text(only_mesh)
    grid = meshio.read(tmp_path / "mesh.inp", file_format="abaqus")
    np.testing.assert_allclose(grid.points, built.points, rtol=0.0, atol=6e-6)
    np.testing.assert_array_equal(grid.cells[0].data, built.elements)


def test_unresolved_creep_is_refused(cases: tuple[Case, ...]) -> None:
    free = replace(next(case for case in cases if case.free_rolling), creep_ratio=None)
    with pytest.raises(InputError, match="creep"):
        deck.build(free)


@pytest.mark.parametrize(
    "changes",
    [
        {"mounting": "flat"},
        {"shape": "parallelogram", "skew_deg": -20.0},
        {"sipes": [{"position_mm": 8.0, "width_mm": 1.0}, {"position_mm": 16.0, "width_mm": 1.0}]},
    ],
)
@pytest.mark.parametrize("kind", ["rig_case", "belt_case"])
def test_every_kind_of_block_gives_a_clean_deck_on_rig_and_belt(
    kind: str, changes: dict[str, Any], request: pytest.FixtureRequest, coarse: Coarse, tmp_path: Path
) -> None:
    from tread_validate.deck.lint import lint

    case = coarse(request.getfixturevalue(kind))
    block = type(case.block).model_validate({**case.block.model_dump(), "mounting": "conforming", **changes})
    case = replace(case, block=block)
    deck.write(case, tmp_path)
    assert lint(tmp_path / f"{case.case_id}.inp") == []


def test_numbers_fit_the_fields_of_the_language() -> None:
    """At most 20 characters, always with a point or an exponent; read back to the digits asked for."""
    for value in (0.0, -0.0, 1.0, -1e-12, 123456789.123456, -1.23456789e-30, 1e22, 7.0 / 3.0):
        for digits in (9, 12, 13):
            text = number(value, digits)
            assert len(text) <= 20
            assert re.fullmatch(r"-?\d+\.\d*(e[+-]\d+)?|-?\d+e[+-]\d+", text)
            assert float(text) == pytest.approx(value, rel=10.0 ** (1 - digits))


def test_keyword_line_spells_parameters_with_blanks() -> None:
    assert keyword("RIGID BODY", REF_NODE="A", TIE_NSET="B") == "*RIGID BODY, REF NODE=A, TIE NSET=B"


def test_an_hourglass_control_that_the_embedded_engine_refuses_is_said_in_the_deck(
    rig_case: Case, coarse: Coarse, tmp_path: Path
) -> None:
    """ENHANCED is ABAQUS's: the deck says so above it, and the engine names the line."""
    case = coarse(rig_case)
    case = replace(case, deck=case.deck.model_copy(update={"hourglass": "ENHANCED"}))
    deck.write(case, tmp_path)
    text = (tmp_path / f"{case.case_id}.inp").read_text().splitlines()
    line = next(i for i, one in enumerate(text) if "HOURGLASS=ENHANCED" in one and one.startswith("*SECTION"))
    assert "does not run HOURGLASS=ENHANCED" in text[line - 1]
    with pytest.raises(InputError, match=rf"inp:{line + 1}: \*SECTION CONTROLS, HOURGLASS"):
        read_model(tmp_path / f"{case.case_id}.inp")
