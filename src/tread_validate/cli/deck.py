"""`tread-validate deck`: write ABAQUS/Explicit decks."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import within


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    case: Annotated[str | None, typer.Option("--case", help="id of one case (see `tread-validate cases`)")] = None,
    every: Annotated[bool, typer.Option("--all", help="every case of the study")] = False,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", help="folder; each case gets one of its own in it [default: the study's, in fe_inputs]"
        ),
    ] = None,
    accept: Annotated[bool, typer.Option("--accept-fit", help="go on with a fit that is too far off")] = False,
    element_size: Annotated[
        float | None,
        typer.Option(
            "--element-size", callback=within("element_size_mm"), help="mm, instead of the study's: for a mesh study"
        ),
    ] = None,
    layers: Annotated[
        int | None, typer.Option("--layers", min=1, max=1000, help="elements over the height, instead of the study's")
    ] = None,
    single_file: Annotated[
        bool, typer.Option("--single-file", help="every number in place and nothing included (for imports into a GUI)")
    ] = False,
    general_contact: Annotated[
        bool, typer.Option("--general-contact", help="also the variant with general contact, and its vfriction.f")
    ] = False,
) -> None:
    """Write the deck of one case, or of all: ID.inp with the files it includes, vfric.f, mesh.vtu and variants.

    Speed, interference, creep, temperature and friction constants stand at the top of ID.inp and can be changed there;
    mesh, sets and surfaces are in mesh-BLOCK-DIGEST.inp, a belt's velocity tables in motion-PATH-DIGEST.inp.

    In ABAQUS: job=ID user=vfric.f double=both (ID-general-contact: user=vfriction.f; ID-constant-friction: no user=);
    on Windows rename the routine to .for first.

    Example: tread-validate deck config/study.yaml --case rig-rectangle-22c-0p2mm-300rpm
    """
    from .. import deck
    from ..deck.compound import EMBEDDED_HOURGLASS, hourglass_note
    from ..errors import InputError
    from ..study import load_study, with_mesh
    from ..units import IN_MS
    from ..workspace import Workspace

    if (case is None) == (not every):
        raise InputError("deck", "both --case and --all" if every else "neither --case nor --all", "one of the two")
    loaded = load_study(study)
    output = output or Workspace(loaded.model.name).decks
    cases = (loaded.case(case),) if case is not None else loaded.cases()
    if any(one.creep_ratio is None for one in cases):
        from ..spring import resolve_creep

        cases = resolve_creep(cases)
    from .laboratory import tell_worth

    tell_worth(cases, study, accept)
    mesh = {"element_size_mm": element_size, "layers": layers}
    for one in (with_mesh(one, {key: value for key, value in mesh.items() if value is not None}) for one in cases):
        written = deck.write(one, output / one.case_id, single_file=single_file, general_contact=general_contact)
        if one.deck.element == "C3D8R" and one.deck.hourglass not in EMBEDDED_HOURGLASS:
            typer.echo(hourglass_note(one.deck.hourglass), err=True)
        typer.echo(
            f"{output / one.case_id}: {written.elements.shape[0]} elements, pass {IN_MS * written.pass_time:.4g} ms"
        )
