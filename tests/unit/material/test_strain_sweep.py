"""Strain dependence: the secant modulus at a run's strain, and what it does to the force."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.material.strain_sweep import StrainSweep, read_strain_sweep
from tread_validate.spring.strain import strain_effect
from tread_validate.study import load_study


def write(folder: Path, head: str = "Strain (%),E' (MPa)") -> Path:
    path = folder / "payne.csv"
    strains = (0.1, 0.5, 1.0, 2.5, 5.0, 10.0)
    rows = [f"{s:g},{20.0 - 5.0 * np.log10(s / 0.1):.9g}" for s in strains]
    path.write_text("\n".join([head, *rows, rows[2]]), encoding="utf-8")
    return path


def test_modulus_is_linear_in_the_logarithm_of_strain_between_points(tmp_path: Path) -> None:
    """E' = 20 - 5 log10(strain/0.1 %) MPa is met between the points to rounding; repeats are averaged."""
    sweep = read_strain_sweep(write(tmp_path))
    assert sweep.strain.size == 6
    assert sweep.modulus(0.03) == pytest.approx(1e6 * (20 - 5 * np.log10(30.0)), rel=1e-7)
    assert sweep.secant_factor(0.005, 0.005) == 1.0


@pytest.mark.parametrize(
    ("strain", "reason"), [(0.2, "a sweep that reaches 20 %"), (1e-4, r"a sweep that reaches 0.01 %")]
)
def test_strains_beyond_the_sweep_are_refused(strain: float, reason: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=reason):
        read_strain_sweep(write(tmp_path)).modulus(strain)


def test_a_missing_unit_of_strain_stops_with_the_choices(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"column 1 'Strain': got no unit.*--strain-unit"):
        read_strain_sweep(write(tmp_path, "Strain,E' (MPa)"))


def test_force_changes_with_the_secant_modulus(paper_study: Path) -> None:
    """Force is proportional to the series where friction does not slip: 0.2 mm on 8 mm, modulus 0.8: N 0.8 to 1 %."""
    case = load_study(paper_study).case("rig-rectangle-22c-0p2mm-300rpm")
    sweep = StrainSweep(np.array([0.005, 0.025, 0.05, 0.1]), np.array([20e6, 16e6, 14e6, 12e6]), "a sweep")
    effect = strain_effect(case, sweep, 0.005)
    assert effect.strain == pytest.approx(0.025)
    assert effect.factor == pytest.approx(0.8)
    assert effect.change == pytest.approx(-0.2, abs=0.01)
