"""`tread-validate fit-prony`: from sweeps of a dynamic mechanical analyser to a Prony series."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, cast

import typer

from .options import number

POOR_OVERLAP = 0.1  # RMS relative difference of neighbouring sweeps: far above any analyser's scatter

if TYPE_CHECKING:
    from ..material import MaterialRoute
    from ..study import TimeShift

_Sweeps = Annotated[list[Path], typer.Argument(help="exports of the analyser, text or .xlsx: one file, or one a sweep")]
_Output = Annotated[Path, typer.Option("-o", "--output", help="material file (YAML) to write")]
_Terms = Annotated[int, typer.Option("--terms", min=1, max=60, help="exponentials besides the long-term one")]
_Band = Annotated[
    tuple[float, float] | None,
    number("--band", "band_rad_s", "reduced frequencies to fit, rad/s: LOW HIGH"),
]
_Reference = Annotated[
    float,
    number("--reference-degC", "temperature_degC", "temperature of the master curve"),
]
_C1 = Annotated[float, number("--c1", "c1", "WLF C1 at --ts")]
_C2 = Annotated[float, number("--c2", "c2_K", "WLF C2 at --ts, K")]
_Ts = Annotated[
    float,
    number("--ts", "temperature_degC", "temperature that C1 and C2 refer to, degC"),
]
_Poisson = Annotated[float, number("--poissons-ratio", "poissons_ratio", "for the file and the card")]
_Density = Annotated[float, number("--density-kg-m3", "density_kg_m3", "for the file and the card")]
_FitWlf = Annotated[bool, typer.Option("--fit-wlf", help="fit C1 and C2 instead (three temperatures)")]
_Free = Annotated[bool, typer.Option("--free-shift", help="lay each sweep on its neighbour instead")]
_Energy = Annotated[
    float | None,
    number("--arrhenius-kJ-mol", "activation_energy_kJ_mol", "shift by this instead"),
]
_Shifts = Annotated[
    Path | None, typer.Option("--shift-table", help="temperature_degC, log10_shift_factor (CSV) instead")
]
_Vertical = Annotated[bool, typer.Option("--vertical-shift", help="with --fit-wlf: a factor a sweep too")]
_Times = Annotated[str, typer.Option("--times", help="relaxation times: auto, even or refined")]
_Margins = Annotated[
    tuple[float, float],
    number("--margins", "margin", "g1 g2: how far times reach beyond the band"),
]
_LossWeight = Annotated[float, number("--loss-weight", "loss_weight", "weight of E'' against E'")]
_Prune = Annotated[
    float | None,
    number("--prune", "prune_percent", "fewest terms with both RMS errors at most this, per cent"),
]
_Master = Annotated[bool, typer.Option("--master", help="the table is a master curve at --reference-degC")]
_Unit = Annotated[str | None, typer.Option("--modulus-unit", help="Pa, kPa, MPa or GPa, whatever the header")]
_FrequencyUnit = Annotated[str | None, typer.Option("--frequency-unit", help="Hz or rad/s")]
_TemperatureUnit = Annotated[str | None, typer.Option("--temperature-unit", help="degC or K")]
_Column = Annotated[
    list[str] | None,
    typer.Option("--column", help="KEY=COLUMN (heading or number), KEY one of temperature, storage, ..."),
]
_Confirm = Annotated[bool, typer.Option("--confirm-units", help="accept values out of the usual range")]
_Replicates = Annotated[int, typer.Option("--resamples", min=0, max=20000, help="for the 95 % bands")]
_Origin = Annotated[str, typer.Option("--origin", help="measured or synthetic; a file may say it")]
_Source = Annotated[str, typer.Option("--source", help="where the data come from, one line")]
_Card = Annotated[Path | None, typer.Option("--abaqus-card", help="write the ABAQUS material card here too")]
_Study = Annotated[Path | None, typer.Option("--study", help="tell what this study's runs need of the series")]
_Figure = Annotated[Path | None, typer.Option("--figure", help="write a picture (PNG) here")]


def command(
    sweeps: _Sweeps,
    output: _Output = Path("material.yaml"),
    terms: _Terms = 24,
    band: _Band = None,
    reference: _Reference = 22.0,
    c1: _C1 = 8.86,
    c2: _C2 = 101.6,
    ts: _Ts = 10.0,
    poisson: _Poisson = 0.47,
    density: _Density = 1000.0,
    fit_wlf: _FitWlf = False,
    free: _Free = False,
    energy: _Energy = None,
    shifts: _Shifts = None,
    vertical: _Vertical = False,
    times: _Times = "auto",
    margins: _Margins = (5.0, 5.0),
    loss_weight: _LossWeight = 1.0,
    prune: _Prune = None,
    master: _Master = False,
    unit: _Unit = None,
    frequency_unit: _FrequencyUnit = None,
    temperature_unit: _TemperatureUnit = None,
    column: _Column = None,
    confirm: _Confirm = False,
    replicates: _Replicates = 400,
    origin: _Origin = "",
    source: _Source = "",
    card: _Card = None,
    figure: _Figure = None,
    study: _Study = None,
) -> None:
    """Shift and fit sweeps; write a material file that a study reads, with its quality and uncertainty.

    Example: tread-validate fit-prony reference_data/material/synthetic_sweeps.csv --band 0.25 2500 -o material.yaml
    """
    from ..instrument.quantities import DMA
    from ..material import RouteSettings, abaqus_card, read_route
    from ..material.material_file import material_yaml
    from .laboratory import checked_origin, provenance, reading_of, write_all

    _refuse_contradictions(times, (fit_wlf, free, energy is not None, shifts is not None), vertical, band)
    units = {"--modulus-unit": unit, "--frequency-unit": frequency_unit, "--temperature-unit": temperature_unit}
    reading = reading_of(column, units, DMA)
    kind, told = checked_origin(sweeps[0], origin, source)
    settings = RouteSettings(
        terms=terms,
        band=band,
        high_margin=margins[0],
        low_margin=margins[1],
        times=cast(Literal["auto", "even", "refined"], times),
        loss_weight=loss_weight,
        largest_error=None if prune is None else prune / 100.0,
        fit_wlf=fit_wlf,
        vertical="fitted" if vertical else "none",
        free=free,
        replicates=replicates,
    )
    law = _law_of((c1, c2, ts), energy, shifts)
    route = read_route(sweeps, law, reference, settings, None, confirm, master, reading)
    series = route.fit.series
    text = material_yaml(series, route.law, kind, told, route.quality(), provenance(*sweeps), poisson, density)
    files = {output: text}
    if card is not None:
        files[card] = f"** {kind} data: {told}\n" + abaqus_card(
            series, route.law, poissons_ratio=poisson, density=density
        )
    write_all(files)
    if figure is not None:
        from . import laboratory_figures as draw

        mark = ", synthetic" if kind == "synthetic" else ""
        draw.save(figure, (9.4, 6.6), lambda canvas: draw.material(route, canvas, mark))
    _tell_needs(route, study)
    _tell(route, f"{kind} data: {told}", reference, (c1, c2, ts), (poisson, density))
    typer.echo(f"wrote {output}")


def _law_of(constants: tuple[float, float, float], energy: float | None, table: Path | None) -> TimeShift:
    """Return the law to shift by: a table, an activation energy in kJ/mol, or WLF constants C1, C2, Ts (K, degC)."""
    from ..material.shifts import read_shift_table
    from ..study import ArrheniusShift, Wlf

    if table is not None:
        return read_shift_table(table)
    if energy is not None:
        return ArrheniusShift(kind="arrhenius", activation_energy_kJ_mol=energy)
    c1, c2, ts = constants
    return Wlf(c1=c1, c2_K=c2, reference_temperature_degC=ts)


def _refuse_contradictions(
    times: str, shifts: tuple[bool, ...], vertical: bool, band: tuple[float, float] | None
) -> None:
    """Raise `InputError` for options that exclude each other; `shifts`: kinds asked for, the WLF fit first."""
    from typing import get_args

    from ..errors import InputError
    from ..material.route_result import Times

    if times not in get_args(Times):
        raise InputError("--times", times, f"one of {', '.join(get_args(Times))}")
    if sum(shifts) > 1:
        raise InputError("shift", "several kinds", "one of --fit-wlf, --free-shift, --arrhenius-kJ-mol, --shift-table")
    if vertical and not shifts[0]:
        raise InputError("--vertical-shift", "given constants", "--fit-wlf with it")
    if band is not None and not 0 < band[0] < band[1]:
        raise InputError("--band", f"{band[0]:g} {band[1]:g}", "0 < LOW < HIGH")


def _tell_needs(route: MaterialRoute, study: Path | None) -> None:
    """Print the frequencies that a study's runs need against those that were measured, and the errors there."""
    from ..material.worth import REFUSE_ABOVE, worth_for
    from ..study import load_study

    if study is None:
        low, high = route.band
        typer.echo(f"fitted to {low:.3g} to {high:.3g} rad/s; --study tells whether the runs of a study need more")
        return
    worth = worth_for(load_study(study).cases(), route, "of this fit")
    for line in worth.lines():
        typer.echo(line, err=line.startswith("warning"))
    if (worth.largest_error or 0.0) > REFUSE_ABOVE:
        typer.echo(f"warning: above {100 * REFUSE_ABOVE:g} % the study refuses it", err=True)


