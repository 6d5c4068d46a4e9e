"""One law of stick and slip (docs/friction.md) in deck, VFRIC and engine: three nodes that share a block.

What moves the nodes by how much is found without contact, by moving one column after the other; then the order of
sticking and slipping and every force follow exactly, event by event.
"""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate.deck.vfric import properties, user_friction
from tread_validate.fe import run_deck
from tread_validate.fe.explicit import Simulation
from tread_validate.fe.model import read_model
from tread_validate.fe.user_friction import compile_vfric
from tread_validate.friction import coulomb_law

Floats = NDArray[np.float64]
DENSITY, DAMPING, PERIOD, PRESS, WAY = 1e-9, 3e-5, 2e-2, 2e-3, 8e-3  # t/mm3, s, s, s, mm
DEEP = 2e-3  # how far the block is pressed, mm
PRESSED = "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., 2e-3, 1.\n"
GOING = f"*AMPLITUDE, NAME=GO\n0., 0., {PRESS!r}, 0., {PERIOD!r}, 1.\n"


def columns(block: object) -> NDArray[np.int64]:
    """Nodes of the face by column along x, (3, 2)."""
    points = block.points  # type: ignore[attr-defined]
    return np.array([np.flatnonzero((points[:, 2] == 0.0) & (points[:, 0] == 4.0 * k)) for k in range(3)])


def built(fe: ModuleType) -> tuple[object, str]:
    """Two flat elements in a row, 8 x 2 x 1 mm, nu 0; their text."""
    block = fe.brick(2, 1, 1, 8.0, 2.0, 1.0)
    text = block.text().replace("NSET=ALL", "NSET=BLOCK", 1)
    return block, text + fe.elastic(20.0, 0.0, DENSITY, f"*DAMPING, BETA={DAMPING!r}\n")


def pressed_by(deep: float) -> str:
    return f"*BOUNDARY, AMPLITUDE=A\nTOP, 3, 3, {-deep!r}\n"


def reactions(fe: ModuleType, folder: Path, deep: float, moved: Floats) -> Floats:
    """Forces (3, 2: along x, normal) that hold the columns of the face where they are moved by `moved`, N."""
    block, text = built(fe)
    place = columns(block)
    sets = "".join(f"*NSET, NSET=C{k}\n" + "".join(f"{n + 1},\n" for n in place[k]) for k in range(3))
    held = "*BOUNDARY\nBLOCK, 2, 2\nTOP, 1, 1\nBOT, 3, 3\n"
    push = "".join(f"C{k}, 1, 1, {float(moved[k])!r}\n" for k in range(3))
    loads = pressed_by(deep) + "*BOUNDARY, AMPLITUDE=A\n" + push
    deck = folder / "held.inp"
    text = text + sets + PRESSED + held + fe.step(3e-3, loads)
    deck.write_text(text.replace("*END STEP", "*NODE OUTPUT, NSET=BOT\nRF,\n*END STEP"), encoding="utf-8")
    table = run_deck(deck, normal="+z", travel="+x").nodes
    last = table[table["time_s"] == table["time_s"].max()].set_index("node")
    return np.array([
        [last.loc[place[k] + 1, f"rf_{axis}_N"].sum() for axis in ("x", "z")] for k in range(3)
    ])  # fmt: skip


