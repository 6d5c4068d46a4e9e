"""Tribometer tables and friction files: front stages of a study, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.friction import fit_friction, friction_schema, huemer_law, law, read_friction_table, table_law
from tread_validate.study import FrictionTable, HuemerFile

HEAD = "pressure_Pa,slip_speed_m_s,friction_coefficient\n"
COMMON = {"origin": "synthetic", "source": "test"}


def write(folder: Path, rows: list[tuple[float, float, float]]) -> Path:
    path = folder / "table.csv"
    path.write_text(HEAD + "".join(f"{p:g},{v:g},{mu:g}\n" for p, v, mu in rows), encoding="utf-8")
    return path


def grid(pressures: tuple[float, ...] = (1e5, 4e5), speeds: tuple[float, ...] = (0.01, 0.1, 1.0, 5.0)):
    return [(p, v, 0.8 + 0.1 * np.log10(v) - 1e-7 * p) for p in pressures for v in speeds]


def test_table_names_a_study_law_and_repeats_are_averaged(tmp_path: Path) -> None:
    rows = [*grid(), (1.01e5, 0.0101, 0.8 - 0.2 - 0.0101 + 0.04)]
    built = law(FrictionTable(kind="table", file=write(tmp_path, rows).name, **COMMON), tmp_path)
    assert built.kind == "table"
    assert built.table.shape == (2, 4)
    assert built.kinetic(1.005e5, 0.01005) == pytest.approx(0.59 + 0.02, abs=1e-3)


def test_shipped_friction_file_is_a_study_law(root: Path) -> None:
    """The fitted law differs from the one that the synthetic table was drawn from by less than 2 % in its range."""
    entry = HuemerFile(kind="huemer_file", file="reference_data/friction/synthetic_friction.yaml", **COMMON)
    fitted = law(entry, root)
    p, v = np.meshgrid(np.geomspace(5e4, 8e5, 9), np.geomspace(3e-3, 10, 9))
    drawn = huemer_law(0.8212, 0.0, 0.9, 10.0, 3.729, -4.495, 1.785)
    np.testing.assert_allclose(fitted.kinetic(p, v), drawn.kinetic(p, v), rtol=0.02)
    assert fitted.static_coefficient == 0.9


def test_units_names_temperature_and_runs_of_a_tribometer(tmp_path: Path) -> None:
    """kPa, mm/s, per cent and kelvin under other names; of two temperatures the one asked for is taken."""
    rows = [f"{t + 273.15};{k};{p / 1e3:g};{1e3 * v:g};{100 * mu:g}".replace(".", ",")
            for t in (22.0, 60.0) for k in (1, 2) for p, v, mu in grid()]  # fmt: skip
    path = tmp_path / "tribo.csv"
    path.write_text("Temp. [K];Run;Pressure [kPa];Sliding speed [mm/s];COF [%]\n" + "\n".join(rows), encoding="latin-1")
    data = read_friction_table(path, temperature=60.0)
    assert data.coefficient.size == 16
    np.testing.assert_allclose(data.pressures, [1e5, 4e5])
    np.testing.assert_allclose(data.speeds, [0.01, 0.1, 1.0, 5.0])
    np.testing.assert_allclose(data.coefficient[:8], [mu for _, _, mu in grid()], rtol=1e-5)
    with pytest.raises(InputError, match=r"temperatures of 22, 60 degC, expected one: --temperature-degC"):
        read_friction_table(path)


def test_a_law_that_misses_its_table_does_not_describe_it(tmp_path: Path) -> None:
    """A step in speed that Huemer's law cannot have, with repeats of 0.1 %: refused; with 30 % scatter it is not."""
    random = np.random.default_rng(1)
    for scatter, describes in ((1e-3, False), (0.3, True)):
        rows = [
            (p, v, (0.5 + 0.15 * (0.05 < v < 0.5)) * (1.0 + scatter * random.standard_normal()))
            for p in (1e5, 2e5, 4e5)
            for v in np.geomspace(1e-3, 10.0, 9)
            for _ in range(3)
        ]
        fit = fit_friction(read_friction_table(write(tmp_path, rows)))
        assert fit.describes is describes
        assert any("lack of fit" in text for text in fit.warnings) is not describes


