"""Cases of other codes, of theory and of standards bodies, as decks of our own, run through the engine's normal door.

Units are those of each source; the engine does not care, but what it writes is scaled from mm, tonne, s to SI, which
`LENGTH` takes back. `python tests/verification/published/published_cases.py docs/images` draws the figure of
docs/published_cases.md.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tread_validate.fe import FeResult, run_deck
from tread_validate.fe.stress import element_stress

sys.path.insert(0, str(Path(__file__).parents[1] / "fe"))
import fe_decks as fe

Floats = NDArray[np.float64]
LENGTH = 1e3  # of the engine's output, m, back to the deck's unit
# creep time, s; depth to press, mm; largest pressure by half-space theory, MPa
ROLLED = ((0.0, 0.6, 60.32), (0.009, 0.515, 78.74), (0.045, 0.386, 84.72), (2.0, 0.316, 85.31))
CONSTANT = "      fTangential(1,k) = -min(props(1)*fNormal(k), fStickForce(k))"
FALLING = """      fmu = 0.05d0 + 0.1d0*exp(-0.01d0*v)
      fTangential(1,k) = -min(fmu*fNormal(k), fStickForce(k))"""


def run(folder: Path, text: str, vfric: str | None = None) -> FeResult:
    """Run a deck's text; `vfric` is the body of the loop over contact points."""
    deck = folder / "deck.inp"
    deck.write_text(text, encoding="utf-8")
    user = None
    if vfric is not None:
        user = folder / "vfric.f"
        user.write_text(fe.VFRIC.format(body=vfric), encoding="utf-8")
    return run_deck(deck, user)


def nodes_of(result: FeResult, name: str) -> pd.DataFrame:
    """Histories of a node set."""
    return result.nodes[result.nodes["nset"] == name]


@dataclass(frozen=True)
class Stop:
    """A sliding block brought to rest: mean velocity and path of its nodes against time."""

    time: Floats
    velocity: Floats
    path: Floats

    @property
    def stop(self) -> tuple[float, float]:
        """Time and path at which the mean velocity first passes zero."""
        row = int(np.argmax(self.velocity <= 0.0))
        share = self.velocity[row - 1] / (self.velocity[row - 1] - self.velocity[row])
        time = self.time[row - 1] + share * (self.time[row] - self.time[row - 1])
        return float(time), float(self.path[row - 1] + share * (self.path[row] - self.path[row - 1]))

    def slowed_to(self, speed: float) -> float:
        """Time at which the mean velocity last is above `speed`, to the next sample."""
        row = int(np.flatnonzero(self.velocity > speed)[-1])
        share = (self.velocity[row] - speed) / (self.velocity[row] - self.velocity[row + 1])
        return float(self.time[row] + share * (self.time[row + 1] - self.time[row]))


def sliding_block(folder: Path, vfric: str, period: float, damping: float = 0.0) -> Stop:
    """Block of 5 x 1 x 1 in in two elements, 2000 psi on top, thrown at 200 in/s along a rigid plane (lbf, in, s).

    `damping` (s) is stiffness-proportional; the published case has none, and rings.
    """
    block = fe.brick(2, 1, 1, 5.0, 1.0, 1.0)
    damped = f"*DAMPING, BETA={damping}\n" if damping else ""
    text = (
        block.text() + fe.elastic(30e6, 0.3, 7.3e-4, damped) + fe.plane() + fe.user_friction(0.15)
        + "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, 200.\n*BOUNDARY\nROADREF, 1, 6\n"
        + fe.step(period, "*DLOAD\nE, P2, 2000.\n", fe.CONTACT, interval=period / 400)
    )  # fmt: skip
    text = text.replace("*END STEP", "*NODE OUTPUT, NSET=ALL\nU, V\n*END STEP")
    table = nodes_of(run(folder, text, vfric), "ALL")
    table = table[table["node"] < 900_000]
    mass = np.bincount(block.elements.ravel()) / block.elements.size
    motion = {
        name: (table.pivot(index="time_s", columns="node", values=name).to_numpy() * LENGTH) @ mass
        for name in ("u_x_m", "v_x_m_s")
    }
    return Stop(np.unique(table["time_s"]), motion["v_x_m_s"], motion["u_x_m"])


@dataclass(frozen=True)
class FrictionBlock:
    """Displacement along the face of a block pushed over a rigid plane: places (mm) and displacements (um)."""

    x: Floats
    displacement: Floats

    def at(self, x: float) -> float:
        """Displacement in um at x mm from the loaded side."""
        return float(np.interp(x, self.x, self.displacement))


