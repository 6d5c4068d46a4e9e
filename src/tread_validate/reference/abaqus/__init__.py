"""Forces from ABAQUS: running it where there is a licence, and bringing its results from elsewhere."""

from .importer import Imported, Options, file_history, import_history
from .runner import EXTRACTION_SCRIPT, AbaqusSettings, load_settings, run_abaqus
from .tables import AbaqusTable, read_table

__all__ = [
    "EXTRACTION_SCRIPT",
    "AbaqusSettings",
    "AbaqusTable",
    "Imported",
    "Options",
    "file_history",
    "import_history",
    "load_settings",
    "read_table",
    "run_abaqus",
]
