"""The friction file: Huemer's constants with their intervals, as `tread-validate fit-friction` writes it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import Field

from ..errors import one_line
from ..model_file import read_model
from ..units import KPA, MM
from .huemer_form import FITTED
from .laws.huemer import Huemer

if TYPE_CHECKING:
    from .fit import FrictionFit


class FrictionFile(Huemer):
    """A study's ``huemer`` law with the quality of its fit."""

    intervals_95: dict[str, tuple[float, float]] = Field(default_factory=dict, description="of each constant")
    held: dict[str, float] = Field(default_factory=dict, description="constants that were not fitted")
    warnings: tuple[str, ...] = Field((), description="what the table could not determine")
    quality: dict[str, float | int | str | None] = Field(default_factory=dict)
    provenance: dict[str, str] = Field(default_factory=dict)


def friction_schema() -> dict[str, Any]:
    """Return the JSON schema of a friction file."""
    return FrictionFile.model_json_schema()


def read_friction(path: Path | str) -> FrictionFile:
    """Read a friction file; raises `InputError` with the key that is wrong."""
    return read_model(path, FrictionFile)


def quality(fit: FrictionFit) -> dict[str, float | int | str | None]:
    """Return the figures that tell how good the law is, by name with unit."""
    data = fit.data
    return {
        "rows": int(data.coefficient.size),
        "pressures": int(data.pressures.size),
        "slip_speeds": int(data.speeds.size),
        "lowest_pressure_Pa": float(f"{data.pressures[0]:.6g}"),
        "highest_pressure_Pa": float(f"{data.pressures[-1]:.6g}"),
        "lowest_slip_speed_m_s": float(f"{data.speeds[0]:.6g}"),
        "highest_slip_speed_m_s": float(f"{data.speeds[-1]:.6g}"),
        "rms_residual": round(fit.rms, 6),
        "largest_residual": round(float(abs(fit.residual).max()), 6),
        "repeatability": None if fit.repeatability is None else round(fit.repeatability, 6),
        "lack_of_fit_probability": None if fit.lack_of_fit is None else float(f"{fit.lack_of_fit:.3g}"),
    }


def friction_yaml(fit: FrictionFit, origin: str, source: str, provenance: Mapping[str, str]) -> str:
    """Return the text of a friction file."""
    constants = fit.law.constants
    lines = [
        "# Friction law of Huemer et al.; name this file in a study as `kind: huemer_file`.",
        "# p in MPa, v in m/s; scaled so that a + b + c = 1.",
        "kind: huemer",
        f"origin: {origin}",
        f"source: {_quoted(source)}",
        f"static_coefficient: {fit.law.static_coefficient:g}",
        *(f"{name}: {constants[name]:.8g}" for name in FITTED),
        f"least_pressure_kPa: {constants['least_pressure'] / KPA:g}",
        f"least_slip_speed_mm_s: {constants['least_slip_speed'] / MM:g}",
        "intervals_95:",
        *(f"  {name}: [{low:.6g}, {high:.6g}]" for name, (low, high) in fit.intervals.items()),
        "held: {" + ", ".join(f"{name}: {value:g}" for name, value in fit.held.items()) + "}",
        "warnings: []" if not fit.warnings else "warnings:",
        *(f"  - {_quoted(text)}" for text in fit.warnings),
        "quality:",
        *(f"  {name}: {'null' if value is None else value}" for name, value in quality(fit).items()),
        "provenance:" if provenance else "provenance: {}",
        *(f"  {key}: {_quoted(one_line(value, 290))}" for key, value in provenance.items()),
    ]
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"
