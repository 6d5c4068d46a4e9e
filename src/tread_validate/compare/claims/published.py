"""Every published number with its computed counterpart and an assessment, or the reason why there is none."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from . import belt, rig
from .claim import Claim, Compute, Computed, Evidence, judge
from .inputs import INPUTS
from .needs import differing_inputs, not_applicable
from .study import STUDY

NOT_COMPARED = "not_compared"

# the surrogate compound was made to meet the mean modulus, and the forces of the paper's uniaxial springs with it; the
# synthetic trace was made with its curvatures: agreement proves nothing
TUNED = (
    "average_modulus", "contact_strain", "belt_normal_force", "belt_contact_pressure", "free_rolling_contact_stress",
    "unloaded_curvature", "largest_curvature", "edge_curvature",
)  # fmt: skip

TUNED_SOURCES = ("study", "spring:paper", "spring:light")


def published_claims(evidence: Evidence, sources: Sequence[str]) -> tuple[Claim, ...]:
    """Return the claims in the order of the paper; one that depends on a run has a row for every source.

    Parameters
    ----------
    sources : sequence of str
        Sources with runs of their own (``spring:paper``, ``fe:embedded``, ...).
    """
    claims = []
    for item in evidence.published.values():
        if item.comparability == "context":
            claims.append(judge(item, "context", "", Computed(None, status=NOT_COMPARED, note=item.comparison)))
            continue
        found = False
        differing = differing_inputs(evidence, item.id)
        for source, compute in _computations(item.id, sources):
            computed = compute(evidence, source)
            if differing and not source.endswith(":published"):
                computed = not_applicable(differing, computed)
            claims.append(judge(item, _kind(item.id, source), source, computed))
            found = True
        if not found:
            claims.append(judge(item, "context", "", Computed(None, status=NOT_COMPARED, note=item.comparison)))
    return tuple(claims)


def _kind(claim_id: str, source: str) -> str:
    if claim_id in TUNED and source in TUNED_SOURCES:
        return "tuned"
    if claim_id in INPUTS:
        return "input"
    if source.endswith(":published") or claim_id.startswith("typical_"):
        return "published"
    return "study" if claim_id in STUDY else "model"


def _computations(claim_id: str, sources: Sequence[str]) -> Iterator[tuple[str, Compute]]:
    """Yield who computes a claim and how."""
    if claim_id in INPUTS:
        yield "study", INPUTS[claim_id]
    elif claim_id in STUDY:
        yield "study", STUDY[claim_id]
    elif claim_id in rig.REGRESSIONS:
        published = ("fe:published",) if claim_id == "temperature_overestimate" else ("rig:published", "fe:published")
        for source in (*published, *sources):
            yield source, rig.REGRESSIONS[claim_id]
    elif claim_id in rig.TABLE_1:
        for source in sources:
            yield source, rig.TABLE_1[claim_id]
    elif claim_id in belt.SPRING:
        for source in sources:
            if source.startswith("spring:"):
                yield source, belt.SPRING[claim_id]
    else:
        compute = belt.RUNS.get(claim_id) or rig.RUNS.get(claim_id)
        for source in sources if compute is not None else ():
            assert compute is not None
            yield source, compute
