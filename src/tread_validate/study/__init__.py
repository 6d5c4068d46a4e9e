"""What is to be run: a study file, its models and its cases."""

from ..friction import Coulomb, Friction, FrictionTable, Huemer, HuemerFile, Power
from ..geometry import Block, FlatTrack, MeasuredBelt, PathEntry, Rig, SimplifiedBelt, Sipe
from ..yaml_text import load_yaml
from .case import Case, conditions_digest, problems_digest, with_mesh
from .compound import (
    Compound,
    FitSettings,
    FractionalZener,
    LibraryCompound,
    PronyCompound,
    PronyFile,
    PronyTerm,
    SpringPot,
    SpringPots,
    SweepFile,
)
from .document import Study
from .load import LoadedStudy, load_study
from .settings import DeckSettings, SpringSettings, ToleranceEntry
from .shift import ArrheniusShift, ShiftTable, TimeShift, Wlf

__all__ = [
    "ArrheniusShift", "Block", "Case", "Compound", "Coulomb", "DeckSettings", "FitSettings", "FlatTrack",
    "FractionalZener", "Friction", "FrictionTable", "Huemer", "HuemerFile", "LibraryCompound", "LoadedStudy",
    "MeasuredBelt", "PathEntry", "Power", "PronyCompound", "PronyFile", "PronyTerm", "Rig", "ShiftTable",
    "SimplifiedBelt", "Sipe", "SpringPot", "SpringPots", "SpringSettings", "Study", "SweepFile", "TimeShift",
    "ToleranceEntry", "Wlf", "conditions_digest", "load_study", "load_yaml", "problems_digest", "with_mesh",
]  # fmt: skip
