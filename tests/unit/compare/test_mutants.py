"""Deliberate changes of the model by one per cent: each has to be caught by the numbers alone."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tread_validate.compare.baseline.delta import check_tables
from tread_validate.compare.baseline.store import Acceptance, load_baseline, save_baseline

FACTS = Acceptance("a test", "somebody", "2026-01-01T00:00:00Z", "0123456789ab", "0.1.0", "liu2010", "digest")


def _replaced(*pairs: tuple[str, str]) -> Callable[[str], str]:
    def change(text: str) -> str:
        for old, new in pairs:
            assert old in text
            text = text.replace(old, new)
        return text

    return change


MUTANTS = {
    "modulus": _replaced(
        ("long_term_modulus_MPa: 10.2", "long_term_modulus_MPa: 10.302"),
        ("modulus_rise_MPa: 77.0", "modulus_rise_MPa: 77.77"),
    ),
    "friction": _replaced(
        ("static_coefficient: 0.9", "static_coefficient: 0.909"), ("alpha: 0.8212", "alpha: 0.829412")
    ),
    "step": _replaced(("element_length_mm: 0.5", "element_length_mm: 0.495")),
    "path, patch of the belt": _replaced(("patch_length_mm: 170.0", "patch_length_mm: 171.7")),
    "path, edge of the belt": _replaced(("edge_radius_mm: 500.0", "edge_radius_mm: 505.0")),
    "path, wheel of the rig": _replaced(("big_wheel_diameter_mm: 600.0", "big_wheel_diameter_mm: 606.0")),
}


@pytest.mark.parametrize("name", MUTANTS)
def test_a_change_of_one_per_cent_is_caught(name: str, workspace: Any, copy: Any, tmp_path: Path) -> None:
    """The digest of the inputs would give every one of these away; it is left out, so that the same change made in
    the code would be caught too. Only spring scalars are looked at: references do not move with the model.
    """
    copy.write_study(MUTANTS[name])
    copy.run_springs()
    copy.build()
    save_baseline(tmp_path / "baseline", workspace.tables, FACTS)
    found = check_tables(load_baseline(tmp_path / "baseline"), copy.tables).failed
    moved = [
        row for row in found if row.in_table == "peaks" and row.source == "spring:paper" and row.outcome == "moved"
    ]
    assert moved


def test_no_change_moves_nothing(workspace: Any, copy: Any, tmp_path: Path) -> None:
    """The same study run again: not one row moves, in any digit that is printed."""
    copy.run_springs()
    copy.build()
    save_baseline(tmp_path / "baseline", workspace.tables, FACTS)
    assert check_tables(load_baseline(tmp_path / "baseline"), copy.tables).deltas == ()
