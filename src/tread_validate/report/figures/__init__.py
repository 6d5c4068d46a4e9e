"""The report's drawn figures, as SVG files."""

from .studio import Studio
from .style import Drawn, figure_items

__all__ = ["Drawn", "Studio", "figure_items"]
