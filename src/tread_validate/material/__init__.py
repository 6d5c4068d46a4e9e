"""The compound: dynamic mechanical analysis, time-temperature shift and Prony series."""

from .abaqus_card import abaqus_card
from .compound import compound_route, fit_surrogate, prony_series, surrogate_modulus
from .fit import PronyFit, fit_prony
from .material_file import MaterialFile, material_schema, read_material
from .prony import PronySeries
from .route import material_route, read_route
from .route_result import MaterialRoute, RouteSettings
from .time_shift import relative_shift
from .wlf import log_shift_factor, pole, referred_to, shift_factor
from .zener import fractional_zener

__all__ = [
    "MaterialFile", "MaterialRoute", "PronyFit", "PronySeries", "RouteSettings", "abaqus_card", "compound_route",
    "fit_prony", "fit_surrogate", "fractional_zener", "log_shift_factor", "material_route", "material_schema", "pole",
    "prony_series", "read_material", "read_route", "referred_to", "relative_shift", "shift_factor", "surrogate_modulus",
]  # fmt: skip
