"""From a force table and its deck to a history and its record, with every check written down."""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ... import provenance
from ...errors import InputError
from ...history import History
from ...inp import DeckFiles
from ...source_code import code_digest
from ...units import KILO, MILLI, MS, US
from ...yaml_text import read_mapping, write_yaml
from ..fe_store import FeStore
from ..filing import file_run, read_run
from .deck_facts import DeckFacts, deck_facts
from .table_checks import against_reaction, clock, plausible
from .tables import AbaqusTable, read_table

FORCE_UNITS = {"N": 1.0, "kN": KILO, "mN": MILLI}
TIME_UNITS = {"s": 1.0, "ms": MS, "us": US}
VARIANTS = ("-constant-friction", "-general-contact")
"""What the names of a case's other decks, and of their jobs, end with."""


@dataclass(frozen=True)
class Options:
    """How to read a table that does not say it itself.

    Attributes
    ----------
    force_unit, time_unit : str
        ``N``, ``kN``, ``mN``; ``s``, ``ms``, ``us``. Decks are in N and s.
    clock : str
        ``step``: t = 0 at the start of the pass; ``total``: at the start of the analysis; ``auto``: whichever the
        last time fits.
    force_on : str
        ``block`` or ``road``: which body the forces act on.
    case_id : str or None
        The case, where it must be another than the table or deck says: never needed, only checked.
    version : str
        Release of ABAQUS, where the table does not say it.
    """

    force_unit: Literal["N", "kN", "mN"] = "N"
    time_unit: Literal["s", "ms", "us"] = "s"
    clock: Literal["auto", "step", "total"] = "auto"
    force_on: Literal["block", "road"] = "block"
    case_id: str | None = None
    version: str = ""


@dataclass(frozen=True)
class Imported:
    """A checked history with its record; the record lacks the history's checksum until it is filed."""

    history: History
    record: dict[str, Any]


def import_history(
    source: Path | str,
    deck: Path | str,
    user: Path | str | None = None,
    *,
    tangential: Path | str | None = None,
    options: Options | None = None,
    engine: str = "abaqus",
) -> Imported:
    """Read a force table, hold it against its deck and return the history.

    Parameters
    ----------
    source : path
        The extraction script's CSV, an XY report with CFN1, CFN2, CFS1, CFS2 as columns, or two columns: time and
        normal force (compression positive).
    deck, user : path
        What was run; the digest of both binds the result to the study.
    tangential : path, optional
        With a two-column `source`: time and tangential force of the road on the block, positive towards -x.
    options : Options, optional

    Raises
    ------
    InputError
        A file that cannot be read, or a result that does not fit its deck: identity, hash, duration, sign, unit.
    """
    choice = options or Options()
    facts = deck_facts(deck, user)
    table = read_table(source)
    checks = _identity(table, facts, choice)
    time, normal, shear, slipping = _forces(table, None if tangential is None else read_table(tangential), choice)
    start, kept, clock_check = clock(table, time, facts, choice.clock)
    time, normal, shear = time[kept] - start, normal[kept], shear[kept]
    slipping = None if slipping is None else slipping[kept]
    reaction = _reaction(table, choice)
    if reaction is not None:
        checks.append(against_reaction(table, reaction[kept], normal, shear))
    checks += [clock_check, *plausible(table, time, normal, shear, facts)]
    normal, shear = facts.whole * normal, facts.whole * shear
    version = table.notes.get("abaqus_version", "") or choice.version
    sources = [Path(source)] + ([] if tangential is None else [Path(tangential)])
    record: dict[str, Any] = {
        "case_id": facts.case_id,
        "engine": engine,
        "version": version or "not stated",
        "imported": True,
        "source_files": [path.name for path in sources],
        "source_sha256": [provenance.sha256_file(path) for path in sources],
        "layout": table.layout,
        "commit": provenance.commit(),
        "code": code_digest("abaqus"),
        "deck_digest": facts.digest,
        "deck_sha256": facts.deck_sha256,
        "user_sha256": facts.user_sha256,
        "symmetry": "half, forces doubled" if facts.whole > 1.0 else "full",
        "precision": table.notes.get("precision", "not stated"),
        "slipping": "share of touching nodes, from field frames" if slipping is not None else "not available",
        "checks": checks,
    }
    history = History(
        time,
        normal,
        shear,
        np.zeros_like(time) if slipping is None else slipping,
        {
            "case_id": facts.case_id,
            "producer": f"fe/{engine}",
            "version": record["version"],
            "engine": engine,
            "code": record["code"],
            "deck_digest": facts.digest,
            "slipping": record["slipping"],
        },
    )
    return Imported(history, record)


