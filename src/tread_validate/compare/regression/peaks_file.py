"""Reading a table of peak forces."""

from __future__ import annotations

import math
from pathlib import Path

from ...bounds import bounded
from ...errors import InputError, one_line
from ...text_table import read_text_table
from .fit import Peak

NUMBERS = ("temperature_degC", "interference_mm", "speed_m_s")
FORCE = "peak_normal_force_N"


def read_peaks(path: Path | str) -> dict[str, list[Peak]]:
    """Return the peaks by source; an empty force is a missing run. Commas, semicolons or tabs part the cells.

    Decimal commas are read where semicolons or tabs do.

    Rows that say false in a column `rig` are passed over: a tyre belt case belongs to no set of speeds. Raises
    `InputError` for a missing column, no rows, a value that is no finite number, a force that is not positive, and for
    two rows of one run.
    """
    table = read_text_table(path, ";\t,")
    table.check(("shape", *NUMBERS, FORCE))
    found: dict[str, list[Peak]] = {}
    seen: set[tuple[object, ...]] = set()
    for where, row in table.records():
        if not _on_rig(row):
            continue
        temperature, interference, speed = (_number(row[name], name, where) for name in NUMBERS)
        force = None if row[FORCE].strip() == "" else _number(row[FORCE], FORCE, where)
        if force is not None and force <= 0.0:
            raise InputError(f"{where}: {FORCE}", row[FORCE], "a force > 0, or nothing where the run is missing")
        source = row.get("source") or ""
        key = (source, row["shape"], temperature, interference, speed)
        if key in seen:
            raise InputError(where, "the same run again", "one row for each shape, temperature, interference and speed")
        seen.add(key)
        case_id = row.get("case_id") or f"row {where.rpartition(':')[2]}"
        found.setdefault(source, []).append(Peak(case_id, row["shape"], temperature, interference, speed, force))
    if not found:
        raise InputError(path, "a header without rows of the rig", "at least one run")
    return found


def _on_rig(row: dict[str, str]) -> bool:
    return row.get("rig", "true") != "false"


def _number(text: str, name: str, where: str) -> float:
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{where}: {name}", one_line(repr(text), 40), "a finite number")
    return bounded(value, name, f"{where}: {name}")
