"""Condensed blocks, remembered for the life of the process: the cases of a study share a few.

A face's stiffness is corrected for its mesh: two coarser static solves extrapolate the block's normal and shear
stiffness to the limit of fine meshes, and the matrix is scaled, symmetrically and direction by direction, to that.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import astuple, dataclass
from functools import cache, cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from ...study import Block
from ...units import MM
from ..stiffness import StiffnessRatios, static_ratios, stuck_ratios
from .body import Body, BodySettings, FreeShape, make_body
from .condense import FaceStiffness, condense, inverse
from .finite_strain import second_order_arrays, second_order_of
from .inputs import SecondOrder, Singles
from .kept import Arrays, keep, kept, load
from .mesh_body import MeshFile, body_of_mesh, hexahedra
from .mesh_condense import condense_mesh, mesh_ratios, mesh_second_order
from .operators import FaceOperators
from .polygon import Polygon
from .stuck import stuck_ratios_of

Array = NDArray[np.float64]

FINE, COARSE = (6.4, 8), (3.2, 4)
"""Elements per height along and across the block, and layers, of the two meshes that are extrapolated from."""
ORDER = 1.39
"""Order of convergence of the stiffness in the element size. Corners between a bonded and a free face limit it: meshes
of 4, 8 and 16 layers give 1.972, 1.891 and 1.860 for a 25 x 20 x 8 mm block with nu = 0.47, that is order 1.39 and a
limit of 1.841 (theory for a sharp corner of that material: 1.22, which would make the limit 0.2 per cent lower)."""


@dataclass(frozen=True)
class ReadyFace:
    """A block's face ready for contact.

    Attributes
    ----------
    shape : FreeShape
    body : Body
    follow : (3 n, 2 k) array
        What the unloaded face does with the mount, as in `FaceStiffness`.
    second : SecondOrder
    bend : (9 e, 2 k) array
        What the elements of `second` do with the mount.
    operators : FaceOperators
    key : str
        What the block is kept under.
    """

    shape: FreeShape
    body: Body
    follow: Array
    second: SecondOrder
    bend: Singles
    operators: FaceOperators
    key: str

    @cached_property
    def polygon(self) -> Polygon:
        """How far the face's elements lie inside it."""
        return Polygon(self.body)

    def remember(self) -> None:
        """Keep the window operators made so far for the next process."""
        keep("windows", self.key, self.operators.known())


def condensed(
    block: Block,
    shape: FreeShape,
    settings: BodySettings,
    poissons_ratio: float,
    mesh_correction: bool = True,
    file: MeshFile | None = None,
) -> tuple[Body, FaceStiffness]:
    """Return the block's body and the stiffness of its face; `file` is that of a block given as a mesh file."""
    body = _body(block, shape, settings, file)
    face = condense(body, poissons_ratio) if file is None else condense_mesh(body, poissons_ratio)
    if not mesh_correction:
        return body, face
    height = block.height_mm * MM
    limit = np.array(converged_stuck(block, shape, poissons_ratio, file))
    normal, across = np.sqrt(limit / stuck_ratios(body, face, poissons_ratio, height))
    scale = np.tile([across, normal, across], body.nodes_per_layer)
    # the supports on the plane of symmetry only have to stay supports
    matrix, compliance = scale[:, None] * face.stiffness * scale, face.compliance / scale[:, None] / scale
    return body, FaceStiffness(matrix, face.follow, compliance)


