"""Shifts laid by overlap, by Arrhenius' law and from a table: exact sweeps come back, and the quality is told."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.material import RouteSettings, fractional_zener, material_route
from tread_validate.material.shifts import free_shifts, nearest_wlf, overlap, read_shift_table
from tread_validate.material.sweep import Sweep
from tread_validate.material.time_shift import arrhenius, log_relative_shift
from tread_validate.material.wlf import log_shift_factor
from tread_validate.study import Wlf

TEMPERATURES = np.array([0.0, 10.0, 20.0, 35.0, 50.0])


def sweeps(logs: np.ndarray) -> tuple[Sweep, ...]:
    """Return exact sweeps of one fractional Zener solid, shifted by log10 a_T."""
    w = np.geomspace(0.6, 600.0, 25)
    found = []
    for k, (t, log) in enumerate(zip(TEMPERATURES, logs, strict=True)):
        modulus = fractional_zener(w * 10.0**log, 5e6, 300e6, 1e3, 0.4)
        found.append(Sweep(float(t), w, modulus.real, modulus.imag, np.arange(25, dtype=np.int64) + 25 * k))
    return tuple(found)


def test_arrhenius_doubles_the_rate_as_by_hand() -> None:
    """E_a = R ln 2/(1/293.15 - 1/303.15) halves the time from 20 to 30 degC: log10 a = -0.30103."""
    energy = 8.314462618e-3 * np.log(2.0) / (1 / 293.15 - 1 / 303.15)
    assert arrhenius(np.array([30.0]), 20.0, energy)[0] == pytest.approx(-np.log10(2.0), rel=1e-9)


def test_sweeps_laid_on_each_other_give_their_shifts_back() -> None:
    """Exact sweeps of an Arrhenius solid: log10 a_T to the search's step of 0.02 decades a neighbour."""
    exact = arrhenius(TEMPERATURES, 20.0, 150.0)
    found = free_shifts(sweeps(exact), 20.0)
    np.testing.assert_allclose(found, exact, atol=0.021 * 2)
    quality = overlap(sweeps(exact), exact)
    assert quality.apart == 0
    assert quality.misfit < 2e-3  # straight lines between the points


def test_wrong_shifts_show_in_the_overlap() -> None:
    """Shifts a tenth of a decade off between neighbours: moduli of slope 0.3 differ by some 7 %."""
    exact = arrhenius(TEMPERATURES, 20.0, 150.0)
    wrong = exact + 0.1 * np.arange(TEMPERATURES.size)
    assert overlap(sweeps(exact), wrong).misfit > 0.03
    apart = exact + 5.0 * np.arange(TEMPERATURES.size)
    assert overlap(sweeps(exact), apart).apart == 4


def test_nearest_wlf_of_wlf_shifts_is_that_law() -> None:
    """Constants referred to 20 degC come back to 1e-4, and the distance is nothing; Arrhenius leaves a distance."""
    law = Wlf(c1=8.86, c2_K=101.6, reference_temperature_degC=20.0)
    found, apart = nearest_wlf(TEMPERATURES, log_shift_factor(TEMPERATURES, law), 20.0)
    assert (found.c1, found.c2_K) == pytest.approx((8.86, 101.6), rel=1e-4)
    assert apart < 1e-6


def test_a_table_of_shifts_serves_and_must_reach(tmp_path: Path) -> None:
    path = tmp_path / "shifts.csv"
    logs = arrhenius(TEMPERATURES, 0.0, 120.0)
    rows = "\n".join(f"{t:g},{v:.12g}" for t, v in zip(TEMPERATURES, logs, strict=True))
    path.write_text(f"temperature_degC,log10_shift_factor\n{rows}\n")
    law = read_shift_table(path)
    there = arrhenius(TEMPERATURES, 20.0, 120.0)
    np.testing.assert_allclose(log_relative_shift(TEMPERATURES, 20.0, law), there, atol=1e-9)
    with pytest.raises(InputError, match="0 to 50 degC, where the shift is tabulated"):
        log_relative_shift(60.0, 20.0, law)
    route = material_route(sweeps(there), law, 20.0, RouteSettings(terms=12, replicates=0))
    assert route.fit.storage_rms < 0.02
    assert route.quality()["shift"] == "table"
    assert route.wlf_apart > 0


def test_neighbours_that_share_nothing_cannot_be_laid() -> None:
    """The glassy and the rubbery end, far apart in modulus, still find a place; a single point does not."""
    first, second, *_ = sweeps(arrhenius(TEMPERATURES, 20.0, 150.0))
    one = {key: getattr(second, key)[:1] for key in ("angular_frequency", "storage_modulus", "loss_modulus", "line")}
    with pytest.raises(InputError, match="no common band"):
        free_shifts((first, replace(second, **one)), 5.0)
