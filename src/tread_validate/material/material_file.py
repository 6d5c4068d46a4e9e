"""The material file: a Prony series with its quality, as `tread-validate fit-prony` writes it and a study reads it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field

from ..errors import InputError, one_line
from ..model_file import read_model
from ..study import PronyCompound, ShiftTable, TimeShift, Wlf
from ..units import MPA
from .prony import PronySeries
from .time_shift import LN_10, log_relative_shift, told

SAME_SHIFT = 0.01  # relative: a study's shift may differ from the file's by this much over 40 K
REACH = np.linspace(-20.0, 20.0, 9).tolist()  # K, where the two are compared
FEWEST = 3


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

    def series_at(self, temperature: float, law: TimeShift, where: str = "material file") -> PronySeries:
        """Return the series at `temperature` in degC, shifted by the study's `law`.

        Raises `InputError` where the study shifts otherwise than the data were shifted.
        """
        if not self._same_shift(law):
            raise InputError(
                f"{where}: wlf or shift",
                f"{told(law)} in the study",
                f"the law that the data were shifted by: {told(self.time_shift)}",
            )
        return self.series().at_temperature(temperature, law)

    def _same_shift(self, law: TimeShift) -> bool:
        """Whether two laws agree to 1 % within 20 K of the data's temperature, where both have a meaning."""
        own, apart = self.time_shift, []
        for offset in REACH:
            there = self.data_temperature_degC + offset
            try:
                pair = [float(log_relative_shift(there, self.data_temperature_degC, one)) for one in (own, law)]
            except InputError:
                continue
            apart.append(abs(pair[1] - pair[0]) * LN_10)
        return law == own or (len(apart) >= FEWEST and max(apart) <= SAME_SHIFT)


def material_schema() -> dict[str, Any]:
    """Return the JSON schema of a material file."""
    return MaterialFile.model_json_schema()


def read_material(path: Path | str) -> MaterialFile:
    """Read a material file; raises `InputError` with the key that is wrong."""
    return read_model(path, MaterialFile)


def material_yaml(
    series: PronySeries,
    law: TimeShift,
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
        *_shift_lines(law),
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


def _shift_lines(law: TimeShift) -> list[str]:
    if isinstance(law, Wlf):
        ts = law.reference_temperature_degC
        return [f"wlf: {{c1: {law.c1:.7g}, c2_K: {law.c2_K:.7g}, reference_temperature_degC: {ts:g}}}"]
    if isinstance(law, ShiftTable):
        rows = [f"    - [{temperature:.7g}, {log:.7g}]" for temperature, log in law.points]
        return ["shift:", "  kind: table", "  points:", *rows]
    return [f"shift: {{kind: arrhenius, activation_energy_kJ_mol: {law.activation_energy_kJ_mol:.7g}}}"]


def _exponent(value: float) -> str:
    """Return a number that YAML 1.1 reads as one (a mantissa with a point, a signed exponent)."""
    return f"{value:.6e}"


def _scalar(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value}" if isinstance(value, int | float) else _quoted(one_line(str(value), 290))


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"
