"""From a case to the text of its deck."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path as FilePath

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..errors import InputError
from ..files import atomic_path, write_text
from ..friction import law
from ..geometry import Path, TabulatedLine, path_of
from ..study import Case
from ..units import DECK_LENGTH, DECK_UNITS
from . import sections
from .keywords import comment
from .mesh import BlockMesh, block_mesh
from .placement import LEAD_IN, MountTable, Placement, mount_tables, place_on_belt, place_on_wheel
from .vfric import user_friction

MARGIN = 1.05  # of the pass over the time of geometrical contact: sheared rubber lets go a little later


@dataclass(frozen=True)
class WrittenDeck:
    """The files of one run.

    Attributes
    ----------
    case_id : str
    input_text : str
        The ABAQUS/Explicit deck with the user friction routine.
    constant_friction_text : str or None
        The same deck with built-in Coulomb friction (the law's `constant_coefficient`); None where not asked for.
    user_text : str
        Fortran source of VFRIC.
    points : (n, 3) array, mm
        Node positions at the start.
    elements : (m, 8) array of int
        Node indices from 0.
    lead_in, pass_time : float, s
        Durations of the two steps; contact begins with the second.
    """

    case_id: str
    input_text: str
    constant_friction_text: str | None
    user_text: str
    points: NDArray[np.float64]
    elements: NDArray[np.int64]
    lead_in: float
    pass_time: float


def build(case: Case) -> WrittenDeck:
    """Return the deck of a case; the same case gives the same bytes.

    Raises `InputError` for a case whose free-rolling creep has not been resolved, and whatever its material, friction
    law or path raise.
    """
    if case.creep_ratio is None:
        raise InputError(f"case {case.case_id}: creep_ratio", "none (free rolling)", "the creep ratio of free rolling")
    path = path_of(case)
    mesh = block_mesh(case.block, case.deck)
    pass_time = math.ceil(path.contact_duration * MARGIN / 1e-5) * 1e-5
    friction = law(case.friction, case.root)
    user = user_friction(friction, sections.face_mass(case, mesh))
    motion, placement, tables = _motion(case, mesh, path, pass_time)
    before = [
        *_opening(case),
        *sections.mesh(mesh, placement.points),
        *sections.material(case),
        *sections.road(path, case.creep_ratio, placement.points, pass_time),
        *motion,
    ]
    after = [
        *sections.initial_conditions(case, mesh, path, placement.velocities),
        *sections.fixed_supports(case),
        *sections.steps(case, path, pass_time, tables),
    ]
    constant = None
    if case.deck.constant_friction_variant:
        constant = _join([*before, *sections.constant_friction(friction.constant_coefficient), *after])
    return WrittenDeck(
        case_id=case.case_id,
        input_text=_join([*before, *sections.user_friction(user.properties), *after]),
        constant_friction_text=constant,
        user_text=user.source,
        points=placement.points,
        elements=mesh.elements,
        lead_in=LEAD_IN,
        pass_time=pass_time,
    )


def write(case: Case, directory: FilePath | str) -> WrittenDeck:
    """Build the deck of a case and write ``<id>.inp``, ``<id>-constant-friction.inp``, ``vfric.f``, ``mesh.vtu``."""
    deck = build(case)
    folder = FilePath(directory)
    if deck.constant_friction_text is not None:
        write_text(folder / f"{deck.case_id}-constant-friction.inp", deck.constant_friction_text)
    write_text(folder / "vfric.f", deck.user_text)
    write_mesh(deck, folder / "mesh.vtu")
    write_text(folder / f"{deck.case_id}.inp", deck.input_text)
    return deck


def write_mesh(deck: WrittenDeck, file: FilePath | str) -> None:
    """Write the block's mesh (mm) for ParaView."""
    import meshio

    grid = meshio.Mesh(deck.points, [("hexahedron", deck.elements)])
    with atomic_path(file) as temporary:
        meshio.write(temporary, grid, file_format="vtu")


def _motion(case: Case, mesh: BlockMesh, path: Path, pass_time: float) -> tuple[list[str], Placement, list[MountTable]]:
    """Return the text that says how the mount is held, where the block starts, and the mount's velocity tables."""
    if case.path.mount_is_rigid:
        return sections.ring(path), place_on_wheel(mesh, path), []
    curvature = _stress_free_curvature(case, path)
    rows = np.unique(np.round(mesh.s[mesh.mount_nodes], 9))
    tables = mount_tables(path, rows, pass_time, curvature)
    return sections.mount_rows(mesh, tables), place_on_belt(mesh, path, curvature), tables


def _stress_free_curvature(case: Case, path: Path) -> float:
    """Return the curvature (1/m) of the mount of the stress-free block on the belt.

    A flat block has none. A conforming one has that of the belt where the block first touches; between the arcs it
    is flattened.
    """
    if case.block.mounting == "flat":
        return 0.0
    middle = path.first_touch_arc - 0.5 * path.columns.extent
    if isinstance(path.line, TabulatedLine):
        arcs = path.first_touch_arc - np.linspace(0.0, path.columns.extent, 101)
        return float(np.mean(path.line.curvature(arcs)))
    return float(path.line.curvature(middle))


def _opening(case: Case) -> list[str]:
    """Return the heading. User's free text stays out of decks: names and ids have a closed alphabet."""
    lines = ["*HEADING", case.case_id]
    lines += [
        comment(text)
        for text in (
            f"Tread block pass for ABAQUS/Explicit, written by tread-validate {__version__}",
            f"Units: {DECK_UNITS}",
            f"Case: {case.case_id}",
            f"Study: {case.study_name}, sha256 {case.study_digest}",
            f"Path {case.path_name}, block {case.block_name}, compound {case.compound_name}, "
            f"friction {case.friction_name}",
            f"{case.temperature:g} degC, interference {case.interference * DECK_LENGTH:g} mm, "
            f"speed {case.speed:.6g} m/s, creep ratio {case.creep_ratio:.6g}"
            + (" (free rolling)" if case.free_rolling else ""),
            *(f"ASSUMED INPUT: {item}" for item in case.assumed()),
            "x: direction of travel, y: away from the road, z: across. Road at y = 0 under the axle (x = 0).",
            "Step approach leads in without contact; step pass begins at the first touch.",
            "Run: abaqus job=... input=... user=vfric.f double",
        )
    ]
    return lines


def _join(lines: list[str]) -> str:
    return "\n".join(lines) + "\n"
