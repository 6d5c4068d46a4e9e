"""Shares of energy that judge an explicit run."""

from __future__ import annotations

import pandas as pd
import pytest

from tread_validate.compare.scores.energy import energy_shares
from tread_validate.errors import InputError


def test_shares_are_over_the_largest_internal_energy():
    """Internal 4 J at most: drift 0.04 and artificial 0.08 are 1 and 2 %."""
    energies = pd.DataFrame(
        {
            "internal": [0.0, 4.0, 1.0],
            "artificial": [0.0, 0.08, 0.02],
            "total": [10.0, 10.04, 10.01],
        }
    )
    assert energy_shares(energies) == pytest.approx({"balance_error": 0.01, "artificial_share": 0.02})


def test_missing_energy_is_refused():
    with pytest.raises(InputError, match="a column internal"):
        energy_shares(pd.DataFrame({"total": [0.0]}))
