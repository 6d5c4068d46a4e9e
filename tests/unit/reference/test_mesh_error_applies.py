"""A mesh error is that of one engine, element size, block and kind of path; elsewhere the uncertainty is unknown."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tread_validate.reference.mesh_errors import MeshErrors, document, file_mesh_study, write_mesh_study
from tread_validate.study import load_study

ERRORS = {"peak_normal_force": 0.012, "normal_impulse": 0.011}


@pytest.fixture
def cases(root: Path):
    return load_study(root / "config" / "study.yaml").cases()


def test_a_study_of_twice_the_element_size_does_not_get_the_mesh_error_of_the_finer_one(cases, tmp_path):
    """Known for the runs it was made on; not for 2 mm, another engine, the other block or a belt path."""
    case = next(case for case in cases if case.path.family == "rig" and case.block.shape == "rectangle")
    record = {"engine": "embedded", "code": "0" * 16, "deck_digest": "0" * 64, "history_sha256": "0" * 64}
    numbers = {"mesh_error": ERRORS, "quantities": {}}
    write_mesh_study(tmp_path / "made.yaml", document(case, "liu2010", [record] * 3, [2.0, 1.4, 1.0], numbers))
    file_mesh_study(tmp_path / "mesh", tmp_path / "made.yaml")
    found = MeshErrors(tmp_path / "mesh")
    size = case.deck.element_size_mm
    coarse = replace(case, deck=case.deck.model_copy(update={"element_size_mm": 2.0 * size}))
    other_block = next(one for one in cases if one.path.family == "rig" and one.block.shape != "rectangle")
    belt = next(one for one in cases if one.path.family == "belt")
    assert found.error(case, "embedded") == ERRORS
    assert found.error(replace(case, speed=2.0 * case.speed), "embedded") == ERRORS
    assert found.error(coarse, "embedded") is None
    assert found.error(case, "abaqus") is None
    assert found.error(other_block, "embedded") is None
    assert found.error(belt, "embedded") is None
