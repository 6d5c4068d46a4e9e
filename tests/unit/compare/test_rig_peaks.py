"""Imported rig records as references."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.compare.quantities import scalars, tolerances
from tread_validate.compare.rig_peaks import rig_peaks, rig_rows
from tread_validate.compare.runs import SourceRun
from tread_validate.errors import InputError
from tread_validate.history import History
from tread_validate.provenance import sha256_file
from tread_validate.reference.rig import write_rig
from tread_validate.reference.rig_passes import cut_passes
from tread_validate.reference.rig_synthetic import synthetic_record
from tread_validate.study import load_study

CONDITIONS = {"shape": "rectangle", "temperature_degC": 22.0, "interference_mm": 0.2, "speed_m_s": 3.14}
CASE = "rig-rectangle-22c-0p1mm-300rpm"


def write_record(place: Any, origin: str, factor: float = 1.1) -> Path:
    """Write a record as `tread-validate import-rig` does: the spring run, `factor` as high, +-5 % over the passes."""
    base = History.read_csv(place.folder / "spring" / "paper" / f"{CASE}.csv")
    path = place.references / "rig" / "record.csv"
    History(base.time, factor * base.normal_force, factor * base.tangential_force, 0 * base.time).write_csv(path)
    peak = factor * float(base.normal_force.max())
    record = {
        "name": "record",
        "origin": origin,
        "case_id": CASE,
        "history": path.name,
        "history_sha256": sha256_file(path),
        "peaks": {
            "peak_normal_force_N": peak,
            "peak_normal_force_min_N": 0.95 * peak,
            "peak_normal_force_max_N": 1.05 * peak,
            "peak_normal_force_half_width_95_N": 0.06 * peak,
        },
    }
    path.with_suffix(".yaml").write_text(yaml.safe_dump(record), encoding="utf-8")
    return path


def rows_of(folder: Path, table: str) -> list[dict[str, str]]:
    with (folder / f"{table}.csv").open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_without_a_record_every_rig_case_says_that_none_was_imported(workspace: Any) -> None:
    """One row for each rig case and source; status missing, never left out."""
    rows = [row for row in rows_of(workspace.tables, "errors") if row["reference_source"] == "rig:measured"]
    assert len(rows) == 24 * 2
    assert {row["status"] for row in rows} == {"missing"}
    assert all("none has been imported" in row["note"] for row in rows)


def test_a_measured_record_is_compared_with_its_spread(copy: Any) -> None:
    """Measured 10 % above the model, +-6 % with 95 %: error 1/1.1 - 1 = -9.1 %, its standard uncertainty
    6 %/2 x (1 + 0.091) = 3.3 % from the data. What the assumed inputs make of it is not known here, so nothing can
    be told. Slip is not measured and has no row.
    """
    write_record(copy, "measured")
    tables = copy.build()
    rows = [
        row
        for row in rows_of(tables, "errors")
        if (row["reference_source"], row["case_id"], row["predicted_source"]) == ("rig:measured", CASE, "spring:paper")
    ]
    quantities = {row["quantity"] for row in rows}
    assert {"peak_normal_force", "normal_force", "contact_duration"} <= quantities
    assert "slipping_share" not in quantities
    (peak,) = [row for row in rows if row["quantity"] == "peak_normal_force"]
    assert float(peak["error"]) == pytest.approx(1 / 1.1 - 1, rel=1e-5)
    assert float(peak["u_data"]) == pytest.approx(0.03 * (2 - 1 / 1.1), rel=1e-5)
    assert (peak["u_input"], peak["uncertainty"], peak["agreement"]) == ("", "", "cannot tell")
    assert peak["assessment"] == "cannot tell"
    measured = [row for row in rows_of(tables, "regression") if row["source"] == "rig:measured"]
    assert measured
    assert {row["status"] for row in measured} == {"missing"}


def test_a_synthetic_record_is_marked_and_proves_nothing(copy: Any) -> None:
    """Its source is rig:synthetic, its rows say so, and no published claim uses it."""
    write_record(copy, "synthetic")
    tables = copy.build()
    rows = [row for row in rows_of(tables, "errors") if row["reference_source"] == "rig:synthetic"]
    assert rows
    assert all("rig record record (synthetic)" in row["assumed"] for row in rows)
    claims = [row for row in rows_of(tables, "claims") if row["claim_id"] == "fe_error_rectangle"]
    assert {row["status"] for row in claims} == {"missing"}


def test_a_record_that_was_changed_by_hand_is_refused(copy: Any) -> None:
    """Wrong checksum: an error that names the file."""
    path = write_record(copy, "measured")
    path.write_text(path.read_text(encoding="utf-8") + "9.0,0.0,0.0,0.0\n", encoding="utf-8")
    with pytest.raises(InputError, match="checksum"):
        copy.build()


@pytest.mark.parametrize(
    ("noise", "said"), [(0.5, "adequate"), (8.0, "adequate"), (18.0, "cannot tell")], ids=["quiet", "loud", "louder"]
)
def test_noise_of_the_record_takes_an_assessment_away(
    tmp_path: Path, paper_study: Path, noise: float, said: str
) -> None:
    """A model 5 % above the rig, 10 % allowed: U = 2 u_data stays below 5 % until the record's noise is some 12 N.

    Nothing but the noise of the synthetic record differs; it reaches the assessment through the record's half-width.
    """
    cases = [case for case in load_study(paper_study).cases() if case.case_id == "rig-rectangle-22c-0p2mm-300rpm"]
    made = synthetic_record(noise=noise, variation=0.01, drift=0.0, revolutions=24).record
    (tmp_path / "rig").mkdir()
    write_rig(tmp_path / "rig", "one", cut_passes(made), "synthetic", "for the test", cases[0].case_id, CONDITIONS, {})
    peaks = rig_peaks(tmp_path, cases)
    (peak,) = peaks.values()
    above = 1.05 * peak.mean / float(peak.history.normal_force.max())
    base = peak.history
    model = History(base.time, above * base.normal_force, above * base.tangential_force, base.slipping_fraction)
    name, exact = ("model:a", cases[0].case_id), {"peak_normal_force": 0.0}
    runs = {name: SourceRun(*name, "current", "", model, scalars(model), numerical=exact)}
    rows = rig_rows(cases, runs, ["model:a"], peaks, {"rig": exact}, tolerances())
    row = next(row for row in rows if row.quantity == "peak_normal_force")
    assert row.error == pytest.approx(0.05, abs=1e-6)
    assert peak.uncertainty is not None
    assert row.u_data == pytest.approx(1.05 * peak.uncertainty["peak_normal_force"], rel=1e-3)
    assert row.assessment == said


def test_a_record_without_half_widths_leaves_the_data_uncertainty_unknown(copy: Any) -> None:
    """As records of before had it: no u_data, nothing can be told, and the rows say why."""
    path = write_record(copy, "measured").with_suffix(".yaml")
    record = yaml.safe_load(path.read_text(encoding="utf-8"))
    del record["peaks"]["peak_normal_force_half_width_95_N"]
    path.write_text(yaml.safe_dump(record), encoding="utf-8")
    rows = [row for row in rows_of(copy.build(), "errors") if row["reference_source"] == "rig:measured"]
    (peak,) = [row for row in rows if (row["case_id"], row["predicted_source"]) == (CASE, "spring:paper")
               and row["quantity"] == "peak_normal_force"]  # fmt: skip
    assert (peak["u_data"], peak["assessment"]) == ("", "cannot tell")
    assert "states no uncertainty of measurement" in peak["note"]
