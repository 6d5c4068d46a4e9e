"""From raw laboratory data to model input: sweeps to Prony series, ridge heights to belt path."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes

from ...geometry.trace import LevelledTrace
from ...material.route_result import MaterialRoute
from ...material.time_shift import told
from ...palette import BLACK, BLUE, GREEN, ORANGE, VERMILION
from ...units import MM, MPA
from ..content import Mark
from .style import Drawn, draw

COLORS = (BLUE, VERMILION, GREEN, ORANGE)
RAMP = colormaps["cividis"]  # for temperatures: even in lightness, told apart by every common colour vision


def sweeps(folder: Path, name: str, route: MaterialRoute, marks: tuple[Mark, ...]) -> Drawn:
    """Draw the storage moduli as measured, with the curve behind them, one colour a temperature."""

    def paint(axes: Axes) -> None:
        last = max(len(route.sweeps) - 1, 1)
        for index, sweep in enumerate(route.sweeps):
            color = RAMP(0.9 * index / last)
            w, modulus = sweep.angular_frequency, sweep.storage_modulus / MPA
            axes.plot(w, modulus, "o", ms=2.5, color=color, mfc="none", label=f"_measured, {sweep.temperature:.3g} °C")
            axes.plot(w, route.curve(index)[0] / MPA, color=color, lw=1.0, label=f"{sweep.temperature:.3g} °C")
            aside = route.set_aside(index)
            axes.plot(w[aside], modulus[aside], "x", ms=5, color=VERMILION, label="_set aside")
        axes.set(xscale="log", yscale="log", xlabel="angular frequency, rad/s", ylabel="storage modulus, MPa")
        axes.legend(ncols=2)

    caption = (
        "Points: as measured; lines: the series behind all sweeps; crosses: points set aside as outliers in E′ or E″."
    )
    return draw(folder, f"route-{name}-sweeps", f"Isothermal sweeps, compound {name}", caption, paint, marks)


def master(folder: Path, name: str, route: MaterialRoute, marks: tuple[Mark, ...]) -> Drawn:
    """Draw the shifted moduli with the Prony series that was fitted to them."""
    curve, series = route.master, route.fit.series
    w = np.geomspace(curve.angular_frequency.min(), curve.angular_frequency.max(), 241)

    def paint(axes: Axes) -> None:
        axes.plot(
            curve.angular_frequency, curve.storage_modulus / MPA, "o", ms=2, color="#9aa3ab", label="data, shifted"
        )
        axes.plot(
            curve.angular_frequency,
            curve.loss_modulus / MPA,
            "o",
            ms=2,
            color="#9aa3ab",
            label="_loss modulus, shifted",
        )
        axes.plot(w, series.storage_modulus(w) / MPA, color=BLUE, label="E′, Prony series")
        axes.plot(w, series.loss_modulus(w) / MPA, "--", color=VERMILION, label="E″, Prony series")
        axes.axvspan(*route.band, color="#eef1f4", zorder=0)
        axes.set(xscale="log", yscale="log", xlabel="reduced angular frequency, rad/s", ylabel="modulus, MPa")
        axes.legend()

    caption = (
        f"Shifted to {curve.reference_temperature:g} °C by {told(route.law).replace('degC', '°C')}. "
        "Shaded: the band of the fit."
    )
    return draw(folder, f"route-{name}-master", f"Master curve, compound {name}", caption, paint, marks)


def residuals(folder: Path, name: str, route: MaterialRoute, marks: tuple[Mark, ...]) -> Drawn:
    """Draw the relative residuals of the fit."""
    fit = route.fit

    def paint(axes: Axes) -> None:
        axes.plot(fit.angular_frequency, 100 * fit.storage_residual, "o", ms=2.5, color=BLUE, label="E′")
        axes.plot(fit.angular_frequency, 100 * fit.loss_residual, "s", ms=2.5, color=VERMILION, mfc="none", label="E″")
        axes.axhline(0.0, color="#57606a", lw=0.7)
        axes.set(xscale="log", xlabel="angular frequency, rad/s", ylabel="residual, % of the datum")
        axes.legend()

    caption = f"RMS {100 * fit.storage_rms:.2g} % in E′, {100 * fit.loss_rms:.2g} % in E″."
    return draw(
        folder, f"route-{name}-residuals", f"Residuals of the Prony fit, compound {name}", caption, paint, marks
    )


def ridges(folder: Path, name: str, traces: tuple[LevelledTrace, ...], marks: tuple[Mark, ...]) -> Drawn:
    """Draw measured ridge heights, tilt and offset removed, with their smoothed lines."""

    def paint(axes: Axes) -> None:
        for index, trace in enumerate(traces):
            color = COLORS[index % len(COLORS)]
            axes.plot(trace.measured_x / MM, trace.measured_height / MM, ".", ms=2.5, color=color, label="_measured")
            axes.plot(trace.x / MM, trace.height / MM, color=color, lw=1.0, label=trace.name.replace("_", " "))
        axes.set(xlabel="distance from the middle of the patch, mm", ylabel="height over the flat patch, mm")
        axes.legend()

    caption = "Points: measured heights, tilt and offset removed; lines: smoothed, flat in the patch."
    return draw(folder, f"route-{name}-ridges", f"Ridge heights, path {name.replace('_', ' ')}", caption, paint, marks)


def ridge_curvature(folder: Path, name: str, trace: LevelledTrace, marks: tuple[Mark, ...]) -> Drawn:
    """Draw the curvature of one ridge as measured and smoothed, with the points set aside."""

    def paint(axes: Axes) -> None:
        axes.plot(
            trace.measured_x / MM, trace.measured_curvature, ".", ms=2.5, color="#9aa3ab", label="three measured points"
        )
        axes.plot(trace.x / MM, trace.curvature, color=BLUE, label="smoothed line")
        for index, spike in enumerate(trace.spikes):
            axes.axvline(spike / MM, color=VERMILION, lw=0.8, ls=":", label="spike set aside" if index == 0 else None)
        for edge in trace.edges:
            axes.axvline(edge / MM, color=BLACK, lw=0.6, ls="--")
        axes.set(xlabel="distance from the middle of the patch, mm", ylabel="curvature, 1/m")
        axes.set_ylim(-4.0, 9.0)
        axes.legend()

    length, radius = trace.patch_length, trace.edge_radius
    caption = (
        f"Dashed: the patch's edges. Patch length {length.value / MM:.1f} ± {length.half_width / MM:.1f} mm, radius "
        f"at its edges {radius.value:.2f} ± {radius.half_width:.2f} m (95 %). Points beyond the scale are not shown."
    )
    title = f"Curvature of ridge {trace.name.replace('_', ' ')}"
    return draw(folder, f"route-{name}-curvature", title, caption, paint, marks)
