"""Running a case: from the study's case to the history of the block's forces."""

from __future__ import annotations

import numpy as np

from ..history import History
from ..provenance import commit, version
from ..study import Case
from .cautions import cautions, sheared
from .creep import resolve_creep
from .variants import code_digest, pass_of

AFTER = 0.02
"""A history goes on for this fraction of the contact time after the block has let go."""


def run(case: Case, variant: str = "paper") -> History:
    """Return the history of one block pass.

    Normal force N = sum F_r, tangential force T = -sum F_l, share of the touching area that slips; uniform clock from
    the first contact to a little after the last. A free-rolling case without a creep ratio gets the one of
    `resolve_creep`. Raises `InputError` for a case that cannot run.
    """
    (case,) = resolve_creep([case])
    assert case.creep_ratio is not None
    block_pass = pass_of(case, variant)
    normal, shear, touching, slipping = block_pass.forces(case.creep_ratio).T
    wary = (*cautions(case, variant), *sheared(case, variant, float(np.max(np.abs(shear)))))
    area = float(np.max(touching))
    touches = touching > 1e-9 * area
    last = int(np.flatnonzero(touches)[-1])
    rows = min(int((1.0 + AFTER) * last) + 3, normal.size)
    share = np.divide(slipping, touching, out=np.zeros_like(slipping), where=touches)
    return History(
        time=block_pass.step * np.arange(rows),
        normal_force=np.where(touches, normal, 0.0)[:rows],
        tangential_force=np.where(touches, -shear, 0.0)[:rows],
        slipping_fraction=np.clip(share, 0.0, 1.0)[:rows],
        provenance={
            "case_id": case.case_id,
            "producer": f"spring/{variant}",
            "version": version(),
            "commit": commit(),
            "code": code_digest(variant),
            "case_digest": case.digest("spring"),
            "creep_ratio": f"{case.creep_ratio:.9g}",
            "free_rolling": str(case.free_rolling).lower(),
            "assumed": "; ".join(case.assumed()) or "none",
            **({"caution": "; ".join(wary)} if wary else {}),
        },
    )
