"""The report's drawn figures, as SVG files."""

from .draw import Drawings
from .style import Drawn, figure_items

__all__ = ["Drawings", "Drawn", "figure_items"]
