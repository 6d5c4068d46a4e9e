"""Measured rig passes as references: three files a record, and one table of peaks for the folder."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError, one_line
from ..files import write_text
from ..history import History
from ..provenance import sha256_file
from ..yaml_text import read_yaml
from .rig_passes import RigPasses, Spread

PEAKS = "peaks.csv"
CONDITIONS = ("shape", "temperature_degC", "interference_mm", "speed_m_s")
PEAK_COLUMNS = (
    "source", "case_id", *CONDITIONS, "passes", "peak_normal_force_N", "peak_normal_force_min_N",
    "peak_normal_force_max_N", "peak_normal_force_sd_N", "largest_tangential_force_N", "largest_tangential_force_min_N",
    "largest_tangential_force_max_N", "least_tangential_force_N", "least_tangential_force_min_N",
    "least_tangential_force_max_N", "peak_normal_force_half_width_95_N", "largest_tangential_force_half_width_95_N",
    "least_tangential_force_half_width_95_N",
)  # fmt: skip


@dataclass(frozen=True)
class RigReference:
    """One imported record.

    Attributes
    ----------
    name : str
    origin : str
        ``measured`` or ``synthetic``.
    history : History
        Mean over the passes; the slipping fraction is not measured and set to 0.
    record : mapping
        The record file: source, checksum, settings, conditions, peaks.
    """

    name: str
    origin: str
    history: History
    record: Mapping[str, Any]


def mean_history(passes: RigPasses, provenance: Mapping[str, str]) -> History:
    """Return the mean over the passes as a history; tangential force keeps the record's sign."""
    head = {**provenance, "slipping_fraction": "not measured, set to 0"}
    mean_n, mean_t = passes.normal_force.mean(axis=0), passes.tangential_force.mean(axis=0)
    return History(passes.time, mean_n, mean_t, np.zeros_like(mean_n), head)


def passes_csv(passes: RigPasses) -> str:
    """Return mean, least and largest force over the passes against time."""
    columns = [passes.time]
    names = ["time_s"]
    for name, forces in (("normal", passes.normal_force), ("tangential", passes.tangential_force)):
        for kind, values in (("mean", forces.mean(0)), ("min", forces.min(0)), ("max", forces.max(0))):
            columns.append(values)
            names.append(f"{name}_force_{kind}_N")
    text = io.StringIO()
    np.savetxt(text, np.column_stack(columns), fmt=["%.7f"] + ["%.4f"] * 6, delimiter=",")
    return ",".join(names) + "\n" + text.getvalue()


def peak_row(
    passes: RigPasses, source: str, case_id: str, conditions: Mapping[str, str | float], calibration: float = 0.0
) -> dict[str, Any]:
    """Return the peak table's row of one record: conditions, then mean, extremes over the passes, 95 % half-width."""
    row: dict[str, Any] = {"source": source, "case_id": case_id, **conditions, "passes": passes.count}

    def add(name: str, spread: Spread) -> None:
        row[f"{name}_N"] = round(spread.mean, 3)
        row[f"{name}_min_N"], row[f"{name}_max_N"] = round(spread.least, 3), round(spread.largest, 3)
        row[f"{name}_half_width_95_N"] = round(passes.half_width(spread, calibration), 3)

    add("peak_normal_force", passes.peak_normal_force)
    row["peak_normal_force_sd_N"] = round(passes.peak_normal_force.deviation, 3)
    add("largest_tangential_force", passes.largest_tangential_force)
    add("least_tangential_force", passes.least_tangential_force)
    return row


def peak_rows(references: tuple[RigReference, ...]) -> list[dict[str, Any]]:
    """Return the peak table's rows of imported records, by shape, temperature, interference and speed."""
    rows = []
    for reference in references:
        record = reference.record
        row = {"source": "rig", "case_id": record.get("case_id", ""), "passes": record.get("passes")}
        row |= {key: record.get(key) for key in CONDITIONS} | dict(record.get("peaks") or {})
        rows.append(row)
    return sorted(rows, key=lambda row: (str(row[CONDITIONS[0]]), *(float(row[key]) for key in CONDITIONS[1:])))


