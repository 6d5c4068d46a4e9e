"""Rows of the runs: what was asked, what came out, and what it depends on."""

from __future__ import annotations

from collections.abc import Mapping

from ..quantities import SCALARS, Noise
from .row import TableColumn, TableRow, column, spread, table_row

ASSUMED = "assumed and synthetic inputs that the row depends on, `; ` between them"
SOURCE = "who made the run: `spring:<variant>`, `fe:<engine>`, `rig:measured`, `<kind>:published`"
STATUS = (
    "`current`, `other_code` (a reference made before its engine's code changed), `missing`, `stale`, `unbound`, "
    "`not_a_reference` (its record says that its energies or forces cannot be believed), "
    "`corrupt`, `no_contact`, `undefined` or `incomplete`"
)
NOTE = "why there is no value, or a word on it"


@table_row
class CaseRow(TableRow):
    """The conditions of one case."""

    table = "cases"
    title = "The cases of the study and their conditions"
    key = ("case_id",)

    case_id: str = column("name of the case")
    run: str = column("run of the study that it belongs to")
    path: str = column("path of the study that the block takes")
    block: str = column("block of the study")
    compound: str = column("compound of the study")
    friction: str = column("friction law of the study")
    poissons_ratio: float = column("Poisson's ratio of the rubber")
    temperature_degC: float = column("temperature of the rubber", "degC")
    interference_mm: float = column("largest compression of the block", "mm")
    speed_m_s: float = column("speed of the surface", "m/s")
    speed_rpm: float | None = column("speed of the small wheel, on a rig", "1/min")
    creep_percent: float | None = column("creep ratio: road faster than block", "%", noise=Noise(1e-5, 1e-7))
    free_rolling: bool = column("whether the creep ratio is that of no net longitudinal impulse")
    measured_profile: bool = column("whether the path is a measured trace")
    shape: str = column("plan of the block: rectangle or parallelogram")
    assumed: str = column(ASSUMED)
    case_digest: str = column("SHA-256 of all inputs of the case")


@table_row
class PeakRow(TableRow):
    """The scalars of one run; empty where it has none."""

    table = "peaks"
    title = "Scalars of every run of every source"
    key = ("source", "case_id")

    source: str = column(SOURCE)
    case_id: str = column("name of the case")
    rig: bool = column("whether the case is one of the two-wheel rig")
    shape: str = column("plan of the block")
    path: str = column("path of the study")
    block: str = column("block of the study")
    temperature_degC: float = column("temperature of the rubber", "degC")
    interference_mm: float = column("largest compression of the block", "mm")
    speed_m_s: float = column("speed of the surface", "m/s")
    values: Mapping[str, float | None] = spread(
        {
            item.name: TableColumn(
                item.column, "number", "" if item.unit == "1" else item.unit, item.label, True, item.noise
            )
            for item in SCALARS
        }
    )
    peak_pressure_MPa: float | None = column(
        "largest normal force over the area of the face", "MPa", noise=Noise(5e-6, 1e-7)
    )
    status: str = column(STATUS)
    note: str = column(NOTE, free=True)
    history_sha256: str = column("SHA-256 of the history file; empty where there is none", free=True)
    folder: str = column("where a reference run lies, below the reference folder; empty for other runs", free=True)
    assumed: str = column(ASSUMED)

    @property
    def peak_normal_force_N(self) -> float | None:
        """The largest normal force, N."""
        return self.values.get("peak_normal_force")


@table_row
class AssumedRow(TableRow):
    """An input that is assumed or synthetic."""

    table = "assumed"
    title = "Assumed and synthetic inputs, and how many cases depend on each"
    key = ("input", "origin")

    input: str = column("the input")
    origin: str = column("`assumed` or `synthetic`")
    source: str = column("what stands in, and why")
    cases: int = column("cases that depend on it")
