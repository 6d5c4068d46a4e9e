"""From test matrices to cases."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..units import MM, PERCENT
from .case import Case
from .document import Study
from .factors import FACTORS
from .library import named_compound
from .run import Run

LONGEST_ID = 64


def expand(study: Study, source: Path, root: Path, digest: str) -> tuple[Case, ...]:
    """Return every case of the study, in the order of the file; the last factor varies fastest.

    Raises `InputError` for a run that cannot be (rpm on a belt, an interference beyond the block's height, a
    temperature at or below the WLF pole) and for two runs with one id.
    """
    cases: list[Case] = []
    seen: dict[str, int] = {}
    for index, run in enumerate(study.runs):
        where = f"{source}: runs[{index}]"
        levels = [factor.levels(run) for factor in FACTORS]
        keys = [factor.key for factor in FACTORS]
        for combination in itertools.product(*levels):
            case = _case(study, run, where, dict(zip(keys, combination, strict=True)), root, digest)
            if case.case_id in seen:
                raise InputError(
                    where, f"case id {case.case_id} again", "runs that differ (a factor level given twice?)"
                )
            seen[case.case_id] = index
            cases.append(case)
    return tuple(cases)


def _case(
    study: Study,
    run: Run,
    where: str,
    level: dict[str, Any],
    root: Path,
    digest: str,
) -> Case:
    path = study.paths[level["path"]]
    block = study.blocks[level["block"]]
    compound = named_compound(study.compounds[level["compound"]], root)
    if level["poissons_ratio"] is not None:
        compound = compound.model_copy(update={"poissons_ratio": level["poissons_ratio"]})
    if run.speed_rpm is not None:
        turning = path.surface_speed(level["speed"])
        if turning is None:
            raise InputError(f"{where}.speed_rpm", level["speed"], f"speed_m_s: path {level['path']} is not a rig")
        speed = turning
    else:
        speed = level["speed"]
    if not path.rolls and level["creep"] != 0.0:
        raise InputError(f"{where}.creep_percent", level["creep"], f"0: the block on {level['path']} does not roll")
    if level["interference_mm"] >= block.height_mm:
        raise InputError(
            f"{where}.interference_mm",
            level["interference_mm"],
            f"less than the block's height, {block.height_mm:g} mm",
        )
    limit = path.tallest_block()
    if limit is not None and block.height_mm >= limit[0]:
        raise InputError(f"{where}.block", f"height {block.height_mm:g} mm", f"less than {limit[1]}")
    compound.time_shift.check(level["temperature_degC"], f"{where}.temperature_degC")
    free_rolling = level["creep"] == "free_rolling"
    return Case(
        case_id=_case_id(run, level),
        study_name=study.name,
        study_digest=digest,
        run=run.name,
        compound_name=level["compound"],
        friction_name=level["friction"],
        block_name=level["block"],
        path_name=level["path"],
        compound=compound,
        friction=study.friction_laws[level["friction"]],
        block=block,
        path=path,
        temperature=float(level["temperature_degC"]),
        interference=level["interference_mm"] * MM,
        speed=speed,
        creep_ratio=None if free_rolling else level["creep"] * PERCENT,
        free_rolling=free_rolling,
        spring=study.spring,
        deck=mesh.of(study.deck) if (mesh := study.mesh_of_path.get(level["path"])) else study.deck,
        root=root,
        speed_rpm=path.revolutions(speed),
    )


def _case_id(run: Run, level: dict[str, Any]) -> str:
    """Name the conditions; names that are the same in the whole run are left out, numbers never are."""
    parts = [run.name]
    for factor in FACTORS:
        tag = factor.tag(run, level[factor.key])
        if tag is not None and (factor.kind != "name" or len(factor.levels(run)) > 1):
            parts.append(tag)
    case_id = "-".join(parts).replace("_", "")
    if len(case_id) > LONGEST_ID:
        raise InputError(f"case {case_id}", f"{len(case_id)} characters", f"at most {LONGEST_ID}: shorten the names")
    return case_id
