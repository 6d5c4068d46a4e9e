"""Pressure and shear on the contact face in the middle of the pass: along the springs, and over the FE face."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ...geometry import path_of
from ...palette import BLACK, BLUE, GREY, ORANGE, VERMILION
from ...plotting import HEIGHT, WIDTH
from ...spring import face_at
from ...study import Case
from ...units import IN_MS, MM, MPA
from ..content import Mark
from ..tables import read_table
from .style import Drawn, draw

FACE_COLUMNS = ("x_m", "y_m", "z_m", "pressure_Pa", "traction_x_Pa", "traction_z_Pa", "state")


def read_face(file: Path) -> pd.DataFrame | None:
    """Read the contact face of an FE run, with ``place_m`` from the end that makes contact first; None without one.

    Places are those of the undeformed block; the first end to touch has the largest x. The instant is half way
    between the first and the last contact.
    """
    if not file.is_file():
        return None
    face = read_table(file, FACE_COLUMNS)
    return face.assign(place_m=face["x_m"].max() - face["x_m"]) if len(face) else None


def pressure(
    folder: Path, case: Case, label: str, face: pd.DataFrame | None, engine: str, marks: tuple[Mark, ...]
) -> Drawn:
    """Draw contact pressure and shear traction along the block, by the spring model of the paper and by FE.

    The FE face is drawn as the mean over the block's width, where its nodes stand in rows across.
    """
    instant = 0.5 * path_of(case).contact_duration
    springs = face_at(case, instant)
    place = springs.place / MM
    rows = _means(face)

    def paint(axes: Axes) -> None:
        axes.plot(place, springs.contact_pressure / MPA, color=BLUE, label="pressure, springs")
        axes.plot(place, springs.shear_traction / MPA, "--", color=VERMILION, label="shear, springs")
        slips = springs.slips & (springs.contact_pressure > 0.0)
        if slips.any():
            axes.plot(place[slips], springs.shear_traction[slips] / MPA, "o", ms=3.5, color=ORANGE, label="slipping")
        if rows is not None:
            axes.plot(rows[0] / MM, rows[1] / MPA, color=BLACK, lw=1.0, label="pressure, FE")
            axes.plot(rows[0] / MM, rows[2] / MPA, "--", color=GREY, lw=1.0, label="shear, FE")
        axes.axhline(0.0, color="#57606a", lw=0.7)
        axes.set(xlabel="distance from the end that makes contact first, mm", ylabel="traction, MPa")
        axes.margins(y=0.2)
        axes.legend(ncols=2, loc="upper right")

    caption = (
        f"{label}, {IN_MS * instant:.2f} ms after first contact. Spring (paper): one value an element. "
        + (f"{engine}: mean over the block's width. " if rows is not None else "")
        + "Shear of the road on the block, positive towards the leading edge."
    )
    return draw(
        folder, f"pressure-{case.case_id}", "Traction on the contact face in mid-contact", caption, paint, marks
    )


def pressure_map(
    folder: Path, case: Case, label: str, face: pd.DataFrame, engine: str, marks: tuple[Mark, ...]
) -> Drawn:
    """Draw the contact pressure over the face of an FE run."""
    place, across = face["place_m"].to_numpy(dtype=float) / MM, face["z_m"].to_numpy(dtype=float) / MM
    values = face["pressure_Pa"].to_numpy(dtype=float) / MPA
    top = float(np.quantile(values, 0.97)) or 1.0

    def paint(axes: Axes) -> None:
        shown = axes.tripcolor(
            place, across, values, shading="gouraud", cmap="cividis", vmin=0.0, vmax=top, rasterized=True
        )
        axes.figure.colorbar(shown, ax=axes, label="contact pressure, MPa", extend="max", shrink=0.85)
        slips = face["state"].to_numpy() == 2
        if slips.any():
            axes.plot(place[slips], across[slips], ".", ms=3, color=VERMILION, label="slipping")
            axes.legend(loc="upper right", frameon=True)
        axes.set(aspect="equal", xlabel="distance from the end that makes contact first, mm", ylabel="across, mm")
        axes.grid(visible=False)

    caption = f"{label}. {engine}. Largest value {values.max():.2f} MPa; the scale ends at the 97th percentile."
    size = (WIDTH, HEIGHT + 0.3)
    header = ("x_mm", "across_mm", "contact_pressure_MPa")
    numbers = (header, zip(place.tolist(), across.tolist(), values.tolist(), strict=True))
    key = f"pressure-map-{case.case_id}"
    return draw(folder, key, "Contact pressure over the face, FE", caption, paint, marks, size, numbers=numbers)


def _means(face: pd.DataFrame | None) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]] | None:
    """Return place, mean pressure and mean shear (positive towards the leading edge) of the rows across the face."""
    if face is None:
        return None
    places, row, count = np.unique(
        np.round(face["place_m"].to_numpy(dtype=float), 9), return_inverse=True, return_counts=True
    )
    if np.unique(count).size > 1 or count[0] < 2:
        return None  # a parallelogram's nodes do not stand in rows across
    found = []
    for column, sign in (("pressure_Pa", 1.0), ("traction_x_Pa", -1.0)):
        ordered = face.assign(row=row).sort_values(["row", "z_m"], kind="stable")
        values = ordered[column].to_numpy(dtype=float).reshape(places.size, -1)
        across = ordered["z_m"].to_numpy(dtype=float).reshape(places.size, -1)
        found.append(sign * np.trapezoid(values, across, axis=1) / np.ptp(across, axis=1))
    return places, found[0], found[1]
