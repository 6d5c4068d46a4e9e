"""What is to be run: a study file, its models and its cases."""

from .case import Case, conditions_digest, with_mesh
from .load import LoadedStudy, load_study, load_yaml
from .models import (
    Block,
    Compound,
    Coulomb,
    DeckSettings,
    FitSettings,
    FractionalZener,
    Friction,
    FrictionTable,
    Huemer,
    HuemerFile,
    MeasuredBelt,
    PronyCompound,
    PronyFile,
    PronyTerm,
    Rig,
    SimplifiedBelt,
    Sipe,
    SpringSettings,
    Study,
    SweepFile,
    Wheel,
    Wlf,
)

__all__ = [
    "Block", "Case", "Compound", "Coulomb", "DeckSettings", "FitSettings", "FractionalZener", "Friction",
    "FrictionTable", "Huemer", "HuemerFile", "LoadedStudy", "MeasuredBelt", "PronyCompound", "PronyFile", "PronyTerm",
    "Rig", "SimplifiedBelt", "Sipe", "SpringSettings", "Study", "SweepFile", "Wheel", "Wlf", "conditions_digest",
    "load_study", "load_yaml", "with_mesh",
]  # fmt: skip
