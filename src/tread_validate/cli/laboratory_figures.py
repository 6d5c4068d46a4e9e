"""Pictures of the laboratory imports: what came in, what was made of it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from .. import plotting
from ..friction import FrictionFit
from ..geometry.trace import LevelledTrace
from ..material import MaterialRoute
from ..palette import BLACK, BLUE, GREEN, PURPLE, SKY, VERMILION
from ..plotting import canvas, styled
from ..reference.rig_passes import RigPasses
from ..units import IN_MS, IN_UM, KPA, MM, MPA

GREY = "#8c959f"
COLOURS = (BLUE, VERMILION, GREEN, PURPLE, BLACK, "#b07d00", SKY, GREY)


def save(path: Path | str, size: tuple[float, float], paint: Callable[[Figure], None]) -> None:
    """Draw with the package's look and write a PNG (or what the ending says), atomically."""
    with styled():
        figure = canvas(size)
        paint(figure)
        plotting.save(figure, path)


def material(route: MaterialRoute, figure: Figure, mark: str = "") -> None:
    """Draw sweeps, master curve with fit and bands, residuals, and relaxation spectrum."""
    axes = figure.subplots(2, 2)
    raw, shifted, residual, spectrum = axes.ravel()
    for k, sweep in enumerate(route.sweeps):
        color = COLOURS[k % len(COLOURS)]
        hertz = sweep.angular_frequency / (2 * np.pi)
        raw.plot(hertz, sweep.storage_modulus / MPA, "o", ms=3, color=color)
        raw.plot(hertz, sweep.loss_modulus / MPA, "s", ms=3, mfc="none", color=color)
        raw.plot(hertz, route.curve(k)[0] / MPA, "-", color=color, lw=1, label=f"{sweep.temperature:.1f} °C")
        raw.plot(hertz, route.curve(k)[1] / MPA, "--", color=color, lw=1)
    raw.set(xscale="log", yscale="log", xlabel="frequency, Hz", ylabel="modulus, MPa")
    raw.set_title("Sweeps: E′ (filled), E″ (open), the curve behind", loc="left")
    raw.legend(ncols=2, fontsize=6.5)
    m, series = route.master, route.fit.series
    w = np.geomspace(m.angular_frequency[0], m.angular_frequency[-1], 200)
    good = ~route.outlier
    for values, marker, name in ((m.storage_modulus, "o", "E′"), (m.loss_modulus, "s", "E″")):
        shifted.plot(m.angular_frequency[good], values[good] / MPA, marker, ms=2.5, color=GREY, mfc="none")
        shifted.plot(m.angular_frequency[~good], values[~good] / MPA, "x", ms=4, color=VERMILION)
        curve = series.storage_modulus(w) if name == "E′" else series.loss_modulus(w)
        color = BLUE if name == "E′" else VERMILION
        shifted.plot(w, curve / MPA, "-" if name == "E′" else "--", color=color, label=f"{name}, Prony series")
    if route.bands is not None:
        b = route.bands
        for band, color in ((b.storage_modulus, BLUE), (b.loss_modulus, VERMILION)):
            shifted.fill_between(b.angular_frequency, band.lower / MPA, band.upper / MPA, color=color, alpha=0.2, lw=0)
    shifted.axvspan(*route.band, color="#eef1f4", zorder=0)
    shifted.set(xscale="log", yscale="log", xlabel="reduced angular frequency, rad/s", ylabel="modulus, MPa")
    shifted.set_title(f"Master curve at {m.reference_temperature:g} °C{mark}", loc="left")
    shifted.legend()
    f = route.fit
    residual.plot(f.angular_frequency, 100 * f.storage_residual, "o", ms=2.5, color=BLUE, label="E′")
    residual.plot(f.angular_frequency, 100 * f.loss_residual, "s", ms=2.5, mfc="none", color=VERMILION, label="E″")
    if route.bands is not None:
        b = route.bands
        for band, color in ((b.storage_modulus, BLUE), (b.loss_modulus, VERMILION)):
            low, high = band.lower / band.centre - 1.0, band.upper / band.centre - 1.0
            residual.fill_between(b.angular_frequency, 100 * low, 100 * high, color=color, alpha=0.12, lw=0)
    residual.axhline(0.0, color=BLACK, lw=0.7)
    residual.set(xscale="log", xlabel="reduced angular frequency, rad/s", ylabel="fit less data, %")
    residual.set_title(f"RMS: E′ {100 * f.storage_rms:.2f} %, E″ {100 * f.loss_rms:.2f} %; 95 % bands", loc="left")
    residual.legend()
    carry = series.moduli > 1e-9 * series.instantaneous_modulus
    times, moduli = series.relaxation_times[carry], series.moduli[carry] / MPA
    spectrum.vlines(times, 0.0, moduli, color=BLUE)
    spectrum.plot(times, moduli, "o", ms=3, color=BLUE)
    if route.bands is not None and route.bands.moduli.shape[0] == carry.size:
        low, high = route.bands.moduli[carry].T / MPA
        spectrum.vlines(times * 1.12, low, high, color=GREY, lw=1, label="95 % of resamples")
        spectrum.legend(loc="center right")
    spectrum.margins(y=0.12)
    spectrum.axhline(series.long_term_modulus / MPA, color=BLACK, lw=0.8, ls=":")
    spectrum.set(xscale="log", xlabel="relaxation time, s", ylabel="modulus of the term, MPa", ylim=(0, None))
    spectrum.set_title(f"{int(carry.sum())} terms; dotted: long-term modulus", loc="left")


