"""A study may name raw laboratory files or finished inputs: the models get the same numbers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tread_validate.friction import law, measured_table
from tread_validate.spring import run
from tread_validate.study import load_study

COMMON = {"origin": "synthetic", "source": "test"}
RAW = {
    "compounds.surrogate": {"kind": "sweeps", "file": "reference_data/material/synthetic_sweeps.csv", **COMMON},
    "paths.mid_top": {"kind": "measured_belt", "file": "reference_data/belt/synthetic_ridges.csv", **COMMON},
    "friction_laws.road": {"kind": "huemer_file", "file": "reference_data/friction/synthetic_friction.yaml", **COMMON},
}
FINISHED = {
    **RAW,
    "compounds.surrogate": {"kind": "prony_file", "file": "reference_data/material/synthetic_material.yaml", **COMMON},
    "paths.mid_top": {"kind": "measured_belt", "file": "reference_data/belt/synthetic_belt.yaml", **COMMON},
}


def belt_case(path: Path):
    return next(c for c in load_study(path).cases() if c.path_name == "mid_top" and not c.free_rolling)


def test_raw_files_and_finished_inputs_give_the_same_pass(altered_study: Callable[..., Path]) -> None:
    """Sweeps or material file, ridges or belt file: forces of the spring model equal to 1e-4 of their peaks.

    The files keep 7 digits of the moduli and 0.1 um of the place.
    """
    raw = run(belt_case(altered_study(RAW, "raw.yaml")))
    finished = run(belt_case(altered_study(FINISHED, "finished.yaml")))
    np.testing.assert_allclose(raw.normal_force, finished.normal_force, atol=1e-4 * finished.normal_force.max())
    np.testing.assert_allclose(
        raw.tangential_force, finished.tangential_force, atol=1e-4 * np.abs(finished.tangential_force).max()
    )


def test_synthetic_laboratory_data_lead_back_to_the_assumed_inputs(
    altered_study: Callable[..., Path], paper_study: Path
) -> None:
    """The synthetic files were drawn from the study's own compound and law, so the peak force returns within 2 %.

    2 % is the noise that was put on every point; a wrong unit or shift would miss by far more.
    """
    found = run(belt_case(altered_study(RAW))).normal_force.max()
    assumed = run(belt_case(paper_study)).normal_force.max()
    assert found == pytest.approx(assumed, rel=0.02)


def test_measured_belt_carries_nearly_the_forces_of_the_simplified_one(paper_study: Path) -> None:
    """The paper's finding (section 5): one radius at the patch edges will do. Peaks within 3 %, same impulse to 3 %.

    3 % covers a patch found 1 mm shorter than it is and an edge radius of 0.56 m where 0.5 m was drawn.
    """
    cases = load_study(paper_study).cases()
    simplified, measured = (
        run(next(c for c in cases if c.path_name == name and not c.free_rolling)) for name in ("simplified", "mid_top")
    )
    assert measured.normal_force.max() == pytest.approx(simplified.normal_force.max(), rel=0.03)
    impulses = [np.trapezoid(h.normal_force, h.time) for h in (measured, simplified)]
    assert impulses[0] == pytest.approx(impulses[1], rel=0.03)


def test_table_law_is_read_by_a_study_and_its_data_are_shown(altered_study: Callable[..., Path]) -> None:
    entry = {"kind": "table", "file": "reference_data/friction/synthetic_tribometer.csv", **COMMON}
    study = load_study(altered_study({"friction_laws.road": entry}))
    built = law(study.model.friction_laws["road"], study.root)
    data = measured_table(study.model.friction_laws["road"], study.root)
    assert data is not None
    assert built.table.shape == (data.pressures.size, data.speeds.size) == (5, 8)
    assert measured_table(study.model.friction_laws["steel"], study.root) is None


def test_shipped_laboratory_study_runs_from_raw_files(root: Path) -> None:
    """`config/laboratory.yaml` names sweeps, a table and ridges; every case runs and carries a force.

    The rig's peak at 22 degC is above that at 45 degC: cooler rubber is stiffer. All inputs are marked.
    """
    cases = load_study(root / "config" / "laboratory.yaml").cases()
    peaks = {case.case_id: run(case).normal_force.max() for case in cases if not case.free_rolling}
    assert len(peaks) == 5
    rig = {c.temperature: peaks[c.case_id] for c in cases if c.path.family == "rig" and c.speed_rpm == 300.0}
    assert rig[22.0] > rig[45.0] > 10.0
    assert all(any("synthetic" in mark for mark in case.assumed()) for case in cases)
