"""A braked block that slides through its patch at one coefficient: T/N is that coefficient, whatever mesh and speed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate import deck, fe, load_study
from tread_validate.friction import Coulomb
from tread_validate.study import Case

STUDY = Path(__file__).parents[3] / "examples" / "hard_passes" / "study.yaml"


@pytest.fixture(scope="module")
def braked() -> Case:
    """A block of 10 x 5 x 4 mm on a belt."""
    return next(case for case in load_study(STUDY).cases() if case.run == "small_braking")


def run(case: Case, folder: Path, size: float, damping: float, share: float = 0.95) -> fe.FeResult:
    """Run a case on elements of `size` (mm), damped (us), its increment a share of the stable one."""
    update = {"element_size_mm": size, "layers": round(1e3 * case.height / size), "stiffness_damping_us": damping}
    deck.write(replace(case, deck=case.deck.model_copy(update=update)), folder)
    path = folder / f"{case.case_id}.inp"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("*DYNAMIC, EXPLICIT", f"*DYNAMIC, EXPLICIT, SCALE FACTOR={share}"), encoding="utf-8")
    return fe.run_deck(path, path.with_name("vfric.f"))


@pytest.mark.parametrize(
    ("mu", "creep", "speed", "damping"),
    [(0.2, 0.02, 16.7, 0.2), (0.5, 0.02, 16.7, 1.0), (0.5, 0.03, 30.0, 1.0)],
)
def test_a_block_that_slides_through_its_patch_has_mu_on_every_mesh(
    braked: Case, tmp_path: Path, mu: float, creep: float, speed: float, damping: float
) -> None:
    """Second half of the contact, 2 and 1 mm: |T|/N is mu within 0.5 %, energy closes to 0.01 %, a reference."""
    law = Coulomb(kind="coulomb", origin="assumed", source="one number", kinetic_coefficient=mu)
    case = replace(braked, friction=law, creep_ratio=creep, speed=speed)
    for size in (2.0, 1.0):
        result = run(case, tmp_path, size, damping)
        normal, tangential = result.history.normal_force, result.history.tangential_force
        pressed = np.flatnonzero(normal > 0.5 * normal.max())
        second = slice(pressed[len(pressed) // 2], pressed[-1])
        assert abs(tangential[second].sum()) / normal[second].sum() == pytest.approx(mu, rel=5e-3)
        assert result.record["energy_balance"]["balance_error"] < 1e-4
        assert result.record["reference_quality"]["usable"]


def test_the_energy_that_is_open_falls_with_the_square_of_the_increment(braked: Case, tmp_path: Path) -> None:
    """A quarter of the increment leaves a tenth or less (a sixteenth without slip that begins and ends)."""
    case = replace(braked, creep_ratio=0.02)
    whole, quarter = (
        run(case, tmp_path, 2.0, 0.2, share).record["energy_balance"]["balance_error"] for share in (0.9, 0.225)
    )
    assert quarter < 0.1 * whole < 1e-5
