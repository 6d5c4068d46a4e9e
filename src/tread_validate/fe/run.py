"""Run a deck from its files."""

from __future__ import annotations

import platform
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba

from ..errors import InputError
from ..files import read_text
from ..inp import problem_of
from ..inp.symmetry import is_half
from ..provenance import commit, sha256_text, version
from ..source_code import code_digest
from ..units import IN_US
from .axes import Axes
from .explicit import Simulation
from .frames import FrameWriter
from .model import Model, read_model
from .result import FeResult, collect
from .user_friction import compile_vfric

ENGINE = "embedded"
STRAIN_MEASURE = (
    "rate form, strain increments in the frame rotated by the polar decomposition (Green-Naghdi), logarithmic strain "
    "where the principal axes do not turn"
)


def run_deck(
    inp: Path | str,
    user: Path | str | None = None,
    *,
    threads: int = 1,
    frames: Path | str | None = None,
    progress: Callable[[float, float], None] | None = None,
    normal: str | None = None,
    travel: str | None = None,
) -> FeResult:
    """Run a deck of the documented subset in explicit dynamics.

    Parameters
    ----------
    inp : path
        The deck, in mm, tonne, s, MPa, N.
    user : path, optional
        Fixed-form Fortran with VFRIC, needed where the deck has ``*FRICTION, USER``.
    threads : int
        The answer does not depend on it.
    frames : path, optional
        Folder for ``.vtu`` frames with displacement, stress and contact pressure.
    progress : callable, optional
        Called with the share done (0..1) and the seconds left.

    normal, travel : str, optional
        ``+x`` .. ``-z``: out of the road, and the way the block goes. By default the axis nearest to the road's normal
        forces, and +x (+y on a road that faces x).

    Returns
    -------
    FeResult
        Of the last step, on its own clock.

    Raises
    ------
    InputError
        A deck outside the subset, or a routine that returns a force out of range.
    EngineError
        No gfortran, a routine that does not compile, or a run that broke down.
    """
    if threads < 1:
        raise InputError("threads", threads, "1 or more")
    if (normal is None) != (travel is None):
        raise InputError("normal and travel", "one of them", "both or neither")
    axes = Axes(normal, travel) if normal is not None and travel is not None else None
    source = Path(inp)
    model = read_model(source)
    user_text = read_text(user) if user is not None else None
    routine = None
    if model.user_friction is not None:
        if user is None:
            raise InputError(model.user_friction.where, "*FRICTION, USER and no user routine", "--user vfric.f")
        routine = compile_vfric(user)
    begun = time.monotonic()
    simulation = Simulation(model, routine, threads)
    if frames is not None:
        simulation.observer = FrameWriter(simulation, Path(frames))
    simulation.run(progress)
    wall = time.monotonic() - begun
    record = _record(source, model, simulation, user_text, threads, wall)
    provenance = {
        "case_id": source.stem,
        "producer": f"tread-validate fe ({ENGINE})",
        "version": version(),
        "commit": commit(),
        "engine": ENGINE,
        "code": record["code"],
        "deck_sha256": record["deck_sha256"],
        "deck_digest": record["deck_digest"],
    }
    return collect(simulation, record, provenance, axes)


def _record(
    source: Path, model: Model, simulation: Simulation, user_text: str | None, threads: int, wall: float
) -> dict[str, Any]:
    elements = int(model.mesh.element_labels.size)
    used = user_text if model.needs_user_routine or user_text is not None else None
    return {
        "case_id": source.stem,
        "engine": ENGINE,
        "version": version(),
        "commit": commit(),
        "code": code_digest("fe"),
        "deck_digest": problem_of(model.deck, used).digest,
        "deck_sha256": sha256_text(model.deck.text),
        "user_sha256": sha256_text(used) if used is not None else None,
        "elements": elements,
        "nodes": int(model.mesh.node_labels.size),
        "increments": simulation.increments,
        "increment_s": {"smallest": float(simulation.smallest), "largest": float(simulation.largest)},
        "prony_terms": {
            "deck": max((int(s.material.prony.shape[0]) for s in model.sections), default=0),
            "recursions": simulation.blocks.terms,
        },
        "strain_measure": STRAIN_MEASURE,
        "symmetry": "half, forces and energies doubled" if is_half(model.deck) else "full",
        "hourglass": sorted({section.hourglass for section in model.sections}),
        "threads": threads,
        "wall_time_s": round(wall, 3),
        "us_per_element_step": round(simulation.kernel_seconds / simulation.increments / elements * IN_US, 4),
        "python": platform.python_version(),
        "numba": numba.__version__,
    }
