"""Blocks beyond the plain brick: sipes of partial depth, drafted walls, meshes of the user's own."""

from __future__ import annotations

import math
import runpy
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import ValidationError

from tread_validate import deck
from tread_validate.deck.block_mesh import BlockMesh
from tread_validate.deck.lint import lint
from tread_validate.deck.mesh import block_mesh
from tread_validate.errors import InputError
from tread_validate.fe import run_deck
from tread_validate.geometry.mesh_file import TURNED, _jacobians
from tread_validate.study import Block, Case, DeckSettings, load_study

FloatArray = NDArray[np.float64]
SETTINGS = DeckSettings(element_size_mm=2.0, layers=5, symmetry="full")
PLAIN = {
    "origin": "assumed", "source": "test", "shape": "rectangle", "length_mm": 24.0, "width_mm": 18.0, "height_mm": 8.0,
    "mounting": "flat",
}  # fmt: skip


def block(**changes: Any) -> Block:
    return Block.model_validate({**PLAIN, **changes})


def _points(mesh: BlockMesh, height: float = 8.0) -> FloatArray:
    return np.column_stack([-mesh.s, mesh.u * height, mesh.z])


def _volume(mesh: BlockMesh) -> float:
    """Volume of hexahedra with planar or ruled faces, by 2 x 2 x 2 Gauss points: exact."""
    corners = _points(mesh)[mesh.elements]
    local = np.array([[x, y, z] for z in (-1, 1) for y, x in ((-1, -1), (-1, 1), (1, 1), (1, -1))], dtype=float)
    total = np.zeros(len(corners))
    for at in local / np.sqrt(3.0):
        f = 1.0 + local * at
        g = 0.125 * np.stack([local[:, 0] * f[:, 1] * f[:, 2], local[:, 1] * f[:, 0] * f[:, 2],
                              local[:, 2] * f[:, 0] * f[:, 1]])  # fmt: skip
        total += np.linalg.det(g @ corners)
    assert (_jacobians(corners)[0] > 0).all()
    return float(total.sum())


@pytest.mark.parametrize("skew", [0.0, 25.0])
def test_a_blind_sipe_takes_its_depth_of_rubber_and_leaves_the_rest(skew: float) -> None:
    """0.6 mm x 5 mm x 18 mm of 24 x 18 x 8 mm; the face is open there, the mount is whole."""
    shape = {"shape": "parallelogram", "skew_deg": skew} if skew else {}
    mesh = block_mesh(block(sipes=[{"position_mm": 11.0, "width_mm": 0.6, "depth_mm": 5.0}], **shape), SETTINGS)
    assert _volume(mesh) == pytest.approx(18.0 * (24.0 * 8.0 - 0.6 * 5.0), rel=1e-12)
    assert np.unique(mesh.elements).size == mesh.s.size
    assert np.any(np.isclose(mesh.u, 5.0 / 8.0))


def test_a_sipe_as_deep_as_it_can_be_is_nearly_a_cut_through() -> None:
    """Depths grow to the height: the rubber that is left goes to that of a block cut through."""
    volumes = [
        _volume(block_mesh(block(sipes=[{"position_mm": 11.0, "width_mm": 0.6, "depth_mm": depth}]), SETTINGS))
        for depth in (7.0, 7.9)
    ]
    cut = _volume(block_mesh(block(sipes=[{"position_mm": 11.0, "width_mm": 0.6}]), SETTINGS))
    gaps = [volume - cut for volume in volumes]
    np.testing.assert_allclose(gaps, [0.6 * 18.0 * 1.0, 0.6 * 18.0 * 0.1], rtol=1e-9)


def test_a_draft_makes_a_frustum_whose_face_keeps_its_size() -> None:
    """tan 6 deg x 8 mm more on every side at the mount: (h/3)(A1 + A2 + ...) with linear sides, exact."""
    mesh = block_mesh(block(draft_deg=6.0), SETTINGS)
    grown = 8.0 * math.tan(math.radians(6.0))
    face, mount = _points(mesh)[mesh.face_nodes], _points(mesh)[mesh.mount_nodes]
    np.testing.assert_allclose(np.ptp(face, axis=0), [24.0, 0.0, 18.0], atol=1e-12)
    np.testing.assert_allclose(np.ptp(mount, axis=0), [24.0 + 2 * grown, 0.0, 18.0 + 2 * grown], atol=1e-12)
    exact = 8.0 * (24.0 * 18.0 + grown * (24.0 + 18.0) + 4.0 / 3.0 * grown**2)
    assert _volume(mesh) == pytest.approx(exact, rel=1e-12)


