"""What a published number stands for, and when a computed one agrees with it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from tread_validate.compare.claims.claim import Computed, Evidence, judge
from tread_validate.compare.claims.rig import TABLE_1
from tread_validate.compare.regression.coefficients import interval
from tread_validate.compare.regression.differences import corrected, differences
from tread_validate.compare.regression.line import Coefficient
from tread_validate.compare.scores.ensemble import summarise
from tread_validate.compare.tables import ClaimRow, Difference, MetricRow, read_rows
from tread_validate.reference import PublishedValue

VALUE = PublishedValue(
    "belt_normal_force", "peak_normal_force", 200.0, "N", 180.0, 220.0, "about", "5", "a force", "computed", "a run"
)  # fmt: skip
TABLE = replace(
    VALUE, id="table1", section="2.3, Table 1", unit="% s/m", value=3.6, low=1.8, high=5.4, spread_kind="sd"
)


@pytest.mark.parametrize(
    ("value", "expected"),
    [(180.0, "agrees"), (220.0, "agrees"), (179.9, "disagrees"), (220.1, "disagrees"), (None, "cannot tell")],
)
def test_a_value_agrees_inside_its_interval_ends_included(value: float | None, expected: str) -> None:
    """180 to 220 N, both ends in."""
    found = judge(VALUE, "model", "spring:paper", Computed(value))
    assert found.assessment == expected
    if value is not None:
        assert found.error == pytest.approx((value - 200.0) / 200.0)


def test_a_printed_standard_deviation_becomes_the_interval_of_the_mean() -> None:
    """3.6 (1.8) of four sets: 3.6 -+ 3.18245 x 1.8/2 = 0.736 to 6.464 (t of 3 degrees of freedom, from tables)."""
    low, high, note = interval(TABLE)
    assert (low, high) == pytest.approx((3.6 - 3.18245 * 0.9, 3.6 + 3.18245 * 0.9), rel=1e-5)
    assert "mean of 4" in note


def test_a_printed_range_of_two_becomes_the_interval_of_their_mean() -> None:
    """-0.60 (-0.58 to -0.62): half-width 12.7062 x 0.04/2 = 0.2541 (t of 1 degree of freedom; sd = range/sqrt 2)."""
    row = replace(TABLE, value=-0.60, low=-0.62, high=-0.58, spread_kind="range")
    low, high, _ = interval(row)
    assert (low, high) == pytest.approx((-0.60 - 0.254124, -0.60 + 0.254124), rel=1e-5)


def evidence_of(printed_sd: float, computed: float, computed_sd: float) -> Evidence:
    """Return evidence with one printed a_v of 3.6 % s/m and one computed one, four sets each."""

    def mean(source: str, value: float, sd: float) -> Coefficient:
        return Coefficient(
            source, "rectangle", "a_v", "mean", 0.01 * value, "s/m", 0.01 * sd, "sd", None, None, None, None, 0.95, 4,
            "current",
        )  # fmt: skip

    rows = (mean("rig:published", 3.6, printed_sd), mean("spring:paper", computed, computed_sd))
    return Evidence(None, (), {}, {}, rows, {}, {}, differences(rows))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("printed_sd", "computed", "expected"),
    [(1.0, 3.8, "agrees"), (1.0, 8.0, "disagrees"), (8.0, 3.8, "cannot tell"), (8.0, 30.0, "disagrees")],
)
def test_table_1_is_judged_by_the_test_of_its_differences(printed_sd: float, computed: float, expected: str) -> None:
    """Printed 3.6 against computed 3.8 (sd 0.5): agrees where the difference is known to better than 3.6, cannot be
    told where the printed scatter of 8 hides everything; 8.0 and 30.0 are far outside either interval.
    """
    found = TABLE_1["table1_a_v_rectangle_rig"](evidence_of(printed_sd, computed, 0.5), "spring:paper")
    assert found.value == pytest.approx(computed)
    assert found.assessment == expected
    assert judge(TABLE, "model", "spring:paper", found).assessment == expected


def test_an_input_has_to_be_the_printed_number() -> None:
    """Without an interval four digits have to agree."""
    row = replace(VALUE, value=8.86, low=None, high=None, spread_kind="none", comparability="input")
    assert judge(row, "input", "study", Computed(8.86)).assessment == "agrees"
    assert judge(row, "input", "study", Computed(8.87)).assessment == "disagrees"


def test_what_has_to_exist_has_to_be_more_than_nothing() -> None:
    """Some slip: 0 is none, anything above is some."""
    row = replace(VALUE, value=None, low=0.0, high=1.0, spread_kind="exists")
    assert judge(row, "model", "x", Computed(0.0)).assessment == "disagrees"
    assert judge(row, "model", "x", Computed(0.01)).assessment == "agrees"


def test_a_computed_input_that_differs_shows(copy: Any) -> None:
    """A study at another belt speed and another wheel: the claims on these inputs disagree, those on others agree."""
    copy.write_study(
        lambda text: text.replace("speed_m_s: 16.7", "speed_m_s: 20.0").replace(
            "big_wheel_diameter_mm: 600.0", "big_wheel_diameter_mm: 1600.0"
        )
    )
    tables = copy.build()
    import csv

    with (tables / "claims.csv").open(newline="", encoding="utf-8") as stream:
        found = {row["claim_id"]: row["assessment"] for row in csv.DictReader(stream) if row["source"] == "study"}
    assert found["belt_speed"] == found["big_wheel_diameter"] == "disagrees"
    assert found["wlf_c1"] == found["belt_compression"] == "agrees"


ROW = MetricRow(
    "a", "peak_normal_force", "scalar", "fe:embedded", "spring:paper", 100.0, 110.0, "N", 0.1, "relative", 0.0, 0.0,
    0.011, 0.022, 0.1, "10 % of the reference", True, "differs", "cannot tell",
)  # fmt: skip


def test_a_summary_counts_every_row() -> None:
    """Three rows, one without an error: three cases, two compared; mean and largest of two; no bias."""
    rows = [
        ROW,
        replace(ROW, case_id="b", predicted=80.0, error=-0.2, passed=False),
        replace(ROW, case_id="c", reference=None, error=None, passed=None, status="missing"),
    ]
    found = summarise("all", rows)
    assert (found.cases, found.compared, found.passed, found.status) == (3, 2, 1, "incomplete")
    assert found.mean_abs_error == pytest.approx(0.15)
    assert (found.largest_abs_error, found.largest_case_id) == (0.2, "b")
    assert found.bias is None
    assert "1 of 3 runs cannot be compared" in found.note
    whole = summarise("all", rows[:2])
    assert whole.status == "current"
    assert whole.bias is not None


def test_no_row_with_an_error_is_no_error_of_zero() -> None:
    """Nothing compared: no mean, no largest, status missing."""
    found = summarise("all", [replace(ROW, error=None, passed=None, status="stale", reference=None)])
    assert (found.mean_abs_error, found.largest_abs_error, found.status) == (None, None, "missing")


def test_the_bias_of_a_negative_peak_is_that_of_its_magnitude() -> None:
    """-30 predicted as -33 twice: bias 1.1, not an error for being negative."""
    row = replace(ROW, quantity="peak_negative_tangential_force", reference=-30.0, predicted=-33.0)
    found = summarise("all", [replace(row, u_data=0.0), replace(row, case_id="b", u_data=0.0)])
    assert found.bias is not None
    assert found.bias == pytest.approx(1.1, rel=1e-12)


def test_the_area_metric_of_a_constant_factor_is_that_factor_less_one() -> None:
    """References 100 and 200 N, predictions ten per cent higher: the distributions are 15 N apart of a mean of 150 N. A
    scatter that is smaller than the references' is said to be within it, not to be zero.
    """
    rows = [ROW, replace(ROW, case_id="b", reference=200.0, predicted=221.0, error=0.105)]
    found = summarise("all", [rows[0], replace(rows[1], predicted=220.0, error=0.1)])
    assert found.area_metric == pytest.approx(0.1, rel=1e-12)
    within = summarise("all", [replace(row, u_data=0.05) for row in rows])
    assert within.model_scatter == 0.0
    assert "is within that of the reference" in within.note


def test_many_tests_are_corrected_for_their_number() -> None:
    """Holm's step-down by hand: p of 0.01, 0.02, 0.03 of three tests become 0.03, 0.04, 0.04; models among themselves
    are another family.
    """

    def row(p: float, family: str) -> Difference:
        return Difference(
            "rectangle", "a_v", "rig:published", f"spring:{p}", 0.01, "s/m", -0.1, 0.1, p, None, family, 0, None,
            "Welch t", "current", "", "",
        )  # fmt: skip

    rows = [*(row(p, "measured or published") for p in (0.03, 0.01, 0.02)), row(0.04, "models")]
    found = corrected(rows)
    assert [item.p_holm for item in found] == pytest.approx([0.04, 0.03, 0.04, 0.04], rel=1e-12)
    assert [item.tests for item in found] == [3, 3, 3, 1]
    assert all(item.significant for item in found)
    assert not corrected([row(0.03, "a"), row(0.5, "a"), row(0.6, "a")])[0].significant


def test_a_difference_that_is_significant_only_alone_cannot_be_told() -> None:
    """Printed 3.6 (sd 1.0) against 5.6 (sd 0.5), four sets each: p = 0.016 alone; as one of ten tests 0.16."""
    alone = evidence_of(1.0, 5.6, 0.5)
    (test,) = alone.differences
    assert test.p_value is not None
    assert 0.01 < test.p_value < 0.02
    assert TABLE_1["table1_a_v_rectangle_rig"](alone, "spring:paper").assessment == "disagrees"
    others = [replace(test, source_b=f"spring:{i}", p_value=0.9) for i in range(9)]
    among = replace(alone, differences=corrected([test, *others]))
    found = TABLE_1["table1_a_v_rectangle_rig"](among, "spring:paper")
    assert found.assessment == "cannot tell"
    assert "as one of 10 (Holm)" in found.note


def test_statements_are_judged_only_where_the_inputs_are_the_papers(copy: Any) -> None:
    """A faster belt: what the paper states of the belt is shown and not judged, with the input that differs; what it
    states of the rig is judged as before.
    """
    copy.write_study(lambda text: text.replace("speed_m_s: 16.7", "speed_m_s: 20.0"))
    copy.run_springs()
    rows = read_rows(copy.build() / "claims.csv", ClaimRow)
    own = {row.claim_id: row for row in rows if row.source in ("spring:paper", "study")}
    force = own["belt_normal_force"]
    assert (force.status, force.assessment) == ("not_applicable", "cannot tell")
    assert "speed 20, published 16.7 m/s" in force.note
    assert own["table1_a_v_rectangle_rig"].status == "current"
    assert own["belt_speed"].assessment == "disagrees"
    assert all(row.assessment == "cannot tell" for row in rows if row.status == "not_applicable")
