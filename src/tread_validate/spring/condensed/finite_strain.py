"""What logarithmic strain adds to the small-strain stiffness of a block, before any reference run is looked at.

Write the displacement as a series in the compression, u = d u1 + d^2 u2 + ...; u2 vanishes where u is prescribed. The
force follows from virtual work with the linear solution u1 as the virtual displacement, N = int P : grad u1. In it the
term of u2 drops out, because C : grad u1 is in equilibrium. So the linear solution alone gives the force to second
order, N = k d (1 + c d): evaluate the stress of the finite-strain law on +d u1 and on -d u1. The same holds for the
shear stiffness under compression. (For a law with an energy this is the 2n + 1 theorem.)

The law is that of an explicit finite element code in rate form, in the limit: Cauchy stress = C : ln V.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from .body import Body
from .condense import assemble
from .element import IncompatibleField, lame_constants

Array = NDArray[np.float64]

PROBE = 1e-3
"""Compression over height at which the stress is evaluated: its square is what matters, its cube is negligible."""


@dataclass(frozen=True)
class Stiffening:
    """Relative growth of a stiffness per metre of compression: N = k d (1 + normal d), dT/ds = k (1 + tangential d).

    Attributes
    ----------
    normal, tangential : float, 1/m
    """

    normal: float
    tangential: float


def logarithmic_stiffening(body: Body, poissons_ratio: float) -> Stiffening:
    """Return the stiffening of `body` between its mount and a road to which its whole face sticks."""
    press, shear = (motion[body.elements] for motion in uniform_motions(body, poissons_ratio, (1, 0)))
    field = IncompatibleField(body.nodes[body.elements], poissons_ratio)
    d = PROBE * float(np.ptp(body.nodes[:, 1]))

    def force(compression: float, slide: float, virtual: Array) -> float:
        return virtual_work(field, compression * press + slide * shear, virtual, poissons_ratio)

    up, down = force(d, 0.0, press), force(-d, 0.0, press)
    shear_up = force(d, d, shear) - force(d, -d, shear)
    shear_down = force(-d, d, shear) - force(-d, -d, shear)
    return Stiffening(
        normal=(up + down) / (up - down) / d,
        tangential=(shear_up - shear_down) / (shear_up + shear_down) / d,
    )


def uniform_motions(body: Body, poissons_ratio: float, components: Sequence[int]) -> list[Array]:
    """Return the nodal displacements (all, 3) when the face moves by one metre in each direction, mount held."""
    matrix = assemble(body, poissons_ratio)
    n = body.nodes_per_layer
    inside = slice(3 * n, 3 * n * body.layers)
    factor = splu(matrix[inside, inside].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    motions = []
    for component in components:
        displacement = np.zeros((body.nodes.shape[0], 3))
        displacement[:n, component] = 1.0
        load = -(matrix @ displacement.ravel())[inside]
        displacement.ravel()[inside] = factor.solve(load)
        motions.append(displacement)
    return motions


def virtual_work(field: IncompatibleField, displacement: Array, virtual: Array, poissons_ratio: float) -> float:
    """Return int P : grad(virtual) in m3 per Pa of Young's modulus, both fields nodal (m, 8, 3).

    P is the first Piola-Kirchhoff stress of Cauchy stress = C : ln V.
    """
    amplitudes, virtual_amplitudes = field.amplitudes(displacement), field.amplitudes(virtual)
    total = 0.0
    for point in range(len(field.at_points)):
        gradient, volume = field.gradient(displacement, amplitudes, point)
        virtual_gradient, _ = field.gradient(virtual, virtual_amplitudes, point)
        total += float(np.einsum("mij,mij,m->", piola_stress(gradient, poissons_ratio), virtual_gradient, volume))
    return total


def piola_stress(gradient: Array, poissons_ratio: float) -> Array:
    """Return the first Piola-Kirchhoff stress (m, 3, 3), per Pa of Young's modulus, of displacement gradients."""
    lame, shear = lame_constants(1.0, poissons_ratio)
    deformation = gradient + np.eye(3)
    squared, axes = np.linalg.eigh(deformation @ np.swapaxes(deformation, 1, 2))
    strain = 0.5 * np.log(squared)
    dilation = strain.sum(axis=1)
    principal = lame * dilation[:, None] + 2.0 * shear * strain
    cauchy = np.einsum("mk,mik,mjk->mij", principal, axes, axes)
    inverse = np.linalg.inv(np.swapaxes(deformation, 1, 2))
    return np.asarray(np.exp(dilation)[:, None, None] * cauchy @ inverse, dtype=np.float64)
