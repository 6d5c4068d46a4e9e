"""Imported rig records as references."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.errors import InputError
from tread_validate.history import History
from tread_validate.provenance import sha256_file

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
    """Measured 10 % above the model with +-5 % over the passes: error 1/1.1 - 1 = -9.1 %, its standard uncertainty
    5 %/sqrt 3 x (1 + 0.091) = 3.1 % from the data. What the assumed inputs make of it is not known here, so nothing can
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
    assert float(peak["u_data"]) == pytest.approx(0.05 / 3.0**0.5 * (2 - 1 / 1.1), rel=1e-5)
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
