"""`tread-validate hierarchy`: how simple may a tread-block model be?"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..units import MM

if TYPE_CHECKING:
    from ..study import Case


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="folder for tables and figures [default: the study's, in results]"),
    ] = None,
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
    decks: Annotated[
        Path | None, typer.Option("--decks", help="folder of the generated decks [default: the study's, in fe_inputs]")
    ] = None,
    models: Annotated[
        Path | None,
        typer.Option("--models", help="folder of the own models' runs [default: the study's, in results]"),
    ] = None,
    samples: Annotated[
        int, typer.Option("--samples", min=8, max=65536, help="base sample of the Sobol indices, a power of two")
    ] = 256,
    part: Annotated[
        list[str] | None,
        typer.Option("--part", help="pareto, effects, published, compounds, compatibility, sobol; else all"),
    ] = None,
) -> None:
    """Compare every level of the model hierarchy with the FE runs, and say what each effect is worth.

    Example: tread-validate hierarchy config/study.yaml
    """

    from ..errors import InputError
    from ..hierarchy.build import PARTS, Folders, build
    from ..provenance import commit, version
    from ..source_code import code_digest
    from ..study import conditions_digest, load_study
    from ..workspace import Workspace
    from ..yaml_text import write_yaml

    if samples & (samples - 1):
        raise InputError("--samples", samples, "a power of two")
    loaded = load_study(study)
    place = Workspace(loaded.model.name)
    output = output or place.hierarchy
    folders = Folders(references, decks or place.decks, output, models or place.results / "models")
    parts = list(part or PARTS)
    if "compatibility" in parts and not _gives_coefficients(loaded.cases()):
        parts.remove("compatibility")
        typer.echo(
            "no compatibility: it needs a rectangular block on a rig, below 0.25 mm, "
            "every speed at every temperature, two of both or more"
        )
    tables = build(loaded, folders, typer.echo, samples, parts)
    record = {
        "study": loaded.model.name,
        "study_digest": conditions_digest(loaded.cases()),
        "version": version(),
        "commit": commit(),
        "code": code_digest("hierarchy"),
        "sobol_base_sample": samples,
    }
    write_yaml(output / "record.yaml", record)
    for row in tables.get("pareto", []):
        error = row["mean_abs_peak_normal_force_error"]
        told = "no current reference" if error is None else f"mean error of peak N {100 * error:.1f} %"
        seconds = row["seconds_per_pass"]
        cost = "" if seconds is None else f"{seconds:.4f} s a pass, "
        nothing = seconds is None and error is None
        typer.echo(f"{row['level']}, {row['group']}: " + (row["note"] if nothing and row["note"] else cost + told))
    typer.echo(f"tables and figures in {output}")


def _gives_coefficients(cases: Sequence[Case]) -> bool:
    """Whether a_v and a_theta follow from the rig runs that the compatibility of both is asked of: a full grid."""
    rig = [
        case
        for case in cases
        if case.path.gives_coefficients and case.block.shape == "rectangle" and case.interference < 0.25 * MM
    ]
    levels = [len({getattr(case, key) for case in rig}) for key in ("temperature", "speed", "interference")]
    return min(levels[:2]) > 1 and len(rig) == math.prod(levels)
