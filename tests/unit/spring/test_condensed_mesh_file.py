"""A block given as a mesh file in the model `condensed`: the block meshed here, whatever the file looks like."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest

from tread_validate.deck.mesh import block_mesh
from tread_validate.errors import InputError
from tread_validate.geometry import Block, path_of
from tread_validate.geometry.mesh_file import TURNED, HexMesh, read_hex_mesh
from tread_validate.spring.condensed.body import BodySettings, FreeShape, make_body
from tread_validate.spring.condensed.condense import condense
from tread_validate.spring.condensed.mesh_body import MeshFile, body_of_mesh, halved, hexahedra, mesh_file_of
from tread_validate.spring.condensed.mesh_condense import condense_mesh
from tread_validate.spring.condensed.motion import free_shape
from tread_validate.spring.condensed.roll import CondensedSettings, roll
from tread_validate.spring.condensed.store import converged_ratios
from tread_validate.spring.stiffness import static_ratios
from tread_validate.study import Case, DeckSettings, load_study

ROOT = Path(__file__).resolve().parents[3]
NU = 0.47
COARSE = DeckSettings(element_size_mm=4.0, layers=3, symmetry="full")


def block(**changes: object) -> Block:
    given = {"origin": "assumed", "source": "test", "shape": "rectangle", "length_mm": 24.0, "width_mm": 16.0,
             "height_mm": 8.0, "mounting": "flat"}  # fmt: skip
    return Block.model_validate({**given, **changes})


def filed(folder: Path, one: Block, settings: DeckSettings = COARSE, crooked: float = 0.0) -> Block:
    """Write the mesh of a block in any order, inner nodes moved by `crooked` (mm); return the block that names it."""
    mesh = block_mesh(one, settings)
    random = np.random.default_rng(3)
    points = np.column_stack([-mesh.s + 5.0, mesh.u * one.height_mm - 2.0, mesh.z + 1.0])
    inside = (points > points.min(axis=0) + 1e-6).all(axis=1) & (points < points.max(axis=0) - 1e-6).all(axis=1)
    points[inside] += random.uniform(-crooked, crooked, (int(inside.sum()), 3))
    order = random.permutation(points.shape[0])
    elements = np.array([row[TURNED[random.integers(6)]] for row in np.argsort(order)[mesh.elements]])
    meshio.write(folder / "mine.vtu", meshio.Mesh(points[order], [("hexahedron", elements)]))
    plain = {"mesh": "mine.vtu", "sipes": [], "draft_deg": 0.0}
    return block(**{**one.model_dump(exclude={"sipes", "draft_deg"}), **plain})


def volume(mesh: HexMesh) -> float:
    body = body_of_mesh(block(), FreeShape(), mesh)
    corners = body.nodes[body.elements]
    one, other, up = (corners[:, k] - corners[:, 0] for k in (4, 2, 1))
    return float(np.abs(np.einsum("ij,ij->i", np.cross(one, other), up)).sum())


@pytest.fixture
def case(tmp_path: Path) -> Case:
    found = next(
        one
        for one in load_study(ROOT / "config" / "study.yaml").cases()
        if one.case_id == "rig-rectangle-22c-0p2mm-300rpm"
    )
    return replace(found, root=tmp_path)


@pytest.mark.parametrize("shape", [FreeShape(), FreeShape(12.0, False, 0.9)], ids=["flat", "on a ring"])
def test_the_face_of_a_mesh_file_is_as_stiff_as_that_of_the_same_bricks(shape: FreeShape, tmp_path: Path) -> None:
    """The same division in layers, whole: every static stiffness to 1e-8, another elimination of the same matrix."""
    one = block()
    mesh = read_hex_mesh(filed(tmp_path, one), tmp_path)
    mine = body_of_mesh(one, shape, mesh)
    layered = make_body(one, shape, BodySettings(4e-3, 3, 1.5, 2, 1.0))
    ratios = [
        static_ratios(body, found, NU, 8e-3)
        for body, found in ((mine, condense_mesh(mine, NU)), (layered, condense(layered, NU)))
    ]
    for name in ("normal", "normal_sliding", "shear", "rocking"):
        assert getattr(ratios[0], name) == pytest.approx(getattr(ratios[1], name), rel=1e-8)
    assert mine.area.sum() == pytest.approx(24e-3 * 16e-3, rel=1e-12)


def test_a_block_carried_rigidly_by_its_mount_bears_no_force(tmp_path: Path) -> None:
    """Crooked bricks: the unloaded face moves with a mount that is shifted or turned (small angles), to 1e-9."""
    one = filed(tmp_path, block(), crooked=0.6)
    body = body_of_mesh(one, FreeShape(), read_hex_mesh(one, tmp_path))
    face = condense_mesh(body, NU)
    k = body.knots.size
    for mount, moved in (
        (np.r_[np.ones(k), np.zeros(k)], np.array([1.0, 0.0, 0.0])),
        (np.r_[np.zeros(k), np.ones(k)], np.array([0.0, 1.0, 0.0])),
    ):
        np.testing.assert_allclose(
            (face.follow @ mount).reshape(-1, 3), np.tile(moved, (body.along.size, 1)), atol=1e-9
        )
    turned = np.column_stack([-body.face[:, 1], body.face[:, 0], np.zeros(body.along.size)])
    np.testing.assert_allclose((face.follow @ np.r_[np.zeros(k), body.knots]).reshape(-1, 3), turned, atol=1e-9)
    assert np.linalg.eigvalsh(face.stiffness).min() > 0.0


def test_bricks_cut_in_eight_fill_the_same_block(tmp_path: Path) -> None:
    mesh = read_hex_mesh(filed(tmp_path, block()), tmp_path)
    fine = halved(mesh)
    assert fine.elements.shape[0] == 8 * mesh.elements.shape[0]
    assert fine.face_elements.size == 4 * mesh.face_elements.size
    assert volume(fine) == pytest.approx(volume(mesh), rel=1e-12)
    assert np.unique(np.round(fine.points, 9), axis=0).shape == fine.points.shape


def test_ratios_of_a_mesh_file_go_to_the_limit_of_the_block_given_by_dimensions(case: Case, tmp_path: Path) -> None:
    """From a crooked mesh of 4 mm and the same cut in eight: within 1.5 % in every direction (2 mm: 0.3 %)."""
    one = case.block.model_copy(update={"length_mm": 24.0, "width_mm": 16.0})
    own = replace(case, block=one)
    mine = replace(case, block=filed(tmp_path, one, crooked=0.4))
    shape = free_shape(path_of(own), one)
    limit = converged_ratios(one, shape, NU)
    found = converged_ratios(mine.block, shape, NU, mesh_file_of(mine))
    for name in ("normal", "normal_sliding", "shear", "rocking"):
        assert getattr(found, name) == pytest.approx(getattr(limit, name), rel=0.015)


def test_a_pass_of_a_mesh_file_is_that_of_the_same_block_on_a_face_as_coarse(case: Case, tmp_path: Path) -> None:
    """Nodes and rows in the same places, 2 mm: N and its impulse within 1 %, T's peaks within 0.5 N."""
    one = case.block.model_copy(update={"length_mm": 24.0, "width_mm": 16.0})
    fine = DeckSettings(element_size_mm=2.0, layers=4, symmetry="full")
    mine = replace(case, block=filed(tmp_path, one, fine))
    passes = [
        roll(replace(case, block=one), CondensedSettings(body=BodySettings(2e-3, 4, 1.5, 4, 1.0), step=0.25)),
        roll(mine, CondensedSettings()),
    ]
    own, found = (
        (run.normal_force.max(), np.trapezoid(run.normal_force, run.time), run.tangential_force) for run in passes
    )
    assert found[0] == pytest.approx(own[0], rel=0.01)
    assert found[1] == pytest.approx(own[1], rel=0.01)
    assert found[2].max() == pytest.approx(own[2].max(), abs=0.5)
    assert found[2].min() == pytest.approx(own[2].min(), abs=0.5)


