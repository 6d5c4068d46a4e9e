"""What the springs miss, compound by compound: elastic blocks differ by their modulus alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from tread_validate.compare.quantities import tolerances
from tread_validate.hierarchy.compounds import QUANTITIES, compound_tables
from tread_validate.hierarchy.tables import CompoundDependence, CompoundError
from tread_validate.study import Case, Coulomb, load_study
from tread_validate.study.library import FOLDER

ELASTIC = "{{kind: prony, origin: published, source: for the test, long_term_modulus_MPa: {modulus}}}"


@pytest.fixture
def rig(paper_study: Path) -> Case:
    cases = load_study(paper_study).cases()
    case = next(case for case in cases if case.case_id == "rig-rectangle-22c-0p2mm-300rpm")
    return replace(case, friction=Coulomb(kind="coulomb", origin="assumed", source="test", kinetic_coefficient=0.6))


@pytest.fixture
def library(tmp_path: Path) -> Callable[..., Path]:
    def write(**moduli: float) -> Path:
        (tmp_path / FOLDER).mkdir(parents=True)
        for name, modulus in moduli.items():
            (tmp_path / FOLDER / f"{name}.yaml").write_text(ELASTIC.format(modulus=modulus), encoding="utf-8")
        return tmp_path

    return write


def test_relative_errors_of_elastic_compounds_do_not_depend_on_their_modulus(
    rig: Case, library: Callable[..., Path]
) -> None:
    """Force and stiffness scale together under Coulomb friction: ten times the modulus, the same error to 1e-6."""
    rows, dependence = compound_tables([rig], library(soft=2.0, stiff=20.0), tolerances())
    for quantity, metric in QUANTITIES:
        own = {row["compound"]: row for row in rows if (row["quantity"], row["metric"]) == (quantity, metric)}
        assert set(own) == {"surrogate", "soft", "stiff"}
        if own["soft"]["error_type"] == "relative" or metric != "scalar":
            assert own["soft"]["mean_error"] == pytest.approx(own["stiff"]["mean_error"], abs=1e-6)
        assert own["soft"]["loss_factor"] == 0.0
        assert own["stiff"]["storage_modulus_MPa"] == pytest.approx(20.0)
        assert set(own["soft"]) == set(CompoundError.header())
    assert all(set(row) == set(CompoundDependence.header()) for row in dependence)


def test_a_compound_against_itself_changes_nothing(rig: Case, library: Callable[..., Path], root: Path) -> None:
    """The study's own compound under another name: equal errors, and no assessment depends on it."""
    place = library()
    text = rig.compound.model_dump_json()
    (place / FOLDER / "twin.yaml").write_text(text, encoding="utf-8")
    rows, dependence = compound_tables([rig], place, tolerances())
    for row in dependence:
        assert row["least_mean_error"] == row["largest_mean_error"] == row["own_mean_error"]
        assert not row["depends"]
        assert row["compounds"] == 2
    assert len(rows) == 2 * len(QUANTITIES)
