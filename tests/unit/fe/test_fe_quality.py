"""What a run says of its own worth, and the axes that its forces are given in."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tread_validate.errors import InputError
from tread_validate.fe.axes import Axes, found_axes
from tread_validate.fe.quality import alternation, energy_balance, reference_quality, unsteadiness


def energies(**columns: float) -> pd.DataFrame:
    values = {"internal": 2.0, "external_work": 10.0, "total": 0.0, "artificial": 0.0, "contact_impact": 0.0} | columns
    return pd.DataFrame({name: [0.0, value] for name, value in values.items()})


def test_balance_is_of_the_larger_of_internal_energy_and_external_work() -> None:
    """0.05 J of 10 J is 0.5 %; artificial energy is of the internal one: 0.02 of 2 J is 1 %."""
    found = energy_balance(energies(total=-0.05, artificial=0.02, contact_impact=0.1))
    assert found == pytest.approx(
        {
            "internal_J": 2.0, "external_work_J": 10.0, "balance_error": 0.005, "artificial_share": 0.01,
            "impact_share": 0.01,
        }
    )  # fmt: skip
    assert reference_quality(found, 0.0, 0.0) == {"usable": True, "reasons": []}


@pytest.mark.parametrize(
    ("columns", "scatter", "chatter", "word"),
    [
        ({"total": 0.11}, 0.0, 0.0, "unaccounted"),
        ({"artificial": 0.05}, 0.0, 0.0, "artificial"),
        ({"contact_impact": 0.3}, 0.0, 0.0, "impacts"),
        ({}, 0.006, 0.0, "T scatters"),
        ({}, 0.0, 0.006, "stick and slip alternate"),
    ],
)
def test_run_beyond_a_limit_is_no_reference_and_says_why(
    columns: dict[str, float], scatter: float, chatter: float, word: str
) -> None:
    found = reference_quality(energy_balance(energies(**columns)), scatter, chatter)
    assert not found["usable"]
    assert len(found["reasons"]) == 1
    assert word in found["reasons"][0]


def test_scatter_of_white_noise_is_its_standard_deviation_and_of_a_straight_line_nothing() -> None:
    """Noise of 1 N on a peak of 100 N: 1 % within 3 % (20 000 samples); a straight line: rounding."""
    rng = np.random.default_rng(1)
    normal = np.full(20_000, 100.0)
    assert unsteadiness(normal, rng.standard_normal(20_000)) == pytest.approx(0.01, rel=0.03)
    assert unsteadiness(normal, np.linspace(0.0, 50.0, 20_000)) < 1e-12


def test_short_sticks_between_slips_are_told_with_what_they_leave_out_of_t() -> None:
    """Three nodes under unit pressure, 10 samples, traction 0.5 where they slip: one slips and then sticks to stay, one
    slips all along, one sticks at two samples at 0.1 in between. It lacks 0.8 of what all carry, 14.2; the other
    way round alike."""
    states = np.array([[2] * 5 + [1] * 5, [2] * 10, [2] * 4 + [1] * 2 + [2] * 4], dtype=np.int8).T
    pressures = np.ones((10, 3))
    tractions = np.zeros((10, 3, 3))
    tractions[:, :, 0] = np.where(states == 2, 0.5, np.array([0.5, 0.0, 0.1]))
    assert alternation(states, pressures, tractions) == pytest.approx(0.8 / 14.2)
    assert alternation(states, pressures, -tractions) == pytest.approx(0.8 / 14.2)
    assert alternation(states[:, :2], pressures[:, :2], tractions[:, :2]) == 0.0
    assert alternation(states, pressures, 0.0 * tractions) == 0.0


def test_normal_is_the_axis_nearest_to_the_forces_of_the_road() -> None:
    """A deck upright in z has its normal along z; nothing touching keeps the usual axes."""
    assert found_axes(np.array([[0.1, 0.0, 3.0], [0.0, 0.1, 5.0]])) == Axes("+z", "+x")
    assert found_axes(np.array([[-4.0, 0.0, 3.0]])) == Axes("-x", "+y")
    assert found_axes(np.zeros((2, 3))) == Axes("+y", "+x")


@pytest.mark.parametrize(("normal", "travel"), [("y", "+x"), ("+y", "-y"), ("+y", "up")])
def test_axes_that_are_none_are_refused(normal: str, travel: str) -> None:
    with pytest.raises(InputError, match=r"normal|travel"):
        Axes(normal, travel)
