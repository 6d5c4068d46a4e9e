"""`tread-validate mesh-error`: what the mesh of a reference run is worth."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    histories: Annotated[list[Path], typer.Argument(help="histories of one case, their records beside them")],
    size: Annotated[list[float], number("--size", "element_size_mm", "their element sizes in mm, in the same order")],
    output: Annotated[Path, typer.Option("-o", "--output", help="YAML file to write")] = Path("mesh_error.yaml"),
) -> None:
    """Extrapolate three runs of one case to element size 0, with the discretisation uncertainty on the study's mesh.

    The result holds for runs of the same engine, block, kind of path and mesh, and for no other.

    Example: tread-validate mesh-error study.yaml 2.csv 1.csv 0.5.csv --size 2 --size 1 --size 0.5 -o rig.yaml
    """

    from ..compare.scores.convergence import mesh_study
    from ..errors import InputError
    from ..history import History
    from ..reference.filing import read_record
    from ..reference.mesh_errors import document, write_mesh_study
    from ..study import load_study

    if len(histories) != 3 or len(size) != 3:
        raise InputError("mesh-error", f"{len(histories)} histories, {len(size)} sizes", "three of each")
    order = sorted(range(3), key=lambda index: -size[index])
    files = [histories[index] for index in order]
    records = [read_record(file) for file in files]
    for key in ("case_id", "engine", "code"):
        found = {str(record.get(key)) for record in records}
        if len(found) != 1:
            raise InputError(f"mesh-error: {key}", ", ".join(sorted(found)), "three runs of one case, engine and code")
    loaded = load_study(study)
    case = loaded.case(str(records[0]["case_id"]))
    used = case.deck.element_size_mm
    sizes = [size[index] for index in order]
    if used not in sizes:
        raise InputError("--size", sizes, f"one of them the study's, {used:g} mm")
    numbers = mesh_study(sizes, [History.read_csv(file) for file in files], used)
    write_mesh_study(output, document(case, loaded.model.name, records, sizes, numbers))
    typer.echo(f"{case.case_id}: relative discretisation uncertainty at {used:g} mm")
    for name, error in numbers["mesh_error"].items():
        quantity = numbers["quantities"].get(name)
        if quantity is None:
            how = "history, root mean square"
        else:
            order_of = quantity["order"]
            how = f"order {order_of:.2f}" if order_of is not None else "no order: scatter of the meshes"
        typer.echo(f"  {name:32s} {100 * error:8.3f} %  ({how})")
