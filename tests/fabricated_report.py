"""Made-up tables and histories for tests of the report: half sines, no physics.

Not a test and not results: nothing that is written here may be shown to anyone.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from tread_validate.compare.binding import write_provenance
from tread_validate.compare.tables import TABLES
from tread_validate.history import History
from tread_validate.source_code import code_digest
from tread_validate.study import Case, load_study

NASTY = "</script><script>document.title='caught'</script><img src=x onerror=alert(1)> & #set *bold* \"quoted\""
STUDY = f"""\
schema_version: 1
name: tiny
title: {json.dumps(NASTY)}
notes: [{json.dumps("note " + NASTY)}]
compounds:
  soft: {{kind: prony, origin: synthetic, source: {json.dumps("source " + NASTY)}, long_term_modulus_MPa: 10.0,
         terms: [{{modulus_MPa: 5.0, relaxation_time_s: 0.001}}]}}
friction_laws:
  dry: {{kind: coulomb, origin: assumed, source: chosen, static_coefficient: 0.9, kinetic_coefficient: 0.8}}
blocks:
  rectangle: {{origin: published, source: s, shape: rectangle, length_mm: 25.0, width_mm: 20.0, height_mm: 8.0}}
  parallelogram: {{origin: assumed, source: s, shape: parallelogram, length_mm: 25.0, width_mm: 20.0, height_mm: 8.0,
                  skew_deg: 30.0}}
paths:
  rig: {{kind: rig, origin: assumed, source: s}}
  simplified: {{kind: simplified_belt, origin: published, source: s}}
runs:
  - {{name: rig, path: rig, block: [rectangle, parallelogram], compound: soft, friction: dry,
     temperature_degC: [22.0, 45.0], interference_mm: [0.1, 0.2], speed_rpm: [150.0, 300.0]}}
  - {{name: belt, path: simplified, block: rectangle, compound: soft, friction: dry, temperature_degC: 60.0,
     interference_mm: 0.2, speed_m_s: 16.7, creep_percent: [free_rolling, 0.3]}}
"""
REFERENCE, MODEL = "fe:embedded", "spring:paper"
STALE, MISSING = "rig-parallelogram-45c-0p2mm-150rpm", "rig-parallelogram-45c-0p2mm-300rpm"
SCALARS = {
    "peak_normal_force": ("N", 1.0),
    "peak_positive_tangential_force": ("N", 0.2),
    "peak_negative_tangential_force": ("N", -0.2),
    "normal_impulse": ("N s", 0.005),
    "contact_duration": ("s", 1e-4),
}


@dataclass(frozen=True)
class Fabricated:
    """Where the made-up inputs of a report lie."""

    study: Path
    tables: Path
    spring: Path
    reference: Path
    decks: Path


def fabricate(folder: Path) -> Fabricated:
    """Write a study with markup in its texts, and its tables and histories."""
    places = Fabricated(
        folder / "study.yaml", folder / "tables", folder / "spring", folder / "reference", folder / "decks"
    )
    folder.mkdir(parents=True, exist_ok=True)
    places.study.write_text(STUDY, encoding="utf-8")
    cases = load_study(places.study).cases()
    places.tables.mkdir()
    _histories(places, cases)
    for name, frame in _frames(cases).items():
        whole = frame.reindex(columns=list(TABLES[name].header()), fill_value="").map(_spelt)
        whole.to_csv(places.tables / f"{name}.csv", index=False, lineterminator="\n")
    provenance = {
        "commit": "0" * 12,
        "version": "0.1.0",
        "study": "tiny",
        "study_digest": load_study(places.study).digest,
        "code": {"compare": code_digest("compare")},
        "packages": {"numpy": "2"},
        "inputs": {"study.yaml": "f" * 64},
        "sources": {REFERENCE: {"current": len(cases) - 2, "missing": 1, "stale": 1}},
    }
    write_provenance(places.tables, provenance)
    return places


def peak(case: Case) -> float:
    """Return the made-up reference's peak normal force, N."""
    return 1e6 * case.interference * (1.0 + 0.03 * case.speed)


