"""The case file holds all that decides a pass: what is rebuilt from it alone is what the package computes with."""

from __future__ import annotations

import json
import math

import jsonschema
import numpy as np
import pytest

from tread_validate.case_file.build import case_file
from tread_validate.case_file.io import case_schema, read_case, write_case
from tread_validate.cli.app import run
from tread_validate.errors import InputError
from tread_validate.friction import law
from tread_validate.geometry import path_of
from tread_validate.material import prony_series
from tread_validate.spring import resolve_creep
from tread_validate.study import load_study


@pytest.fixture(scope="module")
def cases(paper_study):
    every = load_study(paper_study).cases()
    return resolve_creep(
        [case for case in every if case.path.family == "rig"][::13]
        + [case for case in every if case.path.family != "rig"]
    )


def test_indentation_rebuilt_from_the_file_is_the_path_s(cases):
    """Linear between 801 samples: arc spacing 0.2 mm, curvature at most 11 per metre at the points of a trace, so
    h^2 kappa / 8 = 5e-8 m for the place and h kappa' for the slope times the height: 1e-6 m in all, of 1e-4 m."""
    for case in cases:
        document, path = case_file(case), path_of(case)
        samples, columns = document.path.samples, document.block.columns
        time = np.linspace(0.0, document.expected_duration_s, 57)
        for s in (0.0, 0.4 * columns.s_m[-1], columns.s_m[-1]):
            arc = document.path.first_contact_arc_m + document.path.arc_speed_m_s * time
            arc = arc - np.interp(s, columns.s_m, columns.arc_offset_m)
            x, y, slope = (
                np.interp(arc, samples.arc_m, values) for values in (samples.x_m, samples.y_m, samples.slope_rad)
            )
            height = np.interp(s, columns.s_m, columns.height_m)
            x, y = x + height * np.sin(slope), y - height * np.cos(slope)
            radius = document.road.radius_m
            inside = -y if radius is None else radius - np.hypot(x, y + radius)
            np.testing.assert_allclose(inside, path.indentation(s, time), atol=1e-6)


def test_prony_series_is_that_of_the_run_s_temperature(cases):
    for case in cases:
        compound = case_file(case).compound
        series = prony_series(case.compound, case.root).at_temperature(case.temperature, case.compound.wlf)
        time = np.geomspace(1e-6, 10.0, 29)
        terms = np.array([[term.modulus_Pa, term.relaxation_time_s] for term in compound.terms])
        found = compound.long_term_modulus_Pa + np.exp(-time[:, None] / terms[:, 1]) @ terms[:, 0]
        np.testing.assert_allclose(found, series.relaxation_modulus(time), rtol=1e-8)


def test_friction_table_gives_the_law_between_its_levels(cases):
    """Second differences of the paper's law over one level, 0.1 decade: below 0.2 % of the coefficient."""
    case = cases[0]
    friction, table = law(case.friction, case.root), case_file(case).friction.table
    for pressure, speed in ((3.3e5, 0.05), (1.7e6, 0.9), (2.1e4, 12.0)):
        row = np.array([np.interp(math.log(speed), np.log(table.slip_speed_m_s), line) for line in table.coefficient])
        found = np.interp(math.log(pressure), np.log(table.pressure_Pa), row)
        assert found == pytest.approx(float(friction.kinetic(pressure, speed)), rel=2e-3)


def test_outline_profile_and_area_agree(cases):
    for case in cases:
        block = case_file(case).block
        shoelace = sum(
            0.5 * abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(part, part[1:] + part[:1], strict=True)))
            for part in block.outline_m
        )
        assert shoelace == pytest.approx(block.area_m2, rel=1e-9)
        assert np.trapezoid(block.width_profile.width_m, block.width_profile.s_m) == pytest.approx(
            block.area_m2, rel=1e-9
        )


def test_file_is_valid_by_its_schema_and_reads_back_the_same(cases, tmp_path):
    schema = json.loads(case_schema())
    for case in cases:
        document = case_file(case)
        write_case(tmp_path / "case.json", document)
        jsonschema.validate(json.loads((tmp_path / "case.json").read_text()), schema)
        assert read_case(tmp_path / "case.json") == document


def test_schema_in_the_repository_is_that_of_the_code(root):
    assert (root / "workflow" / "schemas" / "case.schema.json").read_text() == case_schema()


def test_free_rolling_case_is_not_handed_out_without_its_creep(paper_study):
    case = next(case for case in load_study(paper_study).cases() if case.creep_ratio is None)
    with pytest.raises(InputError, match="creep_ratio"):
        case_file(case)


def test_verb_writes_one_file_a_case_and_refuses_two_on_the_screen(paper_study, tmp_path, capsys):
    ids = ["rig-rectangle-22c-0p2mm-300rpm", "belt-simplified-60c-0p2mm-16p7mps-free"]
    arguments = ["case", str(paper_study), *(part for name in ids for part in ("--case", name))]
    assert run([*arguments, "-o", str(tmp_path)]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(f"{name}.json" for name in ids)
    assert read_case(tmp_path / f"{ids[1]}.json").free_rolling
    assert run(arguments) == 2
    assert "a folder for 2 cases" in capsys.readouterr().err
