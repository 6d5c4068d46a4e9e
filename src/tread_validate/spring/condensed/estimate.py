"""How far the condensed face is from its own limit of fine faces: an estimate from a second, coarser face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...study import Case
from .roll import CondensedSettings, FacePass, roll
from .store import ORDER

FINE, COARSE = CondensedSettings(), CondensedSettings(density=4.0, layers=6)


@dataclass(frozen=True)
class FaceError:
    """Estimated errors of discretisation of `condensed`, relative, >= 0; of T's peaks over the larger of the two."""

    normal: float
    impulse: float
    tangential: float


def face_error(case: Case) -> FaceError:
    """Return the estimate for a case whose creep ratio is known.

    Two faces, one twice as fine; their difference over 2^p - 1 with the order p = 1.39 of the static solve (the corners
    between bonded and free faces set it). Costs a third of a pass more. It is an estimate, not a bound.
    """
    if case.block.mesh is not None:
        raise InputError("block", f"mesh file {case.block.mesh}", "a block given by its dimensions: a file is one face")
    fine, coarse = _scalars(roll(case, FINE)), _scalars(roll(case, COARSE))
    share = 1.0 / (2.0**ORDER - 1.0)
    normal, impulse, positive, negative = (share * abs(a - b) for a, b in zip(fine, coarse, strict=True))
    largest = max(abs(fine[2]), abs(fine[3]), 1e-9)
    return FaceError(normal / fine[0], impulse / fine[1], max(positive, negative) / largest)


def _scalars(face: FacePass) -> tuple[float, float, float, float]:
    force, pull = face.normal_force, face.tangential_force
    return float(force.max()), float(np.trapezoid(force, face.time)), float(pull.max()), float(pull.min())