def folder_of(case: Case) -> str:
    """Return where the made-up reference of a case lies, below the reference folder."""
    return f"fe/embedded/{case.case_id}-0"


def state(case: Case) -> str:
    """Return the made-up state of the reference of a case."""
    return {STALE: "stale", MISSING: "missing"}.get(case.case_id, "current")


def _spelt(value: object) -> object:
    return str(value).lower() if isinstance(value, bool) else value


def _histories(places: Fabricated, cases: tuple[Case, ...]) -> None:
    time = np.linspace(0.0, 0.01, 701)
    phase = np.pi * time / time[-1]
    for case in cases:
        filed = places.reference / folder_of(case) / "history.csv"
        for factor, file in ((1.0, filed), (0.9, places.spring / "paper" / f"{case.case_id}.csv")):
            normal = factor * peak(case) * np.sin(phase)
            history = History(time, normal, 0.2 * factor * peak(case) * np.sin(2.0 * phase), np.zeros_like(time))
            history.write_csv(file)


def _frames(cases: tuple[Case, ...]) -> dict[str, pd.DataFrame]:
    assumed = {case.case_id: "; ".join(case.assumed()) for case in cases}
    conditions = []
    for case in cases:
        row = case.conditions() | {"shape": case.block.shape, "case_digest": case.digest()}
        conditions.append(row | {"creep_percent": 0.31 if case.creep_ratio is None else row["creep_percent"]})
    return {
        "cases": pd.DataFrame(conditions),
        "peaks": _peaks(cases, assumed),
        "errors": _errors(cases, assumed),
        "ensemble": _ensemble(len(cases)),
        "expected": _expected(cases, assumed),
        "statistics": _statistics(cases, assumed),
        **_regressions(),
        "claims": _claims(),
        "published": pd.DataFrame(
            [
                {
                    "id": "p1",
                    "quantity": "peak",
                    "value": 200,
                    "unit": "N",
                    "low": "",
                    "high": "",
                    "spread_kind": "",
                    "section": "5",
                    "statement": "about 200 N",
                    "comparability": "computed",
                    "comparison": "peak",
                }
            ]
        ),
        "sensitivity": pd.DataFrame(),
        "tolerances": pd.DataFrame(),
        "assumed": pd.DataFrame(
            [
                {"input": "compound soft", "origin": "synthetic", "source": "source " + NASTY, "cases": 18},
                {"input": "friction law dry", "origin": "assumed", "source": "chosen", "cases": 18},
                {"input": "block parallelogram", "origin": "assumed", "source": "s", "cases": 8},
                {"input": "path rig", "origin": "assumed", "source": "s", "cases": 16},
            ]
        ),
    }


def _peaks(cases: tuple[Case, ...], assumed: dict[str, str]) -> pd.DataFrame:
    rows = []
    for source, factor in ((REFERENCE, 1.0), (MODEL, 0.9)):
        for case in cases:
            status = state(case) if source == REFERENCE else "current"
            force = factor * peak(case) if status == "current" else ""
            rows.append(
                {
                    "source": source,
                    "case_id": case.case_id,
                    "rig": case.path.family == "rig",
                    "shape": case.block.shape,
                    "path": case.path_name,
                    "block": case.block_name,
                    "temperature_degC": case.temperature,
                    "interference_mm": 1e3 * case.interference,
                    "speed_m_s": case.speed,
                    "peak_normal_force_N": force,
                    "status": status,
                    "folder": folder_of(case) if source == REFERENCE else "",
                    "assumed": assumed[case.case_id],
                }
            )
    return pd.DataFrame(rows)