def peaks_csv(rows: list[dict[str, Any]]) -> str:
    """Return peak rows as CSV, in the columns that `tread-validate regress` reads and more."""
    lines = [",".join(PEAK_COLUMNS)]
    lines += [",".join(str(row.get(name, "")) for name in PEAK_COLUMNS) for row in rows]
    return "\n".join(lines) + "\n"


def write_rig(
    folder: Path | str,
    name: str,
    passes: RigPasses,
    origin: str,
    source: str,
    case_id: str,
    conditions: Mapping[str, str | float],
    provenance: Mapping[str, str],
    calibration: float = 0.0,
) -> tuple[Path, ...]:
    """Write ``<name>.csv`` (mean history), ``<name>-passes.csv``, ``<name>.yaml``; renew the folder's ``peaks.csv``."""
    base = Path(folder)
    files = [base / f"{name}{ending}" for ending in (".csv", "-passes.csv", ".yaml")]
    head = {"case_id": case_id, "producer": "rig", "origin": origin, **provenance}
    mean_history(passes, head).write_csv(files[0])
    write_text(files[1], passes_csv(passes))
    row = peak_row(passes, "rig", case_id, conditions, calibration)
    lines = [
        f"name: {name}",
        f"origin: {origin}",
        f"source: {_quoted(source)}",
        f"case_id: {_quoted(case_id)}",
        *(f"{key}: {value}" for key, value in conditions.items()),
        f"history: {files[0].name}",
        f"history_sha256: {sha256_file(files[0])}",
        f"passes: {passes.count}",
        f"speed_rpm: {passes.speed_rpm:.3f}",
        f"speed_change_percent: {100 * passes.speed_change:.3f}",
        f"low_pass_Hz: {passes.cutoff:g}",
        "low_pass: 'Butterworth of order 4, forth and back, -3 dB in all at low_pass_Hz'",
        "drift: 'straight line through the free running of each pass, taken off'",
        f"drift_range_N: {passes.drift:.3f}",
        f"noise_N: {passes.noise:.4f}",
        f"missed_triggers: {passes.missed_triggers}",
        f"false_triggers: {passes.false_triggers}",
        f"passes_in_gaps: {passes.passes_in_gaps}",
        f"passes_without_contact: {passes.passes_without_contact}",
        f"calibration_95_percent: {100 * calibration:g}",
        f"contact_duration_s: {passes.contact_duration:.6f}",
        "peaks:",
        *(f"  {key}: {value}" for key, value in row.items() if key.endswith("_N")),
        *(f"{key}: {_quoted(value)}" for key, value in provenance.items()),
    ]
    write_text(files[2], "\n".join(lines) + "\n")
    write_text(base / PEAKS, peaks_csv(peak_rows(load_rig(base))))
    return (*files, base / PEAKS)


def load_rig(folder: Path | str) -> tuple[RigReference, ...]:
    """Return every imported record of a folder, by name; raises `InputError` for a damaged one."""
    found = []
    for path in sorted(Path(folder).glob("*.yaml")):
        record = read_yaml(path)
        if not isinstance(record, dict) or "history" not in record:
            raise InputError(path, "no history", "a record as `tread-validate import-rig` writes it")
        history = path.parent / Path(str(record["history"])).name
        if not history.is_file():
            raise InputError(f"{path}: history", one_line(str(record["history"]), 80), "an existing file beside it")
        if sha256_file(history) != record.get("history_sha256"):
            raise InputError(f"{path}: history_sha256", "another checksum", "the one of the history (changed by hand?)")
        found.append(
            RigReference(
                str(record.get("name", path.stem)), str(record.get("origin")), History.read_csv(history), record
            )
        )
    return tuple(found)


def _quoted(text: str) -> str:
    return "'" + one_line(str(text), 290).replace("'", "''") + "'"
