"""The case as data: everything a model in any language needs to compute one pass, in SI, as one JSON file."""

from .build import case_file
from .document import CaseFile
from .io import case_schema, read_case, write_case

__all__ = ["CaseFile", "case_file", "case_schema", "read_case", "write_case"]
