"""Plan shape of a block, the path that its mount follows and the road that it meets."""

from .belt_file import read_belt_trace
from .block import WidthProfile, block_profile
from .columns import Columns
from .line import ArcFlatArc, MountLine, TabulatedLine, WheelLine
from .measured import line_from_trace
from .path import MountMotion, Path
from .path_entry import FAMILIES, Conditions, Family, PathEntry, Ridge, Sketch, path_of
from .paths import ENTRIES, AnyPath
from .paths.flat_track import FlatTrack
from .paths.measured_belt import MeasuredBelt
from .paths.rig import Rig
from .paths.simplified_belt import SimplifiedBelt
from .road import Road
from .tread_block import Block, Sipe

__all__ = [
    "ENTRIES", "FAMILIES", "AnyPath", "ArcFlatArc", "Block", "Columns", "Conditions", "Family", "FlatTrack",
    "MeasuredBelt", "MountLine", "MountMotion", "Path", "PathEntry", "Ridge", "Rig", "Road", "SimplifiedBelt", "Sipe",
    "Sketch", "TabulatedLine", "WheelLine", "WidthProfile", "block_profile", "line_from_trace", "path_of",
    "read_belt_trace",
]  # fmt: skip
