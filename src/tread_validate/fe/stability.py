"""The stable increment of central differences from the highest frequency of the whole mesh.

An element on its own can pulsate with all its nodes at once; in a mesh its neighbours share them, and the highest
frequency is lower, by up to the square root of three for equal cubes of nearly incompressible rubber. It is found by
Lanczos' method (Golub and Van Loan, Matrix Computations, 10.1) on M^-1/2 K M^-1/2 with the instantaneous moduli and the
mesh as deformed; each look starts from the mode found before, and from something in every direction: the mode of a
block in contact changes places, and from the old one alone the new one would be found too late.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh_tridiagonal

from ..kernels import kernel
from .blocks import Blocks
from .element_full_kernel import POINTS
from .gauss import mean_of_points
from .hyperelastic import stiffened

Floats = NDArray[np.float64]
FIRST_STEPS = 80
"""Lanczos steps from an arbitrary start: the largest eigenvalue to 0.1 %."""
NEXT_STEPS = 12
"""Lanczos steps from the mode of the look before: the increment to 1 % where the mode changes places."""
ANYWHERE = 0.3
"""Size of the arbitrary vector that is added to that mode, of unit length."""
EXHAUSTED = 1e-10
"""Size of a new Lanczos vector, of the largest eigenvalue, at which the space is taken to be complete."""


class Stiffness(NamedTuple):
    """Element data of the instantaneous stiffness: gradients are those of the deformed mesh, volumes its own."""

    connectivity: Any
    gradients: Any
    volume: Any
    lame: Any
    shear: Any


@kernel(reorder=True)
def deform(connectivity, gradients, volume, u, out, out_volume):  # type: ignore[no-untyped-def]  # numba types it
    """Write gradients F^-T b (m, 3, 8) and volumes J V (m,) of the mesh displaced by `u` (n, 3)."""
    f = np.empty((3, 3))
    g = np.empty((3, 3))
    for e in range(volume.size):
        for c in range(3):
            for j in range(3):
                total = 1.0 if c == j else 0.0
                for a in range(8):
                    total += u[connectivity[e, a], c] * gradients[e, j, a]
                f[c, j] = total
        for c in range(3):
            c1, c2 = (c + 1) % 3, (c + 2) % 3
            for j in range(3):
                j1, j2 = (j + 1) % 3, (j + 2) % 3
                g[c, j] = f[c1, j1] * f[c2, j2] - f[c1, j2] * f[c2, j1]
        jacobian = f[0, 0] * g[0, 0] + f[0, 1] * g[0, 1] + f[0, 2] * g[0, 2]
        out_volume[e] = volume[e] * jacobian
        for c in range(3):
            for a in range(8):
                out[e, c, a] = (
                    g[c, 0] * gradients[e, 0, a] + g[c, 1] * gradients[e, 1, a] + g[c, 2] * gradients[e, 2, a]
                ) / jacobian


@kernel(reorder=True)
def multiply(stiffness, x, out):  # type: ignore[no-untyped-def]  # numba types it
    """Write the stiffness times `x` into `out`, both (n, 3)."""
    out[:] = 0.0
    g = np.empty((3, 3))
    s = np.empty((3, 3))
    for e in range(stiffness.volume.size):
        for c in range(3):
            for j in range(3):
                total = 0.0
                for a in range(8):
                    total += x[stiffness.connectivity[e, a], c] * stiffness.gradients[e, j, a]
                g[c, j] = total
        mean = stiffness.lame[e] * (g[0, 0] + g[1, 1] + g[2, 2])
        for c in range(3):
            for j in range(3):
                s[c, j] = stiffness.volume[e] * (stiffness.shear[e] * (g[c, j] + g[j, c]) + (mean if c == j else 0.0))
        for a in range(8):
            node = stiffness.connectivity[e, a]
            for c in range(3):
                out[node, c] += (
                    s[c, 0] * stiffness.gradients[e, 0, a]
                    + s[c, 1] * stiffness.gradients[e, 1, a]
                    + s[c, 2] * stiffness.gradients[e, 2, a]
                )


@kernel(reorder=True)
def dot(x, y):  # type: ignore[no-untyped-def]  # numba types it
    """Return the sum of x y over flat arrays, on this thread alone: BLAS would wake others for it."""
    total = 0.0
    for i in range(x.size):
        total += x[i] * y[i]
    return total


@kernel(reorder=True)
def krylov(stiffness, root, start, basis, diagonal, beside):  # type: ignore[no-untyped-def]  # numba types it
    """Write Lanczos' basis (steps, 3 n) and tridiagonal matrix from `start` (3 n,); return the steps made."""
    size = start.size
    scaled = np.empty(size)
    image = np.empty(size)
    basis[0] = start / math.sqrt(dot(start, start))
    steps = diagonal.size
    largest = 0.0
    for i in range(steps):
        for k in range(size):
            scaled[k] = root[k] * basis[i, k]
        multiply(stiffness, scaled.reshape(-1, 3), image.reshape(-1, 3))
        for k in range(size):
            image[k] *= root[k]
        diagonal[i] = dot(image, basis[i])
        for j in range(2 * i + 2):  # twice: what is left of the space may be nothing but rounding
            share = dot(image, basis[j % (i + 1)])
            for k in range(size):
                image[k] -= share * basis[j % (i + 1), k]
        beside[i] = math.sqrt(dot(image, image))
        largest = max(largest, diagonal[i])
        if beside[i] <= EXHAUSTED * largest:
            return i + 1
        if i + 1 < steps:
            for k in range(size):
                basis[i + 1, k] = image[k] / beside[i]
    return steps