def friction(fit: FrictionFit, figure: Figure, mark: str = "") -> None:
    """Draw data and law against slip speed, one colour a pressure, and the residuals."""
    law, residual = figure.subplots(1, 2)
    data = fit.data
    speed = np.geomspace(data.speeds[0] / 3.0, data.speeds[-1] * 3.0, 200)
    for k, pressure in enumerate(data.pressures):
        color, rows = COLOURS[k % len(COLOURS)], data.pressure_level == k
        law.plot(data.slip_speed[rows], data.coefficient[rows], "o", ms=3, mfc="none", color=color)
        law.plot(speed, fit.law.kinetic(pressure, speed), color=color, label=f"{pressure / KPA:.4g} kPa")
        residual.plot(data.slip_speed[rows], fit.residual[rows], "o", ms=3, color=color)
    law.set(xscale="log", xlabel="slip speed, m/s", ylabel="kinetic friction coefficient", ylim=(0, None))
    law.set_title(f"Tribometer data and Huemer's law{mark}", loc="left")
    law.legend()
    residual.axhline(0.0, color=BLACK, lw=0.7)
    residual.set(xscale="log", xlabel="slip speed, m/s", ylabel="data less law")
    residual.set_title(f"RMS {fit.rms:.4f}", loc="left")


def belt(traces: tuple[LevelledTrace, ...], figure: Figure, mark: str = "") -> None:
    """Draw levelled heights, curvature as measured and smoothed, and the patch edge close up."""
    height, curvature, edge = figure.subplots(1, 3)
    for k, trace in enumerate(traces):
        color = COLOURS[k % len(COLOURS)]
        height.plot(trace.measured_x / MM, trace.measured_height / MM, ".", ms=2, color=color)
        height.plot(trace.x / MM, trace.height / MM, color=color, lw=1, label=trace.name.replace("_", " "))
    height.set(xlabel="x, mm", ylabel="height above the patch, mm")
    height.set_title(f"Levelled traces{mark}", loc="left")
    height.legend()
    chosen = next((trace for trace in traces if trace.name == "mid_top"), traces[0])
    curvature.plot(chosen.measured_x / MM, chosen.measured_curvature, ".", ms=3, color=GREY, label="three points")
    curvature.plot(chosen.x / MM, chosen.curvature, color=BLUE, label="smoothed")
    for spike in chosen.spikes:
        curvature.axvline(spike / MM, color=VERMILION, lw=0.8, ls=":")
    curvature.set(xlabel="x, mm", ylabel="curvature, 1/m", ylim=(-8, 14))
    curvature.set_title(f"{chosen.name.replace('_', ' ')}; dotted: spike set aside", loc="left")
    curvature.legend()
    near = np.abs(chosen.measured_x - chosen.edges[1]) < 0.025
    edge.plot(chosen.measured_x[near] / MM, chosen.measured_height[near] * IN_UM, "o", ms=3, color=GREY, mfc="none")
    near = np.abs(chosen.x - chosen.edges[1]) < 0.025
    edge.plot(chosen.x[near] / MM, chosen.height[near] * IN_UM, color=BLUE)
    edge.axvline(chosen.edges[1] / MM, color=BLACK, lw=0.8)
    edge.set(xlabel="x, mm", ylabel="height, µm")
    length, radius = chosen.patch_length, chosen.edge_radius
    edge.set_title(
        f"trailing edge; l = {length.value / MM:.1f} ± {length.half_width / MM:.1f} mm,\n"
        f"R_d = {radius.value:.2f} ± {radius.half_width:.2f} m",
        loc="left",
    )


