"""The search for free rolling, on impulses whose root is known."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.spring.creep import root_of


class Rolling:
    """A pass whose impulse is a given function of the creep ratio; counts how often it runs."""

    creep_tolerance = 2e-6

    def __init__(self, impulse):
        self.impulse, self.runs = impulse, 0

    def net_shear_impulse(self, creep_ratio):
        self.runs += 1
        return self.impulse(creep_ratio)


@settings(deadline=None)
@given(root=st.floats(-0.19, 0.19), stiffness=st.floats(0.1, 1e4))
def test_a_face_that_sticks_rolls_freely_where_its_line_of_impulse_crosses_zero(root, stiffness):
    assert root_of(Rolling(lambda creep: stiffness * (creep - root)), "line") == pytest.approx(root, abs=2e-8)


@pytest.mark.parametrize("root", [0.0011, 0.0031, -0.004])
def test_a_face_that_slips_a_little_takes_five_passes(root):
    block_pass = Rolling(lambda creep: (creep - root) * (1.0 - 20.0 * (creep - root)))
    assert root_of(block_pass, "curve") == pytest.approx(root, abs=1e-8)
    assert block_pass.runs <= 5


@settings(deadline=None)
@given(
    root=st.floats(-0.15, 0.15), before=st.floats(0.1, 10.0), after=st.floats(0.1, 10.0), kink=st.floats(-0.01, 0.01)
)
def test_a_kink_where_slip_begins_costs_no_sharpness(root, before, after, kink):
    """The impulse is steeper on one side of the kink; the tolerance is one of creep, times the ratio of slopes."""

    def impulse(creep):
        at = creep - root
        return (before if at < kink else after) * (at - kink) + (before if kink > 0.0 else after) * kink

    assert root_of(Rolling(impulse), "kink") == pytest.approx(root, abs=2e-6 * max(before / after, after / before))
