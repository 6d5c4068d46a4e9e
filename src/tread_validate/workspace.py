"""Where a study's decks, results and reports lie: in folders of its own, by its name."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from .errors import InputError
from .files import read_text, write_text

BINDING = "study.txt"


@dataclass(frozen=True)
class Workspace:
    """The folders of the study of one name.

    Attributes
    ----------
    name : str
        The study's ``name``.
    root : path
        The folder that holds ``fe_inputs``, ``results`` and ``reports``.
    """

    name: str
    root: Path = Path()

    @property
    def decks(self) -> Path:
        """Generated decks, ``<case_id>/<case_id>.inp``."""
        return self.root / "fe_inputs" / self.name

    @property
    def results(self) -> Path:
        """Histories and tables."""
        return self.root / "results" / self.name

    @property
    def spring(self) -> Path:
        """Histories of the spring model, ``<variant>/<case_id>.csv``."""
        return self.results / "spring"

    @property
    def tables(self) -> Path:
        """Tables of the comparison."""
        return self.results / "tables"

    @property
    def hierarchy(self) -> Path:
        """Tables of the model hierarchy."""
        return self.results / "hierarchy"

    @property
    def reports(self) -> Path:
        """Page and PDF."""
        return self.root / "reports" / self.name

    @property
    def baseline(self) -> Path:
        """The accepted baseline."""
        return self.reports / "baseline"


def bind(results: Path, study: Path) -> None:
    """Remember which study file a results folder belongs to.

    Raises
    ------
    InputError
        The folder belongs to another study file, which is still there: two studies have one name.
    """
    file = results / BINDING
    here = Path(os.path.relpath(study)).as_posix()
    if file.is_file():
        bound = read_text(file).strip()
        if Path(bound).is_file() and not Path(bound).samefile(study):
            raise InputError(
                f"{study}: name", f"{results.name}, the name of {bound}", f"a name of its own (or `rm -r {results}`)"
            )
        if bound == here:
            return
    write_text(file, f"{here}\n")


def only_tables(root: Path = Path()) -> Path:
    """Return the tables of the only study that has results; raises `InputError` where there are none or several."""
    found = sorted(path.parent for path in (root / "results").glob("*/tables/errors.csv"))
    if len(found) != 1:
        names = ", ".join(str(path) for path in found) or "none"
        raise InputError("tables", names, "one folder of tables: name it")
    return found[0]
