"""Sweeps as an instrument exports them, and every way in which they are refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.material import RouteSettings, read_route
from tread_validate.material.sweeps import COLUMNS, read_export
from tread_validate.study import Wlf

WLF = Wlf(c1=8.86, c2_K=101.6, reference_temperature_degC=10.0)
Row = list[float]


def rows_of(temperatures: tuple[float, ...] = (10.0, 22.0, 40.0), points: int = 12) -> list[Row]:
    frequency = np.geomspace(0.1, 100.0, points)
    return [[t, f, 2e7 * f**0.1 * (1 - 0.005 * t), 3e6 * f**0.15] for t in temperatures for f in frequency]


def write(folder: Path, rows: list[Row], header: tuple[str, ...] = COLUMNS) -> Path:
    path = folder / "sweeps.csv"
    path.write_text("\n".join([",".join(header), *(",".join(f"{v:.6g}" for v in row) for row in rows)]), "utf-8")
    return path


def test_sweeps_are_told_apart_by_temperature_and_sorted_by_frequency(tmp_path: Path) -> None:
    rows = rows_of()
    falling = rows[:12][::-1] + rows[12:]
    sweeps = read_export(write(tmp_path, falling))[0]
    assert [sweep.temperature for sweep in sweeps] == pytest.approx([10.0, 22.0, 40.0])
    assert all(np.all(np.diff(sweep.angular_frequency) > 0) for sweep in sweeps)
    assert sweeps[0].line[0] == 13  # the lowest frequency stood last


@pytest.mark.parametrize("falling", [False, True])
def test_a_dense_sweep_is_one_sweep_and_its_repetition_another(tmp_path: Path, falling: bool) -> None:
    rows = rows_of((22.0,), 300)[:: -1 if falling else 1]  # 100 points a decade: the fifth is still near the first
    sweeps = read_export(write(tmp_path, rows + rows))[0]
    assert [sweep.line.size for sweep in sweeps] == [300, 300]


def test_stated_unit_scales_both_moduli(tmp_path: Path) -> None:
    rows = [[t, f, s / 1e6, loss / 1e6] for t, f, s, loss in rows_of()]
    sweeps = read_export(write(tmp_path, rows), modulus_unit="MPa")[0]
    assert sweeps[0].storage_modulus[0] == pytest.approx(rows_of()[0][2], rel=1e-5)


def test_ready_master_curve_needs_no_temperatures(tmp_path: Path) -> None:
    path = write(tmp_path, [row[1:] for row in rows_of((22.0,), 30)], COLUMNS[1:])
    route = read_route(path, WLF, 22.0, RouteSettings(terms=6, replicates=0), ready_master=True)
    assert route.master.shift_factors == pytest.approx([1.0])
    assert route.fit.series.reference_temperature == 22.0


def change(row: int, column: int, value: float) -> Callable[[list[Row]], None]:
    def alter(rows: list[Row]) -> None:
        rows[row][column] = value

    return alter


def megapascal(rows: list[Row]) -> None:
    for row in rows:
        row[2], row[3] = row[2] / 1e6, row[3] / 1e6


def mixed_units(rows: list[Row]) -> None:
    for row in rows:
        row[3] /= 1e6


def kelvin(rows: list[Row]) -> None:
    for row in rows:
        row[0] += 273.15


@pytest.mark.parametrize(
    ("alter", "where", "reason"),
    [
        (megapascal, "sweeps.csv:2: storage_modulus_Pa", "is it MPa?"),
        (mixed_units, "sweeps.csv:2: loss_modulus_Pa", "both moduli in one unit"),
        (kelvin, "sweeps.csv:2: temperature_degC", "not K"),
        (change(4, 2, -2e7), "sweeps.csv:6: storage_modulus_Pa", "a value > 0"),
        (change(4, 3, 0.0), "sweeps.csv:6: loss_modulus_Pa", "a value > 0"),
        (change(5, 1, 0.2), "sweeps.csv:7: frequency_Hz", "a frequency above the"),
        (change(5, 1, -1.0), "sweeps.csv:7: frequency_Hz", "a number from 0 "),
        (change(6, 0, 60.0), "sweeps.csv:8", "at least 5 at one temperature"),
    ],
)
def test_wrong_sweeps_are_refused(tmp_path: Path, alter: Callable[[list[Row]], None], where: str, reason: str) -> None:
    rows = rows_of()
    alter(rows)
    with pytest.raises(InputError) as refused:
        read_export(write(tmp_path, rows))[0]
    assert where in str(refused.value)
    assert reason in str(refused.value)


def test_confirmed_units_are_taken(tmp_path: Path) -> None:
    rows = rows_of()
    megapascal(rows)
    assert read_export(write(tmp_path, rows), confirm_units=True)[0][0].storage_modulus[0] < 100.0


@pytest.mark.parametrize("temperature", [-91.6, -120.0])
def test_a_sweep_at_or_below_the_pole_of_the_shift_is_refused(tmp_path: Path, temperature: float) -> None:
    path = write(tmp_path, rows_of((temperature, 22.0, 40.0)))
    with pytest.raises(InputError, match=r"sweeps.csv:2: temperature_degC.*above the WLF pole, -91.6 degC"):
        read_route(path, WLF, 22.0, RouteSettings(terms=4, replicates=0))


def test_more_terms_than_the_points_can_carry_are_refused(tmp_path: Path) -> None:
    path = write(tmp_path, rows_of((22.0,), 8))
    with pytest.raises(InputError, match=r"8 points.*at least 13 for 24 terms"):
        read_route(path, WLF, 22.0, RouteSettings(replicates=0))


def test_a_band_without_data_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"data over the band of 0.001 to 1e\+06 rad/s"):
        read_route(write(tmp_path, rows_of()), WLF, 22.0, RouteSettings(band=(1e-3, 1e6), replicates=0))


def test_two_temperatures_do_not_fix_two_shift_constants(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="at least 3"):
        read_route(write(tmp_path, rows_of((10.0, 30.0))), WLF, 22.0, RouteSettings(fit_wlf=True, replicates=0))


def test_an_error_that_no_series_reaches_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="pruning"):
        read_route(write(tmp_path, rows_of()), WLF, 22.0, RouteSettings(largest_error=1e-6, replicates=0))
