"""Energies of the model: kinetic, strain, viscoelastic dissipation, hourglass, bulk viscosity."""

from __future__ import annotations

import math

import numpy as np

from ..kernels import kernel
from .element_kernel import GEO_G, GEO_HOURGLASS, GEO_VOLUME, LANES, STATE_BULK, STATE_STRAIN, STATE_U, STATE_WORK
from .hyperelastic_kernel import long_term_energy

COLUMNS = (
    "time_s",
    "internal",
    "recoverable_strain",
    "viscoelastic_dissipation",
    "artificial",
    "bulk_viscous",
    "kinetic",
    "frictional",
    "contact_impact",
    "external_work",
    "total",
)


@kernel(fastmath=True)
def element_energies(elements, weights, u):  # type: ignore[no-untyped-def]  # numba types it
    """Return recoverable energy, work of the stress, hourglass energy and bulk viscous work of all elements.

    A term of weight g holds q = g e for its spring's strain e: it stores (2 G |dev q|^2 + K tr q^2)/(2 g), per
    reference volume. Of the neo-Hookean law that is exact for what does not relax, and the quadratic form of the terms'
    stresses for the rest. The work of the stress is summed by `block_forces`; what is not stored has been dissipated.

    Parameters
    ----------
    elements : Elements
    weights : (kinds, terms, 2)
    """
    n = LANES
    d = np.empty(8)
    stored = 0.0
    stress_work = 0.0
    hourglass = 0.0
    bulk_work = 0.0
    terms = elements.hist.shape[1]
    for b in range(elements.kind.size):
        k = elements.kind[b]
        two_g = elements.elastic[k, 0]
        bulk = elements.elastic[k, 1]
        for i in range(n):
            volume = elements.geo[b, GEO_VOLUME, i]
            if volume == 0.0:
                continue
            bulk_work += elements.state[b, STATE_BULK, i]
            stress_work += elements.state[b, STATE_WORK, i]
            e = STATE_STRAIN
            d0, d1 = elements.state[b, e, i], elements.state[b, e + 1, i]
            d2, d3, d4 = elements.state[b, e + 2, i], elements.state[b, e + 3, i], elements.state[b, e + 4, i]
            theta = elements.state[b, e + 5, i]
            shape = d0 * d0 + d1 * d1 + (d0 + d1) ** 2 + 2.0 * (d2 * d2 + d3 * d3 + d4 * d4)
            shear_left, bulk_left = two_g * elements.elastic[k, 2], bulk * elements.elastic[k, 3]
            own = 0.5 * (shear_left * shape + bulk_left * theta * theta)
            if elements.elastic[k, 5] > 0.0:
                s = elements.state
                own = long_term_energy(s[b, 0, i], s[b, 1, i], s[b, 2, i], s[b, 3, i], s[b, 4, i], s[b, 5, i],
                                       shear_left, bulk_left)  # fmt: skip
            stored += volume * own
            for t in range(terms):
                if weights[k, t, 0] > 0.0:
                    d0, d1 = elements.hist[b, t, 0, i], elements.hist[b, t, 1, i]
                    d2, d3, d4 = elements.hist[b, t, 2, i], elements.hist[b, t, 3, i], elements.hist[b, t, 4, i]
                    shape = d0 * d0 + d1 * d1 + (d0 + d1) ** 2 + 2.0 * (d2 * d2 + d3 * d3 + d4 * d4)
                    own = 0.5 * two_g * shape / weights[k, t, 0]
                    stored += volume * own
                if weights[k, t, 1] > 0.0:
                    theta = elements.hist[b, t, 5, i]
                    own = 0.5 * bulk * theta * theta / weights[k, t, 1]
                    stored += volume * own
            stiff = 0.5 * elements.geo[b, GEO_HOURGLASS, i]
            for c in range(3):
                fx = 0.0
                fy = 0.0
                fz = 0.0
                for a in range(8):
                    d[a] = u[elements.conn[b, a, i] + c]
                    fx += d[a] * elements.geo[b, a, i]
                    fy += d[a] * elements.geo[b, 8 + a, i]
                    fz += d[a] * elements.geo[b, 16 + a, i]
                p01, p23, p45, p67 = d[0] + d[1], d[2] + d[3], d[4] + d[5], d[6] + d[7]
                m01, m23, m45, m67 = d[0] - d[1], d[2] - d[3], d[4] - d[5], d[6] - d[7]
                for alpha in range(4):
                    if alpha == 0:
                        q = p01 - p23 - p45 + p67
                    elif alpha == 1:
                        q = m01 - m23 - m45 + m67
                    elif alpha == 2:
                        q = m01 + m23 + m45 + m67
                    else:
                        q = -m01 - m23 + m45 + m67
                    g = GEO_G + 3 * alpha
                    q -= fx * elements.geo[b, g, i] + fy * elements.geo[b, g + 1, i] + fz * elements.geo[b, g + 2, i]
                    hourglass += stiff * (0.125 * q) ** 2
    return stored, stress_work, hourglass, bulk_work


@kernel()
def largest_strain(elements, most):  # type: ignore[no-untyped-def]  # numba types it
    """Return the largest principal logarithmic strain by size, over all elements, and `most` if that is larger.

    An element whose stretch is so near to 1 that none of its strains can be larger is passed over.
    """
    near = 1.0 - math.exp(-most)  # |log s| <= most where |s - 1| <= near
    for b in range(elements.kind.size):
        for i in range(LANES):
            if elements.geo[b, GEO_VOLUME, i] == 0.0:
                continue
            u0, u1, u2 = (
                elements.state[b, STATE_U, i],
                elements.state[b, STATE_U + 1, i],
                elements.state[b, STATE_U + 2, i],
            )
            u3, u4, u5 = (
                elements.state[b, STATE_U + 3, i],
                elements.state[b, STATE_U + 4, i],
                elements.state[b, STATE_U + 5, i],
            )
            away = (u0 - 1.0) ** 2 + (u1 - 1.0) ** 2 + (u2 - 1.0) ** 2 + 2.0 * (u3 * u3 + u4 * u4 + u5 * u5)
            if away < near * near:
                continue
            mean = (u0 + u1 + u2) / 3.0
            d0, d1, d2 = u0 - mean, u1 - mean, u2 - mean
            size = math.sqrt((d0 * d0 + d1 * d1 + d2 * d2 + 2.0 * (u3 * u3 + u4 * u4 + u5 * u5)) / 6.0)
            high = low = mean
            if size > 0.0:
                # eigenvalues of a symmetric matrix by its angle (Smith, doi:10.1145/355578.366316)
                third = (d0 * (d1 * d2 - u5 * u5) - u3 * (u3 * d2 - u5 * u4) + u4 * (u3 * u5 - d1 * u4)) / (
                    2.0 * size**3
                )
                angle = math.acos(min(1.0, max(-1.0, third))) / 3.0
                high = mean + 2.0 * size * math.cos(angle)
                low = mean + 2.0 * size * math.cos(angle + 2.0 * math.pi / 3.0)
            most = max(most, math.log(high), -math.log(low))
            near = 1.0 - math.exp(-most)
    return most


@kernel(fastmath=True)
def kinetic_energy(v, mass):  # type: ignore[no-untyped-def]  # numba types it
    """Return half the sum of m v^2; `v` flat, `mass` per node."""
    total = 0.0
    for node in range(mass.size):
        total += mass[node] * (v[3 * node] ** 2 + v[3 * node + 1] ** 2 + v[3 * node + 2] ** 2)
    return 0.5 * total
