"""The mesh against the exact block."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from tread_validate import deck
from tread_validate.deck.block_mesh import BlockMesh
from tread_validate.deck.mesh import block_mesh, layer_fractions
from tread_validate.errors import InputError
from tread_validate.study import Block, Case, DeckSettings, Sipe
from tread_validate.study.case import with_mesh

FloatArray = NDArray[np.float64]
GAUSS = 1.0 / math.sqrt(3.0)
CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])


def _jacobians(points: FloatArray, elements: NDArray[np.int64], at: FloatArray) -> FloatArray:
    """Determinant of the trilinear map at natural coordinates `at`, by central differences of the shape functions."""
    corners = points[elements]

    def place(natural: FloatArray) -> FloatArray:
        return np.einsum("k,mkx->mx", np.prod(1.0 + CORNERS * natural, axis=1) / 8.0, corners)

    columns = [(place(at + 0.5 * unit) - place(at - 0.5 * unit)) for unit in np.eye(3)]
    return np.linalg.det(np.stack(columns, axis=1))


def _volumes(points: FloatArray, elements: NDArray[np.int64]) -> FloatArray:
    """Volumes by 2 x 2 x 2 Gauss points, exact for trilinear elements."""
    return np.sum([_jacobians(points, elements, GAUSS * corner) for corner in CORNERS], axis=0)


def _block_points(mesh: BlockMesh, height: float) -> FloatArray:
    """Stand the block upright: x = -s, y = height above the face."""
    return np.column_stack([-mesh.s, mesh.u * height, mesh.z])


def _face_area(points: FloatArray, mesh: BlockMesh) -> float:
    a, b, c, d = (points[mesh.elements[mesh.face_elements, k]] for k in range(4))
    return float(np.sum(np.linalg.norm(np.cross(c - a, d - b), axis=1)) / 2.0)


def test_flat_belt_block_weighs_four_grams_on_five_square_centimetres(cases: tuple[Case, ...]) -> None:
    """25 x 20 x 8 mm at 1e-9 tonne/mm3 is 4e-6 tonne; planar hexahedra fill it exactly: rounding only."""
    for case in (one for one in cases if one.path.family != "rig"):
        built = deck.build(case)
        mesh = block_mesh(case.block, case.deck)
        assert 2 * _volumes(built.points, built.elements).sum() * 1e-9 == pytest.approx(4e-6, rel=1e-12)
        assert 2 * _face_area(built.points, mesh) == pytest.approx(500.0, rel=1e-12)


def test_rig_block_is_the_annular_sector_of_its_face(cases: tuple[Case, ...]) -> None:
    """Sector of 25 mm at R1 between R1 - 8 and R1: 25 * 20 * 8 * (1 - 8/200) = 3840 mm3.

    Straight edges cut dphi^2 / (6 cos^2 skew) of it off, dphi = 1 mm / 100 mm: 1.7e-5, and 2.2e-5 at 30 deg. What is
    left is of the order of that squared: 1e-8.
    """
    for shape, skew in (("rectangle", 0.0), ("parallelogram", math.radians(30.0))):
        case = next(one for one in cases if one.path.family == "rig" and one.block_name == shape)
        built = deck.build(replace(case, deck=DeckSettings(symmetry="full")))
        cut = 0.01**2 / (6.0 * math.cos(skew) ** 2)
        assert _volumes(built.points, built.elements).sum() == pytest.approx(3840.0 * (1.0 - cut), rel=1e-8)


@settings(max_examples=40, deadline=None)
@given(
    length=st.floats(5.0, 60.0),
    width=st.floats(5.0, 40.0),
    height=st.floats(2.0, 20.0),
    skew=st.floats(-60.0, 60.0),
    size=st.floats(1.5, 6.0),
    layers=st.integers(2, 10),
    refinement=st.floats(1.0, 5.0),
    sipe=st.tuples(st.floats(0.1, 0.4), st.floats(0.01, 0.2)),
)
def test_mesh_fills_any_block_and_leaves_its_sipes_open(
    length: float, width: float, height: float, skew: float, size: float, layers: int, refinement: float,
    sipe: tuple[float, float],
) -> None:  # fmt: skip
    """Area times height less the sipes, every Jacobian positive at corners and centre; planar faces: rounding only."""
    gap = Sipe(position_mm=sipe[0] * length, width_mm=sipe[1] * length)
    skewed = abs(skew) > 1.0
    block = Block(
        origin="assumed", source="any", shape="parallelogram" if skewed else "rectangle", length_mm=length,
        width_mm=width, height_mm=height, skew_deg=skew if skewed else 0.0, sipes=(gap,),
    )  # fmt: skip
    mesh = block_mesh(block, DeckSettings(element_size_mm=size, layers=layers, refinement=refinement))
    points = _block_points(mesh, height)
    for at in (*CORNERS.astype(float), np.zeros(3)):
        assert np.all(_jacobians(points, mesh.elements, at) > 0.0)
    rubber = (length - gap.width_mm) * width * (1.0 if skewed else 0.5)  # a rectangle is meshed for z >= 0 alone
    assert _volumes(points, mesh.elements).sum() == pytest.approx(rubber * height, rel=1e-10)
    assert _face_area(points, mesh) == pytest.approx(rubber, rel=1e-10)
    assert mesh.s.min() == pytest.approx(0.0, abs=1e-9)
    assert np.unique(mesh.elements).size == mesh.s.size, "a node belongs to no element"


def test_layers_thin_towards_the_face_by_the_refinement_asked_for() -> None:
    """Heights 1, r, r^2, ...: last over first is the refinement, and they fill the height; rounding only."""
    fractions = layer_fractions(7, 1.5)
    heights = np.diff(fractions)
    assert fractions[0] == 0.0
    assert fractions[-1] == 1.0
    assert heights[-1] / heights[0] == pytest.approx(1.5, rel=1e-12)
    np.testing.assert_allclose(heights[1:] / heights[:-1], 1.5 ** (1 / 6), rtol=1e-12)


def test_parallelogram_touches_with_the_corner_on_the_side_its_skew_points_to(
    cases: tuple[Case, ...], coarse: Callable[[Case], Case]
) -> None:
    """Rows start z tan(skew) behind the first corner: 11.547 mm at 30 deg over 20 mm; rounding only."""
    case = next(one for one in cases if one.block_name == "parallelogram")
    mesh = block_mesh(case.block, coarse(case).deck)
    first = mesh.z[np.argmin(mesh.s)]
    assert first == -10.0
    assert mesh.span == pytest.approx(25.0 + 20.0 * math.tan(math.radians(30.0)), rel=1e-12)
    mirrored = block_mesh(case.block.model_copy(update={"skew_deg": -30.0}), coarse(case).deck)
    assert mirrored.z[np.argmin(mirrored.s)] == 10.0


def test_mesh_that_would_fill_the_memory_is_refused(cases: tuple[Case, ...]) -> None:
    with pytest.raises(InputError, match="element_size_mm"):
        block_mesh(cases[0].block, DeckSettings(element_size_mm=0.01))


def test_elements_are_short_in_the_direction_of_travel(cases: tuple[Case, ...]) -> None:
    """`mesh_of_path` of the study: 0.625 by 1.667 mm (along and across travel) on the rig, 1 by 2 mm on the belt."""
    for case in cases:
        mesh = block_mesh(case.block, case.deck)
        columns, across = (40, 12) if case.path.family == "rig" else (25, 10)
        across //= 2 if case.block.shape == "rectangle" else 1
        assert mesh.elements.shape[0] == columns * across * case.deck.layers


def test_a_mesh_study_keeps_the_shape_of_the_elements(rig_case: Case) -> None:
    fine = with_mesh(rig_case, {"element_size_mm": 1.0, "layers": 2})
    assert block_mesh(fine.block, fine.deck).elements.shape[0] == 67 * 10 * 2
