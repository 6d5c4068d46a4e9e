"""`tread-validate import-rig`: from a force record of the rig to passes and peaks."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    record: Annotated[Path, typer.Argument(help="CSV or TDMS: time, forces, and a trigger or the wheel's angle")],
    output: Annotated[Path, typer.Option("-o", "--output", help="folder for history, passes, peaks and record")] = Path(
        "reference_data/rig"
    ),
    name: Annotated[str | None, typer.Option("--name", help="of the files; the record's name if left out")] = None,
    cutoff: Annotated[
        float,
        number("--low-pass-Hz", "cutoff_Hz", "cut-off of the filter (no phase shift)"),
    ] = 1000.0,
    channel: Annotated[
        list[str] | None, typer.Option("--channel", help="NAME=COLUMN or NAME=Group/Channel; may be given again")
    ] = None,
    invert: Annotated[
        bool, typer.Option("--invert-tangential", help="the record counts force along the travel positive")
    ] = False,
    calibration: Annotated[
        float, number("--cell-percent", "percent", "95 % uncertainty of the load cell, of the reading")
    ] = 0.5,
    turning: Annotated[
        float | None,
        number("--cell-turns-from-deg", "angle_deg", "the cell turns with the wheel; at this angle it faces the road"),
    ] = None,
    backwards: Annotated[bool, typer.Option("--cell-turns-back", help="its tangential axis lags the wheel")] = False,
    case: Annotated[str, typer.Option("--case", help="id of the study's case that was measured")] = "",
    shape: Annotated[str, typer.Option("--shape", help="rectangle or parallelogram")] = "",
    temperature: Annotated[float | None, number("--temperature-degC", "temperature_degC", "of the rubber")] = None,
    interference: Annotated[float | None, number("--interference-mm", "interference_mm", "of block and wheel")] = None,
    diameter: Annotated[float, number("--wheel-diameter-mm", "diameter_mm", "small wheel over the tread")] = 200.0,
    origin: Annotated[str, typer.Option("--origin", help="measured or synthetic; a file may say it")] = "",
    source: Annotated[str, typer.Option("--source", help="where the data come from, one line")] = "",
    figure: Annotated[Path | None, typer.Option("--figure", help="write a picture (PNG) here")] = None,
    peaks_figure: Annotated[
        Path | None, typer.Option("--peaks-figure", help="peaks of every record in the folder against speed (PNG)")
    ] = None,
) -> None:
    """Cut a record into passes, remove drift and noise, and write their mean, range and peaks.

    The folder's peaks.csv lists every record imported into it, with error bars, for `tread-validate regress`.
    Conditions not given are read from the record's ``# key: value`` lines or TDMS properties.

    Example: tread-validate import-rig reference_data/rig/synthetic_record.csv -o results/rig
    """
    import re
    from dataclasses import replace

    from ..errors import InputError, one_line
    from ..reference.rig import CONDITIONS, write_rig
    from ..reference.rig_axes import axle_fixed
    from ..reference.rig_passes import cut_passes
    from ..reference.rig_record import read_record
    from ..units import DEG, MM
    from .laboratory import checked_origin, provenance

    channels = {}
    for item in channel or ():
        key, equals, value = item.partition("=")
        if not equals or not value.strip():
            raise InputError("--channel", one_line(item, 60), "NAME=COLUMN, such as normal_force_N=Forces/Fz")
        channels[key.strip()] = value.strip()
    files_name = name if name is not None else record.stem
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,80}", files_name):
        raise InputError("--name", one_line(files_name, 60), "letters, digits, - _ and .")
    data = read_record(record, channels)
    kind, told = checked_origin(record, origin or data.comments.get("origin", ""), source)
    if turning is not None:
        data = axle_fixed(data, turning * DEG, -1 if backwards else 1)
    if invert:
        data = replace(data, tangential_force=-data.tangential_force)
    passes = cut_passes(data, cutoff)
    said = {
        "shape": shape or data.comments.get("shape", ""),
        "temperature_degC": _given("temperature_degC", temperature, data.comments),
        "interference_mm": _given("interference_mm", interference, data.comments),
        "speed_m_s": f"{passes.rotational_speed * 0.5 * diameter * MM:.5f}",
    }
    missing = [key for key in CONDITIONS if not said[key]]
    if missing:
        option = f"--{missing[0].replace('_', '-')}"
        raise InputError(
            f"{record}: {missing[0]}", "nothing", f"{option}, or a line '# {missing[0]}: ...' in the record"
        )
    if said["shape"] not in ("rectangle", "parallelogram"):
        raise InputError(f"{record}: shape", one_line(said["shape"], 60), "rectangle or parallelogram")
    written = write_rig(output, files_name, passes, kind, told, case, said, provenance(record), 0.01 * calibration)
    if figure is not None:
        from . import laboratory_figures as draw

        mark = ", synthetic" if kind == "synthetic" else ""
        draw.save(figure, (11.0, 3.4), lambda canvas: draw.rig(passes, canvas, mark))
    if peaks_figure is not None:
        from ..reference.rig import load_rig, peak_rows
        from . import laboratory_figures as draw

        references = load_rig(output)
        mark = ", synthetic" if any(reference.origin == "synthetic" for reference in references) else ""
        draw.save(peaks_figure, (4.7, 3.4), lambda canvas: draw.rig_peaks(peak_rows(references), canvas, mark))
    spread = passes.peak_normal_force
    for line in data.understood:
        typer.echo(f"read: {line}")
    typer.echo(f"{kind} data: {told}")
    typer.echo(
        f"{passes.count} passes at {passes.speed_rpm:.2f} rpm (speed changes by {100 * passes.speed_change:.2f} %), "
        f"low-pass {passes.cutoff:g} Hz, drift {passes.drift:.2f} N, noise {passes.noise:.3f} N"
    )
    lost = {
        "trigger(s) missed, put in": passes.missed_triggers,
        "false trigger(s) left out": passes.false_triggers,
        "pass(es) left out for a gap": passes.passes_in_gaps,
        "pass(es) without contact left out": passes.passes_without_contact,
    }
    told_of = [f"{count} {what}" for what, count in lost.items() if count]
    if told_of:
        typer.echo("; ".join(told_of))
    half = passes.half_width(spread, 0.01 * calibration)
    among = f"passes {spread.least:.2f} to {spread.largest:.2f}"
    typer.echo(f"peak normal force: {spread.mean:.2f} +- {half:.2f} N (95 %; {among})")
    typer.echo("wrote " + ", ".join(str(path) for path in written))


def _given(name: str, value: float | None, comments: Mapping[str, str]) -> str:
    """Return the condition as the command line gives it, or as the record says."""
    from ..bounds import bounded
    from ..errors import InputError, one_line

    if value is not None:
        return f"{value:g}"
    said = comments.get(name, "")
    try:
        return f"{bounded(float(said), name, f'{name} in the record'):g}" if said else ""
    except ValueError:
        raise InputError(f"{name} in the record", one_line(said, 60), "a number") from None
