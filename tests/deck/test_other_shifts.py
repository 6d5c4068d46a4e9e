"""Compounds that do not shift by WLF: the deck holds the times at its own temperature, as the spring does."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate.deck.compound import material
from tread_validate.fe.material import Material, read_materials
from tread_validate.inp import read_deck
from tread_validate.material import log_shift_factor, prony_series
from tread_validate.material.abaqus_card import abaqus_card
from tread_validate.material.material_file import material_yaml, read_material
from tread_validate.spring.rubber import series_of
from tread_validate.study import ArrheniusShift, Case, FractionalZener, ShiftTable, TimeShift

ARRHENIUS = ArrheniusShift(kind="arrhenius", activation_energy_kJ_mol=95.0)
TABLE = ShiftTable(kind="table", points=((5.0, 0.9), (22.0, 0.0), (60.0, -1.4)))


def shifted_by(case: Case, law: TimeShift, temperature: float) -> Case:
    """Return the case with a compound that shifts by another law."""
    keys = case.compound.model_dump(exclude={"wlf", "shift"}) | {"shift": law.model_dump()}
    return replace(case, compound=FractionalZener.model_validate(keys), temperature=temperature)


def engine_material(case: Case, folder: Path) -> Material:
    """Return the compound of a case as the engine reads it from the deck."""
    path = folder / "material.inp"
    path.write_text("\n".join(material(case)) + "\n", encoding="utf-8")
    return read_materials(read_deck(path).blocks)["COMPOUND"]


@pytest.mark.parametrize("law", [ARRHENIUS, TABLE], ids=["arrhenius", "table"])
@pytest.mark.parametrize("temperature", [10.0, 60.0])
def test_deck_engine_and_spring_relax_at_the_same_times(
    rig_case: Case, tmp_path: Path, law: TimeShift, temperature: float
) -> None:
    """To the deck's nine digits, and there is no ``*TRS`` that would shift once more."""
    case = shifted_by(rig_case, law, temperature)
    found = engine_material(case, tmp_path)
    assert found.trs is None
    np.testing.assert_allclose(
        found.prony[:, 2] * found.shift(temperature), series_of(case).relaxation_times, rtol=1e-8
    )


def test_a_table_of_wlf_shifts_makes_the_same_compound_as_the_constants(rig_case: Case, tmp_path: Path) -> None:
    """Times at 60 degC by table and by ``*TRS``: equal to the deck's nine digits."""
    wlf = rig_case.compound.wlf
    points = tuple((t, float(log_shift_factor(t, wlf))) for t in (0.0, 22.0, 60.0))
    by_table = engine_material(shifted_by(rig_case, ShiftTable(kind="table", points=points), 60.0), tmp_path)
    by_wlf = engine_material(replace(rig_case, temperature=60.0), tmp_path)
    np.testing.assert_allclose(by_table.prony[:, 2], by_wlf.prony[:, 2] * by_wlf.shift(60.0), rtol=1e-8)


@pytest.mark.parametrize("law", [ARRHENIUS, TABLE], ids=["arrhenius", "table"])
def test_material_file_keeps_the_law_and_the_card_holds_at_one_temperature(
    rig_case: Case, tmp_path: Path, law: TimeShift
) -> None:
    series = prony_series(rig_case.compound)
    path = tmp_path / "material.yaml"
    path.write_text(material_yaml(series, law, "synthetic", "for the test", {}, {}), encoding="utf-8")
    assert read_material(path).time_shift == law
    card = abaqus_card(series, law)
    assert "*TRS" not in card
    assert "times at 22 degC only" in card
