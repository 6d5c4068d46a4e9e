"""The peak force with the secant modulus at the run's strain, beside the linear one."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..material import prony_series
from ..material.strain_sweep import StrainSweep
from ..study import Case, PronyCompound, PronyTerm
from ..units import MM, MPA
from .run import run


@dataclass(frozen=True)
class StrainEffect:
    """One case: strain, modulus over that of the linear compound, and both peak normal forces, N."""

    case_id: str
    strain: float
    factor: float
    linear_force: float
    secant_force: float

    @property
    def change(self) -> float:
        """Peak force with the secant modulus over the linear one, less 1."""
        return self.secant_force / self.linear_force - 1.0


def strain_effect(case: Case, sweep: StrainSweep, linear_strain: float) -> StrainEffect:
    """Run the paper's spring with the compound as it is, and scaled to the secant modulus at the run's strain.

    Raises `InputError` where the sweep does not reach the strain of the run or `linear_strain`.
    """
    strain = case.interference / (case.block.height_mm * MM)
    factor = sweep.secant_factor(strain, linear_strain)
    forces = [float(run(one).normal_force.max()) for one in (case, replace(case, compound=_scaled(case, factor)))]
    return StrainEffect(case.case_id, strain, factor, forces[0], forces[1])


def _scaled(case: Case, factor: float) -> PronyCompound:
    series = prony_series(case.compound, case.root)
    return PronyCompound(
        kind="prony",
        origin=case.compound.origin,
        source=case.compound.source,
        poissons_ratio=case.compound.poissons_ratio,
        density_kg_m3=case.compound.density_kg_m3,
        **case.compound.shift_keys(),
        data_temperature_degC=series.reference_temperature,
        long_term_modulus_MPa=factor * series.long_term_modulus / MPA,
        terms=tuple(
            PronyTerm(modulus_MPa=factor * modulus / MPA, relaxation_time_s=time)
            for modulus, time in zip(series.moduli.tolist(), series.relaxation_times.tolist(), strict=True)
        ),
    )
