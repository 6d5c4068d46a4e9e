"""What a compound's series is worth where it is used: band, errors, assessment, and the limit where it is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.material.worth import worths
from tread_validate.study import load_study

SWEEPS = {"kind": "sweeps", "origin": "synthetic", "source": "test",
          "file": "reference_data/material/synthetic_sweeps.csv"}  # fmt: skip


def test_the_papers_compound_covers_what_the_runs_need(paper_study: Path) -> None:
    """0.25 to 2500 rad/s at 22 degC; a point loads within 0.4 ms at least, 2.4e3 rad/s; errors far below the limit."""
    (worth,) = worths(load_study(paper_study).cases())
    assert worth.known == (0.25, 2500.0)
    assert 0.25 < worth.needed[0] < worth.needed[1] < 2500.0
    assert worth.largest_error is not None
    assert worth.largest_error < 0.02
    assert not any("warning" in line for line in worth.lines())


def test_constants_left_to_the_paper_are_named(altered_study: Callable[..., Path]) -> None:
    """No WLF constants, Poisson's ratio or density in the entry: each is told."""
    cases = load_study(altered_study({"compounds.surrogate": SWEEPS})).cases()
    (worth,) = worths(cases[:1])
    assert set(worth.defaults) == {"wlf", "poissons_ratio", "density_kg_m3"}
    assert any("by the paper's constants, not given in the study" in line for line in worth.lines())


@pytest.mark.parametrize(("loss", "refused"), [(4.0, False), (23.0, True)])
def test_a_fit_far_off_is_refused(loss: float, refused: bool, altered_study: Callable[..., Path]) -> None:
    """15 % RMS in E'' is the limit, by the quality that the material file says of itself."""
    path = altered_study({"compounds.surrogate": SWEEPS})
    file = path.parent / "off.yaml"
    file.write_text(
        "kind: prony\norigin: measured\nsource: test\nlong_term_modulus_MPa: 10\n"
        "terms:\n  - {modulus_MPa: 5, relaxation_time_s: 1.0e-2}\n"
        f"quality: {{storage_rms_percent: 3.0, loss_rms_percent: {loss}, lowest_frequency_rad_s: 0.1, "
        "highest_frequency_rad_s: 1.0e+3, kramers_kronig_consistent: true}\n"
    )
    entry = {"kind": "prony_file", "origin": "measured", "source": "test", "file": str(file)}
    (worth,) = worths(load_study(altered_study({"compounds.surrogate": entry})).cases()[:1])
    assert worth.loss_error == pytest.approx(0.01 * loss)
    if refused:
        with pytest.raises(InputError, match=r"misses E' by 3 % and E'' by 23 %.*15 % at most"):
            worth.refuse("study.yaml")
    else:
        worth.refuse("study.yaml")


def test_a_slower_run_needs_a_lower_band(paper_study: Path) -> None:
    """Half the speed halves both ends of the band, as every time doubles."""
    cases = [case for case in load_study(paper_study).cases() if case.path.family == "rig" and case.temperature == 22.0]
    slow, fast = (min(cases, key=lambda c: c.speed), max(cases, key=lambda c: c.speed))
    slow = next(c for c in cases if c.speed == slow.speed and c.interference == fast.interference)
    bands = [np.array(worths([case])[0].needed) for case in (slow, fast)]
    np.testing.assert_allclose(bands[1] / bands[0], fast.speed / slow.speed, rtol=0.02)
