"""`tread-validate synthesize`: the synthetic laboratory data that ship with the package."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from .options import number

Array = NDArray[np.float64]


def command(
    output: Annotated[Path, typer.Option("-o", "--output", help="folder for material/, friction/, belt/, rig/")] = Path(
        "reference_data"
    ),
    study: Annotated[Path, typer.Option("--study", help="study whose surrogate compound and law are sampled")] = Path(
        "config/study.yaml"
    ),
    noise: Annotated[float, number("--noise-percent", "noise_percent", "of moduli and friction")] = 2.0,
    seed: Annotated[int, typer.Option("--seed", min=0, max=2**31, help="of every random number")] = 0,
    tdms: Annotated[bool, typer.Option("--tdms", help="write the rig record as TDMS too")] = False,
) -> None:
    """Write synthetic sweeps, tribometer table, ridge heights and rig record. Nothing in them was measured.

    Example: tread-validate synthesize -o reference_data
    """
    from ..errors import InputError
    from ..friction import law
    from ..friction.synthetic import synthetic_table
    from ..geometry.trace import RidgeHeights
    from ..geometry.trace_file import ridges_csv
    from ..geometry.trace_synthetic import synthetic_ridges
    from ..material.synthetic import sweeps_csv, synthetic_sweeps
    from ..reference.rig_synthetic import record_csv, synthetic_record, write_tdms
    from ..study import FractionalZener, Huemer, load_study
    from ..units import PERCENT
    from .laboratory import write_all

    loaded = load_study(study)
    compound = next((c for c in loaded.compounds().values() if isinstance(c, FractionalZener)), None)
    if compound is None:
        raise InputError(f"{study}: compounds", "no fractional_zener", "the surrogate that the sweeps are drawn from")
    friction = next((f for f in loaded.model.friction_laws.values() if isinstance(f, Huemer)), None)
    if friction is None:
        raise InputError(f"{study}: friction_laws", "no huemer", "the law that the table is drawn from")
    made = "tread-validate synthesize"
    ridges = synthetic_ridges(8 + seed)
    rig = synthetic_record(seed=6 + seed)
    files = {
        output / "material" / "synthetic_sweeps.csv": sweeps_csv(
            synthetic_sweeps(compound, noise * PERCENT, outliers=2, seed=1 + seed),
            {
                "origin": "synthetic",
                "source": f"surrogate compound (fractional Zener law) with {noise:g} % noise and 2 bad points; {made}",
            },
        ),
        output / "friction" / "synthetic_tribometer.csv": _table_csv(
            synthetic_table(law(friction), noise * PERCENT, 4 + seed),
            f"assumed Huemer law with {noise:g} % noise, three repeats; {made}",
        ),
        output / "belt" / "synthetic_ridges.csv": ridges_csv(
            RidgeHeights(ridges.position, ridges.heights, "synthetic"),
            {
                "origin": "synthetic",
                "source": "ridge heights with the published features of the loaded belt (flat patch of 0.17 m, "
                f"curvature 2, 5 and 3 1/m), 2 mm pitch, 10 um resolution; {made}",
            },
        ),
        output / "rig" / "synthetic_record.csv": record_csv(rig),
    }
    write_all(files)
    if tdms:
        path = output / "rig" / "synthetic_record.tdms"
        write_tdms(path, rig)
        files[path] = ""
    for path in files:
        typer.echo(f"wrote {path}")


def _table_csv(columns: tuple[Array, Array, Array], source: str) -> str:
    lines = ["# origin: synthetic", f"# source: {source}", "pressure_Pa,slip_speed_m_s,friction_coefficient"]
    lines += [f"{p:.6g},{v:.6g},{mu:.4f}" for p, v, mu in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"
