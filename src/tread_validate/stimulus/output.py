"""The stimulus as files: time signal, spectrum, response, one summary row."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import one_line
from ..files import write_text
from ..units import IN_MS
from .response import Response
from .stimulus import Stimulus, amplitude

SUMMARY_COLUMNS = (
    "model",
    "rib",
    "revolution_frequency_Hz",
    "block_passing_frequency_Hz",
    "mean_normal_force_N",
    "normal_impulse_times_rate_N",
    "mean_tangential_force_N",
    "tangential_impulse_times_rate_N",
    "largest_normal_line_N",
    "largest_normal_line_Hz",
    "largest_tangential_line_N",
    "largest_tangential_line_Hz",
)


def force_csv(stimulus: Stimulus) -> str:
    """Return the time signal of one revolution."""
    rows = zip(stimulus.time, stimulus.normal_force, stimulus.tangential_force, strict=True)
    body = "".join(f"{t:.9f},{n:.5f},{f:.5f}\n" for t, n, f in rows)
    return _head(stimulus.provenance) + "time_s,normal_force_N,tangential_force_N\n" + _no_minus_zero(body)


def spectrum_csv(stimulus: Stimulus) -> str:
    """Return the lines: peak amplitude, phase of the cosine at t = 0, and which block-passing harmonic it is."""
    normal, tangential = amplitude(stimulus.normal_lines), amplitude(stimulus.tangential_lines)
    marks = stimulus.block_passing()
    body = "".join(
        f"{order},{frequency:.6f},{normal[order]:.6e},{_phase(stimulus.normal_lines, order, normal):.6f},"
        f"{tangential[order]:.6e},{_phase(stimulus.tangential_lines, order, tangential):.6f},{marks[order]}\n"
        for order, frequency in enumerate(stimulus.frequency)
    )
    return (
        _head(stimulus.provenance)
        + "order,frequency_Hz,normal_amplitude_N,normal_phase_rad,tangential_amplitude_N,tangential_phase_rad,"
        + "block_passing\n"
        + body
    )


def response_csv(stimulus: Stimulus, response: Response) -> str:
    """Return the response over one revolution."""
    notes = {
        **stimulus.provenance,
        "quantity": response.quantity,
        "unit": response.unit,
        "lines_from_Hz": f"{response.lowest_frequency:g}",
        "lines_to_Hz": f"{response.highest_frequency:g}",
    }
    body = "".join(f"{t:.9f},{v:.9e}\n" for t, v in zip(response.time, response.value, strict=True))
    return _head(notes) + "time_s,response\n" + body


def summary_rows(stimulus: Stimulus) -> list[dict[str, str | float]]:
    """Return one row per rib; the lines and means are those of the whole tyre."""
    normal, tangential = amplitude(stimulus.normal_lines), amplitude(stimulus.tangential_lines)
    n = 1 + int(np.argmax(normal[1:])) if normal.size > 1 else 0
    t = 1 + int(np.argmax(tangential[1:])) if tangential.size > 1 else 0
    rates = [sum(stimulus.impulses[rib][axis] for rib in stimulus.impulses) / stimulus.period for axis in (0, 1)]
    return [
        {
            "model": stimulus.label,
            "rib": rib,
            "revolution_frequency_Hz": 1.0 / stimulus.period,
            "block_passing_frequency_Hz": rate,
            "mean_normal_force_N": stimulus.mean_normal_force,
            "normal_impulse_times_rate_N": rates[0],
            "mean_tangential_force_N": stimulus.mean_tangential_force,
            "tangential_impulse_times_rate_N": rates[1],
            "largest_normal_line_N": float(normal[n]),
            "largest_normal_line_Hz": float(stimulus.frequency[n]),
            "largest_tangential_line_N": float(tangential[t]),
            "largest_tangential_line_Hz": float(stimulus.frequency[t]),
        }
        for rib, rate in stimulus.block_rates.items()
    ]


def write(stimulus: Stimulus, response: Response | None, folder: Path) -> None:
    """Write ``force.csv``, ``spectrum.csv`` and, where there is one, ``response.csv``."""
    write_text(folder / "force.csv", force_csv(stimulus))
    write_text(folder / "spectrum.csv", spectrum_csv(stimulus))
    if response is not None:
        write_text(folder / "response.csv", response_csv(stimulus, response))


def write_summary(stimuli: Iterable[Stimulus], path: Path) -> None:
    """Write the summary of all models."""
    lines = [",".join(SUMMARY_COLUMNS)]
    for stimulus in stimuli:
        for row in summary_rows(stimulus):
            lines.append(
                ",".join(f"{v:.9g}" if isinstance(v, float) else v for v in (row[name] for name in SUMMARY_COLUMNS))
            )
    write_text(path, "\n".join(lines) + "\n")


def draw(stimuli: list[Stimulus], path: Path, assumed: str = "") -> None:
    """Draw the time signals of one revolution's first part and the spectra, block-passing frequencies marked."""
    from ..palette import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
    from ..plotting import canvas, note, save, styled

    colours = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)
    with styled():
        figure = canvas((11, 6.2))
        axes = figure.subplots(2, 2)
        shown = min(stimuli[0].period, 12.0 / max(stimuli[0].block_rates.values()))
        for index, stimulus in enumerate(stimuli):
            colour = colours[index % len(colours)]
            part = stimulus.time <= shown
            forces = (stimulus.normal_force, stimulus.tangential_force)
            lines = (amplitude(stimulus.normal_lines), amplitude(stimulus.tangential_lines))
            for row in (0, 1):
                axes[row, 0].plot(
                    stimulus.time[part] * IN_MS, forces[row][part], color=colour, label=stimulus.label, lw=1.2
                )
                offset = (index - 0.5 * (len(stimuli) - 1)) * 0.27 / stimulus.period
                axes[row, 1].vlines(stimulus.frequency[1:] + offset, 0, lines[row][1:], color=colour, lw=1.1)
        for row, name in enumerate(("normal force, N", "longitudinal force, N")):
            axes[row, 0].set(xlabel="time, ms", ylabel=name)
            axes[row, 1].set(xlabel="frequency, Hz", ylabel=f"{name} (peak)", ylim=(0, None))
            axes[row, 1].set_xlim(0, stimuli[0].frequency[-1])
            _mark(axes[row, 1], stimuli[0])
        axes[0, 0].legend()
        axes[0, 1].set_title("dotted: block-passing frequency and its harmonics", loc="left")
        if assumed:
            note(figure, one_line("depends on " + assumed, 150))
        save(figure, path)


def _mark(axis: object, stimulus: Stimulus) -> None:
    for rate in sorted(set(stimulus.block_rates.values())):
        for harmonic in range(1, int(stimulus.frequency[-1] / rate) + 1):
            axis.axvline(harmonic * rate, color="#888888", lw=0.8, ls=":", zorder=0)  # type: ignore[attr-defined]  # matplotlib's Axes


def _phase(lines: NDArray[np.complex128], order: int, size: NDArray[np.float64]) -> float:
    """Return the phase, 0 where the line is rounding only (so that the file does not depend on the machine)."""
    return float(np.angle(lines[order])) if size[order] > 1e-9 * max(float(size.max()), 1e-300) else 0.0


def _head(notes: Mapping[str, str]) -> str:
    return "".join(f"# {one_line(key)}: {one_line(value)}\n" for key, value in notes.items())


def _no_minus_zero(text: str) -> str:
    return text.replace("-0.00000,", "0.00000,").replace("-0.00000\n", "0.00000\n")
