"""The history data of a deck: the lead-in and the pass."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..geometry import Path
from ..study import Case
from ..units import US
from .form import Form
from .inputs import Inputs
from .keywords import comment, keyword, number
from .placement import MountTable
from .sections import INTERACTION, road_freedom

FloatArray = NDArray[np.float64]

ENERGIES = "ALLIE, ALLKE, ALLAE, ALLVD, ALLCD, ALLSE, ALLFD, ALLWK, ETOTAL"
PAIR = "TREAD_ROAD_PAIR"


def motion_lines(form: Form, inputs: Inputs, tables: Sequence[MountTable]) -> list[str]:
    """Build the amplitudes of the mount rows' velocities (mm/s, total time) and the conditions that apply them."""
    lines = [comment("Belt: each row of mount nodes follows the belt; velocities in mm/s against total time")]
    pace = form.put(inputs["pace"])
    scaled = {} if form.single_file else {"SCALEX": form.put(inputs["stretch"])}
    for index, row in enumerate(tables, start=1):
        for axis, dof, time, velocity in (
            ("X", 1, row.time_x, row.velocity_x),
            ("Y", 2, row.time_y, row.velocity_y),
        ):
            name = f"V{axis}_{index:03d}"
            lines += [
                keyword("AMPLITUDE", NAME=name, TIME="TOTAL TIME", **scaled),
                *_pairs(time, velocity),
                keyword("BOUNDARY", TYPE="VELOCITY", AMPLITUDE=name),
                f"MOUNT_{index:03d}, {dof}, {dof}, {pace}",
            ]
    return lines


def steps(
    form: Form, inputs: Inputs, case: Case, path: Path, tables: Sequence[MountTable], general_contact: bool
) -> list[str]:
    """Build the lead-in and the pass: velocities and contact are set in the first step and go on in the second."""
    viscosity = ", ".join(number(value) for value in case.deck.bulk_viscosity)
    dof = road_freedom(path)
    lines = [
        comment("Lead-in: no contact yet"),
        keyword("STEP", NAME="approach", NLGEOM="YES"),
        keyword("DYNAMIC", "EXPLICIT"),
        f", {form.put(inputs['approach_time'])}",
        keyword("BULK VISCOSITY"),
        viscosity,
        keyword("BOUNDARY", TYPE="VELOCITY"),
        f"ROAD_REF, {dof}, {dof}, {form.put(inputs['road_rate'])}",
    ]
    if case.path.mount_is_rigid:
        lines.append(f"RING_REF, 6, 6, {form.put(inputs['block_rate'])}")
    if tables:
        lines += form.include(f"motion-{case.path_name}", motion_lines(form, inputs, tables))
    return [
        *lines,
        *(_general_contact() if general_contact else _contact_pair()),
        keyword("OUTPUT", "FIELD", NUMBER_INTERVAL=1),
        keyword("NODE OUTPUT"),
        "U,",
        keyword("END STEP"),
        comment("Pass: from the first contact until the block is clear of the road"),
        keyword("STEP", NAME="pass", NLGEOM="YES"),
        keyword("DYNAMIC", "EXPLICIT"),
        f", {form.put(inputs['pass_time'])}",
        keyword("BULK VISCOSITY"),
        viscosity,
        *_output(case, general_contact),
        keyword("END STEP"),
    ]


def _contact_pair() -> list[str]:
    return [
        comment("Kinematic: VFRIC needs it. CPSET names this pair, so that the contact output below can ask for it;"),
        comment("ABAQUS/Explicit gives contact forces of a history for a named set of pairs only."),
        keyword("CONTACT PAIR", INTERACTION=INTERACTION, MECHANICAL_CONSTRAINT="KINEMATIC", CPSET=PAIR),
        "FACE, ROAD",
    ]


def _general_contact() -> list[str]:
    return [
        comment("General contact (penalty) between these two surfaces alone; VFRICTION gives the friction"),
        keyword("CONTACT"),
        keyword("CONTACT INCLUSIONS"),
        "FACE, ROAD",
        keyword("CONTACT PROPERTY ASSIGNMENT"),
        f"FACE, ROAD, {INTERACTION}",
    ]


def _output(case: Case, general_contact: bool) -> list[str]:
    named: dict[str, object] = {"SURFACE": "FACE"} if general_contact else {"CPSET": PAIR}
    field = keyword("CONTACT OUTPUT", "GENERAL CONTACT") if general_contact else keyword("CONTACT OUTPUT", CPSET=PAIR)
    return [
        keyword("OUTPUT", "HISTORY", TIME_INTERVAL=number(case.deck.history_interval_us * US)),
        keyword("CONTACT OUTPUT", **named),
        "CFN, CFS",
        keyword("NODE OUTPUT", NSET="ROAD_REF"),
        "RF, RM, U, UR, V",
        keyword("ENERGY OUTPUT"),
        ENERGIES,
        keyword("OUTPUT", "FIELD", NUMBER_INTERVAL=case.deck.field_frames),
        keyword("NODE OUTPUT"),
        "U, V",
        keyword("ELEMENT OUTPUT", ELSET="BLOCK"),
        "S, LE",
        field,
        "CSTRESS, FSLIP, FSLIPR",
    ]


def _pairs(time: FloatArray, value: FloatArray) -> list[str]:
    """Return (time, value) pairs, four to a line."""
    rounded = np.round(value, 4) + 0.0  # -0 becomes 0
    text = [f"{t:.9f}, {v:.4f}" for t, v in zip(time.tolist(), rounded.tolist(), strict=True)]
    return [", ".join(text[i : i + 4]) for i in range(0, len(text), 4)]
