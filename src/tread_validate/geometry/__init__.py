"""Plan shape of a block, the path that its mount follows and the road that it meets."""

from .belt import belt_path
from .belt_file import read_belt_trace
from .block import WidthProfile, block_profile
from .columns import Columns
from .line import ArcFlatArc, MountLine, TabulatedLine, WheelLine
from .measured import line_from_trace
from .path import MountMotion, Path, path_of
from .rig import rig_path
from .road import Road

__all__ = [
    "ArcFlatArc", "Columns", "MountLine", "MountMotion", "Path", "Road", "TabulatedLine", "WheelLine", "WidthProfile",
    "belt_path", "block_profile", "line_from_trace", "path_of", "read_belt_trace", "rig_path",
]  # fmt: skip
