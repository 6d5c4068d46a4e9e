"""The tables of a whole study."""

from __future__ import annotations

import csv
import dataclasses
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.compare.quantities import HISTORIES, HISTORY_METRICS, SCALARS
from tread_validate.compare.tables import TABLES, MetricRow
from tread_validate.history import CHECKSUM, History

Workspace = Any  # of conftest.py
CASES = 2 * 2 * 2 * 3 + 4
ROWS_PER_CASE = len(SCALARS) + len(HISTORIES) * len(HISTORY_METRICS)
NAMES = set(TABLES)


def read(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_every_table_is_there_with_units_and_marks(workspace: Workspace) -> None:
    """Eleven CSV tables and the provenance; errors has the declared columns; what depends on a surrogate says so."""
    assert {path.stem for path in workspace.tables.glob("*.csv")} == NAMES
    rows = read(workspace.tables / "errors.csv")
    assert tuple(rows[0]) == MetricRow.header()
    assert all("compound surrogate (synthetic)" in row["assumed"] for row in rows)
    assert all(row["unit"] for row in rows)


def test_a_reference_thirty_per_cent_higher_leaves_the_model_23_per_cent_low(workspace: Workspace) -> None:
    """Predicted = reference/1.3 everywhere: relative error 1/1.3 - 1 = -0.2308 of every peak, Sprague-Geers M alike and
    P = 0; relative RMS of N bounded by 0.2308; bias 1/1.3 exp(-sigma_E^2/2) with sigma_E = 0.0125. Histories are
    written to 10 uN, so 1e-6.
    """
    exact = 1 / 1.3 - 1
    rows = [row for row in read(workspace.tables / "errors.csv") if row["reference_source"] == "fe:embedded"]
    peaks = [row for row in rows if row["quantity"] == "peak_normal_force"]
    assert len(peaks) == CASES
    assert all(float(row["error"]) == pytest.approx(exact, rel=1e-5) for row in peaks)
    assert {row["assessment"] for row in peaks} == {"inadequate"}
    assert {row["agreement"] for row in peaks} == {"differs"}
    assert {row["passed"] for row in peaks} == {"false"}
    magnitudes = [row for row in rows if row["metric"] == "sprague_geers_m"]
    assert all(float(row["error"]) == pytest.approx(exact, rel=1e-4) for row in magnitudes)
    durations = [row for row in rows if row["quantity"] == "contact_duration"]
    assert {row["assessment"] for row in durations} == {"adequate"}
    (whole,) = [
        row
        for row in read(workspace.tables / "ensemble.csv")
        if (row["group"], row["quantity"], row["reference_source"]) == ("all", "peak_normal_force", "fe:embedded")
    ]
    assert float(whole["bias"]) == pytest.approx(1 / 1.3 * 2.718281828 ** (-0.5 * 0.0125**2), rel=1e-4)
    assert (whole["cases"], whole["compared"], whole["passed"]) == (str(CASES), str(CASES), "0")


def test_every_case_has_the_same_rows_whatever_its_reference(copy: Workspace) -> None:
    """Missing, stale, corrupt, without contact: as many rows as a current one, without error, each saying why."""
    store = copy.references / "fe" / "embedded"
    folders = {path.name.rpartition("-")[0]: path for path in store.iterdir()}
    ids = sorted(folders)
    shutil.rmtree(folders[ids[0]])
    (copy.decks / ids[1] / f"{ids[1]}.inp").write_text("*HEADING\nanother deck\n", encoding="utf-8")
    (folders[ids[2]] / "record.yaml").unlink()
    with (folders[ids[3]] / "history.csv").open("a", encoding="utf-8") as stream:
        stream.write("1.0,0.0,0.0,0.0\n")
    spring = copy.folder / "spring" / "paper" / f"{ids[4]}.csv"
    made = History.read_csv(spring).provenance
    History([0.0, 1.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], made).with_checksum().write_csv(spring)
    rows = [row for row in read(copy.build() / "errors.csv") if row["reference_source"] == "fe:embedded"]
    assert len(rows) == CASES * ROWS_PER_CASE
    for case_id, status in zip(ids[:5], ("missing", "stale", "corrupt", "corrupt", "no_contact"), strict=True):
        mine = [row for row in rows if row["case_id"] == case_id]
        assert len(mine) == ROWS_PER_CASE
        assert {row["status"] for row in mine} == {status}
        assert {row["error"] for row in mine} == {""}
        assert {row["passed"] for row in mine} == {""}
        assert {row["assessment"] for row in mine} == {"cannot tell"}
        assert all(row["note"] for row in mine)
    ensemble = read(copy.tables / "ensemble.csv")
    whole = [row for row in ensemble if row["group"] == "all" and row["quantity"] == "peak_normal_force"]
    fe = next(row for row in whole if row["reference_source"] == "fe:embedded")
    assert fe["status"] == "incomplete"
    assert fe["bias"] == ""
    assert "every point counts" in fe["note"]


def test_a_spring_run_of_other_inputs_is_stale(copy: Workspace) -> None:
    """A run whose case digest is not today's is not compared."""
    copy.write_study(lambda text: text.replace("exponent: 0.25", "exponent: 0.26"))
    rows = read(copy.build() / "peaks.csv")
    assert {row["status"] for row in rows if row["source"] == "spring:paper"} == {"stale"}


@pytest.mark.parametrize(
    ("key", "value", "status"),
    [
        ("code", "0" * 16, "stale"),
        ("code", None, "unbound"),
        ("case_digest", None, "unbound"),
        (CHECKSUM, None, "unbound"),
        (CHECKSUM, "0" * 64, "corrupt"),
    ],
)
def test_a_spring_run_of_other_code_or_of_none_is_never_compared(
    key: str, value: str | None, status: str, copy: Workspace
) -> None:
    """Made by other code: stale. Without a digest of case or code: unbound. Neither gives an assessment."""
    for path in (copy.folder / "spring" / "paper").glob("*-*.csv"):
        history = History.read_csv(path)
        made = {name: text for name, text in history.provenance.items() if name != key}
        dataclasses.replace(history, provenance=made | ({} if value is None else {key: value})).write_csv(path)
    out = copy.build()
    assert {row["status"] for row in read(out / "peaks.csv") if row["source"] == "spring:paper"} == {status}
    assert {row["assessment"] for row in read(out / "errors.csv")} == {"cannot tell"}


@pytest.mark.parametrize("damage", ["cut off", "one digit"])
def test_a_spring_run_that_is_not_as_it_was_written_is_never_compared(damage: str, copy: Workspace) -> None:
    """Its header is whole and its rows are numbers, but not those of the run: half of them, or one altered."""
    path = next((copy.folder / "spring" / "paper").glob("*-*.csv"))
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    if damage == "cut off":
        lines = lines[:-2]
    else:
        cells = lines[-40].split(",")
        lines[-40] = ",".join([cells[0], f"{float(cells[1]) + 1e-5:.5f}", *cells[2:]])
    path.write_text("".join(lines), encoding="utf-8")
    rows = [row for row in read(copy.build() / "peaks.csv") if row["source"] == "spring:paper"]
    (bad,) = [row for row in rows if row["status"] != "current"]
    assert (bad["case_id"], bad["status"]) == (path.stem, "corrupt")
    assert "altered or cut off" in bad["note"]


def test_a_reference_of_other_code_is_compared_and_marked(copy: Workspace) -> None:
    """The engine has changed since: the numbers are the same, every row says so."""
    before = read(copy.tables / "errors.csv")
    for record in (copy.references / "fe" / "embedded").glob("*/record.yaml"):
        record.write_text(re.sub("code: .*", "code: '0123456789abcdef'", record.read_text()), encoding="utf-8")
    after = read(copy.build() / "errors.csv")
    assert [row["error"] for row in after] == [row["error"] for row in before]
    own = [row for row in after if row["reference_source"] == "fe:embedded"]
    assert {row["status"] for row in own} == {"other_code"}
    assert all("made by code 0123456789abcdef" in row["note"] for row in own)


def test_regressions_cover_every_source_and_shape(workspace: Workspace) -> None:
    """Table 1 in long form: rig and FE as printed, FE and spring as run, both shapes, both coefficients, with means."""
    means = [row for row in read(workspace.tables / "regression.csv") if row["set"] == "mean"]
    assert {(row["source"], row["shape"], row["coefficient"]) for row in means} == {
        (source, shape, name)
        for source in ("rig:published", "fe:published", "fe:embedded", "spring:paper")
        for shape in ("rectangle", "parallelogram")
        for name in ("a_v", "a_theta")
    }
    assert all(row["value"] and row["ci_low"] and row["ci_high"] for row in means)
    of_rectangle = [row for row in means if row["shape"] == "rectangle" and row["coefficient"] == "a_v"]
    scaled = {row["source"]: row["value"] for row in of_rectangle}
    assert float(scaled["fe:embedded"]) == pytest.approx(float(scaled["spring:paper"]), rel=1e-5)
    pairs = read(workspace.tables / "regression_differences.csv")
    assert len(pairs) == 2 * 2 * 6


def test_claims_have_a_row_for_every_published_number(workspace: Workspace) -> None:
    """Nothing that is published is passed over; what is not compared says why."""
    claims = read(workspace.tables / "claims.csv")
    published = read(workspace.tables / "published.csv")
    assert {row["claim_id"] for row in claims} == {row["id"] for row in published}
    assert all(row["note"] for row in claims if row["computed"] == "")
    uncompared = {row["claim_id"] for row in claims if row["status"] == "not_compared"}
    assert uncompared == {row["id"] for row in published if row["comparability"] == "context"}


def test_fe_creep_is_interpolated_from_its_two_runs(workspace: Workspace) -> None:
    """References are multiples of the spring runs, so the line through their net impulses ends at the common creep
    ratio, which the spring model found and rounded to 1e-5; the impulse left by the rounding is below 1 %.
    """
    rows = [row for row in read(workspace.tables / "claims.csv") if row["claim_id"] == "belt_creep"]
    found = {row["source"]: float(row["computed"]) for row in rows}
    assert found["fe:embedded"] == pytest.approx(found["spring:paper"], abs=0.002)


def test_tables_are_the_same_bytes_again_and_on_one_core(workspace: Workspace) -> None:
    """Identical inputs, two processes held to one core and one thread: identical files.

    The commit, in provenance and data package, is left out: it changes when somebody commits between the two runs.
    """
    code = (
        "import os, sys; os.sched_setaffinity(0, {sorted(os.sched_getaffinity(0))[0]});"
        "from tread_validate.compare import build_tables; build_tables(*sys.argv[1:], jobs=2)"
    )
    out = workspace.folder / "again"
    arguments = [workspace.study, workspace.folder / "spring", workspace.references, out, workspace.decks]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    subprocess.run([sys.executable, "-c", code, *map(str, arguments)], check=True, env=environment, timeout=120)
    names = sorted(path.name for path in workspace.tables.iterdir())
    assert names == sorted(path.name for path in out.iterdir())
    for name in names:
        first, second = (
            re.sub(rb'"commit": "[^"]*"|Made by tread-validate, code \S+', b"", (place / name).read_bytes())
            for place in (workspace.tables, out)
        )
        assert first == second, name


def test_provenance_names_inputs_versions_and_states(workspace: Workspace) -> None:
    """Commit, versions, a digest of each input, and how many runs of each source are current."""
    facts = json.loads((workspace.tables / "provenance.json").read_text(encoding="utf-8"))
    assert facts["study"] == "liu2010"
    assert facts["sources"]["fe:embedded"] == {"current": CASES}
    assert {"config/study.yaml", "reference_data/published/published.csv"} <= set(facts["inputs"])
    assert all(len(digest) == 64 for digest in facts["inputs"].values())


def test_sensitivity_is_reported_for_rig_and_belt(workspace: Workspace) -> None:
    """One case of each, five scores, window and sampling; the base rows have no change."""
    rows = read(workspace.tables / "sensitivity.csv")
    assert {row["case_id"].split("-")[0] for row in rows} == {"rig", "belt"}
    assert all(row["change"] == "0" for row in rows if row["variation"] == "as reported")
    wider = [row for row in rows if row["variation"].startswith("window 10 %") and row["metric"] == "iso18571_r"]
    assert len(wider) == 4


@pytest.mark.parametrize("kept", ["belt", "rig"])
def test_a_study_of_the_rig_or_of_the_belt_alone_has_its_tables(kept: str, copy: Workspace) -> None:
    """Claims that need the other half say that the study has no such case; nothing else changes."""
    data = yaml.safe_load(copy.study.read_text(encoding="utf-8"))
    data["runs"] = [run for run in data["runs"] if run["name"] == kept]
    if kept == "rig":
        data["runs"][0].update(speed_rpm=300.0, temperature_degC=22.0)
    data["compounds"]["surrogate"] = {
        "kind": "prony", "origin": "measured", "source": "a test", "long_term_modulus_MPa": 12.0,
        "terms": [{"modulus_MPa": 5.0, "relaxation_time_s": 0.01}],
    }  # fmt: skip
    copy.study.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
    copy.run_springs()
    claims = read(copy.build() / "claims.csv")
    said = {row["claim_id"]: row["note"] for row in claims if row["source"] in ("study", "spring:paper")}
    if kept == "belt":
        assert "no rig case" in said["rig_peak_at_centre"]
        assert "no rig case" in said["rig_speed_low"]
    else:
        assert "no tyre case" in said["tangential_reversal_at_exit"]
        assert "several" not in said["big_wheel_diameter"]
    assert "fitted over a band" in said["average_modulus"]
    regressions = [row for row in read(copy.tables / "regression.csv") if row["source"] == "spring:paper"]
    assert {row["status"] for row in regressions} <= {"undefined", "missing"}
