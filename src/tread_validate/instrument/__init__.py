"""Tables as instruments export them: text of any encoding, spreadsheets; columns known by name and unit."""

from .cells import CellBlock, read_blocks
from .quantities import Measurand
from .recognise import Reading, Recognised, recognise

__all__ = ["CellBlock", "Measurand", "Reading", "Recognised", "read_blocks", "recognise"]
