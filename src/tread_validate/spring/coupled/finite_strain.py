"""What logarithmic strain adds to the small-strain stiffness of a block, before any reference run is looked at.

The stored energy of an elastic body expands in the compression d as U = k d^2/2 + U3 d^3. By the 2n + 1 theorem of
perturbation theory the linear solution alone gives U3: the second-order displacements vanish on the boundary and first
appear with d^4. So the energy of Hencky's solid, evaluated on the linear displacements at +d and -d, tells how the
force stiffens, F = k d (1 + c d) with c = 3 U3/k. Likewise for the stiffness in shear under compression.

Hencky's solid has Kirchhoff stress proportional to logarithmic strain, which is what the rate form of an explicit
finite element code tends to; the ratio of the two stresses is the volume ratio, here within 0.2 per cent.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from .body import Body
from .condense import assemble
from .element import GAUSS, IncompatibleField, lame_constants

Array = NDArray[np.float64]


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
    press, shear = _uniform_motion(body, poissons_ratio, 1), _uniform_motion(body, poissons_ratio, 0)
    height = float(np.ptp(body.nodes[:, 1]))
    field = IncompatibleField(body.nodes[body.elements], poissons_ratio)
    d = 1e-3 * height

    def energy(compression: float, slide: float) -> float:
        return _hencky_energy(field, (compression * press + slide * shear)[body.elements], poissons_ratio)

    up, down, none = energy(d, 0.0), energy(-d, 0.0), energy(0.0, 0.0)
    k_normal = (up + down - 2.0 * none) / d**2
    cubic = (up - down) / (2.0 * d**3)
    with_up = energy(d, d) + energy(d, -d) - 2.0 * up
    with_down = energy(-d, d) + energy(-d, -d) - 2.0 * down
    k_shear = 0.5 * (with_up + with_down) / d**2
    return Stiffening(3.0 * cubic / k_normal, 0.5 * (with_up - with_down) / (d * k_shear * d**2))


def _uniform_motion(body: Body, poissons_ratio: float, component: int) -> Array:
    """Return the nodal displacements (all, 3) when the face moves by one metre in one direction, mount held."""
    matrix = assemble(body, poissons_ratio)
    displacement = np.zeros((body.nodes.shape[0], 3))
    n = body.nodes_per_layer
    displacement[:n, component] = 1.0
    inside = np.arange(3 * n, 3 * n * body.layers)
    load = -(matrix @ displacement.ravel())[inside]
    displacement.ravel()[inside] = splu(matrix[inside][:, inside].tocsc()).solve(load)
    return displacement


def _hencky_energy(field: IncompatibleField, displacement: Array, poissons_ratio: float) -> float:
    """Return the energy (J per Pa of Young's modulus) of nodal displacements (m, 8, 3)."""
    lame, shear = lame_constants(1.0, poissons_ratio)
    total = 0.0
    amplitudes = field.amplitudes(displacement)
    for point in GAUSS:
        gradient, weight = field.gradient(displacement, amplitudes, point)
        deformation = gradient + np.eye(3)
        squared = np.linalg.eigvalsh(np.swapaxes(deformation, 1, 2) @ deformation)
        strain = 0.5 * np.log(squared)
        density = 0.5 * lame * strain.sum(axis=1) ** 2 + shear * np.sum(strain**2, axis=1)
        total += float(density @ weight)
    return total
