"""Pressure and shear along the contact face in the middle of the pass."""

from __future__ import annotations

from pathlib import Path

from matplotlib.axes import Axes

from ...geometry import path_of
from ...spring import face_at
from ...study import Case
from ...units import MM, MPA
from ..content import Mark
from ..palette import BLUE, ORANGE, VERMILION
from .style import Drawn, draw


def pressure(folder: Path, case: Case, label: str, marks: tuple[Mark, ...]) -> Drawn:
    """Draw contact pressure and shear traction along the block, by the spring model of the paper."""
    instant = 0.5 * path_of(case).contact_duration
    face = face_at(case, instant)
    place = face.place / MM

    def paint(axes: Axes) -> None:
        axes.plot(place, face.contact_pressure / MPA, color=BLUE, label="contact pressure")
        axes.plot(place, face.shear_traction / MPA, "--", color=VERMILION, label="shear traction")
        slips = face.slips & (face.contact_pressure > 0.0)
        if slips.any():
            axes.plot(place[slips], face.shear_traction[slips] / MPA, "o", ms=3.5, color=ORANGE, label="slipping")
        axes.axhline(0.0, color="#57606a", lw=0.7)
        axes.set(xlabel="distance from the end that touches first, mm", ylabel="traction, MPa")
        axes.legend()

    caption = (
        f"{label}, {1e3 * instant:.2f} ms after first touch. Spring (paper), one value an element, mean over the "
        "block's width; shear of the road on the block, positive towards the leading edge."
    )
    return draw(
        folder, f"pressure-{case.case_id}", "Traction on the contact face in mid-contact", caption, paint, marks
    )
