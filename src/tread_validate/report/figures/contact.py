"""Pressure and shear on the contact face in the middle of the pass: along every model, and over the FE face."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from scipy.interpolate import LinearNDInterpolator

from ...columns import read_columns
from ...geometry import path_of
from ...palette import VERMILION, Look
from ...plotting import HEIGHT, WIDTH
from ...spring import FaceAtInstant, face_at
from ...spring.variants import BUILT_IN
from ...study import Case
from ...units import IN_MS, MM, MPA
from .. import wording
from ..content import Mark
from .style import Drawn, draw, draw_pair

Array = NDArray[np.float64]

STATIONS = 121  # along the face, and across it
FEWEST = 6  # stations across: at a sharp corner there are too few for a mean
SLIPS = 2  # state of a node that slides


@dataclass(frozen=True)
class FaceTable:
    """The nodes of the contact face of an FE run, half way between the first and the last contact; all (n,) arrays.

    Attributes
    ----------
    place, across : m
        From the end that makes contact first, and across the block; of the undeformed block.
    pressure, shear : Pa
        Shear is positive towards the leading edge.
    slides : bool
    """

    place: Array
    across: Array
    pressure: Array
    shear: Array
    slides: NDArray[np.bool_]


def read_face(file: Path) -> FaceTable | None:
    """Read the contact face of an FE run; None without one. The first end to touch has the largest x."""
    if not file.is_file():
        return None
    face = read_columns(file, ("x_m", "z_m", "pressure_Pa", "traction_x_Pa", "state"))
    x = face["x_m"]
    return FaceTable(x.max() - x, face["z_m"], face["pressure_Pa"], -face["traction_x_Pa"], face["state"] == SLIPS)


def pressure(
    folder: Path,
    case: Case,
    label: str,
    face: FaceTable | None,
    engine: str,
    looks: Mapping[str, Look],
    marks: tuple[Mark, ...],
) -> Drawn:
    """Draw contact pressure and shear traction along the block, by every built-in model and by FE.

    Every line is a mean over the block's width. A model without a face of its own is left out.
    """
    instant = 0.5 * path_of(case).contact_duration
    models = {source: own for source in looks if (own := _face_of(case, instant, source)) is not None}
    rows = _means(face)
    reference = next((looks[source] for source in looks if source.startswith("fe:")), None)

    def paint(pressures: Axes, shears: Axes) -> None:
        for source, own in models.items():
            look, place = looks[source], own.place / MM
            style: dict[str, Any] = {"color": look.color, "ls": look.line, "lw": 1.3, "label": wording.source(source)}
            pressures.plot(place, own.contact_pressure / MPA, **style)
            shears.plot(place, own.shear_traction / MPA, **style)
            slips = own.slips & (own.contact_pressure > 0.0)
            name = f"_{wording.source(source)}, sliding"
            shears.plot(
                place[slips], own.shear_traction[slips] / MPA, "o", ms=3, color=look.color, mfc="none", label=name
            )
        if rows is not None and reference is not None:
            style = {"color": reference.color, "ls": reference.line, "lw": 1.3, "label": engine}
            pressures.plot(rows[0] / MM, rows[1] / MPA, **style)
            shears.plot(rows[0] / MM, rows[2] / MPA, **style)
        for axes, name in ((pressures, "contact pressure, MPa"), (shears, "shear traction, MPa")):
            axes.axhline(0.0, color="#57606a", lw=0.7)
            axes.set(xlabel="distance from the end of first contact, mm", ylabel=name)

    caption = (
        f"{label}, {IN_MS * instant:.2f} ms after first contact; means over the width. Shear of the road on the block, "
        "positive towards the leading edge; rings: sliding."
    )
    return draw_pair(
        folder, f"pressure-{case.case_id}", "Traction on the contact face in mid-contact", caption, paint, marks
    )


def _face_of(case: Case, instant: float, source: str) -> FaceAtInstant | None:
    """Return the face of a built-in model; None of any other source."""
    kind, _, variant = source.partition(":")
    return face_at(case, instant, variant=variant) if kind == "spring" and variant in BUILT_IN else None


def pressure_map(folder: Path, case: Case, label: str, face: FaceTable, engine: str, marks: tuple[Mark, ...]) -> Drawn:
    """Draw the contact pressure over the face of an FE run."""
    place, across, values = face.place / MM, face.across / MM, face.pressure / MPA
    top = float(np.quantile(values, 0.97)) or 1.0

    def paint(axes: Axes) -> None:
        shown = axes.tripcolor(
            place, across, values, shading="gouraud", cmap="cividis", vmin=0.0, vmax=top, rasterized=True
        )
        axes.figure.colorbar(shown, ax=axes, label="contact pressure, MPa", extend="max", shrink=0.85)
        if face.slides.any():
            axes.plot(place[face.slides], across[face.slides], ".", ms=3, color=VERMILION, label="sliding")
            axes.legend(loc="upper right", frameon=True)
        axes.set(aspect="equal", xlabel="distance from the end that makes contact first, mm", ylabel="across, mm")
        axes.grid(visible=False)

    caption = f"{label}. {engine}. Largest value {values.max():.2f} MPa; the scale ends at the 97th percentile."
    size = (WIDTH, HEIGHT + 0.3)
    header = ("x_mm", "across_mm", "contact_pressure_MPa")
    numbers = (header, zip(place.tolist(), across.tolist(), values.tolist(), strict=True))
    key = f"pressure-map-{case.case_id}"
    return draw(folder, key, "Contact pressure over the face, FE", caption, paint, marks, size, numbers=numbers)


def _means(face: FaceTable | None) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]] | None:
    """Return place, mean pressure and mean shear (positive towards the leading edge) of lines across the face.

    The nodal values are interpolated linearly, so that the nodes need not stand in rows across.
    """
    if face is None:
        return None
    nodes = np.column_stack([face.place, face.across])
    values = np.column_stack([face.pressure, face.shear])
    places = np.linspace(nodes[:, 0].min(), nodes[:, 0].max(), STATIONS)
    across = np.linspace(nodes[:, 1].min(), nodes[:, 1].max(), STATIONS)
    grid = LinearNDInterpolator(nodes, values)(*np.meshgrid(places, across, indexing="ij"))
    inside = np.isfinite(grid[:, :, 0])
    share = np.maximum(inside.sum(axis=1), 1)[:, None]
    means = np.where(inside[:, :, None], grid, 0.0).sum(axis=1) / share
    seen = inside.sum(axis=1) > FEWEST
    return places[seen], means[seen, 0], means[seen, 1]