@lru_cache(maxsize=12)
def ready(
    block: Block,
    shape: FreeShape,
    settings: BodySettings,
    poissons_ratio: float,
    mesh_correction: bool = True,
    file: MeshFile | None = None,
) -> ReadyFace:
    """Return the block's face ready for contact, from disk where it has been made before."""
    key = f"{_plan(block, file)} {shape} {settings} {poissons_ratio!r} {mesh_correction}"

    @cache
    def solved() -> FaceStiffness:
        return condensed(block, shape, settings, poissons_ratio, mesh_correction, file)[1]

    @cache
    def compliance() -> Array:
        return solved().compliance if solved.cache_info().currsize else inverse(stiffness())

    def stiffness() -> Array:
        return kept("stiffness", key, lambda: {"stiffness": solved().stiffness})["stiffness"]

    def make() -> Arrays:
        face = solved()
        if file is None:
            second = second_order_arrays(block, shape, body, poissons_ratio)
        else:
            second = mesh_second_order(body, poissons_ratio, block.height_mm * MM)
        return {
            "follow": face.follow,
            "compliance": compliance().astype(np.float32),
            **second,
        }

    body = _body(block, shape, settings, file)
    arrays = kept("face", key, make)
    operators = FaceOperators(body, stiffness, compliance, arrays["compliance"])
    found = load("windows", key)
    if found is not None:
        operators.learn(found["offset"], found["pool"])
    return ReadyFace(
        shape, body, arrays["follow"], second_order_of(arrays, body, poissons_ratio), arrays["bend"], operators, key
    )


@lru_cache(maxsize=32)
def converged_ratios(
    block: Block, shape: FreeShape, poissons_ratio: float, file: MeshFile | None = None
) -> StiffnessRatios:
    """Return the block's static stiffness ratios, extrapolated from two meshes, one twice as fine (Richardson)."""
    if file is not None:
        key = f"{_plan(block, file)} {shape} {poissons_ratio!r}"
        found = kept("ratios", key, lambda: {"ratios": mesh_ratios(block, shape, file, poissons_ratio, ORDER)})
        return StiffnessRatios(*(float(value) for value in found["ratios"]))

    def make(settings: BodySettings) -> Array:
        body = make_body(block, shape, settings)
        ratios = static_ratios(body, condense(body, poissons_ratio), poissons_ratio, block.height_mm * MM)
        return np.array(astuple(ratios))

    return StiffnessRatios(*_converged("ratios", block, shape, poissons_ratio, make))


@lru_cache(maxsize=32)
def converged_stuck(
    block: Block, shape: FreeShape, poissons_ratio: float, file: MeshFile | None = None
) -> tuple[float, ...]:
    """Return the first and the third of them, normal and shear, in a third of the time."""
    if file is not None:
        ratios = converged_ratios(block, shape, poissons_ratio, file)
        return ratios.normal, ratios.shear

    def make(settings: BodySettings) -> Array:
        body = make_body(block, shape, settings)
        return np.array(stuck_ratios_of(block, body, poissons_ratio, block.height_mm * MM))

    return _converged("stuck", block, shape, poissons_ratio, make)


def _converged(
    name: str, block: Block, shape: FreeShape, poissons_ratio: float, make: Callable[[BodySettings], Array]
) -> tuple[float, ...]:
    def extrapolated() -> Arrays:
        fine, coarse = (make(_part(block, mesh)) for mesh in (FINE, COARSE))
        return {"ratios": fine + (fine - coarse) / (2.0**ORDER - 1.0)}

    key = f"{_plan(block, None)} {shape} {poissons_ratio!r}"
    return tuple(float(value) for value in kept(name, key, extrapolated)["ratios"])


def _part(block: Block, mesh: tuple[float, int]) -> BodySettings:
    """Return the division with so many elements per height, at least eight (of FINE) along and across the block."""
    per_height, layers = mesh
    least = min(block.length_mm, block.width_mm) * MM
    return BodySettings(min(block.height_mm * MM / per_height, least / (1.25 * per_height)), layers)


def _body(block: Block, shape: FreeShape, settings: BodySettings, file: MeshFile | None) -> Body:
    return make_body(block, shape, settings) if file is None else body_of_mesh(block, shape, hexahedra(block, file))


def _plan(block: Block, file: MeshFile | None) -> str:
    """Return what of a block decides its shape."""
    plan = json.dumps(block.model_dump(mode="json", exclude={"origin", "source"}), sort_keys=True)
    return plan if file is None else f"{plan} {file.sha256}"
