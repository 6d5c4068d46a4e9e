"""Belt heights and curvature (the paper's Fig. 8), sketches of rig and belt, and the mesh of a deck."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import meshio
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path as MeshPath
from numpy.typing import NDArray

from ...geometry import Path as BlockPath
from ...geometry import path_of
from ...palette import BLACK, BLUE, GREEN, ORANGE, VERMILION
from ...plotting import WIDTH
from ...study import Case
from ...units import MM
from ..content import Mark
from .style import Drawn, draw

REACH = 0.16  # m: how far on either side of the patch's middle the belt is drawn
# corner numbers of the six faces of an 8-node brick
FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
STYLES = ((BLUE, "-"), (VERMILION, "--"), (GREEN, ":"), (BLACK, "-."))


def belt_heights(folder: Path, paths: Mapping[str, Case], marks: tuple[Mark, ...]) -> Drawn:
    """Draw the height of every belt path over its flat level, with the points of a measured trace."""

    def paint(axes: Axes) -> None:
        arc = np.linspace(-REACH, REACH, 401)
        for (name, case), (color, style) in zip(paths.items(), STYLES, strict=False):
            x, y, _ = path_of(case).mount(arc)
            level = float(path_of(case).mount(0.0)[1])
            axes.plot(x / MM, (y - level) / MM, style, color=color, label=_named(name, case))
            for ridge in case.path.ridges(case.root):
                near = np.abs(ridge.x) <= REACH
                axes.plot(
                    ridge.x[near] / MM,
                    ridge.height[near] / MM,
                    "." if ridge.used else "-",
                    ms=2.5,
                    lw=0.6,
                    color=color if ridge.used else "#9aa3ab",
                    label=f"_ridge {ridge.name}",
                )
        axes.set(xlabel="distance from the middle of the patch, mm", ylabel="height over the flat patch, mm")
        axes.legend()

    caption = (
        "As the paper's Fig. 8(a). Lines: the path that the block's mount follows; points: smoothed heights of its "
        "ridge; thin grey: the other ridges."
    )
    return draw(folder, "belt-heights", "Height of the tyre belt", caption, paint, marks)


def belt_curvature(folder: Path, paths: Mapping[str, Case], marks: tuple[Mark, ...]) -> Drawn:
    """Draw the curvature of every belt path."""

    def paint(axes: Axes) -> None:
        arc = np.linspace(-REACH, REACH, 801)
        for (name, case), (color, style) in zip(paths.items(), STYLES, strict=False):
            line = path_of(case).line
            x, _, _ = line.mount(arc)
            axes.plot(x / MM, line.curvature(arc), style, color=color, lw=1.2, label=_named(name, case))
        axes.set(xlabel="distance from the middle of the patch, mm", ylabel="curvature, 1/m")
        axes.legend()

    caption = (
        "As the paper's Fig. 8(b): zero in the patch, about 2 1/m at its edge, up to about 5 1/m outside; unloaded "
        "belt 3 1/m."
    )
    return draw(folder, "belt-curvature", "Curvature of the tyre belt", caption, paint, marks)


def rig_sketch(folder: Path, case: Case, radii: tuple[float, float], marks: tuple[Mark, ...]) -> Drawn:
    """Draw the two wheels, of the radii in mm, to scale with the block in the middle of its contact."""
    small, big = radii
    depth = case.interference / MM

    def paint(axes: Axes) -> None:
        axes.add_patch(Circle((0, -big), big, fill=False, ec=BLACK, lw=1.2, label="big wheel"))
        axes.add_patch(
            Circle((0, small - depth), small - case.height / MM, fill=False, ec=BLUE, lw=1.2, label="small wheel")
        )
        axes.add_patch(Circle((0, small - depth), small, fill=False, ec=BLUE, lw=0.6, ls="--", label="tread surface"))
        _block(axes, path_of(case), (0.5,))
        axes.plot(0, small - depth, "+", color=BLUE)
        axes.annotate(f"big wheel, R₂ = {big:g} mm", (0, -0.45 * small), ha="center", fontsize=7.5)
        axes.annotate(f"small wheel, R₁ = {small:g} mm", (0, 1.25 * small), ha="center", fontsize=7.5)
        axes.annotate(
            "",
            (0.45 * small, 0.4 * small),
            (-0.45 * small, 0.4 * small),
            arrowprops={"arrowstyle": "->", "color": ORANGE},
        )
        axes.annotate("block's travel", (0, 0.47 * small), ha="center", fontsize=7.5)
        limits = {"xlim": (-2.0 * small, 2.0 * small), "ylim": (-0.75 * small, 2.1 * small)}
        axes.set(aspect="equal", xlabel="x, mm", ylabel="y, mm", **limits)

    caption = (
        f"To scale, block {case.block_name.replace('_', ' ')} in mid-contact at {depth:g} mm interference. x is the "
        "direction of travel; dashed: tread surface, flush with the block's face."
    )
    return draw(folder, "rig-sketch", "The two-wheel rig", caption, paint, marks)


def belt_sketch(folder: Path, case: Case, marks: tuple[Mark, ...]) -> Drawn:
    """Draw the belt path with the block entering, in the middle and leaving."""
    path = path_of(case)

    def paint(axes: Axes) -> None:
        x, y, _ = path.mount(np.linspace(-REACH, REACH, 301))
        axes.plot(x / MM, y / MM, color=BLUE, label="belt (mount of the block)")
        axes.axhline(0.0, color=BLACK, lw=1.2, label="road")
        _block(axes, path, (0.03, 0.5, 0.97))
        top = float(np.max(y)) / MM
        axes.annotate("", (40, 0.85 * top), (-40, 0.85 * top), arrowprops={"arrowstyle": "->", "color": ORANGE})
        axes.annotate("block's travel", (0, 0.88 * top), ha="center", fontsize=7.5)
        axes.set(xlabel="x, mm", ylabel="y, mm", ylim=(-0.1 * top, 1.35 * top))
        axes.legend(loc="upper center", ncols=2)

    caption = (
        "Stress-free block at three instants of the pass; heights are drawn larger than lengths. The block enters at "
        "the leading edge (left) and leaves at the trailing edge."
    )
    return draw(folder, "belt-sketch", f"The tyre belt, {_named(case.path_name, case)}", caption, paint, marks)


def track_sketch(folder: Path, case: Case, marks: tuple[Mark, ...]) -> Drawn:
    """Draw what is prescribed on a path where the block does not roll."""
    sketch = case.path.sketch(path_of(case))

    def paint(axes: Axes) -> None:
        for (label, (x, y)), (color, style) in zip(sketch.curves.items(), STYLES, strict=False):
            axes.plot(x, y, style, color=color, label=label)
        axes.set(xlabel=sketch.x_label, ylabel=sketch.y_label)
        axes.legend()

    caption = f"Prescribed motion of block {case.block_name.replace('_', ' ')} at {case.interference / MM:g} mm."
    key = f"track-sketch-{case.path_name}".replace("_", "-")
    return draw(folder, key, f"The flat track, {_named(case.path_name, case)}", caption, paint, marks)


def _block(axes: Axes, path: BlockPath, instants: tuple[float, ...]) -> None:
    s = np.linspace(0.0, path.profile.extent, 25)
    for share in instants:
        t = share * path.contact_duration
        top, face = path.at(s, t), path.free_face(s, t)
        x = np.concatenate([top.x, face[0][::-1]]) / MM
        y = np.concatenate([top.y, face[1][::-1]]) / MM
        axes.fill(x, y, color=ORANGE, alpha=0.55, lw=0, label="_stress-free block")


def mesh(folder: Path, file: Path, title: str, marks: tuple[Mark, ...], height: float) -> Drawn:
    """Draw the outside of the mesh of a block `height` mm high, contact face down."""
    if not file.is_file():
        return Drawn(None, f"{title}: no mesh at {file.parent.name}/{file.name}; the decks have not been written.")
    data = meshio.read(file)
    bricks = np.concatenate([block.data for block in data.cells if block.type == "hexahedron"])
    points = np.asarray(data.points, dtype=np.float64)
    used = np.unique(bricks)
    points = points - 0.5 * (points[used].min(axis=0) + points[used].max(axis=0))
    polygons = _visible(points, bricks)
    closed = np.concatenate([polygons, polygons[:, :1]], axis=1)

    def paint(axes: Axes) -> None:
        # one path for all: the faces that are seen of a block do not hide each other
        outline = MeshPath.make_compound_path(*(MeshPath(corners, closed=True) for corners in closed))
        axes.add_patch(PathPatch(outline, facecolor="#f4ead2", edgecolor="#3c4650", linewidth=0.3))
        axes.autoscale_view()
        axes.set(aspect="equal")
        axes.set_axis_off()

    size = np.ptp(points[used], axis=0)
    caption = (
        f"{len(bricks)} bricks, {used.size} nodes; block {height:.3g} mm high in a bounding box of {size[0]:.3g} x "
        f"{size[1]:.3g} x {size[2]:.3g} mm (its face follows the path); finer towards the contact face, shown on top."
    )
    nodes = (("x_mm", "y_mm", "z_mm"), np.round(points[used], 3).tolist())
    return draw(folder, f"mesh-{file.parent.name}", title, caption, paint, marks, (WIDTH, 2.7), numbers=nodes)


def _visible(points: NDArray[np.float64], bricks: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the outside faces that look at the viewer, in two dimensions, those furthest away first."""
    faces = bricks[:, FACES].reshape(-1, 4)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    outside = faces[np.sort(first[count == 1])]
    # the contact face lies at the lowest y: look at it from below, ahead and to the side
    right = np.array([0.83, 0.0, -0.56])
    towards = np.array([0.42, -0.66, 0.62])
    towards /= np.linalg.norm(towards)
    up = np.cross(right, towards)
    up = -up if up[1] > 0 else up
    corners = points[outside]
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    middle = corners.mean(axis=1)
    facing = np.abs(normal @ towards) > 1e-9 * np.linalg.norm(normal, axis=1)
    order = np.argsort(middle[facing] @ towards, kind="stable")
    corners = corners[facing][order]
    return np.stack([corners @ right, corners @ up], axis=-1)


def _named(name: str, case: Case) -> str:
    return name.replace("_", " ") + (f" ({case.path.origin})" if case.path.origin in ("synthetic", "assumed") else "")
