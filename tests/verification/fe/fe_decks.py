"""Small decks written by hand for the verification of the engine, and CalculiX to hold them against.

Units: mm, tonne, s, MPa, N. The face of every brick lies at z = 0, its mount at z = height.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tread_validate.fe.explicit import Simulation
from tread_validate.fe.model import read_model
from tread_validate.fe.user_friction import compile_vfric

Floats = NDArray[np.float64]
VFRIC = """      subroutine vfric(fTangential, statev, kStep, kInc, nContact,
     & nFacNod, nSlvNod, nMstNod, nFricDir, nDir, nStateVar, nProps,
     & nTemp, nPred, numDefTfv, jSlvUid, jMstUid, jConSlvid, jConMstid,
     & timStep, timGlb, dTimCur, surfInt, surfSlv, surfMst, lContType,
     & dSlipFric, fStickForce, fTangPrev, fNormal, frictionWork, shape,
     & coordSlv, coordMst, dirCosSl, dircosN, props, areaSlv, tempSlv,
     & preDefSlv, tempMst, preDefMst)
      include 'vaba_param.inc'
      character*80 surfInt, surfSlv, surfMst
      dimension fTangential(nFricDir,nContact),
     & statev(nStateVar,nSlvNod), props(nProps),
     & dSlipFric(nDir,nContact), fTangPrev(nDir,nContact),
     & fStickForce(nContact), fNormal(nContact),
     & shape(nFacNod,nContact), areaSlv(nSlvNod),
     & coordSlv(nDir,nSlvNod), coordMst(nDir,nMstNod),
     & dirCosSl(nDir,nContact), dircosN(nDir,nContact),
     & jSlvUid(nSlvNod), jMstUid(nMstNod), jConSlvid(nContact),
     & jConMstid(nFacNod,nContact), tempSlv(nContact),
     & preDefSlv(nContact,nPred), tempMst(numDefTfv),
     & preDefMst(numDefTfv,nPred)
      do 10 k = 1, nContact
      v = sqrt(dSlipFric(1,k)**2+dSlipFric(2,k)**2+dSlipFric(3,k)**2)
      if (dTimCur .gt. 0.d0) v = v/dTimCur
      p = fNormal(k)/areaSlv(jConSlvid(k))
{body}
   10 continue
      return
      end
