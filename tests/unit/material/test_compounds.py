"""Every kind of compound gives a series; files are read once and refused in one line."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.material import compound_route, material_schema, prony_series, read_material
from tread_validate.study import ArrheniusShift, PronyCompound, PronyFile, PronyTerm, SweepFile, Wlf, load_study
from tread_validate.study.library import named_compound

COMMON = {"origin": "synthetic", "source": "test"}


@pytest.fixture(scope="module")
def shipped(root: Path) -> Path:
    return root / "reference_data" / "material"


def test_written_out_series_is_sorted_by_time() -> None:
    terms = (PronyTerm(modulus_MPa=1.0, relaxation_time_s=2.0), PronyTerm(modulus_MPa=3.0, relaxation_time_s=0.1))
    series = prony_series(PronyCompound(kind="prony", long_term_modulus_MPa=5.0, terms=terms, **COMMON))
    np.testing.assert_array_equal(series.relaxation_times, [0.1, 2.0])
    np.testing.assert_array_equal(series.moduli, [3e6, 1e6])
    assert series.instantaneous_modulus == 9e6


def test_fifty_two_cases_cost_one_fit(paper_study: Path) -> None:
    """The second call is a look-up: far below a millisecond, as the fit takes some ten."""
    cases = load_study(paper_study).cases()
    first = prony_series(cases[0].compound)
    start = time.process_time()
    for case in cases:
        assert prony_series(case.compound) is not None
    assert time.process_time() - start < 0.05
    np.testing.assert_array_equal(prony_series(cases[-1].compound).moduli, first.moduli)


def test_material_file_gives_back_what_was_written(shipped: Path) -> None:
    """The shipped file, through the study's kind `prony_file`: the same series, and at 30 degC the shifted one."""
    file = shipped / "synthetic_material.yaml"
    read = read_material(file)
    here = PronyFile(kind="prony_file", file=file.name, **COMMON)
    np.testing.assert_array_equal(prony_series(here, shipped).moduli, read.series().moduli)
    warm = prony_series(here.model_copy(update={"data_temperature_degC": 30.0}), shipped)
    expected = read.series().at_temperature(30.0, read.wlf)
    np.testing.assert_allclose(warm.relaxation_times, expected.relaxation_times, rtol=1e-12)


def test_sweeps_as_front_stage_give_the_same_series_as_the_file_made_from_them(shipped: Path) -> None:
    """A study that names raw sweeps goes the route of `fit-prony`: moduli equal to the 7 digits that are kept."""
    raw = SweepFile(kind="sweeps", file="synthetic_sweeps.csv", **COMMON)
    file = PronyFile(kind="prony_file", file="synthetic_material.yaml", **COMMON)
    a, b = prony_series(raw, shipped), prony_series(file, shipped)
    w = np.geomspace(0.25, 2500, 50)
    np.testing.assert_allclose(a.storage_modulus(w), b.storage_modulus(w), rtol=1e-5)
    np.testing.assert_allclose(a.loss_modulus(w), b.loss_modulus(w), rtol=1e-5)


def test_report_gets_the_whole_route_of_a_compound_that_has_one(shipped: Path, paper_study: Path) -> None:
    raw = SweepFile(kind="sweeps", file="synthetic_sweeps.csv", **COMMON)
    route = compound_route(raw, shipped)
    assert route is not None
    assert len(route.sweeps) == 6
    assert route.bands is not None
    assert route.fit.storage_residual.shape == route.fit.angular_frequency.shape
    assert compound_route(load_study(paper_study).model.compounds["surrogate"]) is None


def test_other_shift_constants_than_the_data_were_shifted_by_are_refused(shipped: Path) -> None:
    other = PronyFile(kind="prony_file", file="synthetic_material.yaml", wlf=Wlf(c1=17.44, c2_K=51.6), **COMMON)
    with pytest.raises(InputError, match=r"wlf or shift.*the law that the data were shifted by"):
        prony_series(other, shipped)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("[1, 2]", "a mapping of keys"),
        ("kind: prony\norigin: measured\nsource: x\n", "long_term_modulus_MPa"),
        ("kind: prony\norigin: measured\nsource: x\nlong_term_modulus_MPa: -1\n", "long_term_modulus_MPa"),
        ("kind: prony\nkind: prony\n", "twice"),
    ],
)
def test_a_wrong_material_file_is_refused_in_one_line(tmp_path: Path, text: str, reason: str) -> None:
    path = tmp_path / "material.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=reason):
        read_material(path)


def test_missing_file_is_refused() -> None:
    with pytest.raises(InputError, match="no such file"):
        prony_series(PronyFile(kind="prony_file", file="nowhere.yaml", **COMMON), Path("/nonexistent"))


def test_schema_names_the_series() -> None:
    assert {"long_term_modulus_MPa", "terms", "quality", "wlf"} <= set(material_schema()["properties"])


def test_a_material_file_named_without_a_shift_brings_its_own(tmp_path: Path, shipped: Path) -> None:
    """An Arrhenius law written by fit-prony shifts the study's runs; one that the study gives is compared with it."""
    text = (shipped / "synthetic_material.yaml").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("wlf:")]
    place = lines.index("data_temperature_degC: 22") + 1
    lines.insert(place, "shift: {kind: arrhenius, activation_energy_kJ_mol: 95}")
    (tmp_path / "own.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    plain = PronyFile(kind="prony_file", file="own.yaml", **COMMON)
    named = named_compound(plain, tmp_path)
    assert named.time_shift == ArrheniusShift(kind="arrhenius", activation_energy_kJ_mol=95)
    warm = prony_series(named, tmp_path).at_temperature(60.0, named.time_shift)
    cold = read_material(tmp_path / "own.yaml").series()
    assert warm.relaxation_times[0] < 0.02 * cold.relaxation_times[0]
    with pytest.raises(InputError, match="the law that the data were shifted by: Arrhenius, 95 kJ/mol"):
        prony_series(plain.model_copy(update={"wlf": Wlf()}), tmp_path)