def friction_block(folder: Path, size: float = 1.25) -> FrictionBlock:
    """Half of a block of 80 x 40 mm in plane strain, 50 MPa on top, 150 MPa on its side, mu = 1 (mm, tonne, s)."""
    count = round(40.0 / size)
    block = fe.brick(count, 1, count, 40.0, size, 40.0)
    rows, x = np.arange(len(block.elements)) + 1, block.points[:, 0]
    left = rows[(x[block.elements[:, 0]] == 0.0)]
    high = rows[np.isin(block.elements[:, 4:], block.top).all(axis=1)]
    middle = np.flatnonzero(x == 40.0) + 1
    text = (
        block.text() + _set("ELSET", "LEFT", left) + _set("ELSET", "HIGH", high) + _set("NSET", "MIDDLE", middle)
        + fe.elastic(130_000.0, 0.2, 7.8e-9, "*DAMPING, BETA=1e-7\n") + fe.plane() + fe.coulomb(1.0)
        + "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., 1e-3, 1.\n"
        + "*BOUNDARY\nROADREF, 1, 6\nALL, 2, 2\nMIDDLE, 1, 1\n"
        + fe.step(1.2e-3, "*DLOAD, AMPLITUDE=A\nHIGH, P2, 50.\nLEFT, P6, 150.\n", fe.CONTACT)
    )  # fmt: skip
    # the reference node has its six conditions already
    text = text.replace("ALL, 2, 2", "BLOCK, 2, 2").replace("NSET=ALL", "NSET=BLOCK", 1)
    text = text.replace("*END STEP", "*NODE OUTPUT, NSET=BOT\nU,\n*END STEP")
    table = nodes_of(run(folder, text), "BOT")
    last = table[table["time_s"] == table["time_s"].max()]
    place = x[last["node"].to_numpy() - 1]
    mean = pd.Series(last["u_x_m"].to_numpy() * LENGTH * 1e3).groupby(place).mean()
    return FrictionBlock(mean.index.to_numpy(dtype=np.float64), mean.to_numpy(dtype=np.float64))


def patch(folder: Path, gradient: Floats) -> Floats:
    """Stress (m, 6: 11, 22, 33, 12, 13, 23) of 27 crooked hexahedra whose outer nodes move by a displacement gradient.

    E 1e6, nu 0.25. All nodes set out at their share of the speed, so that the inner ones need no push.
    """
    block = fe.brick(3, 3, 3, 1.0, 1.0, 1.0)
    inside = ((block.points > 0.0) & (block.points < 1.0)).all(axis=1)
    points = block.points + 0.08 * inside[:, None] * np.random.default_rng(5).uniform(-1.0, 1.0, block.points.shape)
    crooked = fe.Brick(points, block.elements)
    period = 1e-3
    speed = points @ gradient.T / period
    outer = np.flatnonzero(~inside)
    held = "".join(f"{n + 1}, {c + 1}, {c + 1}, {float(speed[n, c])!r}\n" for n in outer for c in range(3))
    first = "".join(f"{n + 1}, {c + 1}, {float(speed[n, c])!r}\n" for n in range(len(points)) for c in range(3))
    text = (
        crooked.text() + fe.elastic(1e6, 0.25, 1e-6) + "*INITIAL CONDITIONS, TYPE=VELOCITY\n" + first
        + fe.step(period, "*BOUNDARY, TYPE=VELOCITY\n" + held)
    )  # fmt: skip
    simulation = fe.run(folder, text)
    return np.asarray(element_stress(simulation), dtype=np.float64)


def _set(kind: str, name: str, labels: NDArray[np.int64]) -> str:
    return f"*{kind}, {kind}={name}\n" + "".join(f"{label},\n" for label in labels)


@dataclass(frozen=True)
class RollingCylinder:
    """Steady rolling over a viscoelastic half-space: line load (N/mm), pressure (MPa) at x (mm) from the axle."""

    load: float
    x: Floats
    pressure: Floats

    @property
    def largest(self) -> float:
        """Largest pressure of a parabola through the highest five nodes, at 600 N/mm: p goes with sqrt(N)."""
        top = np.argsort(self.pressure)[-5:]
        a, b, c = np.polyfit(self.x[top], self.pressure[top], 2)
        return float((c - b * b / (4.0 * a)) * np.sqrt(600.0 / self.load))

    @property
    def width(self) -> float:
        """Width of the contact at 600 N/mm, mm: pressure ends as a square root, so p^2 is drawn to zero at each end."""
        ends = []
        touching = np.flatnonzero(self.pressure > 0.0)
        for row, step in ((touching[0], 1), (touching[-1], -1)):
            x = self.x[[row + step, row + 3 * step]]
            square = self.pressure[[row + step, row + 3 * step]] ** 2
            ends.append(x[0] - square[0] * (x[1] - x[0]) / (square[1] - square[0]))
        return float((ends[1] - ends[0]) * np.sqrt(600.0 / self.load))