"""


@dataclass(frozen=True)
class Brick:
    """A brick of hexahedra."""

    points: Floats
    elements: NDArray[np.int64]

    @property
    def height(self) -> float:
        return float(self.points[:, 2].max())

    @property
    def bottom(self) -> NDArray[np.int64]:
        return np.flatnonzero(self.points[:, 2] == 0.0)

    @property
    def top(self) -> NDArray[np.int64]:
        return np.flatnonzero(self.points[:, 2] == self.height)

    def text(self, element: str = "C3D8R") -> str:
        """Nodes 1.., elements 1.. in set E, node sets ALL, BOT, TOP, surface FACE at z = 0."""
        lines = ["*NODE, NSET=ALL"]
        lines += [f"{i + 1}, {x!r}, {y!r}, {z!r}" for i, (x, y, z) in enumerate(self.points.tolist())]
        lines.append(f"*ELEMENT, TYPE={element}, ELSET=E")
        lines += [f"{i + 1}, " + ", ".join(str(n + 1) for n in e) for i, e in enumerate(self.elements.tolist())]
        for name, members in (("BOT", self.bottom), ("TOP", self.top)):
            lines += [f"*NSET, NSET={name}", *(f"{n + 1}," for n in members)]
        low = [i + 1 for i, e in enumerate(self.elements) if np.isin(e[:4], self.bottom).all()]
        lines += ["*ELSET, ELSET=LOW", *(f"{i}," for i in low), "*SURFACE, TYPE=ELEMENT, NAME=FACE", "LOW, S1"]
        return "\n".join(lines) + "\n"


def brick(nx: int, ny: int, nz: int, lx: float, ly: float, lz: float) -> Brick:
    """A regular brick with one corner at the origin."""
    z, y, x = np.meshgrid(
        np.linspace(0, lz, nz + 1), np.linspace(0, ly, ny + 1), np.linspace(0, lx, nx + 1), indexing="ij"
    )
    i, j, k = (a.ravel() for a in np.meshgrid(np.arange(nx), np.arange(ny), np.arange(nz), indexing="ij"))

    def at(di: int, dj: int, dk: int) -> NDArray[np.int64]:
        return ((k + dk) * (ny + 1) + j + dj) * (nx + 1) + i + di

    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    return Brick(np.column_stack([x.ravel(), y.ravel(), z.ravel()]), np.stack([at(*c) for c in corners], axis=1))


def elastic(modulus: float, ratio: float, density: float = 1e-9, extra: str = "") -> str:
    """Section and material M of elset E."""
    return (
        "*SOLID SECTION, ELSET=E, MATERIAL=M\n,\n*MATERIAL, NAME=M\n*DENSITY\n"
        f"{density!r},\n*ELASTIC, MODULI=INSTANTANEOUS\n{modulus!r}, {ratio!r}\n{extra}"
    )


def step(period: float, *parts: str, interval: float | None = None) -> str:
    """One explicit step with sampling interval (default: 200 samples)."""
    return (
        f"*STEP\n*DYNAMIC, EXPLICIT\n, {period!r}\n" + "".join(parts)
        + f"*OUTPUT, HISTORY, TIME INTERVAL={(interval or period / 200)!r}\n*END STEP\n"
    )  # fmt: skip


def plane(height: float = 0.0, half: float = 1000.0) -> str:
    """A rigid plane ROAD at z = `height`, outward +z, on reference node 900001 (set ROADREF)."""
    return (
        f"*NODE, NSET=ROADREF\n900001, 0., 0., {height!r}\n*SURFACE, TYPE=CYLINDER, NAME=ROAD\n"
        f"0., 0., {height!r}, 1., 0., {height!r}\n0., 1., {height!r}\nSTART, {-half}, 0.\nLINE, {half}, 0.\n"
        "*RIGID BODY, REF NODE=900001, ANALYTICAL SURFACE=ROAD\n"
    )


def wheel(radius: float, low: float = 0.0) -> str:
    """A rigid wheel ROAD about the y axis whose crest lies at z = -`low`, on reference node 900001 (set ROADREF)."""
    z = -radius - low
    wide, high = 0.5 * 3**0.5 * radius, 0.5 * radius
    arcs = [(-wide, high), (wide, high), (0.0, -radius)]
    return (
        f"*NODE, NSET=ROADREF\n900001, 0., 0., {z!r}\n*SURFACE, TYPE=CYLINDER, NAME=ROAD\n"
        f"0., 0., {z!r}, 1., 0., {z!r}\n0., 1., {z!r}\nSTART, 0., {-radius!r}\n"
        + "".join(f"CIRCL, {x!r}, {y!r}, 0., 0.\n" for x, y in arcs)
        + "*RIGID BODY, REF NODE=900001, ANALYTICAL SURFACE=ROAD\n"
    )


def sphere(radius: float) -> str:
    """A rigid sphere ROAD about the z axis, its pole at z = 0, on reference node 900001 (set ROADREF)."""
    return (
        f"*NODE, NSET=ROADREF\n900001, 0., 0., {-radius!r}\n*SURFACE, TYPE=REVOLUTION, NAME=ROAD\n"
        f"0., 0., {-radius!r}, 0., 0., 0.\nSTART, 0., {radius!r}\nCIRCL, {radius!r}, 0., 0., 0.\n"
        "*RIGID BODY, REF NODE=900001, ANALYTICAL SURFACE=ROAD\n"
    )


def disc(centre: tuple[float, float]) -> str:
    """A rigid disc ROAD of 1 m at z = 0, outward +z, turned about a vertical axis through `centre`."""
    x, y = centre
    return (
        "*NODE, NSET=ROADREF\n900001, 0., 0., 0.\n*SURFACE, TYPE=REVOLUTION, NAME=ROAD\n"
        f"{x!r}, {y!r}, -1., {x!r}, {y!r}, 1.\nSTART, 0., 1.\nLINE, 1000., 1.\n"
        "*RIGID BODY, REF NODE=900001, ANALYTICAL SURFACE=ROAD\n"
    )


def coulomb(mu: float) -> str:
    """Built-in friction; the interaction is called TOUCH."""
    return f"*SURFACE INTERACTION, NAME=TOUCH\n*FRICTION\n{mu!r},\n"


def user_friction(*properties: float) -> str:
    """VFRIC with its properties."""
    values = ", ".join(repr(p) for p in properties)
    return f"*SURFACE INTERACTION, NAME=TOUCH\n*FRICTION, USER=FRIC, PROPERTIES={len(properties)}\n{values}\n"


CONTACT = "*CONTACT PAIR, INTERACTION=TOUCH, MECHANICAL CONSTRAINT=KINEMATIC, CPSET=C\nFACE, ROAD\n"


def run(folder: Path, text: str, vfric: str | None = None, threads: int = 1) -> Simulation:
    """Run a deck's text; `vfric` is the body of the loop over contact points (k), with v and p at hand."""
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    routine = None
    if vfric is not None:
        (folder / "vfric.f").write_text(VFRIC.format(body=vfric), encoding="ascii")
        routine = compile_vfric(folder / "vfric.f")
    simulation = Simulation(read_model(path), routine, threads)
    simulation.run()
    return simulation


def held_force(simulation: Simulation, nodes: NDArray[np.int64], axis: int) -> float:
    """The force along `axis` that holds the prescribed `nodes` at the end."""
    p = simulation.prescribed
    own = np.isin(p.dof // 3, nodes) & (p.dof % 3 == axis) & (np.arange(p.dof.size) < p.bodies[0])
    return float(p.reaction[own[: p.reaction.size]].sum())


def calculix(folder: Path, text: str) -> dict[str, Floats]:
    """Run CalculiX on a deck that prints total forces; return the last total force of each set, N."""
    program = shutil.which("ccx")
    assert program is not None, "CalculiX (Debian calculix-ccx) is needed to verify the engine"
    (folder / "ccx.inp").write_text(text, encoding="utf-8")
    done = subprocess.run([program, "ccx"], cwd=folder, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout[-2000:]
    found: dict[str, Floats] = {}
    lines = (folder / "ccx.dat").read_text().splitlines()
    for number, line in enumerate(lines):
        match = re.search(r"total force \(fx,fy,fz\) for set (\S+)", line)
        if match:
            values = next(row for row in lines[number + 1 :] if row.strip())
            found[match.group(1)] = np.array([float(v) for v in values.split()])
    return found
