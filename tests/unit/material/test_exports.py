"""Exports of analysers as they come: the same sweeps out of every format, and a line where a doubt is left."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.instrument import Reading
from tread_validate.material.sweeps import read_export
from tread_validate.study import load_study

TEMPERATURES = (10.0, 30.0, 50.0)
FREQUENCIES = np.geomspace(0.1, 100.0, 7)
ROWS = [(t, f, 2e7 * f**0.1 * (1 - 0.005 * t), 3e6 * f**0.15) for t in TEMPERATURES for f in FREQUENCIES]


def table(head: list[str], rows: list[list[float]], separator: str = ",", comma: bool = False) -> str:
    lines = [separator.join(f"{value:.7g}" for value in row) for row in rows]
    text = "\n".join(lines).replace(".", ",") if comma else "\n".join(lines)
    return "\n".join([*head, text]) + "\n"


def plain(folder: Path) -> Path:
    path = folder / "plain.csv"
    path.write_text(
        table(["temperature_degC,frequency_Hz,storage_modulus_Pa,loss_modulus_Pa"], [list(r) for r in ROWS])
    )
    return path


def units_row(folder: Path) -> Path:
    rows = [[f, e1 / 1e6, e2 / 1e6, t, k // 7] for k, (t, f, e1, e2) in enumerate(ROWS)]
    path = folder / "units.csv"
    path.write_text("\ufeff" + table(["f,E_stor,E_loss,T,Set", "Hz, MPa, MPa, C, -"], rows), "utf-8")
    return path


def rad_and_kelvin(folder: Path) -> Path:
    rows = [[2 * np.pi * f, e1 / 1e9, e2 / 1e9, t + 273.15] for t, f, e1, e2 in ROWS]
    path = folder / "kelvin.txt"
    path.write_text(table(["Angular frequency / rad/s\tE' [GPa]\tE'' [GPa]\tTemp. (K)"], rows, "\t"), "utf-8")
    return path


def german(folder: Path) -> Path:
    rows = [[t, f, e1 / 1e6, e2 / e1] for t, f, e1, e2 in ROWS]
    path = folder / "german.csv"
    head = ["Prüfgerät 7", "Datum;1.2.2024", "", "Temperature [°C];Frequency [Hz];E' [MPa];tan δ"]
    path.write_bytes(table(head, rows, ";", comma=True).replace("δ", "delta").encode("latin-1"))
    return path


def steps_in_utf16(folder: Path) -> Path:
    parts = ["Instrument\tX9\n"]
    for number, t in enumerate(TEMPERATURES, start=1):
        rows = [[2 * np.pi * f, e1, e2, e2 / e1, t] for at, f, e1, e2 in ROWS if at == t]
        names = "Angular frequency\tStorage modulus\tLoss modulus\tTan(delta)\tTemperature"
        head = ["[step]", f"Frequency sweep - {number}", names, "rad/s\tPa\tPa\t\t°C"]
        parts.append(table(head, rows, "\t"))
    path = folder / "steps.txt"
    path.write_text("\n".join(parts), "utf-16")
    return path


def blanks_and_complex(folder: Path) -> Path:
    rows = [[t, f, np.hypot(e1, e2) / 1e3, np.degrees(np.arctan2(e2, e1))] for t, f, e1, e2 in ROWS]
    path = folder / "blanks.dat"
    path.write_text(table(["% made by hand", "T(degC)  f(Hz)  |E*|(kPa)  phase(deg)"], rows, "   "))
    return path


def workbook(folder: Path) -> Path:
    from openpyxl import Workbook  # type: ignore[import-untyped]

    book = Workbook()
    sheet = book.active
    for row in (["Analyser", "X9"], [], ["Temperature", "Frequency", "Storage Modulus", "Loss Modulus", "Remark"],
                ["°C", "Hz", "MPa", "MPa", ""]):  # fmt: skip
        sheet.append(row)
    for t, f, e1, e2 in ROWS:
        sheet.append([t, f, e1 / 1e6, e2 / 1e6, None])
    path = folder / "book.xlsx"
    book.save(path)
    return path


FORMATS = (plain, units_row, rad_and_kelvin, german, steps_in_utf16, blanks_and_complex, workbook)


@pytest.mark.parametrize("make", FORMATS, ids=lambda make: make.__name__)
def test_every_format_gives_the_same_sweeps(make: Callable[[Path], Path], tmp_path: Path) -> None:
    """Seven digits are written, so moduli, frequencies and temperatures agree to 1e-6."""
    sweeps, understood = read_export(make(tmp_path))
    assert [sweep.temperature for sweep in sweeps] == pytest.approx(TEMPERATURES)
    for number, sweep in enumerate(sweeps):
        expected = np.array(ROWS[7 * number : 7 * number + 7])
        np.testing.assert_allclose(sweep.angular_frequency, 2 * np.pi * expected[:, 1], rtol=1e-6)
        np.testing.assert_allclose(sweep.storage_modulus, expected[:, 2], rtol=1e-6)
        np.testing.assert_allclose(sweep.loss_modulus, expected[:, 3], rtol=1e-6)
    assert "3 sweep(s), 21 points" in understood[-1]


def test_what_was_understood_is_told_column_by_column(tmp_path: Path) -> None:
    """Quantity, column, heading and unit, in one line."""
    _, understood = read_export(units_row(tmp_path))
    assert "E' = column 2 'E_stor' in MPa" in understood[1]
    assert "temperature = column 4 'T' in C" in understood[1]


def test_one_file_a_sweep_with_the_temperature_above_the_table(tmp_path: Path) -> None:
    """Files without a column of temperatures say them once, above their tables."""
    paths = []
    for t in TEMPERATURES:
        path = tmp_path / f"at{t:g}.csv"
        rows = [[f, e1 / 1e6, e2 / 1e6] for at, f, e1, e2 in ROWS if at == t]
        path.write_text(table([f"# Temperature: {t:g} °C", "Frequency (Hz),E' (MPa),E'' (MPa)"], rows), "utf-8")
        paths.append(path)
    sweeps, _ = read_export(paths)
    assert [sweep.temperature for sweep in sweeps] == pytest.approx(TEMPERATURES)


def test_ramp_through_frequencies_becomes_isothermal_sweeps(tmp_path: Path) -> None:
    """Moduli of a law that is exponential in temperature interpolate exactly: 1e-6 for the digits written."""
    frequencies = (1.0, 3.0, 10.0, 30.0, 100.0)
    rows, t = [], -20.0
    for _ in range(30):
        for f in frequencies:
            rows.append([t, f, 30.0 * f**0.1 * np.exp(-0.02 * t), 5.0 * f**0.2 * np.exp(-0.03 * t)])
            t += 0.4
    path = tmp_path / "ramp.csv"
    path.write_text(table(["T (°C),f (Hz),E' (MPa),E'' (MPa)"], rows), "utf-8")
    sweeps, understood = read_export(path)
    assert len(sweeps) == 28
    assert any("a temperature ramp with 5 frequencies in turn" in line for line in understood)
    for sweep in sweeps:
        hertz = sweep.angular_frequency / (2 * np.pi)
        exact = 30e6 * hertz**0.1 * np.exp(-0.02 * sweep.temperature)
        np.testing.assert_allclose(sweep.storage_modulus, exact, rtol=1e-5)


@pytest.mark.parametrize(
    ("head", "expected"),
    [
        ("T (degC),f (Hz),E' (MPa),E'' (MPa),Storage modulus (MPa)", r"E' in columns 3 .* 5 .*--column storage=NUMBER"),
        ("T (degC),f (Hz),E',E'',x", r":1: column 3 'E'': got no unit, .*--modulus-unit"),
        ("T,f (Hz),E' (MPa),E'' (MPa),x", r":1: column 1 'T': got no unit, .*degC.*--temperature-unit"),
        ("T (degC),x,E' (MPa),E'' (MPa),y", r"a frequency \(Hz or rad/s\): --column frequency=NUMBER"),
        ("T (degC),f (Hz),E' (MPa),x,y", r"one modulus with tan delta or phase"),
        ("T (degC),f (Hz),G' (MPa),G'' (MPa),x", r"a shear modulus in column 3"),
        ("x,f (Hz),E' (MPa),E'' (MPa),y", r"got no temperature, expected a column of temperatures"),
    ],
)
def test_doubts_stop_with_the_choices_and_the_option_that_decides(head: str, expected: str, tmp_path: Path) -> None:
    rows = [[t, f, e1 / 1e6, e2 / 1e6, 1.0] for t, f, e1, e2 in ROWS]
    path = tmp_path / "doubt.csv"
    path.write_text(table([head], rows), "utf-8")
    with pytest.raises(InputError, match=expected):
        read_export(path)


def test_the_users_word_on_columns_and_units_decides(tmp_path: Path) -> None:
    """Two columns of E': number 5 is taken, and its unit from the option."""
    rows = [[t, f, 1.0, e2 / 1e6, e1 / 1e6] for t, f, e1, e2 in ROWS]
    path = tmp_path / "two.csv"
    path.write_text(table(["T (degC),f (Hz),E',E'',E_stor"], rows), "utf-8")
    reading = Reading({"storage": "5"}, {"--modulus-unit": "MPa"})
    sweeps, _ = read_export(path, reading=reading)
    assert sweeps[0].storage_modulus[0] == pytest.approx(ROWS[0][2], rel=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("21,", "x1,", r"bad.csv:\d+: .*got 'x1', expected a number"),
        ("\n10,", "\n10;", r"bad.csv:5: got 3 cells, expected 4"),
    ],
)
def test_a_bad_cell_is_named_by_line_and_column(old: str, new: str, expected: str, tmp_path: Path) -> None:
    lines = ["T (degC),f (Hz),E' (MPa),E'' (MPa)", *(f"10,{k},21,3" for k in range(1, 9))]
    path = tmp_path / "bad.csv"
    text = "\n".join(lines)
    at = text.index(old, 60)
    path.write_text(text[:at] + new + text[at + len(old) :])
    with pytest.raises(InputError, match=expected):
        read_export(path)


def test_an_old_workbook_is_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "old.xls"
    path.write_bytes(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600))
    with pytest.raises(InputError, match=r"an old binary workbook \(.xls\), expected text, or a workbook named .xlsx"):
        read_export(path)


def test_a_study_says_columns_and_units_too(altered_study: Callable[..., Path], root: Path) -> None:
    """`columns:` and `units:` of a sweeps compound reach the reader."""
    sweeps = {"kind": "sweeps", "origin": "synthetic", "source": "test",
              "file": "reference_data/material/synthetic_sweeps.csv",
              "columns": {"storage": "3"}, "units": {"modulus": "Pa", "frequency": "Hz"}}  # fmt: skip
    compound = load_study(altered_study({"compounds.surrogate": sweeps})).model.compounds["surrogate"]
    assert compound.columns.storage == "3"
    assert compound.units.modulus == "Pa"
