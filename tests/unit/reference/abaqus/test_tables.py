"""Reading force tables: layouts as they occur, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.reference.abaqus import read_table

# columns, padding and engineering notation as the Viewer writes them (single curve, and history names of two pairs)
REPORT = """
                  X               CFN2     ASSEMBLY_FACE/ASSEMBLY_ROAD  CFS1     ASSEMBLY_FACE/ASSEMBLY_ROAD

                0.                 0.                  0.
               47.5732E-06         1.00994           -12.5E-03
              856.05E-06          18.1498             -1.2
                1.04621E-03       22.1747             -2.E+00


"""
TEMPORARY = """
               X               _temp_1

               0.              0.
              10.E-03          2.5
"""


def write(folder, text):
    path = folder / "forces.rpt"
    path.write_text(text)
    return path


def test_report_in_engineering_notation_keeps_every_digit(tmp_path):
    table = read_table(write(tmp_path, REPORT))
    assert table.layout == "xy report"
    np.testing.assert_array_equal(table.values[:, 0], [0.0, 47.5732e-6, 856.05e-6, 1.04621e-3])
    np.testing.assert_array_equal(table.column("CFN2"), [0.0, 1.00994, 18.1498, 22.1747])
    np.testing.assert_array_equal(table.column("CFS1"), [0.0, -0.0125, -1.2, -2.0])
    assert table.column("CFS2") is None


def test_report_with_temporary_names_reads_but_names_nothing(tmp_path):
    table = read_table(write(tmp_path, TEMPORARY))
    assert table.columns == ("X", "_temp_1")
    assert table.column("CFN2") is None


TWO_LINES = """
                                    CFN2 PI: FACE      CFS1 PI: FACE     U2 PI: PART-1
                  X                 on ROAD            on ROAD           N: 12

                0.                 0.                  0.              NoValue
               10.E-03            18.1498             -1.2             0.5
               10.E-03            18.1498             -1.2             NoValue
               20.E-03            22.1747             -2.              1.
"""


def test_heading_over_two_lines_gaps_and_a_step_s_end_twice(tmp_path):
    """Parts of a name go by their place; the row of a time that stands twice counts once; a gap is a gap."""
    table = read_table(write(tmp_path, TWO_LINES))
    assert table.columns == ("X", "CFN2 PI: FACE on ROAD", "CFS1 PI: FACE on ROAD", "U2 PI: PART-1 N: 12")
    np.testing.assert_array_equal(table.values[:, 0], [0.0, 0.01, 0.02])
    np.testing.assert_array_equal(table.column("CFN2"), [0.0, 18.1498, 22.1747])
    with pytest.raises(InputError, match=r"U2, row 1 of numbers: got NoValue, expected .*interpolation on"):
        table.column("U2")


def test_a_used_column_with_a_gap_is_refused(tmp_path):
    table = read_table(write(tmp_path, REPORT.replace("-1.2", "NoValue")))
    assert table.column("CFN2") is not None
    with pytest.raises(InputError, match="interpolation on"):
        table.column("CFS1")


@pytest.mark.parametrize("separator", [" ", ",", "\t", ";", " , "])
def test_two_columns_may_be_apart_in_any_usual_way(tmp_path, separator):
    table = read_table(write(tmp_path, f"0.0{separator}0.0\n1e-3{separator}5.5\n2D-3{separator}0\n"))
    assert table.layout == "two columns"
    np.testing.assert_array_equal(table.values, [[0, 0], [1e-3, 5.5], [2e-3, 0]])


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "an empty file"),
        ("\x00\x01", "NUL"),
        ("# only: notes\n", "no table"),
        ("words\nand words\n", "a CSV header, an XY report"),
        (REPORT + REPORT, "second table"),
        (REPORT.replace("-1.2", ""), "2 fields, expected 3"),
        (REPORT.replace("18.1498", "18,1498"), "4 fields, expected 3"),
        (REPORT.replace("856.05E-06", "6.05E-06"), "a time after the one before"),
        (REPORT.replace("18.1498", "nan"), "got nan"),
        (REPORT.replace("18.1498", "1E999"), "got 1E999"),
        ("0 1 2\n1 2 3\n", "3 numbers without names"),
        ("0 1\n", "1 row(s)"),
        ("time_s,CFN2\n0,1\n1\n", "1 fields, expected 2"),
    ],
)
def test_unreadable_table_is_refused_in_one_line(tmp_path, text, says):
    with pytest.raises(InputError) as fault:
        read_table(write(tmp_path, text))
    assert says in str(fault.value)
    assert "\n" not in str(fault.value)


def test_appended_columns_of_one_name_are_not_guessed_at(tmp_path):
    table = read_table(write(tmp_path, "time_s,CFN2,CFN2\n0,1,2\n1,1,2\n"))
    with pytest.raises(InputError, match="2 columns"):
        table.column("CFN2")


def engineering(value: float) -> str:
    """Write a number as the Viewer does: exponent a multiple of three, up to six digits."""
    if value == 0.0:
        return "0."
    power = int(np.floor(np.log10(abs(value)) / 3.0) * 3)
    text = f"{value / 10.0**power:.6g}"
    if "." not in text and "e" not in text:
        text += "."
    return text if power == 0 else f"{text}E{power:+03d}"


FORCES = st.floats(-1e5, 1e5).map(lambda v: float(f"{v:.5g}") if abs(v) > 1e-12 else 0.0)


@settings(max_examples=60, deadline=None)
@given(
    rows=st.lists(
        st.tuples(FORCES, FORCES),
        min_size=2,
        max_size=30,
    )
)
def test_any_report_reads_back_as_it_was_written(tmp_path_factory, rows):
    """Six digits in engineering notation hold five-digit numbers; reading errs by rounding only (1e-12 relative)."""
    body = "".join(
        f"   {engineering(1e-5 * i):>18}   {engineering(a):>15}   {engineering(b):>15}\n"
        for i, (a, b) in enumerate(rows)
    )
    path = tmp_path_factory.mktemp("rpt") / "x.rpt"
    path.write_text("\n            X            CFN2            CFS1\n\n" + body + "\n\n")
    table = read_table(path)
    np.testing.assert_allclose(table.values[:, 1:], rows, rtol=1e-12, atol=0)