def test_a_hole_in_the_file_softens_the_block(case: Case, tmp_path: Path) -> None:
    """A cut that only the file has: the face loses its area, and the block more than that of its force."""
    one = block(sipes=[{"position_mm": 11.0, "width_mm": 2.0, "depth_mm": 5.0}])
    cut = filed(tmp_path, one)
    (tmp_path / "whole").mkdir()
    whole = filed(tmp_path / "whole", block())
    found = []
    for mine, root in ((cut, tmp_path), (whole, tmp_path / "whole")):
        body = body_of_mesh(mine, FreeShape(), read_hex_mesh(mine, root))
        ratios = static_ratios(body, condense_mesh(body, NU), NU, 8e-3)
        found.append((body.area.sum(), ratios.normal * body.area.sum()))
    assert found[0][0] == pytest.approx(found[1][0] * 22.0 / 24.0)
    assert found[0][1] < 0.9 * found[1][1]


def test_a_file_that_is_changed_or_missing_is_never_answered_from_before(case: Case, tmp_path: Path) -> None:
    mine = replace(case, block=filed(tmp_path, block()))
    before = mesh_file_of(mine)
    filed(tmp_path, block(), crooked=0.1)
    assert mesh_file_of(mine) != before
    (tmp_path / "mine.vtu").unlink()
    with pytest.raises(InputError, match="no such file"):
        mesh_file_of(mine)


def test_a_mesh_too_fine_for_a_dense_face_is_refused_with_its_numbers(tmp_path: Path) -> None:
    one = filed(tmp_path, block(), DeckSettings(element_size_mm=0.5, layers=2, symmetry="full"))
    with pytest.raises(InputError, match=r"3072 elements, 1617 nodes|at most 12000") as fault:
        hexahedra(filed(tmp_path, block(), DeckSettings(element_size_mm=0.4, layers=2, symmetry="full")),
                  MeshFile(tmp_path, ""))  # fmt: skip
    assert str(fault.value).count("\n") == 0
    assert one.mesh == "mine.vtu"