def rolling_cylinder(folder: Path, creep_time: float, depth: float, size: float = 0.4) -> RollingCylinder:
    """A smooth rigid cylinder, R 100 mm, rolls at 1 m/s over a slab 60 mm thick that stands for the half-space.

    Two equal cylinders that roll on each other without friction are each pressed flat half way, which is one of them on
    a rigid plane; on the scale of the contact that is a half-space and a rigid cylinder. The compliance creeps from
    1/1143 to 1/571.5 per MPa with `creep_time`, s, so the modulus relaxes with half that time. Plane strain, `depth`
    (mm) of pressing chosen for about 600 N/mm. Density such that waves run 150 times as fast as the cylinder.
    """
    shear, ratio, speed, travel = 1143.0, 0.4, 1000.0, 50.0
    count = round(120.0 / size)
    layers = 26
    block = fe.brick(count, 1, layers, 120.0, size, 1.0)
    growth = 60.0 / size
    grading = _graded(layers, growth) * 60.0
    points = block.points.copy()
    points[:, 2] = grading[np.rint(points[:, 2] * layers).astype(int)]
    points[:, 0] -= 35.0
    slab = fe.Brick(points, block.elements)
    relax = f"*VISCOELASTIC, TIME=PRONY\n0.5, 0.5, {0.5 * creep_time!r}\n" if creep_time else ""
    modulus = 2.0 * (shear if creep_time else 0.5 * shear) * (1.0 + ratio)
    density = 6.0 * shear / (150.0 * speed) ** 2
    period = travel / speed
    text = (
        slab.text().replace("NSET=ALL", "NSET=SLAB", 1) + fe.elastic(modulus, ratio, density, relax)
        + fe.wheel(100.0) + "*SURFACE INTERACTION, NAME=TOUCH\n"
        + "*AMPLITUDE, NAME=UP, DEFINITION=SMOOTH STEP\n0., 0., 4e-3, 1.\n"
        + "*BOUNDARY\nROADREF, 2, 2\nROADREF, 4, 6\nTOP, ENCASTRE\nSLAB, 2, 2\n"
        + f"*INITIAL CONDITIONS, TYPE=VELOCITY\nROADREF, 1, {speed}\n"
        + fe.step(period, f"*BOUNDARY, TYPE=VELOCITY\nROADREF, 1, 1, {speed}\n",
                  f"*BOUNDARY, AMPLITUDE=UP\nROADREF, 3, 3, {depth}\n", fe.CONTACT)
    )  # fmt: skip
    result = run(folder, text)
    middle = 0.5 * period
    load = float(np.interp(middle, result.history.time, result.history.normal_force)) / size
    face = result.face[result.face["y_m"] < 1e-6]
    x = face["x_m"].to_numpy() * LENGTH
    order = np.argsort(x)
    return RollingCylinder(load, x[order] - speed * middle, face["pressure_Pa"].to_numpy()[order] * 1e-6)


def _graded(layers: int, ratio: float) -> Floats:
    """Heights of the layers, 0 to 1: each thicker than the one before by one factor, the first 1/ratio of the whole."""
    low, high = 1.0, 2.0
    for _ in range(80):
        factor = 0.5 * (low + high)
        low, high = (low, factor) if (factor**layers - 1.0) / (factor - 1.0) > ratio else (factor, high)
    return np.concatenate([[0.0], np.cumsum(factor ** np.arange(layers))]) / float(np.sum(factor ** np.arange(layers)))


def draw(folder: Path) -> None:
    """Draw the cases beside their published values: ``published_cases.png``."""
    import tempfile

    import matplotlib.pyplot as plt

    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        figure, axes = plt.subplots(1, 3, figsize=(13.0, 4.0), layout="constrained")
        for body, label, stop in ((CONSTANT, "mu 0.15", 4.866e-4), (FALLING, "mu falls with speed", 8.3288e-4)):
            block = sliding_block(work, body, 1.15 * stop)
            axes[0].plot(block.time * 1e3, block.velocity, label=f"engine, {label}")
            axes[0].axvline(stop * 1e3, color="0.6", ls=":")
        axes[0].plot(4.878e-1, 0.0, "k^", label="ABAQUS stops, mu 0.15")
        axes[0].set(xlabel="time, ms", ylabel="speed, in/s", title="thrown block")
        pushed = friction_block(work)
        axes[1].plot(pushed.x, pushed.displacement, label="engine, 1.25 mm")
        places = [0.0, 1.25, 5.0, 7.5, 11.25]
        axes[1].plot(places, [28.6, 27.2, 22.8, 19.8, 15.0], "ko", label="SSNV128 reference")
        axes[1].plot(places, [28.65, 27.27, 22.92, 19.93, 15.61], "k+", label="Code_Aster")
        axes[1].set(xlabel="x, mm", ylabel="displacement, um", title="block pushed over a rough plane")
        for tau, depth, largest in ROLLED:
            rolled = rolling_cylinder(work, tau, depth)
            line = axes[2].plot(rolled.x, rolled.pressure * np.sqrt(600.0 / rolled.load), label=f"engine, {tau:g} s")
            axes[2].axhline(largest, color=line[0].get_color(), ls=":")
            print(f"{tau:g} s: {rolled.load:.1f} N/mm, {rolled.largest:.2f} MPa, {rolled.width:.2f} mm")
        axes[2].set(xlabel="x from the axle, mm", ylabel="pressure, MPa", title="rolling cylinder", xlim=(-9.0, 9.0))
        for axis in axes:
            axis.legend(fontsize=8)
        figure.savefig(folder / "published_cases.png", dpi=110)


if __name__ == "__main__":
    draw(Path(sys.argv[1]))
