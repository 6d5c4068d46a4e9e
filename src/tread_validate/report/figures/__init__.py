"""The report's drawn figures, as SVG and PNG files."""

from .studio import Studio
from .style import Drawn

__all__ = ["Drawn", "Studio"]