def test_a_draft_leaves_the_walls_of_sipes_upright() -> None:
    sipe = {"position_mm": 10.0, "width_mm": 1.0}
    mesh = block_mesh(block(draft_deg=6.0, sipes=[sipe]), SETTINGS)
    for wall in (10.0, 11.0):
        on_wall = np.isclose(mesh.s, wall, atol=1e-9)
        assert set(np.round(mesh.u[on_wall], 6)) == set(np.round(np.unique(mesh.u), 6))


@pytest.mark.parametrize(
    "changes",
    [
        {"sipes": [{"position_mm": 11.0, "width_mm": 0.6, "depth_mm": 8.0}]},
        {"sipes": [{"position_mm": 11.0, "width_mm": 0.6, "depth_mm": 0.0}]},
        {"draft_deg": -1.0},
        {"mesh": "a.vtu", "draft_deg": 3.0},
        {"mesh": "a.vtu", "mesh_unit": "inch"},
    ],
)
def test_shapes_that_are_none_are_refused_by_the_study(changes: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        block(**changes)


def test_a_blind_sipe_lies_between_the_whole_block_and_the_cut_one(
    belt_case: Case, coarse: Callable[[Case], Case], tmp_path: Path
) -> None:
    """Peak normal force: a 5 mm sipe of 8 mm takes part of the stiffness that a cut through takes."""
    peaks = []
    for depth in (None, 5.0, 0.0):
        sipes = [] if depth == 0.0 else [{"position_mm": 12.0, "width_mm": 0.8, "depth_mm": depth}]
        one = type(belt_case.block).model_validate({**belt_case.block.model_dump(), "sipes": sipes})
        case = replace(belt_case, block=one, deck=DeckSettings(element_size_mm=2.5, layers=3))
        deck.write(case, tmp_path)
        assert lint(tmp_path / f"{case.case_id}.inp") == []
        peaks.append(run_deck(tmp_path / f"{case.case_id}.inp", tmp_path / "vfric.f").history.normal_force.max())
    cut, blind, whole = peaks
    assert 1.03 * cut < blind < 0.97 * whole


# meshes of the user's own -------------------------------------------------------------------------------------------


def _file(folder: Path, name: str = "mine.vtu", unit: float = 1.0, shuffle: bool = True, **changes: Any) -> Path:
    """Write the plain block's mesh as a user might: nodes in any order, hexahedra turned in any of six ways."""
    mesh = block_mesh(block(), SETTINGS)
    points, elements = _points(mesh) + np.array([3.0, 50.0, -7.0]), mesh.elements.copy()
    if shuffle:
        random = np.random.default_rng(5)
        order = random.permutation(points.shape[0])
        elements = np.argsort(order)[elements]
        points = points[order]
        elements = np.array([one[TURNED[random.integers(6)]] for one in elements])
    points = changes.get("points", lambda p: p)(points) * unit
    elements = changes.get("elements", lambda e: e)(elements)
    meshio.write(folder / name, meshio.Mesh(points, [(changes.get("cell", "hexahedron"), elements)]))
    return folder / name


@pytest.mark.parametrize(("name", "unit"), [("mine.vtu", 1.0), ("mine.inp", 1.0), ("metres.vtu", 1e-3)])
def test_a_block_from_a_mesh_file_is_the_block_meshed_here(name: str, unit: float, tmp_path: Path) -> None:
    """The same volume, face, mount and face elements, whatever the order of nodes and corners."""
    _file(tmp_path, name, unit)
    mine = block_mesh(block(mesh=name, mesh_unit="mm" if unit == 1.0 else "m"), SETTINGS, tmp_path)
    own = block_mesh(block(), SETTINGS)
    assert _volume(mine) == pytest.approx(_volume(own), rel=1e-9)
    assert mine.face_elements.size == own.face_elements.size
    np.testing.assert_allclose(np.ptp(mine.s[mine.face_nodes]), 24.0)
    assert mine.s[mine.face_nodes].min() == pytest.approx(0.0, abs=1e-9)
    for nodes in ("face_nodes", "mount_nodes"):
        a, b = ({tuple(np.round([m.s[i], m.z[i]], 6) + 0.0) for i in getattr(m, nodes)} for m in (mine, own))
        assert a == b


def test_a_deck_of_a_mesh_file_runs_like_the_one_meshed_here(
    belt_case: Case, coarse: Callable[[Case], Case], tmp_path: Path
) -> None:
    """The same block by file and by numbers: one history to 1e-4 of the peak (coordinates are written to 1e-5 mm)."""
    _file(tmp_path, "mine.vtu")
    forces = []
    for changes in ({}, {"mesh": "mine.vtu"}):
        case = replace(coarse(belt_case), block=block(**changes), deck=SETTINGS, root=tmp_path)
        deck.write(case, tmp_path / "deck")
        assert lint(tmp_path / "deck" / f"{case.case_id}.inp") == []
        forces.append(run_deck(tmp_path / "deck" / f"{case.case_id}.inp", tmp_path / "deck" / "vfric.f").history)
    own, mine = forces
    peak = own.normal_force.max()
    np.testing.assert_allclose(np.interp(own.time, mine.time, mine.normal_force), own.normal_force, atol=1e-3 * peak)
    assert mine.normal_force.max() == pytest.approx(peak, rel=1e-4)


def test_the_example_of_a_mesh_file_is_720_mm3_of_hexahedra_and_poses_clean_decks(root: Path, tmp_path: Path) -> None:
    example = root / "examples" / "mesh_block"
    shutil.copy(example / "study.yaml", tmp_path)
    runpy.run_path(str(example / "make_mesh.py"))["main"](tmp_path)
    for case in load_study(tmp_path / "study.yaml").cases():
        mesh = block_mesh(case.block, case.deck, tmp_path)
        assert len(mesh.elements) == 720
        assert mesh.face_elements.size == 12 * 10
        assert _volume(mesh) * 6.0 / 8.0 == pytest.approx(720.0, rel=1e-5)
        deck.write(case, tmp_path / case.case_id)
        assert lint(tmp_path / case.case_id / f"{case.case_id}.inp") == []


def _inside_out(elements: NDArray[np.int64]) -> NDArray[np.int64]:
    folded = elements.copy()
    folded[3] = folded[3, [4, 5, 6, 7, 0, 1, 2, 3]]
    return folded


@pytest.mark.parametrize(
    ("name", "changes", "says"),
    [
        ("m.vtu", {"unit": 1e-3}, "metres"),
        ("m.vtu", {"points": lambda p: p * [1.0, 1.0, 1.1]}, "width_mm"),
        ("m.vtu", {"points": lambda p: p[:, [1, 0, 2]]}, "length_mm"),
        ("m.vtu", {"elements": _inside_out}, "element 3 folded"),
        ("m.vtu", {"elements": lambda e: e[:, :4], "cell": "tetra"}, "cells of type tetra"),
        ("m.vtu", {"elements": lambda e: e[:, :4], "cell": "quad"}, "no hexahedra"),
        ("m.xyz", None, "format"),
        ("m.vtu", None, "meshio reads"),
        ("m.inp", None, "meshio reads|binary|text"),
        ("none.vtu", "absent", "no such file"),
    ],
)
def test_a_file_that_is_no_such_block_is_refused_in_one_line(
    name: str, changes: Any, says: str, tmp_path: Path
) -> None:
    if changes is None:
        (tmp_path / name).write_bytes(b"\x00\x01 no mesh")
    elif changes != "absent":
        _file(tmp_path, name, **changes)
    with pytest.raises(InputError, match=says) as fault:
        block_mesh(block(mesh=name), SETTINGS, tmp_path)
    assert "\n" not in str(fault.value)


def test_a_file_that_numbers_every_element_the_other_way_round_is_turned(tmp_path: Path) -> None:
    _file(tmp_path, elements=lambda e: e[:, [4, 5, 6, 7, 0, 1, 2, 3]])
    mesh = block_mesh(block(mesh="mine.vtu"), SETTINGS, tmp_path)
    assert _volume(mesh) == pytest.approx(24.0 * 18.0 * 8.0)
