"""Ridge heights as a measuring machine exports them, belt files, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.geometry import read_belt_trace
from tread_validate.geometry.belt_file import read_belt
from tread_validate.geometry.trace import level
from tread_validate.geometry.trace_import import read_ridges

Lines = list[str]


@pytest.fixture(scope="module")
def shipped(root: Path) -> Path:
    return root / "reference_data" / "belt"


@pytest.fixture
def lines(shipped: Path) -> Lines:
    return (shipped / "synthetic_ridges.csv").read_text(encoding="utf-8").splitlines()


def write(folder: Path, lines: Lines) -> Path:
    path = folder / "ridges.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def cell(line: int, column: int, value: str) -> Callable[[Lines], None]:
    def alter(lines: Lines) -> None:
        cells = lines[line - 1].split(",")
        cells[column] = value
        lines[line - 1] = ",".join(cells)

    return alter


def without(line: int) -> Callable[[Lines], None]:
    return lambda lines: lines.pop(line - 1) and None


def scaled(factor: float, columns: slice) -> Callable[[Lines], None]:
    def alter(lines: Lines) -> None:
        for k in range(3, len(lines)):
            cells = lines[k].split(",")
            cells[columns] = [f"{float(c) * factor:.6g}" if c else "" for c in cells[columns]]
            lines[k] = ",".join(cells)

    return alter


def test_raw_heights_serve_a_study_as_the_imported_file_does(shipped: Path) -> None:
    """`measured_belt` may name either file: the same line to 0.1 um in x and 1 nm in height."""
    raw = read_belt_trace(shipped / "synthetic_ridges.csv", "mid_top")
    ready = read_belt_trace(shipped / "synthetic_belt.yaml", "mid_top")
    np.testing.assert_allclose(raw[0], ready[0], atol=1e-7)
    np.testing.assert_allclose(raw[1], ready[1], atol=1e-9)


def test_shipped_belt_reaches_far_enough_and_is_level(shipped: Path) -> None:
    """At least 150 mm beyond a patch of 170 mm on both sides; height 0 on the patch, away from the road beyond."""
    for x, height in read_belt(shipped / "synthetic_belt.yaml").values():
        assert x[0] < -0.235
        assert x[-1] > 0.235
        assert np.all(height >= 0)
        assert np.all(height[np.abs(x) < 0.075] == 0)


@pytest.mark.parametrize(
    ("alter", "reason"),
    [
        (cell(53, 0, "99.3"), r"ridges.csv:53: position_mm: got a step of 3.3 mm, expected the pitch of 2 mm"),
        (without(60), r"ridges.csv:60: position_mm.*a step of 4 mm"),
        (cell(40, 2, "12,5"), r"ridges.csv:40"),
        (cell(40, 2, "x"), r"ridges.csv:40: mid_top_mm.*a number"),
        (cell(41, 0, ""), r"ridges.csv:41: position_mm"),
        (scaled(1000.0, slice(1, None)), "is it um"),
        (scaled(1e-3, slice(0, 1)), "is it m or um"),
        (cell(3, 0, "x_mm"), "column position_mm"),
    ],
)
def test_wrong_ridges_are_refused_with_line_and_reason(
    tmp_path: Path, lines: Lines, alter: Callable[[Lines], None], reason: str
) -> None:
    alter(lines)
    with pytest.raises(InputError, match=reason):
        read_ridges(write(tmp_path, lines))


def test_heights_towards_the_road_are_refused_and_turned_on_request(tmp_path: Path, lines: Lines) -> None:
    scaled(-1.0, slice(1, None))(lines)
    path = write(tmp_path, lines)
    with pytest.raises(InputError, match="--invert"):
        level(read_ridges(path))
    assert level(read_ridges(path, invert=True))[1].patch_length.value == pytest.approx(0.169, abs=0.002)


def test_an_unloaded_belt_has_no_patch() -> None:
    x = np.arange(120) * 2e-3
    from tread_validate.geometry.trace import RidgeHeights

    with pytest.raises(InputError, match="flat patch"):
        level(RidgeHeights(x, {"mid": (x - 0.12) ** 2 * 1.5}, "unloaded"))


def test_an_unknown_ridge_is_refused(shipped: Path) -> None:
    with pytest.raises(InputError, match="one of top, mid_top"):
        read_belt_trace(shipped / "synthetic_ridges.csv", "middle")
