"""Forces from ABAQUS: running it where there is a licence, and bringing its results from elsewhere."""

from .importer import Imported, Options, file_history, import_history
from .runner import EXTRACTION_SCRIPT, Settings, load_settings, run_abaqus
from .tables import Table, read_table

__all__ = [
    "EXTRACTION_SCRIPT",
    "Imported",
    "Options",
    "Settings",
    "Table",
    "file_history",
    "import_history",
    "load_settings",
    "read_table",
    "run_abaqus",
]
