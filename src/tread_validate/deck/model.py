"""From a case to the text of its deck."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path as FilePath

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..errors import InputError
from ..files import atomic_path, write_text
from ..friction import law
from ..geometry import Path, path_of
from ..study import Case
from ..units import DECK_LENGTH, DECK_UNITS
from . import sections
from .block_mesh import BlockMesh
from .compound import material
from .form import Form
from .inputs import inputs_of
from .keywords import comment
from .mesh import block_mesh
from .placement import LEAD_IN, MountTable, Placement, mount_tables, place
from .steps import steps
from .vfric import GENERAL, PAIRS, user_friction

POINT_DECIMALS = 6  # of the mesh for ParaView, mm: further digits depend on the processor
MARGIN = 1.05  # of the pass over the time of geometrical contact: sheared rubber lets go a little later
INCLUDED = re.compile(r"(mesh|motion)-[a-z0-9_]+-[0-9a-f]{10}\.inp")


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
    general_contact_text : str or None
        The same deck with general contact and VFRICTION; None where not asked for.
    user_text : str
        Fortran source of VFRIC.
    general_user_text : str or None
        Fortran source of VFRICTION.
    includes : mapping of str to str
        Files that the decks include, by name.
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
    includes: Mapping[str, str] = field(default_factory=dict)
    general_contact_text: str | None = None
    general_user_text: str | None = None

    @property
    def files(self) -> dict[str, str]:
        """Every text file of the run by name, the deck itself last."""
        files = dict(self.includes)
        if self.constant_friction_text is not None:
            files[f"{self.case_id}-constant-friction.inp"] = self.constant_friction_text
        if self.general_contact_text is not None and self.general_user_text is not None:
            files["vfriction.f"] = self.general_user_text
            files[f"{self.case_id}-general-contact.inp"] = self.general_contact_text
        return {**files, "vfric.f": self.user_text, f"{self.case_id}.inp": self.input_text}


def build(case: Case, *, single_file: bool = False, general_contact: bool = False) -> WrittenDeck:
    """Return the deck of a case; the same case gives the same bytes.

    Parameters
    ----------
    case : Case
    single_file : bool
        Every number in place and nothing included, for programs that know neither ``*PARAMETER`` nor ``*INCLUDE``.
    general_contact : bool
        Also write the variant with general contact and VFRICTION.

    Raises
    ------
    InputError
        A case whose free-rolling creep has not been resolved, and whatever its material, friction law or path raise.
    """
    if case.creep_ratio is None:
        raise InputError(f"case {case.case_id}: creep_ratio", "none (free rolling)", "the creep ratio of free rolling")
    path = path_of(case)
    mesh = block_mesh(case.block, case.deck, case.root if case.block.mesh is not None else None)
    pass_time = math.ceil(path.contact_duration * MARGIN / 1e-5) * 1e-5
    friction = law(case.friction, case.root)
    user = user_friction(friction, sections.face_mass(case, mesh))
    placement, tables = _motion(case, mesh, path, pass_time)
    inputs = inputs_of(case, path, friction, placement, pass_time)
    form = Form(single_file)
    top, below = _opening(case, mesh), form.parameters(inputs.by_hand, inputs.derived)
    before = [
        *below,
        *sections.mesh(form, mesh, placement, case.block_name, bool(tables), case.deck.element),
        *material(case),
        *sections.road(form, inputs, path, placement),
        *(sections.ring(path) if case.path.mount_is_rigid else ()),
    ]
    after = [
        *sections.initial_conditions(form, inputs, case, path, placement),
        *sections.fixed_supports(case, path, mesh),
    ]
    pair = steps(form, inputs, case, path, tables, general_contact=False)
    constant = general = None
    if case.deck.constant_friction_variant:
        own = sections.constant_friction(form, inputs, friction.constant_coefficient)
        constant = _join([*top, _run(case, "-constant-friction"), *before, *own, *after, *pair])
    if general_contact:
        own = sections.user_friction(form, inputs, user.properties, GENERAL)
        contact = steps(form, inputs, case, path, tables, general_contact=True)
        general = _join([*top, _run(case, "-general-contact", "vfriction"), *before, *own, *after, *contact])
    own = sections.user_friction(form, inputs, user.properties, PAIRS)
    return WrittenDeck(
        case_id=case.case_id,
        input_text=_join([*top, _run(case, "", "vfric"), *before, *own, *after, *pair]),
        constant_friction_text=constant,
        user_text=user.source,
        points=placement.points,
        elements=mesh.elements,
        lead_in=LEAD_IN,
        pass_time=pass_time,
        includes=form.files,
        general_contact_text=general,
        general_user_text=user.general_source if general_contact else None,
    )


def write(
    case: Case, directory: FilePath | str, *, single_file: bool = False, general_contact: bool = False
) -> WrittenDeck:
    """Build the deck of a case and write its `files` and ``mesh.vtu``; see `build`.

    Include files that an earlier deck in the folder left behind and this one does not use are removed.
    """
    deck = build(case, single_file=single_file, general_contact=general_contact)
    folder = FilePath(directory)
    write_mesh(deck, folder / "mesh.vtu")
    for name, text in deck.files.items():
        write_text(folder / name, text)
    for old in folder.glob("*.inp"):
        if INCLUDED.fullmatch(old.name) and old.name not in deck.includes:
            old.unlink()
    return deck


def write_mesh(deck: WrittenDeck, file: FilePath | str) -> None:
    """Write the block's mesh (mm) for ParaView."""
    import meshio

    points = np.round(deck.points, POINT_DECIMALS) + 0.0  # + 0.0 turns -0.0 into 0.0
    grid = meshio.Mesh(points, [("hexahedron", deck.elements)])
    with atomic_path(file) as temporary:
        meshio.write(temporary, grid, file_format="vtu")


def _motion(case: Case, mesh: BlockMesh, path: Path, pass_time: float) -> tuple[Placement, list[MountTable]]:
    """Return where the block starts, and the velocity tables of its mount; none on the rig, where the ring moves it."""
    if case.path.mount_is_rigid:
        return place(mesh, path, float(path.line.curvature(0.0)) / path.line.speed_ratio), []
    curvature = 0.0 if case.block.mounting == "flat" else path.block_curvature()
    rows = np.unique(sections.mount_place(mesh))
    return place(mesh, path, curvature), mount_tables(path, rows, pass_time, curvature)


def _opening(case: Case, mesh: BlockMesh) -> list[str]:
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
            f"Written for {case.temperature:g} degC, interference {case.interference * DECK_LENGTH:g} mm, "
            f"speed {case.speed:.6g} m/s, creep ratio {case.creep_ratio:.6g}"
            + (" (free rolling)" if case.free_rolling else ""),
            *(f"ASSUMED INPUT: {item}" for item in case.assumed()),
            *(
                ("HALF the block (z >= 0) is modelled: double the forces, reactions and energies of the results",)
                if mesh.symmetry_nodes.size
                else ()
            ),
            "x: direction of travel, y: away from the road, z: across. Road at y = 0 under the axle (x = 0).",
            "Step approach leads in without contact; step pass begins at the first contact.",
        )
    ]
    return lines


def _run(case: Case, variant: str, routine: str | None = None) -> str:
    """Return the comment that says how a deck is run; built-in friction needs no routine."""
    user = "" if routine is None else f" user={routine}.f"
    rename = "" if routine is None else f" (on Windows rename {routine}.f to {routine}.for)"
    return comment(f"Run: abaqus job={case.case_id}{variant}{user} double=both{rename}")


def _join(lines: list[str]) -> str:
    return "\n".join(lines) + "\n"
