"""What a baseline holds: every number of the tables with the tolerance within which it may move."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from ...errors import InputError
from ...files import read_text
from ..quantities import SCALARS

ROW_COLUMNS = (
    "kind", "source", "reference_source", "case_id", "quantity", "metric", "unit", "value", "text", "status",
    "tolerance",
)  # fmt: skip

# how far a number may move before it counts as moved: (relative, absolute in its unit). The models are deterministic
# and their histories are written to 10 uN; these tolerances are what another processor may do, not what a change may.
RELATIVE = 5e-6
TOLERANCES: dict[str, tuple[float, float]] = {
    "peak_normal_force": (RELATIVE, 5e-5),
    "peak_positive_tangential_force": (RELATIVE, 5e-4),
    "peak_negative_tangential_force": (RELATIVE, 5e-4),
    "normal_impulse": (RELATIVE, 1e-7),
    "net_tangential_impulse": (RELATIVE, 2e-6),
    "contact_duration": (RELATIVE, 1e-8),
    "time_of_peak_normal_force": (0.0, 2e-5),
    "tangential_to_normal_ratio": (RELATIVE, 5e-6),
    "late_sign_change": (0.0, 0.5),
    "slipping_share": (0.0, 2e-3),
}
SCORE_TOLERANCE = (0.0, 2e-4)
ISO_TOLERANCE = (0.0, 2e-3)
COEFFICIENT_TOLERANCE = (1e-4, 1e-6)
CLAIM_TOLERANCE = (1e-4, 1e-6)
UNCERTAIN_CLAIMS = {"rig_peak_at_centre": (0.0, 2e-3), "belt_slip_at_exit": (0.0, 2e-3)}

# the coupled springs stop iterating within a tolerance, and another processor ends elsewhere in it: measured, up to 1.8
# times the tolerances above between an AVX-512 machine and one without AVX; the other variants did not move a digit
ITERATIVE, ITERATIVE_FACTOR = "spring:coupled", 5.0

Key = tuple[str, str, str, str, str, str]


@dataclass(frozen=True)
class BaselineRow:
    """One number (or, where `text` is set, one word) with its tolerance.

    Attributes
    ----------
    kind : str
        ``case`` (digest of all inputs of a case), ``scalar``, ``error``, ``regression`` or ``claim``.
    value : float or None
    text : str
        Digest of a case, verdict of a claim; must not change at all.
    status : str
        ``current``, ``missing``, ``stale``, ...
    tolerance : float
        In `unit`; a move of more than this in either direction fails.
    """

    kind: str
    source: str
    reference_source: str
    case_id: str
    quantity: str
    metric: str
    unit: str
    value: float | None
    text: str
    status: str
    tolerance: float

    @property
    def key(self) -> Key:
        """What makes the row the same row in another table."""
        return (self.kind, self.source, self.reference_source, self.case_id, self.quantity, self.metric)


def rows_of_tables(folder: Path | str) -> tuple[BaselineRow, ...]:
    """Return the rows of a folder of tables.

    Raises `InputError` where a table is missing, empty or without a column.
    """
    place = Path(folder)
    rows = [*_cases(place), *_scalars(place), *_errors(place), *_coefficients(place), *_claims(place)]
    rows = [_widened(row) if row.source.startswith(ITERATIVE) else row for row in rows]
    seen: dict[Key, BaselineRow] = {}
    for row in rows:
        if row.key in seen:
            raise InputError(place, f"{' '.join(part for part in row.key if part)} twice", "each row once")
        seen[row.key] = row
    return tuple(rows)


def _widened(row: BaselineRow) -> BaselineRow:
    return replace(row, tolerance=float(f"{ITERATIVE_FACTOR * row.tolerance:.4g}"))


def _cases(place: Path) -> Iterator[BaselineRow]:
    for row in _table(place / "cases.csv", ("case_id", "case_digest")):
        yield BaselineRow(
            "case", "study", "", row["case_id"], "inputs", "digest", "", None, row["case_digest"], "current", 0.0
        )


def _scalars(place: Path) -> Iterator[BaselineRow]:
    columns = tuple(quantity.column for quantity in SCALARS)
    for row in _table(place / "peaks.csv", ("source", "case_id", "status", *columns)):
        for quantity in SCALARS:
            value = _value(row[quantity.column])
            tolerance = _width(TOLERANCES[quantity.name], value)
            yield BaselineRow(
                "scalar", row["source"], "", row["case_id"], quantity.name, "scalar", quantity.unit, value, "",
                row["status"], tolerance,
            )  # fmt: skip


def _errors(place: Path) -> Iterator[BaselineRow]:
    needed = ("case_id", "quantity", "metric", "reference_source", "predicted_source", "error", "error_type", "unit")
    for row in _table(place / "errors.csv", (*needed, "reference", "status")):
        value = _value(row["error"])
        if row["metric"] == "scalar":
            width = _error_width(row, value)
        elif row["error_type"] == "absolute":
            width = _width(TOLERANCES["peak_positive_tangential_force"], _value(row["reference"]))
        else:
            width = _width(ISO_TOLERANCE if row["metric"].startswith("iso") else SCORE_TOLERANCE, value)
        yield BaselineRow(
            "error", row["predicted_source"], row["reference_source"], row["case_id"], row["quantity"], row["metric"],
            row["unit"] if row["error_type"] == "absolute" else "1", value, "", row["status"], width,
        )  # fmt: skip


def _coefficients(place: Path) -> Iterator[BaselineRow]:
    for row in _table(place / "regression.csv", ("source", "shape", "coefficient", "set", "value", "unit", "status")):
        value = _value(row["value"])
        yield BaselineRow(
            "regression", row["source"], "", f"{row['shape']} {row['set']}", row["coefficient"], "coefficient",
            row["unit"], value, "", row["status"], _width(COEFFICIENT_TOLERANCE, value),
        )  # fmt: skip


def _claims(place: Path) -> Iterator[BaselineRow]:
    for row in _table(place / "claims.csv", ("claim_id", "source", "computed", "unit", "verdict", "status")):
        value = _value(row["computed"])
        width = _width(UNCERTAIN_CLAIMS.get(row["claim_id"], CLAIM_TOLERANCE), value)
        yield BaselineRow(
            "claim", row["source"], "", row["claim_id"], "computed", "claim", row["unit"], value, row["verdict"],
            row["status"], width,
        )  # fmt: skip


def _error_width(row: dict[str, str], error: float | None) -> float:
    """Return how far a scalar's error may move: as far as its prediction may, expressed as the error is."""
    tolerance = TOLERANCES[row["quantity"]]
    reference = _value(row["reference"])
    if row["error_type"] == "relative":
        if reference is None or reference == 0.0 or error is None:
            return tolerance[0]
        return _width((tolerance[0], tolerance[0] + tolerance[1] / abs(reference)), error)
    return _width(tolerance, reference)


def _width(tolerance: tuple[float, float], value: float | None) -> float:
    relative, absolute = tolerance
    return float(f"{relative * abs(value or 0.0) + absolute:.4g}")


def _value(text: str) -> float | None:
    if text == "":
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def _table(path: Path, needed: tuple[str, ...]) -> list[dict[str, str]]:
    reader = csv.DictReader(io.StringIO(read_text(path)))
    missing = [name for name in needed if name not in (reader.fieldnames or ())]
    if missing:
        raise InputError(f"{path}:1", f"no column {missing[0]}", "a table of the comparison")
    rows = list(reader)
    if not rows:
        raise InputError(path, "a header only", "at least one row")
    return rows
