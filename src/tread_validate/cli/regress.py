"""`tread-validate regress`: how peak force depends on speed and temperature."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    peaks: Annotated[Path, typer.Argument(help="table of peaks (CSV)")],
    exclude: Annotated[
        list[float] | None,
        number("--exclude-mm", "interference_mm", "interference left out; repeatable; 0.3 if left out"),
    ] = None,
    all_interferences: Annotated[bool, typer.Option("--all-interferences", help="leave none out")] = False,
    zero: Annotated[
        float,
        number("--zero-degC", "temperature_degC", "reference temperature of a_theta, degC"),
    ] = 22.0,
    level: Annotated[float, number("--level", "confidence", "confidence level")] = 0.95,
    json: Annotated[bool, typer.Option("--json", help="JSON in place of CSV")] = False,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write to this file")] = None,
) -> None:
    """Fit a_v and a_theta, set by set and as means, with spread and confidence intervals.

    The table has the columns shape, temperature_degC, interference_mm, speed_m_s, peak_normal_force_N, and if there
    are several, source and case_id.

    A row without a force counts as one that is not there. Where the speeds differ between the temperatures of a set,
    speed and temperature are fitted together and the set's note says so; else the paper's way, set by set.

    Example: tread-validate regress results/tables/peaks.csv
    """
    from json import dumps

    from ..compare.regression.line import EXCLUDED_INTERFERENCES, regress
    from ..compare.regression.peaks_file import read_peaks
    from ..compare.tables import Coefficient, rows_text
    from ..files import write_text

    left_out = () if all_interferences else tuple(exclude or EXCLUDED_INTERFERENCES)
    table = read_peaks(peaks)
    empty = [peak.case_id for members in table.values() for peak in members if peak.force is None]
    if empty:
        typer.echo(f"{len(empty)} row(s) without a force left out, first {empty[0]}", err=True)
    rows = [
        row
        for source, members in table.items()
        for row in regress(
            members, source=source, exclude=left_out, reference_temperature=zero, level=level, drop_missing=True
        ).coefficients
    ]
    text = dumps([row.cells() for row in rows], indent=2) + "\n" if json else rows_text(Coefficient, rows)
    if output is not None:
        write_text(output, text)
    else:
        typer.echo(text, nl=False)
