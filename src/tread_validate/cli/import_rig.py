"""`tread-validate import-rig`: from a force record of the rig to passes and peaks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .options import number

if TYPE_CHECKING:
    from ..reference.rig_passes import RigPasses

_Record = Annotated[Path, typer.Argument(help="CSV or TDMS: time, forces, and a trigger or the wheel's angle")]
_Output = Annotated[Path, typer.Option("-o", "--output", help="folder for history, passes, peaks and record")]
_Name = Annotated[str | None, typer.Option("--name", help="of the files; the record's name if left out")]
_Cutoff = Annotated[
    float,
    number("--low-pass-Hz", "cutoff_Hz", "cut-off of the filter (no phase shift)"),
]
_Channel = Annotated[
    list[str] | None, typer.Option("--channel", help="NAME=COLUMN or NAME=Group/Channel; may be given again")
]
_Invert = Annotated[bool, typer.Option("--invert-tangential", help="the record counts force along the travel positive")]
_Calibration = Annotated[
    float, number("--cell-percent", "cell_percent", "95 % uncertainty of the load cell, of the reading")
]
_Turning = Annotated[
    float | None,
    number("--cell-turns-from-deg", "angle_deg", "the cell turns with the wheel; at this angle it faces the road"),
]
_Backwards = Annotated[bool, typer.Option("--cell-turns-back", help="its tangential axis lags the wheel")]
_Case = Annotated[str, typer.Option("--case", help="id of the study's case that was measured")]
_Shape = Annotated[str, typer.Option("--shape", help="rectangle or parallelogram")]
_Temperature = Annotated[float | None, number("--temperature-degC", "temperature_degC", "of the rubber")]
_Interference = Annotated[float | None, number("--interference-mm", "interference_mm", "of block and wheel")]
_Diameter = Annotated[float, number("--wheel-diameter-mm", "diameter_mm", "small wheel over the tread")]
_Origin = Annotated[str, typer.Option("--origin", help="measured or synthetic; a file may say it")]
_Source = Annotated[str, typer.Option("--source", help="where the data come from, one line")]
_Figure = Annotated[Path | None, typer.Option("--figure", help="write a picture (PNG) here")]
_PeaksFigure = Annotated[
    Path | None, typer.Option("--peaks-figure", help="peaks of every record in the folder against speed (PNG)")
]


def command(
    record: _Record,
    output: _Output = Path("reference_data/rig"),
    name: _Name = None,
    cutoff: _Cutoff = 1000.0,
    channel: _Channel = None,
    invert: _Invert = False,
    calibration: _Calibration = 0.5,
    turning: _Turning = None,
    backwards: _Backwards = False,
    case: _Case = "",
    shape: _Shape = "",
    temperature: _Temperature = None,
    interference: _Interference = None,
    diameter: _Diameter = 200.0,
    origin: _Origin = "",
    source: _Source = "",
    figure: _Figure = None,
    peaks_figure: _PeaksFigure = None,
) -> None:
    """Cut a record into passes, remove drift and noise, and write their mean, range and peaks.

    The folder's peaks.csv lists every record imported into it, with error bars, for `tread-validate regress`.
    Conditions not given are read from the record's ``# key: value`` lines or TDMS properties.

    Example: tread-validate import-rig reference_data/rig/synthetic_record.csv -o results/rig
    """
    import re
    from dataclasses import replace

    from ..errors import InputError, one_line
    from ..reference.rig import load_rig, peak_rows, write_rig
    from ..reference.rig_axes import axle_fixed
    from ..reference.rig_passes import cut_passes
    from ..reference.rig_record import read_record
    from ..units import DEG, MM
    from .laboratory import checked_origin, provenance

    files_name = name if name is not None else record.stem
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,80}", files_name):
        raise InputError("--name", one_line(files_name, 60), "letters, digits, - _ and .")
    data = read_record(record, _channels(channel or ()))
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
    _check_conditions(record, said)
    written = write_rig(output, files_name, passes, kind, told, case, said, provenance(record), 0.01 * calibration)
    if figure is not None:
        from . import laboratory_figures as draw

        mark = ", synthetic" if kind == "synthetic" else ""
        draw.save(figure, (11.0, 3.4), lambda canvas: draw.rig(passes, canvas, mark))
    if peaks_figure is not None:
        from . import laboratory_figures as draw

        references = load_rig(output)
        mark = ", synthetic" if any(reference.origin == "synthetic" for reference in references) else ""
        draw.save(peaks_figure, (4.7, 3.4), lambda canvas: draw.rig_peaks(peak_rows(references), canvas, mark))
    for line in (
        *(f"read: {line}" for line in data.understood),
        f"{kind} data: {told}",
        *_told(passes, 0.01 * calibration),
    ):
        typer.echo(line)
    typer.echo("wrote " + ", ".join(str(path) for path in written))


def _channels(items: Sequence[str]) -> dict[str, str]:
    """Return the record's columns that ``--channel`` names."""
    from ..errors import InputError, one_line

    channels = {}
    for item in items:
        key, equals, value = item.partition("=")
        if not equals or not value.strip():
            raise InputError("--channel", one_line(item, 60), "NAME=COLUMN, such as normal_force_N=Forces/Fz")
        channels[key.strip()] = value.strip()
    return channels


def _check_conditions(record: Path, said: Mapping[str, str]) -> None:
    """Raise `InputError` where a condition of the run is not known."""
    from ..errors import InputError, one_line
    from ..reference.rig import CONDITIONS

    missing = [key for key in CONDITIONS if not said[key]]
    if missing:
        option = f"--{missing[0].replace('_', '-')}"
        raise InputError(
            f"{record}: {missing[0]}", "nothing", f"{option}, or a line '# {missing[0]}: ...' in the record"
        )
    if said["shape"] not in ("rectangle", "parallelogram"):
        raise InputError(f"{record}: shape", one_line(said["shape"], 60), "rectangle or parallelogram")


def _told(passes: RigPasses, calibration: float) -> Iterator[str]:
    """Return what is printed of the passes; `calibration` is the load cell's relative uncertainty."""
    spread = passes.peak_normal_force
    yield (
        f"{passes.count} passes at {passes.speed_rpm:.2f} rpm (speed changes by {100 * passes.speed_change:.2f} %), "
        f"low-pass {passes.cutoff:g} Hz, drift {passes.drift:.2f} N, noise {passes.noise:.3f} N"
    )
    lost = {
        "trigger(s) missed, put in": passes.missed_triggers,
        "false trigger(s) left out": passes.false_triggers,
        "pass(es) left out for a gap": passes.passes_in_gaps,
        "pass(es) without contact left out": passes.passes_without_contact,
    }
    counts = [f"{count} {what}" for what, count in lost.items() if count]
    if counts:
        yield "; ".join(counts)
    half = passes.half_width(spread, calibration)
    among = f"passes {spread.least:.2f} to {spread.largest:.2f}"
    yield f"peak normal force: {spread.mean:.2f} +- {half:.2f} N (95 %; {among})"


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
