"""Section and material of a deck's block."""

from __future__ import annotations

from ..material import prony_series
from ..material.time_shift import told
from ..material.wlf import referred_to
from ..study import Case, Wlf
from ..units import DECK_DENSITY, DECK_STRESS, US
from .keywords import comment, keyword, number, table

EMBEDDED_HOURGLASS = ("STIFFNESS", "RELAX STIFFNESS")


def hourglass_note(kind: str) -> str:
    """Return what a user of an hourglass control that the embedded engine does not have must know."""
    return f"The embedded engine does not run HOURGLASS={kind} (it knows {', '.join(EMBEDDED_HOURGLASS)}); ABAQUS does"


def material(case: Case) -> list[str]:
    """Section and compound: instantaneous moduli, Prony series of one ratio for shear and bulk, time shift."""
    compound = case.compound
    series = prony_series(compound, case.root)
    ratios = series.moduli / series.instantaneous_modulus
    law = compound.time_shift
    if not isinstance(law, Wlf):  # no *TRS of its own: the times stand as they are at the run's temperature
        series = series.at_temperature(case.temperature, law)
    lines = [
        *_section(case),
        keyword("MATERIAL", NAME="COMPOUND"),
        keyword("DENSITY"),
        number(compound.density_kg_m3 * DECK_DENSITY) + ",",
        *_elasticity(compound.elasticity, series.instantaneous_modulus * DECK_STRESS, compound.poissons_ratio),
    ]
    if case.deck.stiffness_damping_us > 0.0:
        lines += [
            comment(
                "Loss above the band of the Prony series, without which sliding rubber flutters at mesh frequencies"
            ),
            keyword("DAMPING", BETA=number(case.deck.stiffness_damping_us * US)),
        ]
    if ratios.size:
        lines += [
            comment("g_i, k_i, tau_i: constant Poisson's ratio means one ratio for shear and bulk"),
            keyword("VISCOELASTIC", TIME="PRONY"),
            table([ratios, ratios, series.relaxation_times], ["%.10g", "%.10g", "%.9g"]),
        ]
        if isinstance(law, Wlf):
            c1, c2 = referred_to(law, series.reference_temperature)
            lines += [keyword("TRS"), f"{number(series.reference_temperature)}, {number(c1)}, {number(c2)}"]
        else:
            lines.append(comment(f"tau_i at {case.temperature:g} degC, shifted by {told(law)}; another temperature"))
            lines.append(comment("needs a deck of its own"))
    return lines


def _section(case: Case) -> list[str]:
    """Return the section; elements with eight integration points have no hourglass mode to control."""
    kind = case.deck.hourglass
    if case.deck.element == "C3D8":
        return [keyword("SOLID SECTION", ELSET="BLOCK", MATERIAL="COMPOUND"), ","]
    lines = [] if kind in EMBEDDED_HOURGLASS else [comment(hourglass_note(kind))]
    return [
        *lines,
        keyword("SECTION CONTROLS", NAME="BLOCK_CONTROLS", HOURGLASS=kind),
        keyword("SOLID SECTION", ELSET="BLOCK", MATERIAL="COMPOUND", CONTROLS="BLOCK_CONTROLS"),
        ",",
    ]


def _elasticity(kind: str, young: float, poisson: float) -> list[str]:
    """Return the instantaneous law: linear, or neo-Hookean with the same moduli (MPa) at no strain."""
    if kind == "linear":
        return [keyword("ELASTIC", MODULI="INSTANTANEOUS"), f"{number(young, 10)}, {number(poisson)}"]
    shear, bulk = young / (2.0 * (1.0 + poisson)), young / (3.0 * (1.0 - 2.0 * poisson))
    return [
        comment(f"C10 = G/2, D1 = 2/K: Young's modulus {number(young)} MPa, Poisson's ratio {number(poisson)}"),
        comment("at small strain; D1 = 0 would make ABAQUS/Explicit take K = 20 G"),
        keyword("HYPERELASTIC", "NEO HOOKE", MODULI="INSTANTANEOUS"),
        f"{number(0.5 * shear, 10)}, {number(2.0 / bulk, 10)}",
    ]
