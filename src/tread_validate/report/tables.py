"""The comparison's tables, read back with a check of their columns."""

from __future__ import annotations

import io
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from ..errors import InputError
from ..files import read_text

COLUMNS: dict[str, tuple[str, ...]] = {
    "cases": (
        "case_id", "run", "path", "block", "temperature_degC", "interference_mm", "speed_m_s", "speed_rpm",
        "creep_percent", "free_rolling", "shape", "assumed",
    ),
    "peaks": (
        "source", "case_id", "shape", "path", "temperature_degC", "interference_mm", "speed_m_s",
        "peak_normal_force_N", "status", "assumed",
    ),
    "errors": (
        "case_id", "quantity", "metric", "reference_source", "predicted_source", "reference", "predicted", "unit",
        "error", "error_type", "reference_uncertainty", "tolerance", "passed", "verdict", "status", "note", "assumed",
    ),
    "ensemble": (
        "group", "quantity", "metric", "reference_source", "predicted_source", "unit", "error_type", "cases",
        "compared", "passed", "mean_abs_error", "largest_abs_error", "largest_case_id", "bias", "model_scatter",
        "total_scatter", "reference_scatter", "status", "note", "assumed",
    ),
    "regression": (
        "source", "shape", "coefficient", "set", "value", "unit", "spread", "spread_kind", "low", "high", "ci_low",
        "ci_high", "ci_level", "n", "status", "note", "assumed",
    ),
    "regression_differences": (
        "shape", "coefficient", "source_a", "source_b", "difference", "unit", "ci_low", "ci_high", "p_value",
        "significant", "status", "note", "assumed",
    ),
    "regression_residuals": (
        "source", "shape", "coefficient", "set", "case_id", "x", "x_unit", "residual_percent", "assumed",
    ),
    "claims": (
        "claim_id", "kind", "section", "statement", "quantity", "unit", "published", "published_low", "published_high",
        "source", "computed", "error", "error_type", "verdict", "status", "note", "assumed",
    ),
    "published": ("id", "quantity", "value", "unit", "section", "statement", "comparability", "comparison"),
    "assumed": ("input", "origin", "source", "cases"),
}  # fmt: skip
OPTIONAL: dict[str, tuple[str, ...]] = {
    "sensitivity": ("metric", "quantity", "case_id", "variation", "samples", "value", "change"),
}


@dataclass(frozen=True)
class Tables:
    """Every table of one comparison; text columns hold empty strings, never NaN, where nothing is written."""

    cases: pd.DataFrame
    peaks: pd.DataFrame
    errors: pd.DataFrame
    ensemble: pd.DataFrame
    regression: pd.DataFrame
    regression_differences: pd.DataFrame
    regression_residuals: pd.DataFrame
    claims: pd.DataFrame
    published: pd.DataFrame
    assumed: pd.DataFrame
    sensitivity: pd.DataFrame
    provenance: dict[str, Any]
    folder: Path

    def sources(self, kind: str) -> list[str]:
        """Return the sources of `kind` (``spring``, ``fe`` or ``rig``) that have runs, in the order of the peaks."""
        names = dict.fromkeys(str(name) for name in self.peaks["source"])
        return [name for name in names if name.split(":")[0] == kind and not name.endswith(":published")]


def read_tables(folder: Path | str) -> Tables:
    """Read ``results/tables``; a missing table or column is an `InputError`."""
    place = Path(folder)
    frames = {name: read_table(place / f"{name}.csv", columns) for name, columns in COLUMNS.items()}
    for name, columns in OPTIONAL.items():
        path = place / f"{name}.csv"
        frames[name] = read_table(path, columns) if path.is_file() else pd.DataFrame(columns=list(columns))
    return Tables(**frames, provenance=_provenance(place / "provenance.json"), folder=place)


def read_table(path: Path, columns: tuple[str, ...]) -> pd.DataFrame:
    """Read one CSV table and check that it has `columns`; wholly numeric columns become numbers, others text."""
    try:
        frame = pd.read_csv(io.StringIO(read_text(path)), keep_default_na=False, dtype=str)
    except (pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(path, error, "a CSV table with a header row") from None
    missing = [name for name in columns if name not in frame.columns]
    if missing:
        raise InputError(f"{path}:1", f"no column {missing[0]}", "columns " + ", ".join(columns))
    for name in frame.columns:
        numbers = pd.to_numeric(frame[name].where(frame[name] != ""), errors="coerce")
        if bool((numbers.notna() | (frame[name] == "")).all()) and bool(numbers.notna().any()):
            frame[name] = numbers
    return frame


def _provenance(path: Path) -> dict[str, Any]:
    try:
        data = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}:{error.lineno}", error.msg, "JSON") from None
    if not isinstance(data, dict):
        raise InputError(path, type(data).__name__, "a JSON object")
    return data


def records(frame: pd.DataFrame) -> list[dict[str, Any]]:
    """Return the rows as mappings of column to value."""
    return [{str(key): value for key, value in row.items()} for row in frame.to_dict("records")]


def number(value: object) -> float | None:
    """Return a table value as a number, None where nothing (or no number) is written."""
    if isinstance(value, str):
        try:
            value = float(value)
        except ValueError:
            return None
    if not isinstance(value, int | float) and not hasattr(value, "__float__"):
        return None
    result = float(value)
    return None if pd.isna(result) else result