def _errors(cases: tuple[Case, ...], assumed: dict[str, str]) -> pd.DataFrame:
    rows = []
    for case in cases:
        status = state(case)
        there = status == "current"
        common = {
            "case_id": case.case_id,
            "reference_source": REFERENCE,
            "predicted_source": MODEL,
            "status": status,
            "assumed": assumed[case.case_id],
            "tolerance": 0.05,
            "u_numerical": 0.0 if there else "",
            "u_input": 0.0 if there else "",
            "u_data": 0.01 if there else "",
            "uncertainty": 0.02 if there else "",
            "criterion": "5 % of the reference",
            "agreement": "differs" if there else "cannot tell",
        }
        for quantity, (unit, scale) in SCALARS.items():
            value = scale * peak(case)
            rows.append(
                common
                | {
                    "quantity": quantity,
                    "metric": "scalar",
                    "reference": value if there else "",
                    "predicted": 0.9 * value,
                    "unit": unit,
                    "error": -0.1 if there else "",
                    "error_type": "relative",
                    "passed": "false" if there else "",
                    "assessment": "inadequate" if there else "cannot tell",
                    "note": "",
                }
            )
        for quantity in ("normal_force", "tangential_force"):
            rows.append(
                common
                | {
                    "quantity": quantity,
                    "metric": "relative_rms",
                    "reference": "",
                    "predicted": "",
                    "unit": "1",
                    "error": 0.07 if there else "",
                    "error_type": "relative",
                    "passed": "",
                    "assessment": "cannot tell",
                    "note": "",
                }
            )
            rows.append(
                common
                | {
                    "quantity": quantity,
                    "metric": "iso18571_r",
                    "reference": 1 if there else "",
                    "predicted": 0.91 if there else "",
                    "unit": "1",
                    "error": -0.09 if there else "",
                    "error_type": "score",
                    "passed": "",
                    "assessment": "cannot tell",
                    "note": "",
                    "grade": "good" if there else "",
                }
            )
    return pd.DataFrame(rows)


def _expected(cases: tuple[Case, ...], assumed: dict[str, str]) -> pd.DataFrame:
    """The map expects 12 %, nine in ten below 30 %, and the run of the model is 10 % low; T lies outside the map."""
    rows = []
    for case in cases:
        there = state(case) == "current"
        for quantity in ("normal", "impulse", "tangential"):
            outside = quantity == "tangential"
            rows.append(
                {
                    "case_id": case.case_id,
                    "predicted_source": MODEL,
                    "reference_source": REFERENCE,
                    "quantity": quantity,
                    "expected": "" if outside else 0.12,
                    "limit": "" if outside else 0.3,
                    "actual": "" if not there else 0.1 if outside else -0.1,
                    "inside": "" if outside or not there else True,
                    "outside_map": "interference" if outside else "",
                    "map_made_by": "the model changed since the map was made",
                    "status": state(case),
                    "assumed": assumed[case.case_id],
                }
            )
    return pd.DataFrame(rows)


def _statistics(cases: tuple[Case, ...], assumed: dict[str, str]) -> pd.DataFrame:
    """Stick and slip alternate in the reference of the first case; the model's means are 5 % lower."""
    rows = []
    for case in cases:
        for source, factor in ((REFERENCE, 1.0), (MODEL, 0.95)):
            alternates = source == REFERENCE and case is cases[0]
            rows.append(
                {
                    "source": source,
                    "case_id": case.case_id,
                    "mean_normal_N": 100.0 * factor,
                    "mean_tangential_N": -40.0 * factor,
                    "rms_tangential_N": 50.0 * factor,
                    "scatter_N": 3.0,
                    "frequency_Hz": 2500.0 if alternates else "",
                    "alternates": alternates,
                    "status": "not_a_reference" if alternates else "current",
                    "assumed": assumed[case.case_id],
                }
            )
    return pd.DataFrame(rows)


def _ensemble(cases: int) -> pd.DataFrame:
    rows = []
    for quantity, metric, kind, mean in (
        ("peak_normal_force", "scalar", "relative", 0.1),
        ("peak_positive_tangential_force", "scalar", "relative", 0.1),
        ("normal_force", "relative_rms", "relative", 0.07),
        ("tangential_force", "relative_rms", "relative", 0.07),
        ("normal_force", "iso18571_r", "score", 0.09),
    ):
        scalar = metric == "scalar"
        for group in ("all", "rig"):
            rows.append(
                {
                    "group": group,
                    "quantity": quantity,
                    "metric": metric,
                    "reference_source": REFERENCE,
                    "predicted_source": MODEL,
                    "unit": "1",
                    "error_type": kind,
                    "cases": cases,
                    "compared": cases - 2,
                    "passed": 0,
                    "adequate": 0,
                    "inadequate": cases - 2,
                    "agrees": 0,
                    "criterion": "5 % of the reference",
                    "mean_abs_error": mean,
                    "largest_abs_error": mean,
                    "largest_case_id": "rig-rectangle-22c-0p1mm-150rpm",
                    "bias": 0.9 if scalar else "",
                    "model_scatter": 0.02 if scalar else "",
                    "total_scatter": 0.02 if scalar else "",
                    "reference_scatter": 0.01 if scalar else "",
                    "status": "current",
                    "note": "",
                    "assumed": "compound soft (synthetic)",
                }
            )
    return pd.DataFrame(rows)


