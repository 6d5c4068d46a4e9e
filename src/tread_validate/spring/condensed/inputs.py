"""What the kernels of the condensed face take: plain tuples of numbers and arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..inputs import KernelLaw

Array = NDArray[np.float64]
Singles = NDArray[np.float32]
Shorts = NDArray[np.int16]
Integers = NDArray[np.int64]

FREE, STICK, SLIP = 0, 1, 2
"""What a node of the face does."""
ROWS = 2
"""Rows of nodes in a cell; windows begin and end between cells."""


class Solid(NamedTuple):
    """The rubber of the block.

    Attributes
    ----------
    long_term : float, Pa
    moduli, relaxation_times : (k,) arrays, Pa and s
        At the temperature of the run.
    """

    long_term: float
    moduli: Array
    relaxation_times: Array


class Fold(NamedTuple):
    """Motions of a symmetric face that its symmetry keeps apart from all others: the even, or the odd ones.

    Attributes
    ----------
    left, right : (k,) arrays of int
        Degrees of freedom that move together; equal where one moves by itself.
    own, other : (k,) arrays
        What they do in unit motion, as a sum where they are equal: the motions are orthonormal.
    """

    left: Integers
    right: Integers
    own: Array
    other: Array


_EMPTY = np.zeros(0, dtype=np.int64)
NO_FOLD = Fold(_EMPTY, _EMPTY, np.zeros(0), np.zeros(0))
"""Of a face without symmetry."""


class SecondOrder(NamedTuple):
    """What finite strain and rotation do to the unloaded face, see `second_order`; without elements: small strain.

    Attributes
    ----------
    free : (n, 3) array, m
        Stress-free positions of the face's nodes.
    gather : (n, c) array
        Displacements of the face's nodes -> those of the c nodes of a coarser face; one row a node of the face.
    even, odd : Fold
        Motions of the coarser face; without symmetry all are even.
    gradient_even, gradient_odd : (k, 9 m) arrays, 1/m
        Displacement gradients of m elements (component by component), of which the e elements are these and their
        images, for unit size of each of the k motions; in units of `gradient_unit`.
    spread_even, spread_odd : (9 m, k) arrays, m per (stress over E)
        Size of each motion of the unloaded coarser face for unit stresses in the elements, alike (even) or opposite
        (odd) in their images; in units of `spread_unit`.
    flip : (9,) array
        Sign of each component in the image of an even motion; (0,) without symmetry.
    near, share : (n, 4) arrays
        Coarser nodes around a node of the face, and their weights.
    lame, shear : float
        Lame's constants for E = 1.
    gradient_unit, spread_unit : float
        One step of the 16-bit numbers, 1/m and m: half the memory, and 1/65000 of the largest is far below what the
        second order is known to.
    """

    free: Array
    gather: Singles
    even: Fold
    odd: Fold
    gradient_even: Shorts
    gradient_odd: Shorts
    spread_even: Shorts
    spread_odd: Shorts
    flip: Singles
    near: Integers
    share: Array
    lame: float
    shear: float
    gradient_unit: float
    spread_unit: float


_NONE, _NO_SHORTS = np.zeros((0, 0), dtype=np.float32), np.zeros((0, 0), dtype=np.int16)
SMALL_STRAIN = SecondOrder(
    np.zeros((0, 3)), _NONE, NO_FOLD, NO_FOLD, _NO_SHORTS, _NO_SHORTS, _NO_SHORTS, _NO_SHORTS, _NONE[0:0].ravel(),
    np.zeros((0, 4), dtype=np.int64), np.zeros((0, 4)), 0.0, 0.0, 0.0, 0.0,
)  # fmt: skip
"""Nothing of second order."""


class RoadMotion(NamedTuple):
    """The rigid road.

    Attributes
    ----------
    radius : float, m
        Of the circle with its top at the axle frame's origin; inf for the plane y = 0.
    speed : float, m/s
        Towards +x at the top.
    """

    radius: float
    speed: float


class Pose(NamedTuple):
    """Where the mount holds the block at an instant.

    Attributes
    ----------
    x, y : float, m
        Mount above the middle of the block, in the axle frame.
    angle : float, rad
        Slope of the mount there.
    unloaded : (n, 3) array, m
        Positions of the face's nodes in the block's frame if no force acted on the face (small strain).
    bend : (9 e,) array
        Displacement gradients that the mount's bending makes in the elements of `SecondOrder`.
    rise : float, m
        By which the road that the nodes meet stands proud: chords between nodes lie inside a curved face and road.
    """

    x: float
    y: float
    angle: float
    unloaded: Array
    bend: Singles = _NONE[0:0].ravel()
    rise: float = 0.0


class FaceNodes(NamedTuple):
    """The face's nodes, sorted by their place along the block.

    Attributes
    ----------
    area : (n,) array, m2
        Area that each node stands for; 0 for a node without rubber.
    row : (n,) array of int
        Row across the block that a node belongs to; never falls.
    compliance : (3 n, 3 n) array, Pa m/N
        Inverse of the face's stiffness for E = 1 Pa.
    """

    area: Array
    row: Integers
    compliance: Singles


class FaceState(NamedTuple):
    """What the face remembers between steps; every array is changed in place.

    Attributes
    ----------
    w : (n, 3) array, m
        Elastic displacement in the block's frame.
    rate : (n, 3) array, m/s
    memory : (k, n, 3) array, m
        Fading displacement of each Prony term.
    place : (n, 3) array, m
        Positions in the axle frame.
    code : (n,) array of int
        `FREE`, `STICK` or `SLIP`.
    force : (n, 3) array, N
        Force of the road on the nodes, block's frame.
    scale : (1,) array, N
        Largest nodal force of the step before.
    shift, flow : (n, 3) arrays, m and m/s
        Displacement of the unloaded face of second order, and its rate over the step before.
    pace : (1,) array, s
        Length of that step.
    """

    w: Array
    rate: Array
    memory: Array
    place: Array
    code: Integers
    force: Array
    scale: Array
    shift: Array
    flow: Array
    pace: Array


class Scratch(NamedTuple):
    """Work space of one step."""

    relaxed: Array
    q: Array
    target: Array
    normal: Array
    before: Integers
    decay: Array
    unloaded: Array
    moved: Singles
    coarse: Singles
    third: Singles
    gradient: Singles
    even: Singles
    odd: Singles


class Operator(NamedTuple):
    """Stiffness of a window for E = 1 Pa; for the whole of a symmetric face also that of its even and odd motions."""

    whole: Singles
    even: Singles
    odd: Singles


class Windows(NamedTuple):
    """Operators of windows of cells.

    Attributes
    ----------
    first : (cells + 1,) array of int
        First node of each cell, and n.
    offset : (cells, cells + 1) array of int
        Where the operator of the cells a..b-1 begins in `pool`, at [a, b]; -1 where it is not there yet. Behind that
        of all cells come the even and the odd part, where the face is symmetric.
    pool : (size,) array, N/m per Pa
    even, odd : Fold
    """

    first: Integers
    offset: Integers
    pool: Singles
    even: Fold = NO_FOLD
    odd: Fold = NO_FOLD


class Solver(NamedTuple):
    """When the sweeps stop: change of a nodal force over the largest one, and at most how many."""

    tolerance: float
    most_sweeps: int


class Scene(NamedTuple):
    """What stays the same over a pass."""

    face: FaceNodes
    solid: Solid
    road: RoadMotion
    law: KernelLaw
    solver: Solver
    second: SecondOrder = SMALL_STRAIN


def fresh_state(nodes: int, terms: int) -> FaceState:
    """Return the state of a block that never touched; positions are filled in by `start`."""
    return FaceState(
        np.zeros((nodes, 3)), np.zeros((nodes, 3)), np.zeros((terms, nodes, 3)), np.zeros((nodes, 3)),
        np.zeros(nodes, dtype=np.int64), np.zeros((nodes, 3)), np.full(1, 1e-3), np.zeros((nodes, 3)),
        np.zeros((nodes, 3)), np.zeros(1),
    )  # fmt: skip


def scratch(nodes: int, terms: int, second: SecondOrder = SMALL_STRAIN) -> Scratch:
    """Return work space for `nodes` nodes and `terms` Prony terms."""
    coarse, elements = second.even.left.size + second.odd.left.size, second.gradient_even.shape[1]
    return Scratch(
        np.zeros((nodes, 3)), np.zeros((nodes, 3)), np.zeros((nodes, 3)), np.zeros((nodes, 2)),
        np.zeros(nodes, dtype=np.int64), np.zeros(terms), np.zeros((nodes, 3)), np.zeros((3, nodes), dtype=np.float32),
        np.zeros(coarse, dtype=np.float32), np.zeros(coarse // 3, dtype=np.float32),
        np.zeros(elements * (2 if second.flip.size else 1), dtype=np.float32), np.zeros(elements, dtype=np.float32),
        np.zeros(elements, dtype=np.float32),
    )  # fmt: skip
