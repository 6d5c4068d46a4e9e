"""`tread-validate fit-friction`: from a tribometer table to a friction law."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    table: Annotated[Path, typer.Argument(help="table: pressure_Pa, slip_speed_m_s, friction_coefficient")],
    output: Annotated[Path, typer.Option("-o", "--output", help="friction file (YAML) to write")] = Path(
        "friction.yaml"
    ),
    hold: Annotated[
        list[str] | None, typer.Option("--hold", help="NAME=VALUE: beta, n or m not fitted; may be given again")
    ] = None,
    static: Annotated[float, number("--static", "static_coefficient", "static coefficient")] = 0.9,
    temperature: Annotated[
        float | None, number("--temperature-degC", "temperature_degC", "rows of this temperature (within 3 K)")
    ] = None,
    pressure_unit: Annotated[str | None, typer.Option("--pressure-unit", help="Pa, kPa, MPa")] = None,
    speed_unit: Annotated[str | None, typer.Option("--speed-unit", help="m/s, mm/s, km/h")] = None,
    column: Annotated[
        list[str] | None,
        typer.Option("--column", help="KEY=COLUMN: pressure, slip_speed, coefficient, temperature"),
    ] = None,
    accept: Annotated[
        bool, typer.Option("--accept-lack-of-fit", help="write the law although it misses the table")
    ] = False,
    confirm: Annotated[bool, typer.Option("--confirm-units", help="accept values out of the usual range")] = False,
    origin: Annotated[str, typer.Option("--origin", help="measured or synthetic; a file may say it")] = "",
    source: Annotated[str, typer.Option("--source", help="where the data come from, one line")] = "",
    vfric: Annotated[Path | None, typer.Option("--vfric", help="write the law as VFRIC (Fortran) here too")] = None,
    figure: Annotated[Path | None, typer.Option("--figure", help="write a picture (PNG) here")] = None,
) -> None:
    """Fit Huemer's law to a table; write a friction file that a study reads, with intervals and warnings.

    Example: tread-validate fit-friction reference_data/friction/synthetic_tribometer.csv --hold beta=0
    """
    from ..bounds import bounded
    from ..errors import InputError, one_line
    from ..friction import fit_friction, read_friction_table
    from ..friction.law_file import friction_yaml, quality
    from ..instrument.quantities import FRICTION
    from .laboratory import checked_origin, provenance, reading_of, write_all

    held: dict[str, float] = {}
    for item in hold or ():
        name, equals, value = item.partition("=")
        try:
            held[name.strip()] = float(value)
        except ValueError:
            equals = ""
        if not equals:
            raise InputError("--hold", one_line(item, 60), "NAME=VALUE, such as beta=0")
        bounded(held[name.strip()], name, f"--hold {name.strip()}")
    kind, told = checked_origin(table, origin, source)
    units = {"--pressure-unit": pressure_unit, "--speed-unit": speed_unit}
    data = read_friction_table(table, confirm, reading_of(column, units, FRICTION), temperature)
    fit = fit_friction(data, held, static)
    if not fit.describes and not accept:
        raise InputError(
            table,
            f"a lack of fit of p = {fit.lack_of_fit:.2g} and {100 * fit.misfit:.2g} % of the mean coefficient",
            "p of 0.001 or more, or 3 % at most (kind: table follows any table; --accept-lack-of-fit insists)",
        )
    files = {output: friction_yaml(fit, kind, told, provenance(table))}
    if vfric is not None:
        files[vfric] = _vfric(fit.law, kind, told)
    write_all(files)
    if figure is not None:
        from . import laboratory_figures as draw

        mark = ", synthetic" if kind == "synthetic" else ""
        draw.save(figure, (9.4, 3.4), lambda canvas: draw.friction(fit, canvas, mark))
    for line in data.understood:
        typer.echo(f"read: {line}")
    typer.echo(f"{kind} data: {told}")
    for constant, fitted in fit.constants.items():
        low, high = fit.intervals[constant]
        interval = "held" if constant in fit.held else f"95 %: {low:.5g} to {high:.5g}"
        typer.echo(f"{constant}: {fitted:.6g} ({interval})")
    for key, merit in quality(fit).items():
        typer.echo(f"{key}: {merit}")
    for warning in fit.warnings:
        typer.echo(f"warning: {warning}")
    typer.echo(f"wrote {output}")


def _vfric(law: object, kind: str, told: str) -> str:
    """Return the Fortran source, its properties in a comment: in a deck they stand under ``*FRICTION``."""
    from ..deck.vfric import user_friction
    from ..friction import FrictionLaw

    assert isinstance(law, FrictionLaw)
    user = user_friction(law)
    lines = [f"c     {kind} data: {told}"[:72], "c     Properties in the deck's units (MPa, mm/s), in their order:"]
    lines += [f"c       {value:.8g}" for value in user.properties]
    return "\n".join(lines) + "\n" + user.source
