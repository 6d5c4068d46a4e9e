"""Inputs of a user's own, from the command line: what is taken for what, what is warned of, what is refused and how."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from tread_validate.cli.app import run

STUDY = """
schema_version: 1
name: meet
title: What a user meets
compounds:
  rubber: {kind: prony, origin: assumed, source: one number, long_term_modulus_MPa: 10.0}
friction_laws:
  one: {kind: coulomb, origin: assumed, source: one number, kinetic_coefficient: 0.5}
blocks:
  block: {origin: assumed, source: a box, shape: rectangle, length_mm: 25.0, width_mm: 20.0, height_mm: 8.0,
          mounting: flat}
paths:
  belt: {kind: simplified_belt, origin: assumed, source: a belt, patch_length_mm: 60.0, edge_radius_mm: 500.0}
runs:
  - name: run
    path: belt
    block: block
    compound: rubber
    friction: one
    temperature_degC: 22.0
    interference_mm: 0.2
    speed_m_s: 10.0
    creep_percent: 10.0
spring: {variants: [condensed]}
deck: {element_size_mm: 2.0, layers: 4}
"""


def study(folder: Path, *changes: tuple[str, str]) -> str:
    """Write the study with its changes; return its path."""
    text = STUDY
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "study.yaml").write_text(text, encoding="utf-8")
    return str(folder / "study.yaml")


def spring(folder: Path, *changes: tuple[str, str]) -> pd.DataFrame:
    """Run the condensed face; return its summary."""
    assert run(["spring", study(folder, *changes), "--all", "--variant", "condensed", "-o", str(folder / "out")]) == 0
    return pd.read_csv(folder / "out" / "summary.csv")


def test_one_coefficient_is_both_in_every_deck_and_in_the_model(tmp_path: Path) -> None:
    """`kinetic_coefficient: 0.5` alone: 0.5 in both decks, and T/N of the sliding face 0.5 within 0.2 %."""
    summary = spring(tmp_path)
    assert run(["deck", str(tmp_path / "study.yaml"), "--all", "-o", str(tmp_path / "decks")]) == 0
    decks = [path.read_text() for path in (tmp_path / "decks").glob("*/run*.inp")]
    assert len(decks) == 2
    assert all("friction_static = 0.5\n" in text for text in decks)
    history = pd.read_csv(next((tmp_path / "out").glob("run*.csv")), comment="#")
    middle = history.iloc[len(history) // 2]
    assert middle.iloc[2] / middle.iloc[1] == pytest.approx(-0.5, rel=2e-3)
    assert len(summary) == 1


@pytest.mark.parametrize(
    ("change", "caution"),
    [
        (("interference_mm: 0.2", "interference_mm: 3.0"), "interference 38 % of the height"),
        (("_MPa: 10.0", "_MPa: 10.0, poissons_ratio: 0.4999"), "Poisson's ratio 0.4999: compared with FE up to 0.495"),
        (("edge_radius_mm: 500.0", "edge_radius_mm: 5.0"), "path radius 5 mm below 1.5 times the block's height"),
    ],
    ids=["3 mm of 8", "nu 0.4999", "edge radius 5 mm"],
)
def test_a_case_beyond_what_was_compared_runs_with_a_caution(
    tmp_path: Path, change: tuple[str, str], caution: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """One line on the screen that names the quantity and how far it goes."""
    spring(tmp_path, change)
    printed = capsys.readouterr()
    assert caution in printed.out + printed.err


def test_a_small_block_runs_on_a_face_of_its_own_size(tmp_path: Path) -> None:
    """5 x 4 x 2 mm: N in proportion to the area over the height within a fifth of the large block's."""
    small = ("length_mm: 25.0, width_mm: 20.0, height_mm: 8.0", "length_mm: 5.0, width_mm: 4.0, height_mm: 2.0")
    (tmp_path / "small").mkdir()
    peaks = [spring(tmp_path)["peak_normal_force_N"][0], spring(tmp_path / "small", small)["peak_normal_force_N"][0]]
    assert peaks[1] / peaks[0] == pytest.approx((20.0 / 2.0) / (500.0 / 8.0), rel=0.2)


def test_no_friction_is_a_law(tmp_path: Path) -> None:
    """Coefficients of 0 are taken, and T stays below a thousandth of N."""
    none = ("kinetic_coefficient: 0.5", "kinetic_coefficient: 0.0, static_coefficient: 0.0")
    summary = spring(tmp_path, none)
    history = pd.read_csv(next((tmp_path / "out").glob("run*.csv")), comment="#")
    assert history.iloc[:, 2].abs().max() < 1e-3 * summary["peak_normal_force_N"][0]


def test_poissons_ratio_is_a_factor(tmp_path: Path) -> None:
    """Two ratios are two cases, the stiffer one at 0.45."""
    summary = spring(tmp_path, ("speed_m_s: 10.0", "speed_m_s: 10.0\n    poissons_ratio: [0.3, 0.45]"))
    by_name = summary.set_index("case_id")["peak_normal_force_N"]
    assert [name.split("-")[1] for name in by_name.index] == ["nu0p3", "nu0p45"]
    assert by_name.iloc[1] > by_name.iloc[0]


@pytest.mark.parametrize(("creep", "expected"), [("25.0", "less than 20"), ("-101.0", "greater than -20")])
def test_creep_out_of_range_is_told_its_range(
    tmp_path: Path, creep: str, expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file = study(tmp_path, ("creep_percent: 10.0", f"creep_percent: {creep}"))
    assert run(["spring", file, "--all", "-o", str(tmp_path / "out")]) == 2
    assert f"creep_percent: got {creep.removesuffix('.0')}, expected {expected} or 'free_rolling'" in (
        capsys.readouterr().err.replace(creep, creep.removesuffix(".0"))
    )


def test_a_deck_with_viscous_hourglass_says_that_the_engine_will_not_run_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = study(tmp_path, ("layers: 4}", "layers: 4, hourglass: VISCOUS}"))
    assert run(["deck", file, "--all", "-o", str(tmp_path / "decks")]) == 0
    printed = capsys.readouterr()
    assert "The embedded engine does not run HOURGLASS=VISCOUS" in printed.out + printed.err


def test_histories_of_two_cases_are_not_compared_without_a_word(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both carry their case; `--case NAME` insists."""
    spring(tmp_path, ("speed_m_s: 10.0", "speed_m_s: [5.0, 10.0]"))
    files = sorted(str(path) for path in (tmp_path / "out").glob("run*.csv"))
    assert run(["compare", *files]) == 2
    assert "expected two of one case, or --case NAME" in capsys.readouterr().err
    assert run(["compare", *files, "--case", "both"]) == 0
