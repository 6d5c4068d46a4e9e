"""The face of a block given as a mesh file: condensed by sparse elimination, corrected by a mesh of half the size."""

from __future__ import annotations

from dataclasses import astuple

import numpy as np
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import cg, splu

from ...errors import EngineError, InputError
from ...study import Block
from ...units import MM
from ..stiffness import StiffnessRatios
from .body import Array, Body, FreeShape
from .condense import FaceStiffness, assemble, inverse
from .element import IncompatibleField
from .finite_strain import PER_HEIGHT, gathered, gradients, parted
from .kept import Arrays
from .mesh_body import MeshFile, body_of_mesh, cells_of, face_grid, halved, hexahedra

AT_ONCE = 400  # right-hand sides of one solve
CHUNK = 2_000  # elements assembled at a time
APART = 1.6
"""Least spacing of the coarse face over the length of the mesh's elements: finer, it would say one motion twice."""
TOLERANCE = 1e-8


def condense_mesh(body: Body, poissons_ratio: float) -> FaceStiffness:
    """Eliminate the inside of a body of any mesh; `InputError` for a Poisson's ratio outside 0..0.5."""
    matrix = stiffness_of(body, poissons_ratio)
    face, mount = _parts(body)
    held = _solved(body, matrix, np.eye(face.stop), face)
    whole = np.asarray(matrix[face] @ held)
    whole = 0.5 * (whole + whole.T)
    moved = _solved(body, matrix, body.mount_shapes(), mount)
    compliance = inverse(whole)
    return FaceStiffness(whole, -compliance @ np.asarray(matrix[face] @ moved), compliance)


def mesh_ratios(block: Block, shape: FreeShape, file: MeshFile, poissons_ratio: float, order: float) -> Array:
    """Return the block's `StiffnessRatios` (4,), extrapolated from its mesh and the same cut in eight (Richardson)."""
    mesh = hexahedra(block, file)
    coarse, fine = (
        np.array(astuple(_ratios(body_of_mesh(block, shape, each), poissons_ratio, block.height_mm * MM)))
        for each in (mesh, halved(mesh))
    )
    return np.asarray(fine + (fine - coarse) / (2.0**order - 1.0))


def mesh_second_order(body: Body, poissons_ratio: float, height: float) -> Arrays:
    """Return what `second_order` takes: motions of a coarse grid over the face, mean gradients of coarse cells."""
    spacing = max(height / PER_HEIGHT, APART * float(np.diff(body.knots).mean()))
    near, share, count = face_grid(body, spacing)
    matrix = stiffness_of(body, poissons_ratio)
    face, mount = _parts(body)
    unit = np.zeros((body.along.size, count))
    np.add.at(unit, (np.arange(body.along.size)[:, None], near), share)
    motions = _solved(body, matrix, np.asarray(np.kron(unit, np.eye(3)), dtype=np.float64), face)
    bent = _solved(body, matrix, body.mount_shapes(), mount)
    cell = cells_of(body, spacing)
    shapes, volume = IncompatibleField(body.nodes[body.elements], poissons_ratio).shape_gradients(np.zeros(3))
    mean = csr_array((volume, (cell, np.arange(cell.size))))
    total: Array = np.asarray(mean.sum(axis=1)).ravel()
    mean = csr_array(diags_array(1.0 / total) @ mean)

    def averaged(motion: Array) -> Array:
        found = gradients(body, shapes[:, :8], motion).reshape(9, cell.size, -1)
        return np.concatenate([mean @ part for part in found])

    stretch, bend = averaged(motions), averaged(bent)
    loads = (stretch.reshape(9, total.size, -1) * (8.0 * total)[:, None]).reshape(stretch.shape)
    stiffness = motions.T @ (matrix @ motions)
    return {
        "gather": gathered(near, share, body.area, count).T.astype(np.float32, order="C"),
        **parted(None, stretch, -(np.linalg.pinv(stiffness, hermitian=True) @ loads.T).T, bend),
        "near": near,
        "share": share,
    }


def stiffness_of(body: Body, poissons_ratio: float) -> csr_array:
    """Return the stiffness of the whole body in m, per Pa of Young's modulus, a part of its elements at a time."""
    if not 0.0 <= poissons_ratio < 0.5:
        raise InputError("Poisson's ratio", poissons_ratio, "0 or more and less than 0.5")
    size = 3 * body.nodes.shape[0]
    whole = csr_array((size, size))
    for first in range(0, body.elements.shape[0], CHUNK):
        whole = whole + assemble(body, poissons_ratio, slice(first, first + CHUNK))
    return whole


def _parts(body: Body) -> tuple[slice, slice]:
    """Return the degrees of freedom of the face and of the mount."""
    return slice(0, 3 * body.along.size), slice(3 * (body.nodes.shape[0] - body.mount_along.size), None)


def _solved(body: Body, matrix: csr_array, given: Array, where: slice) -> Array:
    """Return the displacements of all nodes where those of face or mount are given, the other at rest."""
    face, mount = _parts(body)
    inside = slice(face.stop, mount.start)
    motions = np.zeros((matrix.shape[0], given.shape[1]))
    motions[where] = given
    if face.stop == mount.start:
        return motions
    factor = splu(matrix[inside, inside].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    load = csr_array(matrix[inside, where])
    for first in range(0, given.shape[1], AT_ONCE):
        some = slice(first, first + AT_ONCE)
        motions[inside, some] = factor.solve(-np.asarray(load @ given[:, some]))
    return motions


def _ratios(body: Body, poissons_ratio: float, height: float) -> StiffnessRatios:
    """Return the ratios of `static_ratios` by conjugate gradients: each is one solve of the whole body."""
    matrix = stiffness_of(body, poissons_ratio)
    area = float(body.area.sum())
    middle = body.along - float(body.area @ body.along) / area
    inertia = float(body.area @ middle**2)
    shear_modulus = 0.5 / (1.0 + poissons_ratio)
    nothing, one = np.zeros(body.along.size), np.ones(body.along.size)
    press = _work(body, matrix, np.column_stack([nothing, one, nothing]), (0, 1, 2))
    slide = _work(body, matrix, np.column_stack([nothing, one, nothing]), (1,))
    shear = _work(body, matrix, np.column_stack([one, nothing, nothing]), (0, 1, 2))
    rock = _work(body, matrix, np.column_stack([nothing, middle, nothing]), (0, 1, 2))
    return StiffnessRatios(
        normal=press * height / area,
        normal_sliding=slide * height / area,
        shear=shear * height / (shear_modulus * area),
        rocking=rock * height / inertia,
    )


def _work(body: Body, matrix: csr_array, moved: Array, held: tuple[int, ...]) -> float:
    """Return twice the energy where the face's components `held` move as given, its others and the inside are free."""
    face, mount = _parts(body)
    displacement = np.zeros(matrix.shape[0])
    free = np.ones(matrix.shape[0], dtype=bool)
    free[mount] = False
    for component in held:
        free[face][component::3] = False
        displacement[face][component::3] = moved[:, component]
    rows = matrix[free]
    inner, load = csr_array(rows[:, free]), -np.asarray(rows @ displacement)
    guess = diags_array(1.0 / inner.diagonal())
    solution, fault = cg(inner, load, rtol=TOLERANCE, maxiter=20_000, M=guess)
    if fault:
        raise EngineError(f"static solve of a mesh file: no solution in {fault} iterations")
    displacement[free] = solution
    return float(displacement @ (matrix @ displacement))
