"""`tread-validate import-belt`: from ridge heights of a cast to levelled belt traces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    heights: Annotated[Path, typer.Argument(help="table: position_mm and one <ridge>_mm a ridge, gaps left empty")],
    output: Annotated[Path, typer.Option("-o", "--output", help="belt file (YAML) to write")] = Path("belt.yaml"),
    invert: Annotated[bool, typer.Option("--invert", help="heights are positive towards the road")] = False,
    confirm: Annotated[bool, typer.Option("--confirm-units", help="accept values out of the usual range")] = False,
    origin: Annotated[str, typer.Option("--origin", help="measured or synthetic; a file may say it")] = "",
    source: Annotated[str, typer.Option("--source", help="where the data come from, one line")] = "",
    figure: Annotated[Path | None, typer.Option("--figure", help="write a picture (PNG) here")] = None,
) -> None:
    """Level and smooth ridge heights; write the belt file a study reads, with patch length and edge radius.

    Example: tread-validate import-belt reference_data/belt/synthetic_ridges.csv -o belt.yaml
    """
    from ..geometry.trace import level
    from ..geometry.trace_file import belt_yaml
    from ..geometry.trace_import import read_ridges
    from ..units import IN_UM, MM
    from .laboratory import checked_origin, provenance, write_all

    kind, told = checked_origin(heights, origin, source)
    traces = level(read_ridges(heights, invert, confirm))
    write_all({output: belt_yaml(traces, kind, told, provenance(heights))})
    if figure is not None:
        from . import laboratory_figures as draw

        mark = ", synthetic" if kind == "synthetic" else ""
        draw.save(figure, (11.0, 3.4), lambda canvas: draw.belt(traces, canvas, mark))
    typer.echo(f"{kind} data: {told}")
    for trace in traces:
        length, radius = trace.patch_length, trace.edge_radius
        spikes = ", ".join(f"{x / MM:.1f}" for x in trace.spikes) or "none"
        typer.echo(
            f"{trace.name}: patch {length.value / MM:.1f} +- {length.half_width / MM:.1f} mm, "
            f"edge radius {radius.value / MM:.0f} +- {radius.half_width / MM:.0f} mm (95 %), "
            f"noise {trace.noise * IN_UM:.1f} um, spikes at x = {spikes} mm, "
            f"edge moved by setting them aside: {trace.edge_shift / MM:.3f} mm"
        )
    typer.echo(f"wrote {output}")
