"""Which engines can run on this machine."""

from __future__ import annotations

import shlex
import shutil
from collections.abc import Mapping
from pathlib import Path

from ..errors import EngineError
from .abaqus import load_settings
from .fe_store import check_engine

PROGRAMS: Mapping[str, tuple[tuple[str, str], ...]] = {
    "embedded": (("gfortran", "apt-get install gfortran"),),
    "calculix": (("ccx", "apt-get install calculix-ccx"),),
}
"""Programs that an engine calls, and how they are installed on Debian."""


def require(engine: str, settings: Path | None = None) -> None:
    """Raise `EngineError`, before anything runs, where an engine's program is not on this machine."""
    check_engine(engine)
    if engine == "abaqus":
        program = shlex.split(load_settings(settings).command)[0]
        if shutil.which(program) is None:
            where = settings or "engines.yaml"
            raise EngineError(
                f"engine abaqus: no executable {program} here ({where}: abaqus.command); nothing was run: run the decks"
                " on a machine that has ABAQUS and bring the forces back with `tread-validate import-abaqus`"
            )
        return
    for program, remedy in PROGRAMS[engine]:
        if shutil.which(program) is None:
            raise EngineError(f"engine {engine}: no program {program} here; nothing was run ({remedy})")
