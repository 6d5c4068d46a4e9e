"""Rows of what is not a row by itself: cases, runs and claims."""

from __future__ import annotations

from typing import Any, cast

from ..study import Case
from ..units import IN_MM, IN_MPA
from .claims.claim import Claim
from .quantities import SCALARS, Tolerance
from .runs import SourceRun
from .tables import CaseRow, ClaimRow, PeakRow, StatisticsRow, ToleranceRow


def case_row(case: Case) -> CaseRow:
    """Return a case's conditions."""
    conditions = cast(dict[str, Any], case.conditions())
    return CaseRow(**conditions, shape=case.block.shape, case_digest=case.digest())


def peak_row(case: Case, run: SourceRun) -> PeakRow:
    """Return the scalars of one run, empty where it has none."""
    found = run.scalars.as_dict() if run.scalars is not None else {}
    measured = run.source.startswith("rig:")
    values = {item.name: found.get(item.name) if item.measured or not measured else None for item in SCALARS}
    peak = values["peak_normal_force"]
    return PeakRow(
        source=run.source,
        case_id=case.case_id,
        rig=case.path.gives_coefficients,
        shape=case.block.shape,
        path=case.path_name,
        block=case.block_name,
        temperature_degC=case.temperature,
        interference_mm=round(IN_MM * case.interference, 9),
        speed_m_s=round(case.speed, 6),
        values=values,
        peak_pressure_MPa=None if peak is None else IN_MPA * peak / (case.length * case.width),
        status=run.status,
        note=run.note,
        history_sha256=run.digest,
        folder=run.folder,
        assumed="; ".join(case.assumed()),
    )


def statistics_row(case: Case, run: SourceRun) -> StatisticsRow:
    """Return means and scatter of one run, empty where it has no history with T."""
    found = run.statistics
    return StatisticsRow(
        source=run.source,
        case_id=case.case_id,
        mean_normal_N=None if found is None else found.mean_normal,
        mean_tangential_N=None if found is None else found.mean_tangential,
        rms_tangential_N=None if found is None else found.rms_tangential,
        scatter_N=None if found is None else found.scatter,
        frequency_Hz=None if found is None else found.frequency,
        alternates=run.status == "not_a_reference" and "stick and slip alternate" in run.note,
        status=run.status,
        assumed="; ".join(case.assumed()),
    )


def tolerance_row(item: Tolerance) -> ToleranceRow:
    """Return what is good enough for one quantity or score."""
    return ToleranceRow(
        item.name, item.value, item.floor, "" if item.floor is None else item.unit, item.criterion, item.origin,
        item.reason,
    )  # fmt: skip


def claim_row(claim: Claim) -> ClaimRow:
    """Return one published claim next to its computed counterpart."""
    item, computed = claim.published, claim.computed
    return ClaimRow(
        claim_id=item.id,
        kind=claim.kind,
        section=item.section,
        statement=item.statement,
        quantity=item.quantity,
        unit=item.unit,
        published=item.value,
        published_low=claim.low,
        published_high=claim.high,
        spread_kind=item.spread_kind,
        source=claim.source,
        case_ids=computed.case_ids,
        computed=computed.value,
        error=claim.error,
        error_type=claim.error_type,
        assessment=claim.assessment,
        status=computed.status,
        note=claim.note,
        assumed="; ".join(computed.assumed),
    )
