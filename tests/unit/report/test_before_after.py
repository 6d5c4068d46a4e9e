"""What moved since the baseline, drawn: histories as accepted over histories as they are."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from tread_validate.compare.baseline.histories import HISTORIES, SAMPLES, accepted_histories, histories_text
from tread_validate.compare.baseline.store import RECORD, Acceptance, save_baseline
from tread_validate.compare.binding import write_provenance
from tread_validate.compare.thinned import unpack
from tread_validate.errors import InputError
from tread_validate.report import build_report

FACTS = Acceptance("why", "Tester", "2026-11-01T00:00:00Z", "0" * 12, "0", "tiny", "0")


@pytest.fixture(scope="module")
def moved(inputs: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Accept the made-up tables, with histories; then let one error grow, and build the report with its check."""
    folder = tmp_path_factory.mktemp("moved")
    out = folder / "out"
    save_baseline(out / "baseline", inputs.tables, FACTS, histories_text(inputs.tables, inputs.reference))
    tables = folder / "tables"
    shutil.copytree(inputs.tables, tables)
    errors = pd.read_csv(tables / "errors.csv", keep_default_na=False, dtype=str)
    row = errors.index[(errors["quantity"] == "peak_normal_force") & (errors["error"] != "")][0]
    errors.loc[row, "error"] = "-0.5"
    errors.to_csv(tables / "errors.csv", index=False, lineterminator="\n")
    write_provenance(tables, json.loads((tables / "provenance.json").read_text(encoding="utf-8")))
    from tread_validate.cli.app import run

    assert run(["check", str(tables), "--baseline", str(out / "baseline"), "-o", str(folder / "d.csv")]) == 1
    build_report(
        inputs.study, tables, inputs.spring, inputs.reference, inputs.decks, out, baseline_delta=folder / "d.csv"
    )
    (out / "moved_case").write_text(str(errors.loc[row, "case_id"]))
    return out


def test_accepted_histories_are_the_runs_thinned(inputs: Any, moved: Path) -> None:
    """Exact: every current run of a model or of FE, at most 63 samples, its peak to one 20,000th."""
    found = accepted_histories(moved / "baseline", RECORD)
    peaks = pd.read_csv(inputs.tables / "peaks.csv", keep_default_na=False)
    current = peaks[(peaks["status"] == "current") & ~peaks["source"].str.startswith("rig:")]
    assert set(found) == set(zip(current["source"], current["case_id"], strict=True))
    for row in current.itertuples():
        packed = found[str(row.source), str(row.case_id)]
        assert len(packed["t"]) <= SAMPLES + 3
        assert unpack(packed, "n").max() == pytest.approx(float(row.peak_normal_force_N), rel=2e-4)


def test_run_that_moved_most_is_drawn_before_and_after_with_a_link_to_its_case(moved: Path) -> None:
    """Exact: accepted and present curve of model and reference, and the figure leads to its case."""
    case = (moved / "moved_case").read_text()
    (file,) = (moved / "figures").glob("moved-*.csv")
    assert file.stem.endswith(case)
    with file.open(encoding="utf-8") as stream:
        series = {row["series"] for row in csv.DictReader(stream)}
    names = ("Built-in explicit FE", "Springs of the paper")
    assert series == {f"{name}, {when}" for name in names for when in ("accepted", "now")}
    page = (moved / "index.html").read_text(encoding="utf-8")
    figure = page.split(f'<figure id="figure-{file.stem}"')[1].split("</figure>")[0]
    assert f'href="#case={case}"' in figure
    assert "50.0\u00a0%" in figure


def test_histories_that_are_not_those_of_the_record_are_refused(moved: Path, tmp_path: Path) -> None:
    """Exact: one changed number is another checksum; a baseline without histories has none."""
    shutil.copytree(moved / "baseline", tmp_path / "b")
    data = json.loads((tmp_path / "b" / HISTORIES).read_text())
    next(iter(data.values()))["ns"] = 1.0
    (tmp_path / "b" / HISTORIES).write_text(json.dumps(data))
    with pytest.raises(InputError, match="another checksum"):
        accepted_histories(tmp_path / "b", RECORD)
    record = (tmp_path / "b" / RECORD).read_text()
    (tmp_path / "b" / RECORD).write_text(record[: record.index("histories:")])
    assert accepted_histories(tmp_path / "b", RECORD) == {}
