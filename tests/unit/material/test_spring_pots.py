"""Spring-pots in series and parallel: the fractional solids that they contain, and the published rubbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.material import fit_surrogate, fractional_zener, prony_series, surrogate_modulus
from tread_validate.material.spring_pots import spring_pots
from tread_validate.study import LibraryCompound, SpringPots
from tread_validate.study.library import library_compound, library_names, named_compound

W = np.geomspace(1e-3, 1e6, 19)


def test_a_spring_beside_a_spring_and_spring_pot_is_the_fractional_zener_solid() -> None:
    """1/(1/dE + 1/(dE u)) = dE u/(1 + u): to rounding."""
    found = spring_pots(W, 1e2, [[(10e6, 0.0)], [(70e6, 0.0), (70e6, 0.3)]])
    np.testing.assert_allclose(found, fractional_zener(W, 10e6, 70e6, 1e2, 0.3), rtol=1e-13)


def test_a_dashpot_and_a_spring_in_series_are_a_maxwell_element() -> None:
    x = W / 30.0
    np.testing.assert_allclose(
        spring_pots(W, 30.0, [[(2e6, 0.0), (2e6, 1.0)]]), 2e6 * 1j * x / (1 + 1j * x), rtol=1e-12
    )


@pytest.mark.parametrize("name", ["polybutadiene_14", "polyisoprene_14", "polyisoprene_34", "sbr"])
def test_series_of_a_published_rubber_is_its_fractional_law(root: Path, name: str) -> None:
    """Within 0.1 % RMS in both moduli over its band, from 1 to 50 MPa in the band of a run at 22 degC."""
    compound = library_compound(name, root)
    assert isinstance(compound, SpringPots)
    fit = fit_surrogate(compound)
    assert max(fit.storage_rms, fit.loss_rms) < 1e-3
    w = np.array([1.0, 1000.0])
    np.testing.assert_allclose(
        prony_series(compound).storage_modulus(w), surrogate_modulus(compound, w).real, rtol=2e-3
    )
    assert compound.origin == "published"
    assert "DMA_sampledefs.py" in compound.source


def test_published_rubbers_give_the_moduli_that_their_source_measured_at_15_megahertz(root: Path) -> None:
    """Shear modulus times density by quartz crystal in the source, K = 2.4 GPa, 0.9 g/cm3: E within 18 % at 20 degC."""
    for name, modulus in (("sbr", 8.89e7), ("polyisoprene_14", 3.2e7), ("polybutadiene_14", 3e6)):
        compound = library_compound(name, root)
        assert isinstance(compound, SpringPots)
        shear = modulus / 0.9
        tension = 9 * 2.4e9 * shear / (3 * 2.4e9 + shear)
        found = abs(surrogate_modulus(compound, np.array([2 * np.pi * 1.5e7]))[0])
        assert found == pytest.approx(tension, rel=0.18), name


def test_shift_of_a_published_rubber_is_that_of_its_source_to_base_ten(root: Path) -> None:
    """15 MHz at 50, 90 and 130 degC, reduced to 20 degC: the source's moduli, 740, 70 and 16 MPa, within 11 %."""
    from tread_validate.material import relative_shift

    compound = library_compound("polyisoprene_34", root)
    assert isinstance(compound, SpringPots)
    a = relative_shift(np.array([50.0, 90.0, 130.0]), 20.0, compound.time_shift)
    found = np.abs(surrogate_modulus(compound, 2 * np.pi * 1.5e7 * a))
    np.testing.assert_allclose(found, [740.4e6, 69.8e6, 16.0e6], rtol=0.11)


def test_a_name_that_the_library_does_not_have_is_answered_with_those_it_has(root: Path) -> None:
    assert len(library_names(root)) >= 3
    with pytest.raises(InputError, match=r"library compound mastic.*polybutadiene_14, .*sbr"):
        named_compound(LibraryCompound(kind="library", name="mastic"), root)
