"""From factor grids to cases."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..units import MM, PERCENT, RPM
from .case import Case
from .models import Rig, Run, Study

FACTORS = (
    "path",
    "block",
    "compound",
    "friction",
    "temperature_degC",
    "interference_mm",
    "speed",
    "creep_percent",
)
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
        speeds = run.speed_rpm if run.speed_rpm is not None else run.speed_m_s
        levels = [_levels(speeds if name == "speed" else getattr(run, name)) for name in FACTORS]
        for combination in itertools.product(*levels):
            case = _case(study, run, where, dict(zip(FACTORS, combination, strict=True)), levels, root, digest)
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
    levels: list[tuple[Any, ...]],
    root: Path,
    digest: str,
) -> Case:
    path = study.paths[level["path"]]
    block = study.blocks[level["block"]]
    compound = study.compounds[level["compound"]]
    if run.speed_rpm is not None:
        if not isinstance(path, Rig):
            raise InputError(f"{where}.speed_rpm", level["speed"], f"speed_m_s: path {level['path']} is not a rig")
        speed = level["speed"] * RPM * 0.5 * path.small_wheel_diameter_mm * MM
    else:
        speed = level["speed"]
    if level["interference_mm"] >= block.height_mm:
        raise InputError(
            f"{where}.interference_mm",
            level["interference_mm"],
            f"less than the block's height, {block.height_mm:g} mm",
        )
    if isinstance(path, Rig) and block.height_mm >= 0.5 * path.small_wheel_diameter_mm:
        raise InputError(f"{where}.block", f"height {block.height_mm:g} mm", "less than the small wheel's radius")
    pole = compound.wlf.reference_temperature_degC - compound.wlf.c2_K
    if level["temperature_degC"] <= pole:
        raise InputError(f"{where}.temperature_degC", level["temperature_degC"], f"above the WLF pole, {pole:g} degC")
    free_rolling = level["creep_percent"] == "free_rolling"
    return Case(
        case_id=_case_id(run, level, levels),
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
        creep_ratio=None if free_rolling else level["creep_percent"] * PERCENT,
        free_rolling=free_rolling,
        spring=study.spring,
        deck=study.deck,
        root=root,
        speed_rpm=speed / (0.5 * path.small_wheel_diameter_mm * MM) / RPM if isinstance(path, Rig) else None,
    )


def _levels(value: Any) -> tuple[Any, ...]:
    return value if isinstance(value, tuple) else (value,)


def _case_id(run: Run, level: dict[str, Any], levels: list[tuple[Any, ...]]) -> str:
    """Name the conditions; names that are the same in the whole run are left out, numbers never are."""
    varies = {name: len(values) > 1 for name, values in zip(FACTORS, levels, strict=True)}
    parts = [run.name]
    parts += [level[name] for name in ("path", "block", "compound", "friction") if varies[name]]
    unit = "rpm" if run.speed_rpm is not None else "mps"
    parts += [
        f"{_number(level['temperature_degC'])}c",
        f"{_number(level['interference_mm'])}mm",
        f"{_number(level['speed'])}{unit}",
    ]
    if level["creep_percent"] == "free_rolling":
        parts.append("free")
    elif level["creep_percent"] != 0.0 or varies["creep_percent"]:
        parts.append(f"creep{_number(level['creep_percent'])}")
    case_id = "-".join(parts).replace("_", "")
    if len(case_id) > LONGEST_ID:
        raise InputError(f"case {case_id}", f"{len(case_id)} characters", f"at most {LONGEST_ID}: shorten the names")
    return case_id


def _number(value: float) -> str:
    """Write a number with letters, digits only: 0.2 -> 0p2, -5 -> m5."""
    text = f"{abs(value):.9g}".replace(".", "p").replace("e", "x").replace("+", "").replace("-", "m")
    return ("m" if math.copysign(1.0, value) < 0 and value != 0 else "") + text
