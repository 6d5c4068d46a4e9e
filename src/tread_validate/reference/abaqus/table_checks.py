"""What a force table must be to be the result of its deck: clock, sign, unit and whole contact."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from .deck_facts import DeckFacts
from .tables import AbaqusTable

Array = NDArray[np.float64]

DURATION_TOLERANCE = 0.01  # of the pass
OPEN_END = 0.05  # of the peak, at both ends: corners of a mesh touch a little before the path's first contact
LARGEST_TENSION = 0.01  # of the peak
SAME_TIME = 1e-9  # s
STRAIN_RANGE = (1e-4, 0.5)  # peak force over plan area over modulus: what a pressed block can have
REACTION_TOLERANCE = 0.05
LARGEST_SHEAR = 3.0  # peak tangential force over peak normal force


def against_reaction(table: AbaqusTable, reaction: Array, normal: Array, shear: Array) -> str:
    """Compare the contact force with the road's reaction, which fixes its sign and its frame."""
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


def clock(table: AbaqusTable, time: Array, facts: DeckFacts, asked: str) -> tuple[float, NDArray[np.bool_], str]:
    """Return when the pass starts on the table's clock, which rows belong to it, and what was found."""
    stated = table.notes.get("clock", "")
    wanted = stated if stated in ("step", "total") else asked
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


def plausible(
    table: AbaqusTable,
    time: Array,
    normal: Array,
    shear: Array,
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
