"""One table row for each thing that is compared; units stand in the headers or in a unit column."""

from __future__ import annotations

from dataclasses import asdict, fields
from typing import Any

from ..study import Case
from .claims.claim import CLAIM_COLUMNS, Claim
from .quantities import SCALARS
from .regression.differences import Difference
from .regression.line import Coefficient, Residual
from .runs import SourceRun
from .scores.ensemble import Ensemble
from .scores.sensitivity import Sensitivity

COLUMNS: dict[str, tuple[str, ...]] = {
    "cases": (
        "case_id", "run", "path", "block", "compound", "friction", "temperature_degC", "interference_mm", "speed_m_s",
        "speed_rpm", "creep_percent", "free_rolling", "measured_profile", "shape", "assumed", "case_digest",
    ),
    "peaks": (
        "source", "case_id", "rig", "shape", "path", "block", "temperature_degC", "interference_mm", "speed_m_s",
        *(quantity.column for quantity in SCALARS), "peak_pressure_MPa", "status", "note", "history_sha256", "assumed",
    ),
    "ensemble": (
        "group", "quantity", "metric", "reference_source", "predicted_source", "unit", "error_type", "cases",
        "compared", "passed", "mean_abs_error", "largest_abs_error", "largest_case_id", "bias", "model_scatter",
        "total_scatter", "reference_scatter", "status", "note", "assumed",
    ),
    "regression": tuple(item.name for item in fields(Coefficient)),
    "differences": tuple(item.name for item in fields(Difference)),
    "residuals": (
        "source", "shape", "coefficient", "set", "case_id", "x", "x_unit", "force_N", "fitted_N", "residual_N",
        "residual_percent", "assumed",
    ),
    "claims": CLAIM_COLUMNS,
    "sensitivity": tuple(item.name for item in fields(Sensitivity)),
    "assumed": ("input", "origin", "source", "cases"),
}  # fmt: skip


def case_row(case: Case) -> dict[str, Any]:
    """Return a case's conditions."""
    return {**case.conditions(), "shape": case.block.shape, "case_digest": case.digest()}


def peak_row(case: Case, run: SourceRun) -> dict[str, Any]:
    """Return the scalars of one run, empty where it has none."""
    values = run.scalars.as_dict() if run.scalars is not None else {}
    peak = values.get("peak_normal_force")
    if run.source.startswith("rig:"):
        values.pop("slipping_share", None)  # not measured
    return {
        "source": run.source,
        "case_id": case.case_id,
        "rig": case.is_rig,
        "shape": case.block.shape,
        "path": case.path_name,
        "block": case.block_name,
        "temperature_degC": case.temperature,
        "interference_mm": round(1e3 * case.interference, 9),
        "speed_m_s": round(case.speed, 6),
        **{quantity.column: values.get(quantity.name) for quantity in SCALARS},
        "peak_pressure_MPa": None if peak is None else 1e-6 * peak / (case.length * case.width),
        "status": run.status,
        "note": run.note,
        "history_sha256": run.digest,
        "assumed": "; ".join(case.assumed()),
    }


def ensemble_row(item: Ensemble) -> dict[str, Any]:
    """Return one summary."""
    row = {field.name: getattr(item, field.name) for field in fields(item) if field.name != "bias"}
    names = ("bias", "model_scatter", "total_scatter", "reference_scatter")
    return {**row, **(asdict(item.bias) if item.bias is not None else dict.fromkeys(names))}


def residual_row(row: Residual, assumed: str) -> dict[str, Any]:
    """Return one point of a regression."""
    return {
        "source": row.source,
        "shape": row.shape,
        "coefficient": row.coefficient,
        "set": row.set,
        "case_id": row.case_id,
        "x": row.x,
        "x_unit": row.x_unit,
        "force_N": row.force,
        "fitted_N": row.fitted,
        "residual_N": row.force - row.fitted,
        "residual_percent": 100.0 * (row.force - row.fitted) / row.fitted if row.fitted else None,
        "assumed": assumed,
    }


def claim_row(claim: Claim) -> dict[str, Any]:
    """Return one published claim next to its computed counterpart."""
    item, computed = claim.published, claim.computed
    return {
        "claim_id": item.id,
        "kind": claim.kind,
        "section": item.section,
        "statement": item.statement,
        "quantity": item.quantity,
        "unit": item.unit,
        "published": item.value,
        "published_low": claim.low,
        "published_high": claim.high,
        "spread_kind": item.spread_kind,
        "source": claim.source,
        "case_ids": computed.case_ids,
        "computed": computed.value,
        "error": claim.error,
        "error_type": claim.error_type,
        "verdict": claim.verdict,
        "status": computed.status,
        "note": claim.note,
        "assumed": "; ".join(computed.assumed),
    }
