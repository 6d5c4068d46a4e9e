"""The material file: a Prony series with its quality, as `tread-validate fit-prony` writes it and a study reads it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field

from ..errors import InputError, one_line
from ..model_file import read_model
from ..study import PronyCompound, Wlf
from ..units import MPA
from .prony import PronySeries
from .wlf import relative_shift

SAME_SHIFT = 0.01  # relative: a study's WLF constants may differ from the file's by this much over 40 K


class MaterialFile(PronyCompound):
    """A study's ``prony`` compound with the quality of its fit."""

    quality: dict[str, float | int | bool | str] = Field(default_factory=dict, description="figures of the fit")
    provenance: dict[str, str] = Field(default_factory=dict, description="input digest, version, settings")

    def series(self) -> PronySeries:
        """Return the series at the file's data temperature."""
        terms = sorted(self.terms, key=lambda term: term.relaxation_time_s)
        return PronySeries(
            self.long_term_modulus_MPa * MPA,
            np.array([term.modulus_MPa * MPA for term in terms]),
            np.array([term.relaxation_time_s for term in terms]),
            self.data_temperature_degC,
        )

    def series_at(self, temperature: float, wlf: Wlf, where: str = "material file") -> PronySeries:
        """Return the series at `temperature` in degC, shifted by the study's `wlf`.

        Raises `InputError` where the study's constants shift otherwise than those that the data were shifted by.
        """
        there = np.array([self.data_temperature_degC - 20.0, self.data_temperature_degC + 20.0])
        try:
            of_file = relative_shift(there, self.data_temperature_degC, self.wlf)
            of_study = relative_shift(there, self.data_temperature_degC, wlf)
        except InputError:
            of_file = of_study = np.ones(2)
        if np.any(np.abs(np.log(of_study / of_file)) > SAME_SHIFT):
            c = self.wlf
            raise InputError(
                f"{where}: wlf",
                f"C1 {wlf.c1:g}, C2 {wlf.c2_K:g} K at {wlf.reference_temperature_degC:g} degC in the study",
                f"the constants that the data were shifted by: C1 {c.c1:g}, C2 {c.c2_K:g} K at "
                f"{c.reference_temperature_degC:g} degC",
            )
        return self.series().at_temperature(temperature, wlf)


def material_schema() -> dict[str, Any]:
    """Return the JSON schema of a material file."""
    return MaterialFile.model_json_schema()


def read_material(path: Path | str) -> MaterialFile:
    """Read a material file; raises `InputError` with the key that is wrong."""
    return read_model(path, MaterialFile)


def material_yaml(
    series: PronySeries,
    wlf: Wlf,
    origin: str,
    source: str,
    quality: Mapping[str, float | int | bool | str],
    provenance: Mapping[str, str],
    poissons_ratio: float = 0.47,
    density: float = 1000.0,
) -> str:
    """Return the text of a material file; terms without a modulus are left out, numbers have 7 digits."""
    lines = [
        "# Prony series of a compound; name this file in a study as `kind: prony_file`.",
        "kind: prony",
        f"origin: {origin}",
        f"source: {_quoted(source)}",
        f"poissons_ratio: {poissons_ratio:g}",
        f"density_kg_m3: {density:g}",
        f"data_temperature_degC: {series.reference_temperature:g}",
        f"wlf: {{c1: {wlf.c1:.7g}, c2_K: {wlf.c2_K:.7g}, "
        f"reference_temperature_degC: {wlf.reference_temperature_degC:g}}}",
        f"long_term_modulus_MPa: {series.long_term_modulus / MPA:.7g}",
        "terms:",
    ]
    least = 1e-9 * series.instantaneous_modulus
    for modulus, time in zip(series.moduli, series.relaxation_times, strict=True):
        if modulus > least:
            lines.append(f"  - {{modulus_MPa: {modulus / MPA:.7g}, relaxation_time_s: {_exponent(time)}}}")
    for name, table in (("quality", quality), ("provenance", provenance)):
        lines.append(f"{name}:" if table else f"{name}: {{}}")
        lines += [f"  {key}: {_scalar(value)}" for key, value in table.items()]
    return "\n".join(lines) + "\n"


def _exponent(value: float) -> str:
    """Return a number that YAML 1.1 reads as one (a mantissa with a point, a signed exponent)."""
    return f"{value:.6e}"


def _scalar(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value}" if isinstance(value, int | float) else _quoted(one_line(str(value), 290))


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"