def file_history(imported: Imported, folder: Path | str, deck: DeckFiles, *, replace: bool = False) -> Path:
    """File the history, its record and its deck in the store of the reference folder and return the run's folder.

    Raises
    ------
    InputError
        A run of the same problem is there already and `replace` is not set.
    """
    store = FeStore(folder)
    there = store.equal_entry(str(imported.record["engine"]), deck.problem)
    if there is not None and not replace:
        raise InputError(there.folder, "a reference that is there already", "none, or --replace")
    with tempfile.TemporaryDirectory() as scratch:
        history = Path(scratch) / f"{imported.record['case_id']}.csv"
        write(imported, history)
        return file_run(store, read_run(history, deck), study="", replace=replace)


def write(imported: Imported, path: Path | str) -> None:
    """Write a history and, last, its record beside it."""
    target = Path(path)
    target.with_suffix(".yaml").unlink(missing_ok=True)
    imported.history.write_csv(target)
    record = {**imported.record, "history_sha256": provenance.sha256_file(target)}
    write_yaml(target.with_suffix(".yaml"), record)


def _identity(table: AbaqusTable, facts: DeckFacts, choice: Options) -> list[str]:
    checks = []
    for what, found in (("--case", choice.case_id), (f"{table.source}: job", table.notes.get("job"))):
        same = {facts.case_id, *(facts.case_id + one for one in VARIANTS if "job" in what)}
        if found and found not in same:
            raise InputError(what, found, f"{facts.case_id}, the case of the deck")
        if found:
            checks.append(f"case id: {what.split(': ')[-1]} says {found}, as the deck does")
    for key, own in (("deck_sha256", facts.deck_sha256), ("user_sha256", facts.user_sha256)):
        found = table.notes.get(key, "")
        if found and own and found != own:
            raise InputError(f"{table.source}: {key}", found[:12] + "...", f"{own[:12]}..., that of the file given")
        if found and own:
            checks.append(f"{key}: equal")
        elif own:
            checks.append(f"{key}: not in the table; bound to this deck by the importer's word only")
    return checks


def _forces(
    table: AbaqusTable, second: AbaqusTable | None, choice: Options
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64] | None]:
    """Return time (s, clock as written), normal and tangential force (N, our signs) and the slipping share."""
    scale = FORCE_UNITS[choice.force_unit]
    time = table.values[:, 0] * TIME_UNITS[choice.time_unit]
    if table.layout == "two columns":
        if second is None or second.layout != "two columns":
            found = "nothing" if second is None else second.layout
            raise InputError("--tangential", found, "a two-column file of the tangential force as well")
        return time, scale * table.values[:, 1], scale * _at(second, time, choice), None
    if second is not None:
        raise InputError("--tangential", second.source, "none: the table has both forces")
    parts: dict[str, NDArray[np.float64]] = {}
    for name in ("CFN1", "CFN2", "CFS1", "CFS2"):
        column = table.column(name)
        if column is None:
            raise InputError(
                f"{table.source}: columns", ", ".join(table.columns)[:120], "columns CFN1, CFN2, CFS1 and CFS2"
            )
        parts[name] = column
    sign = 1.0 if choice.force_on == "block" else -1.0
    normal = sign * scale * (parts["CFN2"] + parts["CFS2"])
    shear = -sign * scale * (parts["CFN1"] + parts["CFS1"])
    return time, normal, shear, table.column("slipping_fraction")


def _reaction(table: AbaqusTable, choice: Options) -> NDArray[np.float64] | None:
    """Return the road's reaction, (n, 2) in N, or None; what holds the road is the force that it has on the block."""
    found = []
    for name in ("RF1", "RF2"):
        index = [i for i, column in enumerate(table.columns) if re.fullmatch(rf"{name}@ROAD_REF(_N)?", column.strip())]
        if len(index) != 1:
            return None
        found.append(FORCE_UNITS[choice.force_unit] * table.values[:, index[0]])
    return np.column_stack(found)


def _at(second: AbaqusTable, time: NDArray[np.float64], choice: Options) -> NDArray[np.float64]:
    own = second.values[:, 0] * TIME_UNITS[choice.time_unit]
    step = float(np.median(np.diff(time)))
    if abs(own[0] - time[0]) > step or abs(own[-1] - time[-1]) > step:
        raise InputError(f"{second.source}: time", f"{own[0]:g} to {own[-1]:g} s", f"{time[0]:g} to {time[-1]:g} s")
    return np.interp(time, own, second.values[:, 1])


def read_record(path: Path | str) -> dict[str, Any]:
    """Read a record; raises `InputError` where it is no mapping."""
    return read_mapping(path)
