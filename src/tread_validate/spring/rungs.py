"""The other rungs of the model ladder, made known to the registry; their modules load when one is run."""

from __future__ import annotations

from ..study import Case
from .variants import Pass, register


def _bonded(case: Case) -> Pass:
    from .bonded import prepare_bonded

    return prepare_bonded(case)


def _bonded_theory(case: Case) -> Pass:
    from .bonded import prepare_bonded_theory

    return prepare_bonded_theory(case)


def _coupled(case: Case) -> Pass:
    from .coupled.face_pass import prepare_coupled

    return prepare_coupled(case)


def _coupled_coarse(case: Case) -> Pass:
    from .coupled.face_pass import COARSE, prepare_coupled

    return prepare_coupled(case, COARSE)


register("bonded", _bonded, "the paper's springs with the block's apparent moduli, from one static elastic solve")
register("bonded_theory", _bonded_theory, "the same with moduli from shape-factor theory, for rectangles")
register("coupled", _coupled, "springs that know their neighbours: the block condensed on to its face, 1 mm")
register("coupled_coarse", _coupled_coarse, "the same on a 2 mm face, for many runs")
