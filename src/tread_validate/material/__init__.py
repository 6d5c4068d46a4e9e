"""The compound: dynamic mechanical analysis, time-temperature shift and Prony series."""

from .compound import fit_surrogate, prony_series, surrogate_modulus
from .fit import PronyFit, fit_prony
from .prony import PronySeries
from .wlf import log_shift_factor, pole, referred_to, relative_shift, shift_factor
from .zener import fractional_zener

__all__ = [
    "PronyFit", "PronySeries", "fit_prony", "fit_surrogate", "fractional_zener", "log_shift_factor", "pole",
    "prony_series", "referred_to", "relative_shift", "shift_factor", "surrogate_modulus",
]  # fmt: skip
