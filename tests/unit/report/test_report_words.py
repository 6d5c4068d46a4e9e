"""Numbers, units, assessments and marks in words."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.compare.tables import AssumedRow
from tread_validate.report import wording
from tread_validate.report.marks import Marks, in_words


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"), (203.4, "203"), (9.996, "10.0"), (0.0996, "0.0996"), (-0.5, "−0.500"), (1.0e5, "100000"),
        (3.0e7, "3.00·10⁷"), (2.0e-6, "2.00·10⁻⁶"), (None, "–"), (math.nan, "–"), (-math.inf, "−∞"),
    ],
)  # fmt: skip
def test_number_has_three_significant_digits(value: float | None, text: str) -> None:
    """Exact: rounded, with a true minus sign; what is not there is a dash, never a zero."""
    assert wording.digits(value) == text


@given(st.floats(min_value=1e-4, max_value=9e5) | st.floats(min_value=-9e5, max_value=-1e-4))
def test_number_reads_back_within_half_a_digit(value: float) -> None:
    """Exact: four significant digits are within 5 parts in 10,000 of the value."""
    assert float(wording.digits(value, 4).replace("−", "-")) == pytest.approx(value, rel=5.01e-4)


def test_error_is_written_as_its_type_asks() -> None:
    """Exact: per cent with sign, newtons with sign, a score as it is, an RMS error without sign."""
    assert wording.error(-0.1234, "relative") == "−12.3\u00a0%"
    assert wording.error(0.5, "absolute", "N") == "+0.500 N"
    assert wording.error(0.91, "score") == "0.910"
    assert wording.error(0.07, "relative", metric="relative_rms") == "7.0\u00a0%"
    assert wording.error(None, "relative") == "–"
    assert wording.error(-1e-9, "relative") == "0.0\u00a0%"


def test_assessment_carries_a_symbol_beside_its_colour() -> None:
    """Exact: the three assessments have three symbols; an unknown word is shown as it is."""
    assert [wording.assessment(v) for v in ("agrees", "disagrees", "cannot tell")] == [
        "✓ agrees",
        "✗ disagrees",
        "? cannot tell",
    ]
    assert wording.assessment("perhaps") == "perhaps"


def test_marks_follow_the_list_of_assumptions() -> None:
    """Exact: codes in the list's order, each once, an input that the list has not is added rather than dropped."""
    listed = [AssumedRow("compound c", "synthetic", "s", 2), AssumedRow("path p", "assumed", "t", 2)]
    marks = Marks(listed)
    found = marks.of("path p (assumed); compound c (synthetic)", "path p (assumed)", "block b (assumed)")
    assert [(mark.code, mark.origin) for mark in found] == [("S1", "synthetic"), ("A2", "assumed"), ("A3", "assumed")]
    assert in_words(found) == "synthetic S1 · assumed A2 A3"
    assert marks.of("", "") == ()