class StableIncrement:
    """The stable increment of a mesh as it deforms.

    Parameters
    ----------
    blocks : Blocks
    free : (n,) bool
        Nodes that are not held; held ones only stiffen the mesh, and are left out.
    """

    def __init__(self, blocks: Blocks, free: NDArray[np.bool_]) -> None:
        self.blocks = blocks
        self._gather(blocks)
        root = np.sqrt(np.divide(1.0, blocks.mass, out=np.zeros_like(blocks.mass), where=free & (blocks.mass > 0.0)))
        self.root = np.repeat(root[:, None], 3, axis=1)
        self.mode: Floats | None = None
        self.random = np.random.default_rng(0)

    def _gather(self, b: Blocks) -> None:
        """Set up the rows of the stiffness: one-point elements, Gauss points, fully integrated elements.

        Gauss points resist distortion only, with -2/3 of the shear modulus in the place of Lame's first; what resists
        the change of volume of a fully integrated element is one row with its mean gradients and the bulk modulus.
        """
        whole = np.zeros(b.volume.size, dtype=bool)
        whole[b.full] = True
        one, points = ~whole, np.repeat(b.full, POINTS)
        shear = np.concatenate([b.shear[one], b.shear[points], np.zeros(b.full.size)])
        bulk = np.concatenate([b.bulk[one], np.zeros(points.size), b.bulk[b.full]])
        self.connectivity = np.concatenate([b.connectivity[one], b.connectivity[points]])
        self.gradients = np.concatenate([b.gradients[one], b.point_gradients.reshape(-1, 3, 8)])
        self.volume = np.concatenate([b.volume[one], b.point_volume.ravel()])
        self.moduli = shear.copy(), bulk  # the rows' own are overwritten as the mesh deforms
        self.neo_hookean = np.concatenate([b.neo_hookean[one], b.neo_hookean[points], b.neo_hookean[b.full]])
        self.stiffness = Stiffness(
            np.concatenate([self.connectivity, b.connectivity[b.full]]),
            np.zeros((shear.size, 3, 8)),
            np.zeros(shear.size),
            bulk - 2.0 / 3.0 * shear,
            shear,
        )

    def _deform(self, displacement: Floats) -> None:
        """Let the rows of the stiffness follow the mesh, displaced by (n, 3)."""
        own = self.volume.size
        full = self.blocks.full.size
        gradients, volume = self.stiffness.gradients, self.stiffness.volume
        deform(self.connectivity, self.gradients, self.volume, displacement, gradients[:own], volume[:own])
        if full:
            at = own - POINTS * full
            volume[own:], gradients[own:] = mean_of_points(
                volume[at:own].reshape(-1, POINTS), gradients[at:own].reshape(-1, POINTS, 3, 8)
            )
        if self.neo_hookean.any():
            rows = np.concatenate([self.gradients, self.blocks.gradients[self.blocks.full]])
            moved = np.einsum("nac,nja->ncj", displacement[self.stiffness.connectivity], rows)
            shear, bulk = stiffened(*self.moduli, self.neo_hookean, moved)
            self.stiffness.shear[:] = shear
            self.stiffness.lame[:] = bulk - 2.0 / 3.0 * shear

    def frequency_squared(self, displacement: Floats) -> float:
        """Return the square of the highest angular frequency at a displacement (n, 3), hourglass stiffness included."""
        b = self.blocks
        self._deform(displacement)
        arbitrary = self.random.standard_normal(displacement.shape) * (self.root > 0.0)
        if self.mode is None:
            largest, self.mode = self._lanczos(arbitrary, FIRST_STEPS)
        else:
            arbitrary *= ANYWHERE / math.sqrt(dot(arbitrary.ravel(), arbitrary.ravel()))
            largest, self.mode = self._lanczos(self.mode + arbitrary, NEXT_STEPS)
        return largest + float((b.hourglass / (b.density * b.volume)).max())

    def increment(self, displacement: Floats) -> float:
        """Return 2 (sqrt(1 + x^2) - x)/omega with a bound on the damping ratio x of the highest modes.

        Bulk viscosity takes at most its ratio to the bulk modulus of what the elastic stress does, in the element where
        that ratio is largest; damping of the material is proportional to the stiffness.
        """
        omega = math.sqrt(self.frequency_squared(displacement))
        b = self.blocks
        ratio = 0.5 * omega * float((b.bulk_linear / b.bulk + b.damping).max())
        return float(2.0 * (math.sqrt(1.0 + ratio**2) - ratio) / omega)

    def _lanczos(self, start: Floats, steps: int) -> tuple[float, Floats]:
        """Return the largest eigenvalue and its vector, of unit length, in the Krylov space of `start`."""
        basis = np.zeros((steps, start.size))
        diagonal, beside = np.zeros(steps), np.zeros(steps)
        count = krylov(self.stiffness, self.root.ravel(), start.ravel(), basis, diagonal, beside)
        values, vectors = eigh_tridiagonal(
            diagonal[:count], beside[: count - 1], select="i", select_range=(count - 1, count - 1)
        )
        mode = (vectors[:, 0, None] * basis[:count]).sum(axis=0)
        return float(values[0]), mode.reshape(start.shape)
