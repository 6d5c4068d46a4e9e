"""A viscoelastic pass in the engine against a quasi-static, small-strain, condensed solution."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

PRONY = [(0.25, 1e-4), (0.25, 1e-3), (0.15, 1e-2)]


def test_coarse_viscoelastic_pass_agrees_with_the_condensed_quasi_static_solution(
    tmp_path: Path, fe: ModuleType, condensed: ModuleType
) -> None:
    """A flat block carried over the crest of a wheel that turns 0.2 % faster, 0.02 mm deep, mu = 0.5.

    The two share mesh, one-point elements and material and nothing else: explicit against quasi-static, logarithmic
    against small strain, kinematic correction against projected Gauss-Seidel, 1 us against 10 us steps. The peak, and
    the root mean square difference of both forces over the pass, within 1 % of the peak; no sample off by more than
    4 %, what a row of nodes that touches a step earlier is worth on so coarse a mesh.
    """
    modulus, ratio, mu, creep = 30.0, 0.47, 0.5, 0.002
    speed, radius, depth, period, start = 5000.0, 300.0, 0.02, 6e-3, -25.0
    block = fe.brick(20, 4, 5, 20.0, 8.0, 8.0)
    moved = fe.Brick(block.points + np.array([start, 0.0, 0.0]), block.elements)
    prony = "*VISCOELASTIC, TIME=PRONY\n" + "".join(f"{g}, {g}, {tau}\n" for g, tau in PRONY)
    turning = (1.0 + creep) * speed / radius
    text = (
        moved.text() + fe.elastic(modulus, ratio, extra=prony) + fe.wheel(radius, -depth) + fe.coulomb(mu)
        + "*BOUNDARY\nROADREF, 1, 4\nROADREF, 6, 6\nTOP, 2, 3\n"
        + f"*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, {speed}\nROADREF, 5, {turning}\n"
        + fe.step(period, f"*BOUNDARY, TYPE=VELOCITY\nTOP, 1, 1, {speed}\nROADREF, 5, 5, {turning}\n", fe.CONTACT)
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    from tread_validate.fe.blocks import HOURGLASS_COEFFICIENT

    small = condensed.condense(
        block.points, block.elements, block.bottom, block.top, modulus, ratio, HOURGLASS_COEFFICIENT
    )
    time, force = condensed.roll_over_wheel(
        small, block.points[block.bottom], PRONY, radius, -depth, start, speed, creep, mu, period, 600
    )
    samples = simulation.samples
    engine = np.array(samples.normal) + np.array(samples.tangential)
    along = np.interp(time, samples.time, engine[:, 0])
    normal = np.interp(time, samples.time, engine[:, 2])
    peak = force[:, 2].max()
    assert peak > 2.5
    assert max(samples.slipping) > 0.02, "some of the face slips"
    assert normal.max() == pytest.approx(peak, rel=0.01)
    for ours, other in ((normal, force[:, 2]), (along, force[:, 0])):
        assert np.sqrt(np.mean((ours - other) ** 2)) < 0.01 * peak
        assert np.abs(ours - other).max() < 0.04 * peak
