"""`tread-validate mesh-error`: what the mesh of a reference run is worth."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    histories: Annotated[
        list[Path], typer.Argument(help="histories of one case, named <case>/<size>.csv, or <size>.csv in a folder")
    ],
    size: Annotated[
        list[float],
        number("--size", "element_size_mm", "their element sizes in mm, in the same order"),
    ],
    used: Annotated[float, number("--used", "element_size_mm", "element size of the reference runs, mm")] = 1.0,
    kind: Annotated[str, typer.Option("--kind", help="which cases the result is for: rig or belt")] = "rig",
    output: Annotated[Path, typer.Option("-o", "--output", help="YAML file to write")] = Path("mesh_error.yaml"),
) -> None:
    """Extrapolate three runs of one case to element size 0, and give the error that remains on the mesh in use.

    Example: tread-validate mesh-error 2p0.csv 1p0.csv 0p5.csv --size 2 --size 1 --size 0.5 --kind rig -o rig.yaml
    """

    from ..compare.scores.convergence import convergence, history_errors
    from ..errors import InputError
    from ..history import History
    from ..provenance import sha256_file
    from ..yaml_text import write_yaml

    if len(histories) != 3 or len(size) != 3:
        raise InputError("mesh-error", f"{len(histories)} histories, {len(size)} sizes", "three of each")
    if kind not in ("rig", "belt"):
        raise InputError("--kind", kind, "rig or belt")
    if used not in size:
        raise InputError("--used", used, f"one of the sizes {size}")
    order = sorted(range(3), key=lambda index: -size[index])
    loaded = [History.read_csv(histories[index]) for index in order]
    sizes = [size[index] for index in order]
    at = sizes.index(used)
    of_histories = history_errors(sizes, loaded, used)
    case_ids = {str(history.provenance.get("case_id", "")) for history in loaded}
    if len(case_ids) != 1:
        raise InputError("mesh-error: case_id", ", ".join(sorted(case_ids)), "three runs of one case")
    results = convergence(sizes, loaded)
    document = {
        "kind": kind,
        "case_id": case_ids.pop(),
        "element_size_mm": used,
        "method": "Richardson extrapolation from three meshes (doi:10.1115/1.2960953); errors are relative",
        "sizes_mm": sizes,
        "history_sha256": [sha256_file(histories[index]) for index in order],
        "mesh_error": {
            **{name: float(f"{item.errors[at]:.4g}") for name, item in results.items()},
            **{name: float(f"{value:.4g}") for name, value in of_histories.items()},
        },
        "quantities": {
            name: {
                "values": [float(f"{value:.7g}") for value in item.values],
                "limit": float(f"{item.limit:.7g}"),
                "order": None if item.order is None else round(item.order, 3),
            }
            for name, item in results.items()
        },
    }
    write_yaml(output, document)
    typer.echo(f"{document['case_id']}: relative error that remains at {used:g} mm")
    for name, item in results.items():
        how = f"order {item.order:.2f}" if item.order is not None else "no order: scatter of the meshes"
        typer.echo(f"  {name:32s} {100 * item.errors[at]:8.3f} %  ({how})")
    for name, value in of_histories.items():
        typer.echo(f"  {name:32s} {100 * value:8.3f} %  (history, root mean square)")
