"""A cylinder and a sphere pressed into a thick layer and drawn back: Hertz if it is elastic, Ting if it relaxes."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate.fe import FeResult, run_deck

sys.path.insert(0, str(Path(__file__).parents[1]))
from half_space import MODULUS, RELAXED, ting

Floats = NDArray[np.float64]
RADIUS, RATIO, DEPTH, SLOW, PERIOD = 20.0, 0.4, 0.28, 6e-4, 6e-4  # mm, s
STIFF = MODULUS * 1e-6  # E/(1 - nu^2) at once, MPa
TIME = np.linspace(0.0, PERIOD, 241)
PRESSED = DEPTH * np.sin(np.pi * TIME / PERIOD) ** 2


def relaxation(relaxes: bool) -> str:
    """One Prony term, or none."""
    share = 1.0 - RELAXED / MODULUS
    return f"*VISCOELASTIC, TIME=PRONY\n{share!r}, {share!r}, {SLOW!r}\n" if relaxes else ""


def up() -> str:
    """How far the road has come up."""
    table = "".join(f"{t!r}, {d!r}\n" for t, d in zip(TIME.tolist(), PRESSED.tolist(), strict=True))
    return "*SURFACE INTERACTION, NAME=TOUCH\n*AMPLITUDE, NAME=UP\n" + table


def pressed(fe: ModuleType, folder: Path, relaxes: bool, size: float) -> FeResult:
    """Half of a layer 40 mm wide and 20 mm thick, in plane strain, on a rigid cylinder of 20 mm that comes up and goes.

    Density such that waves cross the layer a hundred times while the cylinder comes and goes.
    """
    count, layers = round(20.0 / size), 14
    block = fe.brick(count, 1, layers, 20.0, size, 1.0)
    points = block.points.copy()
    thick = 1.28 ** np.arange(layers)
    places = np.concatenate([[0.0], np.cumsum(thick)]) * 20.0 / thick.sum()
    points[:, 2] = places[np.rint(points[:, 2] * layers).astype(int)]
    slab = fe.Brick(points, block.elements)
    middle = np.flatnonzero(points[:, 0] == 0.0) + 1
    text = (
        slab.text().replace("NSET=ALL", "NSET=SLAB", 1) + "*NSET, NSET=MIDDLE\n" + "".join(f"{n},\n" for n in middle)
        + fe.elastic(STIFF * (1.0 - RATIO**2), RATIO, 1e-12, relaxation(relaxes)) + fe.wheel(RADIUS)
        + up() + "*BOUNDARY\nROADREF, 1, 2\nROADREF, 4, 6\nTOP, ENCASTRE\nSLAB, 2, 2\nMIDDLE, 1, 1\n"
        + fe.step(PERIOD, "*BOUNDARY, AMPLITUDE=UP\nROADREF, 3, 3, 1.\n", fe.CONTACT, interval=PERIOD / 240)
    )  # fmt: skip
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    return run_deck(path)


def force(result: FeResult, size: float) -> Floats:
    """Force of the whole cylinder per width at `TIME`, N/mm."""
    history = result.history
    return np.asarray(2.0 / size * np.interp(TIME, history.time, history.normal_force), dtype=np.float64)


def test_cylinder_pressed_into_a_viscoelastic_layer_and_drawn_back_feels_the_force_of_ting(
    tmp_path: Path, fe: ModuleType
) -> None:
    """Ting's theorem holds for any layer of one Poisson's ratio: E(t) and the force of the elastic layer give that of
    the other, 0.5 % of its peak at every instant, and the moment at which contact is lost, 1 % of the time.

    J. Appl. Mech. 33 (1966) 845-854. The elastic layer is a half-space on the scale of the contact: its largest
    pressure is Hertz', sqrt(P E/(pi R (1 - nu^2))), to 1.5 % with 8 elements over the half-width, which is a tenth of
    the thickness.
    """
    size = 0.25
    elastic = pressed(fe, tmp_path, False, size)
    load = force(elastic, size)
    middle = TIME.size // 2
    face = elastic.face
    peak = float(face["pressure_Pa"].max()) * 1e-6
    assert peak == pytest.approx(np.sqrt(load[middle] * STIFF / (np.pi * RADIUS)), rel=0.015)
    curve = np.interp(np.linspace(0.0, DEPTH, 401), PRESSED[: middle + 1], load[: middle + 1]) / STIFF
    exact, lost = ting(TIME, PRESSED, curve * 1e-6, SLOW)
    found = force(pressed(fe, tmp_path, True, size), size)
    assert found == pytest.approx(exact, abs=5e-3 * exact.max())
    assert exact.max() < 0.9 * load.max()
    assert lost < 0.95 * PERIOD
    assert TIME[found > 2e-3 * found.max()][-1] == pytest.approx(lost, abs=0.01 * PERIOD)


def graded(fine: float, count: int, length: float) -> Floats:
    """Places of nodes: `count` elements of `fine`, then 1.3 times as long each, stretched to end at `length`."""
    places = np.concatenate([[0.0], np.cumsum(fine * np.concatenate([np.ones(count), 1.3 ** np.arange(1, 40)]))])
    places = places[: int(np.searchsorted(places, length)) + 1]
    start = places[count]
    places[count:] = start + (places[count:] - start) * (length - start) / (places[-1] - start)
    return places


def pressed_sphere(fe: ModuleType, folder: Path, relaxes: bool, fine: float, dome: bool = False) -> FeResult:
    """A quarter of a layer of 40 x 40 x 20 mm on a rigid sphere of 20 mm (`TYPE=REVOLUTION`) that comes up and goes; or
    its face is a dome of that radius, on a plane: the same to the order of Hertz' theory.
    """
    side, deep = graded(fine, round(3.0 / fine), 20.0), graded(fine, 2, 20.0)
    regular = fe.brick(side.size - 1, side.size - 1, deep.size - 1, 1.0, 1.0, 1.0)
    points = np.column_stack(
        [
            places[np.rint(regular.points[:, c] * (places.size - 1)).astype(int)]
            for c, places in enumerate((side, side, deep))
        ]
    )
    bulge = np.minimum(points[:, 0] ** 2 + points[:, 1] ** 2, 36.0) / (2.0 * RADIUS) if dome else 0.0
    sets = {"XS": points[:, 0] == 0.0, "YS": points[:, 1] == 0.0}
    flat = fe.Brick(points, regular.elements).text()
    points[:, 2] += bulge * (1.0 - points[:, 2] / 20.0)
    nodes = "".join(f"{i + 1}, {x!r}, {y!r}, {z!r}\n" for i, (x, y, z) in enumerate(points.tolist()))
    text = (
        "*NODE, NSET=ALL\n" + nodes + flat[flat.index("*ELEMENT") :]
        + "".join(f"*NSET, NSET={k}\n" + "".join(f"{n + 1},\n" for n in np.flatnonzero(v)) for k, v in sets.items())
        + fe.elastic(STIFF * (1.0 - RATIO**2), RATIO, 1e-12, relaxation(relaxes))
        + (fe.plane() if dome else fe.sphere(RADIUS)) + up()
        + "*BOUNDARY\nROADREF, 1, 2\nROADREF, 4, 6\nTOP, ENCASTRE\nXS, 1, 1\nYS, 2, 2\n"
        + fe.step(PERIOD, "*BOUNDARY, AMPLITUDE=UP\nROADREF, 3, 3, 1.\n", fe.CONTACT, interval=PERIOD / 240)
    )  # fmt: skip
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    return run_deck(path)


@pytest.mark.parametrize(
    ("fine", "dome"),
    [
        (0.6, False),
        *(pytest.param(*each, marks=pytest.mark.heavy) for each in ((0.6, True), (0.3, False), (0.3, True))),
    ],
)
def test_sphere_pressed_into_a_viscoelastic_layer_and_drawn_back_feels_the_force_of_ting(
    tmp_path: Path, fe: ModuleType, fine: float, dome: bool
) -> None:
    """Three dimensions: Ting's force from that of the elastic layer, 0.5 % of its peak at every instant; contact lost
    to 1.5 % of the time (elements of 0.6 and 0.3 mm under a contact of 2.4 mm); the elastic peak pressure is Hertz',
    (6 P E*^2/(pi^3 R^2))^(1/3), to 1.5 %.
    """
    elastic = pressed_sphere(fe, tmp_path, False, fine, dome)
    load = force(elastic, 0.5)
    middle = TIME.size // 2
    peak = float(elastic.face["pressure_Pa"].max()) * 1e-6
    assert peak == pytest.approx((6.0 * load[middle] * STIFF**2 / (np.pi**3 * RADIUS**2)) ** (1.0 / 3.0), rel=0.015)
    curve = np.interp(np.linspace(0.0, DEPTH, 401), PRESSED[: middle + 1], load[: middle + 1]) / STIFF
    exact, lost = ting(TIME, PRESSED, curve * 1e-6, SLOW)
    found = force(pressed_sphere(fe, tmp_path, True, fine, dome), 0.5)
    assert found == pytest.approx(exact, abs=5e-3 * exact.max())
    assert TIME[found > 2e-3 * found.max()][-1] == pytest.approx(lost, abs=0.015 * PERIOD)
