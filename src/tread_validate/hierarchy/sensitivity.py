"""Sobol indices of peak forces and creep over the inputs that the study had to assume.

Spring passes are cheap enough for thousands of samples. The compound is varied where its Prony series can be
scaled without a new fit: level, strength of the viscoelastic part, rate at which it relaxes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..friction import FORMS
from ..spring.block_pass import BlockPass, prepare
from ..spring.creep import root_of
from ..study import Case
from ..units import MM
from .tables import SobolIndex

Array = NDArray[np.float64]


@dataclass(frozen=True)
class UncertainInput:
    """An input and its range, uniform; logarithmic for a rate.

    Attributes
    ----------
    apply : callable
        (case, pass, value) -> (case, pass).
    """

    name: str
    low: float
    high: float
    unit: str
    apply: Callable[[Case, float], Case] | None = None
    scale: Callable[[BlockPass, float], BlockPass] | None = None


def _modulus(block_pass: BlockPass, factor: float) -> BlockPass:
    rubber = block_pass.rubber
    scaled = rubber._replace(
        long_term_modulus=factor * rubber.long_term_modulus, moduli=np.ascontiguousarray(factor * rubber.moduli)
    )
    return replace(block_pass, rubber=scaled)


def _strength(block_pass: BlockPass, factor: float) -> BlockPass:
    rubber = block_pass.rubber
    return replace(block_pass, rubber=rubber._replace(moduli=np.ascontiguousarray(factor * rubber.moduli)))


def _rate(block_pass: BlockPass, log_factor: float) -> BlockPass:
    rubber = block_pass.rubber
    times = np.ascontiguousarray(rubber.relaxation_times * 10.0**-log_factor)
    return replace(block_pass, rubber=rubber._replace(relaxation_times=times))


def _friction(block_pass: BlockPass, factor: float) -> BlockPass:
    law = block_pass.law
    form = next(form for form in FORMS.values() if form.code == law.code)
    parameters = law.parameters.copy()
    parameters[: form.proportional] *= factor
    table = np.ascontiguousarray(factor * law.table)
    return replace(block_pass, law=law._replace(parameters=parameters, table=table))


def _static(block_pass: BlockPass, value: float) -> BlockPass:
    return replace(block_pass, law=block_pass.law._replace(static_coefficient=value))


def _path(**names: str) -> Callable[[Case, float], Case]:
    (key,) = names.values()

    def apply(case: Case, value: float) -> Case:
        return replace(case, path=case.path.model_copy(update={key: value}))

    return apply


def _interference(case: Case, value: float) -> Case:
    return replace(case, interference=value * MM)


def _skew(case: Case, value: float) -> Case:
    return replace(case, block=case.block.model_copy(update={"skew_deg": value}))


def _temperature(case: Case, offset: float) -> Case:
    return replace(case, temperature=case.temperature + offset)


COMPOUND = (
    UncertainInput("modulus level", 0.8, 1.2, "of the surrogate's", scale=_modulus),
    UncertainInput("viscoelastic strength", 0.7, 1.3, "of the surrogate's", scale=_strength),
    UncertainInput("relaxation rate", -0.5, 0.5, "decades", scale=_rate),
)
LAW = (
    UncertainInput("kinetic friction", 0.8, 1.2, "of the law's", scale=_friction),
    UncertainInput("static friction", 0.7, 1.1, "1", scale=_static),
)


def factors_of(case: Case) -> tuple[UncertainInput, ...]:
    """Return the assumed inputs of a case and their ranges."""
    depth = case.interference / MM
    common = (
        *COMPOUND,
        *LAW,
        UncertainInput("interference", 0.95 * depth, 1.05 * depth, "mm", _interference),
        UncertainInput("temperature of the rubber", -5.0, 5.0, "degC from the nominal", _temperature),
    )
    path = [
        UncertainInput(item.label, item.low, item.high, item.unit, _path(key=item.key)) for item in case.path.uncertain
    ]
    skew = (UncertainInput("skew angle", 20.0, 40.0, "deg", _skew),) if case.block.shape == "parallelogram" else ()
    return (*common, *path, *skew)


@dataclass(frozen=True)
class OutputQuantity:
    """An output of a pass."""

    name: str
    unit: str


FORCES = (
    OutputQuantity("peak normal force", "N"),
    OutputQuantity("peak longitudinal force, leading edge", "N"),
    OutputQuantity("peak longitudinal force, trailing edge", "N"),
)
CREEP = OutputQuantity("free-rolling creep", "1")


def sobol_rows(case: Case, samples: int = 256, with_creep: bool = True, seed: int = 2010) -> list[dict[str, Any]]:
    """Return first-order and total indices, with 95 % intervals, of a case's forces (and creep on a belt).

    `samples` is the base sample N, a power of two; the number of passes is N (inputs + 2). The scheme is that of
    Saltelli et al., Comput. Phys. Commun. 181 (2010) 259-270, doi:10.1016/j.cpc.2009.09.018. The rows' columns are
    those of `SobolIndex`.
    """
    from SALib.analyze import sobol
    from SALib.sample import sobol as sampler

    factors = factors_of(case)
    problem = {
        "num_vars": len(factors),
        "names": [factor.name for factor in factors],
        "bounds": [[factor.low, factor.high] for factor in factors],
    }
    inputs = sampler.sample(problem, samples, calc_second_order=False, seed=seed)
    # on the rig the springs have hardly any longitudinal force: what they have is no finding
    quantities = FORCES[:1] if not case.path.pulls else (*FORCES, CREEP) if with_creep else FORCES
    outputs = evaluate(case, factors, inputs, CREEP in quantities)
    rows = []
    for column, quantity in enumerate(quantities):
        values = outputs[:, column]
        spread = float(values.std(ddof=1))
        if spread <= 1e-9 * max(abs(float(values.mean())), 1e-9):
            continue
        indices = sobol.analyze(problem, values, calc_second_order=False, seed=seed, num_resamples=200)
        low, high = np.percentile(values, [5.0, 95.0])
        for k, factor in enumerate(factors):
            entries = (
                case.case_id, quantity.name, quantity.unit, factor.name, factor.low, factor.high, factor.unit,
                float(indices["S1"][k]), float(indices["S1_conf"][k]), float(indices["ST"][k]),
                float(indices["ST_conf"][k]), float(values.mean()), spread, float(low), float(high),
                int(values.size), "; ".join(case.assumed()),
            )  # fmt: skip
            rows.append(dict(zip(SobolIndex.header(), entries, strict=True)))
    return rows


def evaluate(case: Case, factors: Sequence[UncertainInput], inputs: Array, with_creep: bool) -> Array:
    """Return the outputs of a pass for each row of `inputs` (n, factors), (n, 3 or 4)."""
    base = prepare(case)
    out = np.empty((inputs.shape[0], 4 if with_creep else 3))
    for i, row in enumerate(inputs):
        block_pass = _varied(case, base, factors, row)
        creep = root_of(block_pass, case.case_id) if with_creep else float("nan")
        fixed = case.creep_ratio if case.creep_ratio is not None else creep
        forces = block_pass.forces(fixed)
        out[i, 0] = forces[:, 0].max()
        out[i, 1] = max(float(-forces[:, 1].min()), 0.0)
        out[i, 2] = -max(float(forces[:, 1].max()), 0.0)
        if with_creep:
            out[i, 3] = creep
    return out


def _varied(case: Case, base: BlockPass, factors: Sequence[UncertainInput], row: Array) -> BlockPass:
    """Return the pass with the inputs of one sample; the Prony fit is not done again."""
    varied = case
    for factor, value in zip(factors, row, strict=True):
        if factor.apply is not None:
            varied = factor.apply(varied, float(value))
    block_pass = prepare(varied) if varied is not case else base
    for factor, value in zip(factors, row, strict=True):
        if factor.scale is not None:
            block_pass = factor.scale(block_pass, float(value))
    return block_pass