def _regressions() -> dict[str, pd.DataFrame]:
    rows, residuals = [], []
    for source, factor in (("rig:published", 1.2), ("fe:published", 1.1), (REFERENCE, 1.0), (MODEL, 0.9)):
        made = "" if source.endswith("published") else "compound soft (synthetic)"
        for shape in ("rectangle", "parallelogram"):
            for coefficient, value, unit, kind in (("a_v", 0.03, "s/m", "sd"), ("a_theta", -0.005, "1/degC", "range")):
                mean = factor * value
                rows.append(
                    {
                        "source": source,
                        "shape": shape,
                        "coefficient": coefficient,
                        "set": "mean",
                        "value": mean,
                        "unit": unit,
                        "spread": 0.2 * abs(mean),
                        "spread_kind": kind,
                        "low": mean - 0.2 * abs(mean),
                        "high": mean + 0.2 * abs(mean),
                        "ci_low": mean - 0.4 * abs(mean) if made else "",
                        "ci_high": mean + 0.4 * abs(mean) if made else "",
                        "ci_level": 0.95,
                        "n": 4,
                        "status": "current",
                        "note": "",
                        "assumed": made,
                    }
                )
                if made:
                    for rpm, x, residual in ((150, 1.571, 0.5), (300, 3.142, -0.5)):
                        residuals.append(
                            {
                                "source": source,
                                "shape": shape,
                                "coefficient": coefficient,
                                "set": "22 degC 0.1 mm",
                                "case_id": f"rig-rectangle-22c-0p1mm-{rpm}rpm",
                                "x": x,
                                "x_unit": "m/s" if coefficient == "a_v" else "degC",
                                "force_N": 100,
                                "fitted_N": 100,
                                "residual_N": residual,
                                "residual_percent": residual,
                                "assumed": made,
                            }
                        )
    difference = {
        "shape": "rectangle",
        "coefficient": "a_v",
        "source_a": MODEL,
        "source_b": "rig:published",
        "difference": -0.009,
        "unit": "s/m",
        "ci_low": -0.02,
        "ci_high": 0.002,
        "p_value": 0.09,
        "p_holm": 0.09,
        "family": "measured or published",
        "tests": 1,
        "significant": "false",
        "test": "Welch",
        "status": "current",
        "note": "",
        "assumed": "compound soft (synthetic)",
    }
    return {
        "regression": pd.DataFrame(rows),
        "regression_residuals": pd.DataFrame(residuals),
        "regression_differences": pd.DataFrame([difference]),
    }


def _claims() -> pd.DataFrame:
    rows = []
    for i, (assessment, computed) in enumerate((("agrees", 203.0), ("disagrees", 260.0), ("cannot tell", ""))):
        rows.append(
            {
                "claim_id": f"c{i}",
                "kind": "model",
                "section": "5",
                "statement": f"normal force about 200 N {NASTY}",
                "quantity": "peak_normal_force",
                "unit": "N",
                "published": 200,
                "published_low": "",
                "published_high": "",
                "spread_kind": "",
                "source": MODEL,
                "case_ids": "",
                "computed": computed,
                "error": 0.015 if computed else "",
                "error_type": "relative",
                "assessment": assessment,
                "status": "current" if computed else "missing",
                "note": "",
                "assumed": "compound soft (synthetic)",
            }
        )
    return pd.DataFrame(rows)