def test_a_kinetic_coefficient_above_the_static_one_is_told(tmp_path: Path) -> None:
    rows = [(p, v, 2.0 * mu) for p, v, mu in grid((1e5, 2e5, 4e5), (1e-3, 0.01, 0.1, 1.0, 5.0))]
    fit = fit_friction(read_friction_table(write(tmp_path, rows)), static_coefficient=0.9)
    assert any("above the static one of 0.9" in text for text in fit.warnings)


@pytest.mark.parametrize(
    ("rows", "reason"),
    [
        ([(0.1, 0.1, 0.9), (0.4, 0.1, 0.9)], "is it MPa"),
        ([(1e5, 100.0, 0.9), (4e5, 200.0, 0.9)], "is it mm/s"),
        ([(1e5, 0.1, 90.0), (4e5, 0.1, 80.0)], "per cent"),
        ([(1e5, 0.1, 0.9), (4e5, 0.1, -0.1)], r"table.csv:3: friction_coefficient.*a value > 0"),
        ([(1e5, 0.0, 0.9)], r"table.csv:2: slip_speed_m_s.*a value > 0"),
    ],
)
def test_wrong_tables_are_refused(tmp_path: Path, rows: list[tuple[float, float, float]], reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        read_friction_table(write(tmp_path, rows))


@pytest.mark.parametrize(
    ("rows", "reason"),
    [
        (grid(pressures=(4e5,)), "one pressure only"),
        (grid(speeds=(0.5,)), "one slip speed only"),
        (grid(speeds=(0.1, 0.5)), "2 slip speeds"),
        (grid(speeds=(0.01, 0.1, 1.0, 5.0))[:5], "5 combinations"),
    ],
)
def test_tables_that_cannot_carry_a_fit_are_refused(
    tmp_path: Path, rows: list[tuple[float, float, float]], reason: str
) -> None:
    with pytest.raises(InputError, match=reason):
        fit_friction(read_friction_table(write(tmp_path, rows)))


def test_one_pressure_serves_when_its_dependence_is_held(tmp_path: Path) -> None:
    rows = [
        (4e5, v, float(huemer_law(0.8, 0, 1.0, 10, 3.7, -4.5, 1.8).kinetic(4e5, v))) for v in np.geomspace(0.01, 9, 9)
    ]
    fit = fit_friction(read_friction_table(write(tmp_path, rows)), {"n": 1.0, "beta": 0.0})
    assert fit.rms < 1e-4
    assert fit.held["n"] == 1.0


def test_a_gap_in_the_grid_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no measurement at 4e\\+05 Pa and 5 m/s"):
        law(FrictionTable(kind="table", file=write(tmp_path, grid()[:-1]).name, **COMMON), tmp_path)


def test_constants_that_make_no_law_are_refused() -> None:
    with pytest.raises(InputError, match="a denominator of"):
        huemer_law(0.8, 0.0, 0.9, 10.0, 1.0, -4.5, 1.8)
    with pytest.raises(InputError, match="a negative coefficient"):
        huemer_law(0.8, -2.0, 0.9, 10.0, 3.7, -4.5, 1.8)
    with pytest.raises(InputError, match="increasing order"):
        table_law(np.array([2e5, 1e5]), np.array([1.0]), np.ones((2, 1)), 0.9)


@pytest.mark.parametrize("hold", [{"alpha": 1.0}, {"m": 1e4}])
def test_only_three_constants_can_be_held_and_within_reason(tmp_path: Path, hold: dict[str, float]) -> None:
    with pytest.raises(InputError, match="held constant"):
        fit_friction(read_friction_table(write(tmp_path, grid((1e5, 2e5, 4e5)))), hold)


def test_schema_names_the_constants() -> None:
    assert {"alpha", "m", "intervals_95", "warnings"} <= set(friction_schema()["properties"])