def rig(passes: RigPasses, figure: Figure, mark: str = "") -> None:
    """Draw the mean pass with its range, and the peaks of the passes."""
    normal, tangential, peaks = figure.subplots(1, 3, width_ratios=(2, 2, 1))
    ms = IN_MS
    normal.plot(passes.raw_time * ms, passes.raw_normal_force, ".", ms=1.5, color=GREY, label="first pass as recorded")
    for axes, forces, color, name in (
        (normal, passes.normal_force, BLUE, "normal"),
        (tangential, passes.tangential_force, VERMILION, "tangential"),
    ):
        axes.fill_between(passes.time * ms, forces.min(0), forces.max(0), color=color, alpha=0.3, lw=0, label="range")
        axes.plot(passes.time * ms, forces.mean(0), color=color, label=f"mean of {passes.count} passes")
        axes.set(xlabel="time from first contact, ms", ylabel=f"{name} force, N")
        axes.legend(loc="center" if axes is normal else "upper right")
    normal.set_title(f"{passes.speed_rpm:.1f} rpm, low-pass {passes.cutoff:g} Hz{mark}", loc="left")
    values = passes.normal_force.max(axis=1)
    spread = passes.peak_normal_force
    peaks.plot(np.zeros(values.size), values, "o", mfc="none", color=GREY, ms=4)
    below, above = spread.mean - spread.least, spread.largest - spread.mean
    peaks.errorbar([0.3], [spread.mean], yerr=[[below], [above]], fmt="s", color=BLUE, capsize=4)
    peaks.set(xlim=(-0.4, 0.7), xticks=[], ylabel="peak normal force, N", ylim=(0, 1.15 * spread.largest))
    peaks.set_title("passes; mean, min, max", loc="left")


def rig_peaks(rows: list[dict[str, Any]], figure: Figure, mark: str = "") -> None:
    """Draw peak normal force against speed, one line a set of shape, temperature and interference; least to largest."""
    axes = figure.subplots()
    sets = dict.fromkeys((row["shape"], row["temperature_degC"], row["interference_mm"]) for row in rows)
    for k, key in enumerate(sets):
        members = [row for row in rows if (row["shape"], row["temperature_degC"], row["interference_mm"]) == key]
        speed, mean, least, largest = (
            np.array([float(row[name]) for row in members])
            for name in ("speed_m_s", "peak_normal_force_N", "peak_normal_force_min_N", "peak_normal_force_max_N")
        )
        label = f"{key[0]}, {key[1]} °C, {key[2]} mm"
        axes.errorbar(
            speed,
            mean,
            yerr=[mean - least, largest - mean],
            fmt="o-",
            capsize=3,
            ms=4,
            label=label,
            color=COLOURS[k % 8],
        )
    axes.set(xlabel="surface speed, m/s", ylabel="peak normal force, N", ylim=(0, None))
    axes.set_title(f"Mean, least and largest pass{mark}", loc="left")
    axes.legend()
