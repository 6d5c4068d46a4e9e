"""One run against its reference: rows, assessments, bad input."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.cli.app import run as tread_validate
from tread_validate.compare import assessment, compare, empty_rows
from tread_validate.compare.quantities import SCALAR, tolerances
from tread_validate.compare.scores.align import align, window
from tread_validate.compare.scores.assessment import Parts, agreement
from tread_validate.compare.scores.comparison import scalar_row
from tread_validate.compare.scores.uncertainty import from_mesh_error
from tread_validate.errors import InputError
from tread_validate.history import History
from tread_validate.study import ToleranceEntry

FINITE = st.floats(-1e3, 1e3)
SIZE = st.floats(0, 1e3)


def half_sine(
    peak: float = 100.0, shear: float = 30.0, start: float = 0.0, n: int = 801, duration: float = 0.01
) -> History:
    t = np.linspace(start, start + duration, n)
    wave = (t - start) / duration
    return History(t, peak * np.sin(np.pi * wave), shear * np.sin(2 * np.pi * wave), np.zeros_like(t))


@given(FINITE, SIZE, SIZE)
def test_a_assessment_holds_for_every_error_that_the_uncertainty_allows(
    error: float, tolerance: float, spread: float
) -> None:
    """adequate: both ends of error -+ spread pass; inadequate: the nearer end (or zero, if between) fails."""
    found = assessment(error, tolerance, spread)
    nearest = max(0.0, abs(error) - spread)
    if found == "adequate":
        assert abs(error) + spread <= tolerance
    elif found == "inadequate":
        assert nearest > tolerance
    else:
        assert abs(error) + spread > tolerance
        assert nearest <= tolerance


@given(FINITE, SIZE)
def test_agreement_asks_for_nothing_but_the_uncertainty(error: float, spread: float) -> None:
    """|E| <= U, whatever is good enough."""
    assert agreement(error, spread) == ("agrees" if abs(error) <= spread else "differs")


def test_without_an_uncertainty_nothing_can_be_told() -> None:
    """Neither agreement nor disagreement can be claimed of a reference whose uncertainty is not known."""
    assert assessment(0.0, 0.1, None) == assessment(5.0, 0.1, None) == agreement(5.0, None) == "cannot tell"
    assert assessment(None, 0.1, 0.0) == agreement(None, 0.0) == "cannot tell"
    assert assessment(float("nan"), 0.1, 0.0) == agreement(float("nan"), 0.0) == "cannot tell"
    assert Parts(0.0, None, 0.1).expanded is None


@given(SIZE, SIZE, SIZE)
def test_the_parts_of_an_uncertainty_add_as_squares(numerical: float, inputs: float, data: float) -> None:
    """U = 2 sqrt(u_num^2 + u_input^2 + u_D^2), ASME V&V 20 with a coverage factor of 2: 3, 4 and 12 give 26."""
    assert Parts(3.0, 4.0, 12.0).expanded == pytest.approx(26.0, rel=1e-15)
    exact = 2.0 * (numerical**2 + inputs**2 + data**2) ** 0.5
    assert Parts(numerical, inputs, data).expanded == pytest.approx(exact, rel=1e-12)


def test_each_part_reaches_the_row() -> None:
    """Reference 100 N, prediction 110 N; 1 % of the reference, 2 % of the prediction, 3 % of it from the inputs: parts
    of the relative error 1 % (1 + 0.1), 2 % 1.1 and 3 % 1.1.
    """
    rows = compare(half_sine(), half_sine(110.0, 33.0), uncertainty=0.01, numerical=0.02, inputs=0.03)
    row = next(row for row in rows if row.quantity == "peak_normal_force")
    assert (row.u_data, row.u_numerical, row.u_input) == pytest.approx((0.011, 0.022, 0.033), rel=1e-6)
    assert row.uncertainty == pytest.approx(2.0 * 0.011 * 14.0**0.5, rel=1e-6)


@settings(max_examples=25, deadline=None)
@given(st.floats(1.0, 1e4), st.floats(0.5, 2.0))
def test_relative_errors_do_not_depend_on_the_size_of_the_forces(peak: float, factor: float) -> None:
    """Scaling both histories leaves every relative error and score alone, to 1e-9."""
    one = compare(half_sine(), half_sine(100.0 * factor, 30.0 * factor), uncertainty=0.01)
    other = compare(half_sine(peak, 0.3 * peak), half_sine(peak * factor, 0.3 * peak * factor), uncertainty=0.01)
    for a, b in zip(one, other, strict=True):
        if a.error_type == "absolute" or a.error is None or b.error is None or a.uncertainty is None:
            continue  # what is judged in newtons has a floor in newtons
        assert b.error == pytest.approx(a.error, abs=1e-7)
        limits = (abs(a.error) + a.uncertainty, abs(a.error) - a.uncertainty)
        assert a.assessment == b.assessment or min(abs(limit - (a.tolerance or 0.0)) for limit in limits) < 1e-6


def test_a_run_agrees_with_itself() -> None:
    """Every error 0, every score 1, all good enough and in agreement, but slip, whose uncertainty is not known."""
    rows = compare(half_sine(), half_sine(), uncertainty=0.01)
    assert all(row.error == pytest.approx(0.0, abs=1e-7) for row in rows)
    assert {row.quantity for row in rows if row.assessment != "adequate"} == {"slipping_share"}
    assert {row.quantity for row in rows if row.agreement != "agrees"} == {"slipping_share"}


@pytest.mark.parametrize(("shear", "other", "tolerance", "passed"), [(5.0, 6.5, 2.0, True), (30.0, 36.0, 3.0, False)])
def test_a_tangential_peak_is_judged_in_newtons(shear: float, other: float, tolerance: float, passed: bool) -> None:
    """Ten per cent of the reference, but no less than 2 N: 5 N may be off by 2 N, 30 N by 3 N."""
    rows = {row.quantity: row for row in compare(half_sine(shear=shear), half_sine(shear=other), uncertainty=0.01)}
    row = rows["peak_positive_tangential_force"]
    assert (row.error_type, row.unit, row.passed) == ("absolute", "N", passed)
    assert row.error == pytest.approx(other - shear, rel=1e-4)
    assert row.tolerance == pytest.approx(tolerance, rel=1e-5)
    assert row.criterion == "10 % of the reference, at least 2 N"


@pytest.mark.parametrize(("shear", "other", "tolerance"), [(5.0, 6.5, 2.0), (30.0, 39.0, 3.0)])
def test_a_tangential_history_is_judged_in_newtons(shear: float, other: float, tolerance: float) -> None:
    """RMS of the difference (other - shear)/sqrt 2; ten per cent of the largest reference, no less than 2 N. The 1 %
    window leaves 0.6 % of the RMS out.
    """
    rows = compare(half_sine(shear=shear), half_sine(shear=other), uncertainty=0.01)
    row = next(row for row in rows if (row.quantity, row.metric) == ("tangential_force", "relative_rms"))
    assert (row.error_type, row.unit) == ("absolute", "N")
    assert row.error == pytest.approx((other - shear) / np.sqrt(2.0), rel=6e-3)
    assert row.tolerance == pytest.approx(tolerance, rel=1e-5)


@given(st.floats(0.0, 1e3), st.floats(1e-9, 1e-3))
def test_a_tolerance_does_not_jump(reference: float, step: float) -> None:
    """A reference that is a little larger may be off by at most a tenth of that more, also where the floor ends."""
    quantity = SCALAR["peak_positive_tangential_force"]
    a, b = (
        scalar_row(quantity, value, 0.0, {}, ("", "", "")).tolerance or 0.0 for value in (reference, reference + step)
    )
    assert 0.0 <= b - a <= 0.1001 * step + 1e-12


def test_a_study_chooses_what_is_good_enough() -> None:
    """Twenty per cent for the peak, a floor of 5 N for the tangential one; the rest keep their defaults."""
    own = {
        "peak_normal_force": ToleranceEntry(value=0.2, reason="a screening"),
        "peak_positive_tangential_force": ToleranceEntry(value=0.1, floor=5.0, reason="a screening"),
    }
    judged = tolerances(own)
    assert judged["peak_normal_force"].criterion == "20 % of the reference"
    assert (judged["peak_normal_force"].origin, judged["normal_impulse"].origin) == ("study", "default")
    rows = {
        row.quantity: row
        for row in compare(half_sine(), half_sine(115.0, 34.5), uncertainty=0.001, tolerances=judged)
        if row.metric == "scalar"
    }
    assert (rows["peak_normal_force"].assessment, rows["normal_impulse"].assessment) == ("adequate", "inadequate")
    assert rows["peak_positive_tangential_force"].tolerance == 5.0


@pytest.mark.parametrize(
    ("name", "chosen", "match"),
    [
        (
            "peak_farce",
            ToleranceEntry(value=0.1, reason="r"),
            r"study\.yaml: tolerances\.peak_farce: got an unknown name",
        ),
        ("normal_impulse", ToleranceEntry(value=0.1, floor=1.0, reason="r"), r"normal_impulse\.floor: got 1"),
    ],
)
def test_a_tolerance_of_nothing_is_refused(name: str, chosen: ToleranceEntry, match: str) -> None:
    """A name that is no quantity, and a floor where none is."""
    with pytest.raises(InputError, match=match):
        tolerances({name: chosen}, "study.yaml")


def test_the_uncertainty_of_a_reference_reaches_the_assessment() -> None:
    """8 % high, tolerance 10 %: good enough at a standard uncertainty of 0.5 %, open at 5 %, where the two agree; 30 %
    high is not good enough at either.
    """
    for factor, mesh, good, agrees in (
        (1.08, 0.005, "adequate", "differs"),
        (1.08, 0.05, "cannot tell", "agrees"),
        (1.30, 0.005, "inadequate", "differs"),
        (1.30, 0.05, "inadequate", "differs"),
        (1.30, None, "cannot tell", "cannot tell"),
    ):
        rows = compare(half_sine(), half_sine(100.0 * factor), uncertainty=mesh)
        row = next(row for row in rows if row.quantity == "peak_normal_force")
        assert (row.assessment, row.agreement) == (good, agrees)


def test_a_mesh_error_by_quantity_is_used_where_it_is_known() -> None:
    """A mapping gives each scalar its own; histories take that of their peaks; what is not named is not known. Half of
    the grid convergence index, 1.25 times the mesh error, is the standard uncertainty.
    """
    known = from_mesh_error({"peak_normal_force": 0.02})
    rows = compare(half_sine(), half_sine(), uncertainty=known)
    assert {row.quantity for row in rows if row.u_data is not None} == {
        "peak_normal_force", "late_sign_change", "normal_force",
    }  # fmt: skip
    row = next(row for row in rows if row.quantity == "peak_normal_force")
    assert row.uncertainty == pytest.approx(1.25 * 0.02, rel=1e-12)


def test_what_a_model_does_not_give_is_said() -> None:
    """A history without a tangential force: its rows are there, without an error, and the normal ones are judged."""
    full = half_sine()
    bare = History.of(full.time, full.normal_force)
    rows = compare(full, bare, uncertainty=0.01)
    assert len(rows) == len(compare(full, full))
    lost = {row.quantity for row in rows if row.status == "not_given"}
    assert {
        "peak_positive_tangential_force",
        "net_tangential_impulse",
        "tangential_force",
        "slipping_share",
        "late_sign_change",
    } <= lost
    assert all(row.assessment == "cannot tell" and row.error is None for row in rows if row.status == "not_given")
    assert next(row for row in rows if row.quantity == "peak_normal_force").assessment == "adequate"


def test_histories_of_other_lengths_and_samplings_are_compared_on_one_clock() -> None:
    """The same pass sampled 801 and 333 times, the second record longer: the difference is that of linear
    interpolation, (pi h)^2/8 with h = 1/332 of the pass, 1.1e-5 of the peak."""
    fine, coarse = half_sine(), half_sine(n=333)
    longer = History(
        np.append(coarse.time, [0.02, 0.03]), np.append(coarse.normal_force, [0.0, 0.0]),
        np.append(coarse.tangential_force, [0.0, 0.0]), np.zeros(coarse.time.size + 2),
    )  # fmt: skip
    rows = compare(fine, longer, uncertainty=0.0)
    found = next(row for row in rows if (row.quantity, row.metric) == ("normal_force", "relative_rms"))
    assert found.error == pytest.approx(0.0, abs=2e-5)


def test_nothing_is_shifted() -> None:
    """A pass that is late by a tenth stays late: the window is the union of both contacts, 1.1 passes."""
    late = half_sine(start=0.001)
    start, end = window(half_sine(), late)
    assert end - start == pytest.approx(0.011, rel=1e-2)
    pair = align(half_sine(), late, 1101)
    assert pair.predicted_normal[0] == 0.0
    rows = compare(half_sine(), late, uncertainty=0.0)
    phase = next(row for row in rows if (row.quantity, row.metric) == ("normal_force", "sprague_geers_p"))
    assert (phase.error or 0.0) > 0.05


@pytest.mark.parametrize(
    ("other", "match"),
    [
        (half_sine(start=1.0), "one clock"),
        (half_sine(duration=1e-5, start=0.1), "one clock"),
        (half_sine(peak=0.0), "a contact"),
        (half_sine(peak=-5.0), "a contact"),
        (History([0.0, 0.005, 0.01], [0.0, 50.0, 100.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]), "ends out of contact"),
    ],
)
def test_histories_that_cannot_be_compared_are_refused(other: History, match: str) -> None:
    """Other clocks, no contact, a record that ends in contact: an error that says so, never a zero."""
    with pytest.raises(InputError, match=match):
        compare(half_sine(), other)


def test_a_zero_tangential_reference_gives_undefined_rows() -> None:
    """Scores that are relative to nothing are rows without an error, with the reason in the note; the RMS is in N."""
    rows = compare(half_sine(shear=0.0), half_sine(), uncertainty=0.01)
    broken = [row for row in rows if row.status == "undefined"]
    assert {row.quantity for row in broken} == {"tangential_force"}
    assert len(broken) == 8
    assert all(row.error is None and row.passed is None and row.note for row in broken)


def test_empty_rows_have_the_shape_of_full_ones() -> None:
    """The same quantities, metrics and units whether there is a reference or not."""
    full = compare(half_sine(), half_sine(), case_id="a")
    empty = empty_rows("a", "reference", "predicted", "missing", "no run")
    assert [(r.quantity, r.metric, r.unit) for r in full] == [(r.quantity, r.metric, r.unit) for r in empty]


def test_the_command_compares_two_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """CSV and JSON on standard output or in a file; bad input ends with 2 and one line."""
    half_sine().write_csv(tmp_path / "a.csv")
    half_sine(110.0, 33.0).write_csv(tmp_path / "b.csv")
    a, b = str(tmp_path / "a.csv"), str(tmp_path / "b.csv")
    assert tread_validate(["compare", a, b, "--uncertainty", "0.01"]) == 0
    assert "peak_normal_force,scalar,a,b,100,110,N,0.1,relative" in capsys.readouterr().out
    assert tread_validate(["compare", a, b, "--json", "-o", str(tmp_path / "c.json")]) == 0
    assert '"sprague_geers_m"' in (tmp_path / "c.json").read_text(encoding="utf-8")
    half_sine(start=1.0).write_csv(tmp_path / "late.csv")
    assert tread_validate(["compare", a, str(tmp_path / "late.csv")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


PEAKS = "shape,temperature_degC,interference_mm,speed_m_s,peak_normal_force_N\n"


def test_the_command_regresses_a_table_of_peaks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """F = 50 (1 + 0.04 v): a_v is 0.04."""
    rows = "".join(f"rectangle,22,0.2,{v},{50 * (1 + 0.04 * v)}\n" for v in (1.0, 2.0, 4.0))
    (tmp_path / "peaks.csv").write_text(PEAKS + rows, encoding="utf-8")
    assert tread_validate(["regress", str(tmp_path / "peaks.csv")]) == 0
    assert ",rectangle,a_v,22 degC 0.2 mm,0.04,s/m" in capsys.readouterr().out


def test_peaks_of_the_tables_can_be_regressed_as_they_are(workspace: Any, tmp_path: Path) -> None:
    """peaks.csv goes straight in: tyre cases are passed over, and the coefficients are those of regression.csv."""
    out = tmp_path / "regression.csv"
    assert tread_validate(["regress", str(workspace.tables / "peaks.csv"), "-o", str(out)]) == 0

    def values(path: Path) -> dict[tuple[str, ...], float]:
        with path.open(newline="", encoding="utf-8") as stream:
            rows = [row for row in csv.DictReader(stream) if not row["source"].endswith(":published")]
        return {tuple(row[n] for n in ("source", "shape", "coefficient", "set")): float(row["value"]) for row in rows}

    again, first = values(out), values(workspace.tables / "regression.csv")
    assert again.keys() == first.keys()
    assert all(again[key] == pytest.approx(first[key], rel=1e-4) for key in first)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("shape,speed_m_s\n", "column temperature_degC"),
        (PEAKS, "at least one run"),
        (PEAKS + "rectangle,22,0.2,1\n", "cells"),
        (PEAKS + "rectangle,22,0.2,fast,3\n", "finite number"),
        (PEAKS + "rectangle,22,0.2,1,-3\n", "a force > 0"),
        (PEAKS + "rectangle,22,0.2,1,3\nrectangle,22,0.2,1,4\n", "one row for each"),
        (PEAKS + "rectangle,22,0.2,1,nan\n", "finite number"),
    ],
)
def test_a_wrong_table_of_peaks_is_refused(
    text: str, match: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One line, exit code 2."""
    (tmp_path / "peaks.csv").write_text(text, encoding="utf-8")
    assert tread_validate(["regress", str(tmp_path / "peaks.csv")]) == 2
    assert match in capsys.readouterr().err


def test_histories_of_two_cases_are_not_compared_without_a_word(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both files carry their case; a name for the pair says that it is meant."""
    time = np.linspace(-1e-3, 11e-3, 200)
    force = np.where((time > 0) & (time < 10e-3), 100.0 * np.sin(np.pi * time / 10e-3), 0.0)
    for name in ("a", "b"):
        History.of(time, force, 0.2 * force, 0.0 * force, {"case_id": name}).write_csv(tmp_path / f"{name}.csv")
    pair = ["compare", str(tmp_path / "a.csv"), str(tmp_path / "b.csv")]
    assert tread_validate(pair) == 2
    assert "histories of a and b" in capsys.readouterr().err
    assert tread_validate([*pair, "--case", "both"]) == 0
