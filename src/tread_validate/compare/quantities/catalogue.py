"""Every quantity, a row each: a new scalar is a row here and a test.

The tolerances are this workbench's own, and a study may choose others: the paper prints none for the spring model. Ten
per cent is what the paper reports for the linear material model (section 2.3) and for its better FE comparison (18 and
10 %); everything else follows from it. The models are deterministic and their histories are written to 10 uN: a noise
is what another processor may do, not what a change may.
"""

from __future__ import annotations

from . import values as of
from .quantity import FORCE_TOLERANCE, HistoryMetric, Noise, Quantity

RELATIVE = 5e-6
PAPER = "10 % is what the paper reports for its linear material and for the better of its FE comparisons"
SMALL_FORCE = 2.0  # N
SMALL = f"as the peak normal force; {SMALL_FORCE:g} N is a hundredth of the paper's belt force"
CLOCK = "half of what the forces are allowed"
SHAPE = "as the forces"
GOOD = "the standard's grade `good`"

SCALARS = (
    Quantity("peak_normal_force", "N", "Peak normal force", "N_max", of.peak_normal, of.as_force,
             Noise(RELATIVE, 5e-5), "itself", FORCE_TOLERANCE, PAPER),
    Quantity("peak_positive_tangential_force", "N", "Peak longitudinal force, leading edge", "T_max", of.peak_positive,
             of.as_force, Noise(RELATIVE, 5e-4), "itself", FORCE_TOLERANCE, SMALL, floor=SMALL_FORCE,
             needs="tangential"),
    Quantity("peak_negative_tangential_force", "N", "Peak longitudinal force, trailing edge", "T_min", of.peak_negative,
             of.as_force, Noise(RELATIVE, 5e-4), "itself", FORCE_TOLERANCE, SMALL, floor=SMALL_FORCE,
             needs="tangential"),
    Quantity("normal_impulse", "N s", "Normal impulse", "J_N", of.normal_impulse, of.as_force,
             Noise(RELATIVE, 1e-7), "itself", FORCE_TOLERANCE, PAPER),
    Quantity("net_tangential_impulse", "N s", "Net longitudinal impulse", "J_T", of.net_tangential_impulse,
             of.as_difference, Noise(RELATIVE, 2e-6), "normal_impulse", 0.02,
             "a fifth of what the forces are allowed: it is a small difference of two large impulses",
             needs="tangential"),
    Quantity("contact_duration", "s", "Contact duration", "t_c", of.duration, of.untouched,
             Noise(RELATIVE, 1e-8), "itself", 0.05, CLOCK),
    Quantity("time_of_peak_normal_force", "s", "Time of normal peak", "t_max", of.time_of_peak, of.untouched,
             Noise(0.0, 2e-5), "contact_duration", 0.05, CLOCK),
    Quantity("tangential_to_normal_ratio", "1", "Peak ratio |T|/N", "|T|_max/N_max", of.peak_ratio, of.as_force,
             Noise(RELATIVE, 5e-6), "itself", FORCE_TOLERANCE,
             "as the forces; below 0.2 what that is at 0.2", floor=0.02, needs="tangential"),
    Quantity("late_sign_change", "1", "T changes sign again at exit", "", of.late_sign_change, of.untouched,
             Noise(0.0, 0.5), "one", 0.5, "it does or it does not", needs="tangential", flag=True),
    Quantity("slipping_share", "1", "Sliding area fraction", "", of.slipping_share, of.not_known,
             Noise(0.0, 2e-3), "one", 0.10, "as the forces", needs="slip", measured=False),
)  # fmt: skip
SCALAR = {quantity.name: quantity for quantity in SCALARS}

HISTORIES = {"normal_force": "Normal force history", "tangential_force": "Longitudinal force history"}

SCORE, ISO = Noise(0.0, 2e-4), Noise(0.0, 2e-3)

# sensitivities of ISO/TS 18571, x the difference and e the error sums over the reference: corridor
# 2 (1 + x)/(0.5 - 0.05) at x = 0.05, magnitude 2 (1 + e) at e = 0.5, slope (1 + e)/2 at e = 2, weighted 0.4, 0.2, 0.2;
# phase does not depend on amplitude.
HISTORY_METRICS = (
    HistoryMetric("relative_rms", "relative RMS error", "relative", FORCE_TOLERANCE, SHAPE, 1.0, SCORE, SMALL_FORCE),
    HistoryMetric("sprague_geers_m", "Sprague-Geers magnitude M", "relative", FORCE_TOLERANCE, SHAPE, 1.0, SCORE),
    HistoryMetric("sprague_geers_p", "Sprague-Geers phase P", "relative", 0.05, CLOCK, 0.0, SCORE),
    HistoryMetric("sprague_geers_c", "Sprague-Geers combined C", "relative", FORCE_TOLERANCE, SHAPE, 1.0, SCORE),
    HistoryMetric(
        "iso18571_r", "ISO/TS 18571 score R", "score", 0.20, GOOD, 0.4 * 2.1 / 0.45 + 0.2 * 3.0 + 0.2 * 1.5, ISO
    ),
    HistoryMetric("iso18571_corridor", "ISO/TS 18571 corridor", "score", 0.20, GOOD, 2.1 / 0.45, ISO),
    HistoryMetric("iso18571_phase", "ISO/TS 18571 phase", "score", 0.20, GOOD, 0.0, ISO),
    HistoryMetric("iso18571_magnitude", "ISO/TS 18571 magnitude", "score", 0.20, GOOD, 3.0, ISO),
    HistoryMetric("iso18571_slope", "ISO/TS 18571 slope", "score", 0.20, GOOD, 1.5, ISO),
)
HISTORY_METRIC = {metric.name: metric for metric in HISTORY_METRICS}

# what is shown first of every model, as (quantity, metric)
HEADLINE = (
    ("peak_normal_force", "scalar"),
    ("peak_positive_tangential_force", "scalar"),
    ("peak_negative_tangential_force", "scalar"),
    ("normal_impulse", "scalar"),
    ("contact_duration", "scalar"),
    ("normal_force", "relative_rms"),
    ("tangential_force", "relative_rms"),
    ("normal_force", "sprague_geers_c"),
    ("tangential_force", "sprague_geers_c"),
    ("normal_force", "iso18571_r"),
    ("tangential_force", "iso18571_r"),
)
