"""The regression coefficients of every source: printed ones from Table 1, computed ones from peaks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...reference import PublishedValue
from ...study import Case
from ...units import IN_MM
from ..runs import Runs
from ..tables import Coefficient
from .fit import Peak
from .line import EXCLUDED_INTERFERENCES, LEVEL, Regression, mean_interval, regress

PRINTED_SPEEDS = (150.0, 300.0, 600.0)  # rpm; the paper's other levels are not printed
ZERO_ASSUMED = "reference temperature of a_theta (assumed)"
SPEEDS_ASSUMED = "rig speeds between the printed ones (assumed)"


def published_coefficients(published: Mapping[str, PublishedValue]) -> tuple[Coefficient, ...]:
    """Return the eight cells of Table 1 as fractions; n and kind of spread as the table's caption says."""
    rows = []
    for shape in ("rectangle", "parallelogram"):
        for origin in ("rig", "fe"):
            for name, unit, n in (("a_v", "s/m", 4), ("a_theta", "1/degC", 2)):
                item = published.get(f"table1_{name}_{shape}_{origin}")
                if item is None or item.value is None or item.low is None or item.high is None:
                    continue
                low, high, note = interval(item)
                spread = (item.high - item.low) * (0.5 if name == "a_v" else 1.0)
                rows.append(
                    Coefficient(
                        f"{origin}:published", shape, name, "mean", 0.01 * item.value, unit, 0.01 * spread,
                        item.spread_kind, 0.01 * item.low, 0.01 * item.high, None if low is None else 0.01 * low,
                        None if high is None else 0.01 * high, LEVEL, n, "current", note,
                        ZERO_ASSUMED if name == "a_theta" else "",
                    )
                )  # fmt: skip
    return tuple(rows)


def interval(published: PublishedValue) -> tuple[float | None, float | None, str]:
    """Return the interval that a computed value is compared with, and a word on it."""
    low, high, value = published.low, published.high, published.value
    if published.section.endswith("Table 1") and value is not None and low is not None and high is not None:
        if published.spread_kind == "sd":
            ends = mean_interval(value, 0.5 * (high - low), 4)
            return *ends, "95 % interval of the published mean of 4"
        if published.spread_kind == "range":
            ends = mean_interval(value, (high - low) / 2.0**0.5, 2)
            return *ends, "95 % interval of the published mean of 2"
    return low, high, ""


def computed_regression(
    cases: Sequence[Case],
    runs: Runs,
    source: str,
    exclude: Sequence[float] = EXCLUDED_INTERFERENCES,
) -> Regression:
    """Regress a source's peaks over the rig cases of the study; a missing run shows as a set without a value."""
    peaks: list[Peak] = []
    rig = [case for case in cases if case.path.gives_coefficients]
    assumed = sorted({item for case in rig for item in case.assumed()} | {ZERO_ASSUMED})
    if any(not _printed(case.speed_rpm) for case in rig):
        assumed.append(SPEEDS_ASSUMED)
    for case in rig:
        run = runs.get((source, case.case_id))
        force = run.scalars.peak_normal_force if run is not None and run.scalars is not None else None
        peaks.append(peak_of(case, force))
    return regress(peaks, source=source, exclude=exclude, assumed="; ".join(assumed))


def peak_of(case: Case, force: float | None) -> Peak:
    """Return a case's peak with what it is regressed on."""
    return Peak(
        case.case_id,
        case.block.shape,
        case.temperature,
        round(IN_MM * case.interference, 9),
        round(case.speed, 9),
        force,
    )


def _printed(speed: float | None) -> bool:
    return speed is not None and any(abs(speed - printed) < 1e-6 for printed in PRINTED_SPEEDS)
