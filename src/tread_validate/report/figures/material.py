"""Moduli of the compound (the paper's Fig. 1) and friction coefficient (its Fig. 4)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from ...friction import law
from ...material import prony_series, surrogate_modulus
from ...material.compound import compound_route
from ...palette import BLACK, BLUE, GREEN, PURPLE, VERMILION
from ...study import Compound, FractionalZener, Friction
from ...units import MPA
from ..content import Mark
from .style import Drawn, draw

PRESSURES = (0.08 * MPA, 0.2 * MPA, 0.4 * MPA, 1.0 * MPA)


def moduli(folder: Path, name: str, compound: Compound, root: Path, marks: tuple[Mark, ...]) -> Drawn:
    """Draw storage and loss modulus against frequency, with the data where they are a law."""
    series, route = prony_series(compound, root), compound_route(compound, root)
    low, high = compound.fit.band_rad_s if hasattr(compound, "fit") else (0.25, 2500.0)
    w = np.geomspace(0.1 * low, 10.0 * high, 241)

    def paint(axes: Axes) -> None:
        if route is not None:
            curve = route.master
            axes.plot(
                curve.angular_frequency,
                curve.storage_modulus / MPA,
                "o",
                ms=2,
                color="#9aa3ab",
                label="data, shifted",
            )
            axes.plot(
                curve.angular_frequency,
                curve.loss_modulus / MPA,
                "o",
                ms=2,
                color="#9aa3ab",
                label="_loss modulus, shifted",
            )
        if isinstance(compound, FractionalZener):
            data = np.geomspace(low, high, 29)
            modulus = surrogate_modulus(compound, data)
            axes.plot(data, modulus.real / MPA, "o", ms=3.5, color=BLACK, mfc="none", label="E′, data")
            axes.plot(data, modulus.imag / MPA, "s", ms=3.5, color=BLACK, mfc="none", label="E″, data")
        axes.plot(w, series.storage_modulus(w) / MPA, color=BLUE, label="E′, Prony series")
        axes.plot(w, series.loss_modulus(w) / MPA, "--", color=VERMILION, label="E″, Prony series")
        axes.axvspan(low, high, color="#eef1f4", zorder=0)
        axes.set(xscale="log", yscale="log", xlabel="angular frequency, rad/s", ylabel="modulus, MPa")
        axes.set_title(f"at {compound.data_temperature_degC:g} °C", loc="left")
        axes.legend()

    title = f"Storage and loss modulus, compound {name}"
    caption = (
        f"As the paper's Fig. 1. Shaded: the band of the data, {low:g} to {high:g} rad/s at "
        f"{compound.data_temperature_degC:g} °C; outside it the series extrapolates. {series.moduli.size} of "
        f"its terms carry a modulus. Long-term modulus "
        f"{series.long_term_modulus / MPA:.3g} MPa, instantaneous {series.instantaneous_modulus / MPA:.3g} MPa."
    )
    return draw(folder, f"moduli-{name}", title, caption, paint, marks)


def friction(folder: Path, name: str, friction_law: Friction, root: Path, marks: tuple[Mark, ...]) -> Drawn:
    """Draw the kinetic coefficient against slip speed at several pressures."""
    rule = law(friction_law, root)
    data = friction_law.measurements(root)
    pressures = (
        PRESSURES if data is None else tuple(np.quantile(data.pressures, (0.0, 0.33, 0.67, 1.0), method="nearest"))
    )
    speed = np.geomspace(1e-4, 20.0, 241)

    def paint(axes: Axes) -> None:
        for pressure, color, style in zip(
            pressures, (GREEN, BLUE, BLACK, VERMILION), (":", "--", "-", "-."), strict=True
        ):
            values = rule.kinetic(np.full_like(speed, pressure), speed)
            axes.plot(speed, values, style, color=color, label=f"{pressure / MPA:.3g} MPa")
            if data is not None:
                near = data.pressures[data.pressure_level] == pressure
                axes.plot(
                    data.slip_speed[near],
                    data.coefficient[near],
                    "o",
                    ms=2.5,
                    color=color,
                    label=f"_measured, {pressure / MPA:.3g} MPa",
                )
        axes.axhline(rule.static_coefficient, color=PURPLE, lw=1.0)
        axes.text(1.1e-4, rule.static_coefficient, " static", color=PURPLE, va="bottom", fontsize=7.5)
        axes.set(xscale="log", xlabel="slip speed, m/s", ylabel="coefficient of friction", ylim=(0, None))
        axes.legend(title="pressure", title_fontsize=7.5)

    title = f"Friction coefficient, law {name}"
    caption = (
        f"As the paper's Fig. 4 and Eq. (5); kind: {friction_law.kind.replace('_', ' ')}. Below its least slip speed "
        "and least pressure the law is held constant."
    )
    return draw(folder, f"friction-{name}", title, caption, paint, marks)