def _tell(
    route: MaterialRoute,
    origin: str,
    reference: float,
    constants: tuple[float, float, float],
    properties: tuple[float, float],
) -> None:
    """Print how the files were read, how good the series is and what to beware of."""
    from ..material.worth import REFUSE_ABOVE, WARN_ABOVE

    for line in route.understood:
        typer.echo(f"read: {line}")
    typer.echo(origin)
    for key, merit in route.quality().items():
        typer.echo(f"{key}: {merit}")
    if route.wlf_fit is not None:
        fitted, (d1, d2) = route.wlf_fit.wlf, route.wlf_fit.deviations
        typer.echo(
            f"fitted WLF at {reference:g} degC: C1 = {fitted.c1:.4f} +- {1.96 * d1:.4f}, "
            f"C2 = {fitted.c2_K:.2f} +- {1.96 * d2:.2f} K (95 %)"
        )
    typer.echo(f"shift: {_shift_told(route, constants)}")
    if route.overlap is not None and route.overlap.apart:
        typer.echo(
            f"warning: {route.overlap.apart} pair(s) of neighbouring sweeps share no band: nothing holds their shift"
        )
    if route.overlap is not None and route.overlap.misfit > POOR_OVERLAP:
        typer.echo(
            f"warning: neighbouring sweeps lie {100 * route.overlap.misfit:.3g} % apart where they overlap: another "
            "shift (--fit-wlf, --free-shift, --shift-table)?"
        )
    if properties == (0.47, 1000.0):
        typer.echo("not given, so the paper's: Poisson's ratio 0.47, 1000 kg/m3")
    worst = max(route.fit.storage_rms, route.fit.loss_rms)
    if worst > WARN_ABOVE:
        after = f"; above {100 * REFUSE_ABOVE:g} % a study refuses it" if worst > REFUSE_ABOVE else ""
        typer.echo(f"warning: the fit misses the data by {100 * worst:.3g} % RMS{after}")
    if route.bands_refused:
        typer.echo(f"warning: no bands: {route.bands_refused}")
    if not route.consistency.consistent:
        typer.echo("warning: storage and loss modulus are not consistent with each other (Kramers-Kronig)")


def _shift_told(route: MaterialRoute, constants: tuple[float, float, float]) -> str:
    from ..material.time_shift import told
    from ..study import Wlf

    if not isinstance(route.law, Wlf):
        return (
            f"{'free: ' if route.settings.free else ''}{told(route.law)}; in the file as it is (the nearest WLF law "
            f"would miss it by up to {route.wlf_apart:.3g} decades)"
        )
    if route.settings.fit_wlf:
        return "constants fitted to the overlap of the sweeps"
    return "the paper's constants, none were given" if constants == (8.86, 101.6, 10.0) else "constants as given"