def followed(base: Floats, gain: Floats, static: float, kinetic: float, ways: Floats) -> tuple[Floats, Floats]:
    """Return forces along x (n, 3) and what slips (n, 3) as the road goes `ways`, by the law and statics alone.

    `base` (3, 2) are the forces before; `gain` (3, 2, 3) what a column's displacement adds to them. A column that slips
    and is carried ahead of the road by another's letting go stops there: its slip speed has passed zero.
    """
    slips, place, behind, before = np.zeros(3, dtype=bool), np.zeros(3), np.zeros(3), 0.0
    forces, states = [], []
    for way in ways:
        last = place.copy()
        for _ in range(6):
            place = np.where(slips, place, way - behind)
            if slips.any():
                # T = mu_k N of what slips: linear in where it is
                mixed = gain[slips, 0] - kinetic * gain[slips, 1]
                rest = -(base[slips, 0] - kinetic * base[slips, 1]) - mixed[:, ~slips] @ place[~slips]
                place[slips] = np.linalg.solve(mixed[:, slips], rest)
            found = base + gain @ place
            ahead = slips & (place - last > way - before)
            fresh = ~slips & (found[:, 0] > static * found[:, 1])
            if ahead.any():
                behind[ahead] = before - last[ahead]
            elif not fresh.any():
                break
            slips = (slips | fresh) & ~ahead
        before = way
        forces.append(found[:, 0])
        states.append(slips.copy())
    return np.array(forces), np.array(states)


@pytest.mark.parametrize(("static", "kinetic"), [(0.5, 0.5), (0.9, 0.5)], ids=["one coefficient", "two"])
def test_three_columns_of_a_block_slip_one_after_the_other(
    tmp_path: Path, fe: ModuleType, static: float, kinetic: float
) -> None:
    """The couple of the shear takes load off the column in front, which slips first; then the middle one does.

    With one coefficient the last follows. With two the middle lets go at once, which carries the one in front ahead of
    the road: it sticks again, by the law's third rule. States of all are exact outside of 1 % of the time around a
    change, and the forces of each within 1 % of the largest, by the decks' own VFRIC.
    """
    base = reactions(fe, tmp_path, DEEP, np.zeros(3))
    unit = [reactions(fe, tmp_path, 0.0, 1e-3 * np.eye(3)[k]) * 1e3 for k in range(3)]
    gain = np.stack(unit, axis=2)
    block, text = built(fe)
    law = coulomb_law(kinetic, static)
    routine = tmp_path / "vfric.f"
    routine.write_text(user_friction(law).source, encoding="ascii")
    friction = fe.user_friction(*properties(law, 0.5 * DENSITY)).replace("USER=FRIC", "USER=FRIC, DEPVAR=1")
    text += (
        fe.plane() + friction + PRESSED + GOING + "*BOUNDARY\nROADREF, 2, 6\nBLOCK, 2, 2\nTOP, 1, 1\n"
        + fe.step(PERIOD, "*BULK VISCOSITY\n0., 0.\n", pressed_by(DEEP),
                  f"*BOUNDARY, AMPLITUDE=GO\nROADREF, 1, 1, {WAY!r}\n", fe.CONTACT, interval=PERIOD / 400)
    )  # fmt: skip
    deck = tmp_path / "dragged.inp"
    deck.write_text(text, encoding="utf-8")
    simulation = Simulation(read_model(deck), compile_vfric(routine))
    simulation.run()
    pair = simulation.pairs[0].pair
    order = [np.isin(pair.slaves, c) for c in columns(block)]
    traction = np.array(simulation.samples.traction)[:, :, 0] * pair.area
    states = np.array(simulation.samples.slip_state) == 2
    found = np.stack([traction[:, own].sum(axis=1) for own in order], axis=1)
    slips = np.stack([states[:, own].any(axis=1) for own in order], axis=1)
    time = np.array(simulation.samples.time)
    ways = np.maximum(time - PRESS, 0.0) / (PERIOD - PRESS) * WAY
    exact, expected = followed(base, gain, static, kinetic, ways)
    turns = [time[row] for row in np.flatnonzero((expected[1:] != expected[:-1]).any(axis=1)) + 1]
    # but for the moments after a column lets go, in which the damped block settles
    calm = (time > PRESS) & np.all([np.abs(time - turn) > 0.01 * PERIOD for turn in turns], axis=0)
    assert len(turns) == (3 if static == kinetic else 2)
    assert np.array_equal(slips[calm], expected[calm])
    assert found[calm] == pytest.approx(exact[calm], abs=0.01 * np.abs(exact).max())
