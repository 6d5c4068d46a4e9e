"""The ABAQUS material card of a Prony series."""

from __future__ import annotations

from ..study import TimeShift, Wlf
from ..units import DECK_DENSITY, DECK_STRESS
from .prony import PronySeries
from .time_shift import told
from .wlf import referred_to


def abaqus_card(
    series: PronySeries,
    law: TimeShift,
    name: str = "TREAD",
    poissons_ratio: float = 0.47,
    density: float = 1000.0,
) -> str:
    """Return ``*MATERIAL`` with ``*ELASTIC`` (instantaneous), ``*VISCOELASTIC`` and ``*TRS`` in mm, tonne, s, MPa.

    Poisson's ratio is constant, so g_i = k_i = E_i/E_0. WLF constants are referred to the series' temperature; another
    law has no ``*TRS``,
    and the card holds at that temperature alone.
    Density in kg/m3.
    """
    instantaneous = series.instantaneous_modulus
    lines = [
        "** units: mm, tonne, s, MPa, N, degC",
        f"*MATERIAL, NAME={name}",
        "*DENSITY",
        f" {density * DECK_DENSITY:.6E},",
        "*ELASTIC, MODULI=INSTANTANEOUS",
        f" {instantaneous * DECK_STRESS:.7g}, {poissons_ratio:.6g}",
        "*VISCOELASTIC, TIME=PRONY",
    ]
    for modulus, time in zip(series.moduli, series.relaxation_times, strict=True):
        if modulus > 1e-9 * instantaneous:
            ratio = modulus / instantaneous
            lines.append(f" {ratio:.8f}, {ratio:.8f}, {time:.6E}")
    if isinstance(law, Wlf):
        c1, c2 = referred_to(law, series.reference_temperature)
        lines += ["*TRS, DEFINITION=WLF", f" {series.reference_temperature:.6g}, {c1:.6g}, {c2:.6g}"]
    else:
        lines += [f"** times at {series.reference_temperature:.6g} degC only: shifted by {told(law)}"]
    return "\n".join(lines) + "\n"
