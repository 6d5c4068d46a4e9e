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
from ...yaml_text import read_mapping, write_yaml
from ..fe_store import FeStore
from ..filing import file_run, read_run
from .deck_facts import DeckFacts, deck_facts
from .tables import Table, read_table

FORCE_UNITS = {"N": 1.0, "kN": 1e3, "mN": 1e-3}
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
DURATION_TOLERANCE = 0.01  # of the pass
OPEN_END = 0.05  # of the peak, at both ends: corners of a mesh touch a little before the path's first touch
LARGEST_TENSION = 0.01  # of the peak
SAME_TIME = 1e-9  # s
STRAIN_RANGE = (1e-4, 0.5)  # peak force over plan area over modulus: what a pressed block can have
REACTION_TOLERANCE = 0.05
LARGEST_SHEAR = 3.0  # peak tangential force over peak normal force


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
    start, kept, clock_check = _clock(table, time, facts, choice)
    time, normal, shear = time[kept] - start, normal[kept], shear[kept]
    slipping = None if slipping is None else slipping[kept]
    reaction = _reaction(table, choice)
    if reaction is not None:
        checks.append(_against_reaction(table, reaction[kept], normal, shear))
    checks += [clock_check, *_plausible(table, time, normal, shear, facts)]
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


def _identity(table: Table, facts: DeckFacts, choice: Options) -> list[str]:
    checks = []
    for what, found in (("--case", choice.case_id), (f"{table.source}: job", table.notes.get("job"))):
        if found and found != facts.case_id:
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
    table: Table, second: Table | None, choice: Options
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


def _reaction(table: Table, choice: Options) -> NDArray[np.float64] | None:
    """Return the road's reaction, (n, 2) in N, or None; what holds the road is the force that it has on the block."""
    found = []
    for name in ("RF1", "RF2"):
        index = [i for i, column in enumerate(table.columns) if re.fullmatch(rf"{name}@ROAD_REF(_N)?", column.strip())]
        if len(index) != 1:
            return None
        found.append(FORCE_UNITS[choice.force_unit] * table.values[:, index[0]])
    return np.column_stack(found)


def _against_reaction(
    table: Table, reaction: NDArray[np.float64], normal: NDArray[np.float64], shear: NDArray[np.float64]
) -> str:
    """Hold the contact force against the road's reaction, which fixes its sign and its frame."""
    contact = np.column_stack([-shear, normal])
    scale = float(np.max(np.abs(contact)))
    apart = float(np.max(np.abs(contact - reaction)))
    if apart > REACTION_TOLERANCE * scale:
        opposite = float(np.max(np.abs(contact + reaction))) <= REACTION_TOLERANCE * scale
        raise InputError(
            f"{table.source}: contact force against RF@ROAD_REF",
            "the opposite sign" if opposite else f"{apart:.4g} N apart",
            f"equal to {REACTION_TOLERANCE:.0%} of {scale:.4g} N"
            + (" (the forces act on the road: --force-on road)" if opposite else ""),
        )
    return f"contact force and reaction of the road: at most {apart:.3g} N apart"


def _at(second: Table, time: NDArray[np.float64], choice: Options) -> NDArray[np.float64]:
    own = second.values[:, 0] * TIME_UNITS[choice.time_unit]
    step = float(np.median(np.diff(time)))
    if abs(own[0] - time[0]) > step or abs(own[-1] - time[-1]) > step:
        raise InputError(f"{second.source}: time", f"{own[0]:g} to {own[-1]:g} s", f"{time[0]:g} to {time[-1]:g} s")
    return np.interp(time, own, second.values[:, 1])


def _clock(
    table: Table, time: NDArray[np.float64], facts: DeckFacts, choice: Options
) -> tuple[float, NDArray[np.bool_], str]:
    """Return when the pass starts on the table's clock, which rows belong to it, and what was found."""
    stated = table.notes.get("clock", "")
    wanted = stated if stated in ("step", "total") else choice.clock
    room = DURATION_TOLERANCE * facts.pass_duration
    whole = facts.lead_in + facts.pass_duration
    for clock, end, start in (("step", facts.pass_duration, 0.0), ("total", whole, facts.lead_in)):
        if wanted not in (clock, "auto") or abs(time[-1] - end) > room:
            continue
        kept = time >= start - SAME_TIME
        if time[kept][0] - start > room:
            raise InputError(
                f"{table.source}: time, first row", f"{time[0]:g} s", f"the pass from its start at {start:g} s on"
            )
        if clock == "step" and not kept.all():
            raise InputError(f"{table.source}: time, first row", f"{time[0]:g} s", "no time before the step")
        return start, kept, f"duration: ends at {time[-1]:.6g} s on the {clock} clock, the deck's is {end:.6g} s"
    raise InputError(
        f"{table.source}: time, last row",
        f"{time[-1]:g} s",
        f"{facts.pass_duration:g} s (clock of the pass) or {whole:g} s (total time), within 1 %",
    )


def _plausible(
    table: Table,
    time: NDArray[np.float64],
    normal: NDArray[np.float64],
    shear: NDArray[np.float64],
    facts: DeckFacts,
) -> list[str]:
    """Check sign, unit and whole contact; return what was found."""
    where = f"{table.source}: normal force"
    peak = float(np.max(np.abs(normal)))
    if peak == 0.0:
        raise InputError(where, "0 throughout", "a block that touches the road")
    impulse = float(np.trapezoid(normal, time))
    if impulse <= 0.0:
        raise InputError(
            where, f"an impulse of {impulse:.4g} N s", "compression as positive (do the forces act on the road?)"
        )
    lowest = float(normal.min())
    if lowest < -LARGEST_TENSION * peak:
        raise InputError(
            where, f"{lowest:.4g} N of tension", f"none beyond {LARGEST_TENSION:.0%} of the peak, {peak:.4g} N"
        )
    strain = peak / (facts.plan_area * facts.modulus)
    if not STRAIN_RANGE[0] <= strain <= STRAIN_RANGE[1]:
        raise InputError(
            where,
            f"a peak of {peak:.4g} N, {strain:.2g} of the block's modulus times area",
            f"{STRAIN_RANGE[0]:g} to {STRAIN_RANGE[1]:g} (is the unit N?)",
        )
    for end, value in (("first", normal[0]), ("last", normal[-1])):
        if abs(value) > OPEN_END * peak:
            raise InputError(f"{where}, {end} row", f"{value:.4g} N", "a whole pass, without contact at both ends")
    ratio = float(np.max(np.abs(shear))) / peak
    if ratio > LARGEST_SHEAR:
        raise InputError(
            f"{table.source}: tangential force", f"{ratio:.3g} times the normal peak", f"at most {LARGEST_SHEAR:g}"
        )
    return [
        f"sign: normal impulse {impulse:.6g} N s, largest tension {max(0.0, -lowest):.3g} N",
        f"unit: peak over modulus times area {strain:.3g}",
        f"tangential over normal peak {ratio:.3g}",
    ]


def read_record(path: Path | str) -> dict[str, Any]:
    """Read a record; raises `InputError` where it is no mapping."""
    return read_mapping(path)
