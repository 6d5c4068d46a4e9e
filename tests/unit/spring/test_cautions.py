"""What a case asks beyond what was compared with FE is said, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from tread_validate.friction import Coulomb
from tread_validate.geometry import path_of
from tread_validate.spring import resolve_creep, run
from tread_validate.spring.cautions import SHEARED, cautions, sheared
from tread_validate.spring.rubber import series_of
from tread_validate.study import load_study


@pytest.fixture(scope="module")
def cases(paper_study):
    return resolve_creep(load_study(paper_study).cases())


@pytest.fixture(scope="module")
def belt(cases):
    return next(case for case in cases if case.case_id == "belt-simplified-60c-0p2mm-16p7mps-creep0p3")


def test_the_papers_cases_need_no_caution(cases):
    assert all(cautions(case, variant) == () for case in cases for variant in ("paper", "condensed"))


def coulomb(kinetic, static):
    plan = {"kind": "coulomb", "origin": "assumed", "source": "test"}
    return Coulomb(**plan, kinetic_coefficient=kinetic, static_coefficient=static)


def changed(case, **path):
    return replace(case, path=case.path.model_copy(update=path))


def test_each_limit_is_said_where_it_is_passed(belt):
    rubbery = belt.compound.model_copy(update={"poissons_ratio": 0.4999})
    for case, said in (
        (replace(belt, interference=3e-3), "interference 38 %"),
        (replace(belt, compound=rubbery), "Poisson's ratio 0.4999"),
        (changed(belt, edge_radius_mm=5.0), "path radius 5 mm"),
        (replace(belt, speed=60.0), "shear wave"),
        (replace(belt, interference=0.02e-3), "the road meets the face at 0.5"),
    ):
        assert any(said in line for line in cautions(case, "condensed")), said
    assert "lumped mass" in cautions(replace(belt, speed=60.0), "paper")[0]


def test_sliding_where_friction_falls_has_no_reliable_history(belt):
    """3 % at 30 m/s is 0.9 m/s of slip: on the falling branch of the study's law. Constant friction is reliable."""
    fast = replace(belt, creep_ratio=0.03, speed=30.0)
    assert any("no reliable history" in line for line in cautions(fast, "condensed"))
    assert not any("no reliable" in line for line in cautions(replace(fast, friction=coulomb(0.6, 0.6)), "condensed"))
    shallow = replace(belt, interference=0.05e-3, temperature=-10.0, speed=3.0)  # slips at 9 mm/s: 0.9 drops to 0.7
    assert any("no reliable history" in line for line in cautions(shallow, "condensed"))
    dropping = replace(belt, creep_ratio=0.03, friction=coulomb(0.48, 0.9))
    assert any("no reliable" in line for line in cautions(dropping, "paper"))


def test_a_history_carries_its_caution(belt):
    assert "shear wave" in run(replace(belt, speed=60.0), "paper").provenance["caution"]
    assert "caution" not in run(belt, "paper").provenance


def test_shear_whose_square_nears_the_interference_lies_outside_the_map(belt):
    """N grows with T squared, and with T at mu N runs away where that share is large: a limit that FE gave. No caution
    of this kind for the study's 85 N of T, nor for springs that know no second order."""
    assert sheared(belt, "condensed", 85.0) == ()
    depth, area = belt.interference / belt.height, 25e-3 * 20e-3
    duration = path_of(belt).contact_duration
    shear = series_of(belt).relaxation_modulus(0.5 * duration) / (2 * (1 + belt.compound.poissons_ratio))
    limit = float(shear) * area * np.sqrt(SHEARED * depth)
    assert sheared(belt, "condensed", 0.999 * limit) == ()
    assert "outside the map" in sheared(belt, "condensed", 1.001 * limit)[0]
    assert sheared(belt, "paper", 2.0 * limit) == ()
