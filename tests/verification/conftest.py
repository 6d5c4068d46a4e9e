"""Fixtures of the verification tests."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tread_validate.study import Case, Coulomb, PronyCompound, load_study

BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"
RIG = "rig-rectangle-22c-0p2mm-300rpm"


@pytest.fixture(scope="session")
def study_cases(paper_study: Path) -> dict[str, Case]:
    """Every case of the paper's study by its id, free-rolling ones unresolved."""
    return {case.case_id: case for case in load_study(paper_study).cases()}


@pytest.fixture(scope="session")
def spring_case(study_cases: dict[str, Case]) -> Callable[..., Case]:
    """Return a case of the study with some of its inputs replaced.

    ``modulus`` (Pa) makes it elastic; ``friction=(static, kinetic)`` constant; ``step_fraction`` its step; anything
    else is a field of `Case`.
    """

    def build(case_id: str = BELT, **changes: Any) -> Case:
        case = study_cases[case_id]
        if "modulus" in changes:
            elastic = PronyCompound(
                kind="prony", origin="assumed", source="a test", long_term_modulus_MPa=changes.pop("modulus") * 1e-6
            )
            case = replace(case, compound=elastic)
        if "friction" in changes:
            static, kinetic = changes.pop("friction")
            law = Coulomb(
                kind="coulomb",
                origin="assumed",
                source="a test",
                static_coefficient=static,
                kinetic_coefficient=kinetic,
            )
            case = replace(case, friction=law)
        if "step_fraction" in changes:
            case = replace(case, spring=case.spring.model_copy(update={"step_fraction": changes.pop("step_fraction")}))
        return replace(case, **changes)

    return build
