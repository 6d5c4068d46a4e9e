"""What finite strain and rotation add to the condensed face: the unloaded face moves with the square of the strain.

With H the displacement gradient of the linear solution, eps its symmetric and W its skew part, and the rate law of an
explicit finite element code (Cauchy stress from logarithmic strain in a frame that turns with the rubber), the first
Piola-Kirchhoff stress is P = C : eps + P2 + ..., with

    P2 = C : (H^T H/2 - eps^2) + W s - s eps + tr(eps) s,    s = C : eps.

Perturbation of the equilibrium to second order (R.S. Rivlin, C. Topakoglu, J. Rational Mech. Anal. 3 (1954) 581-589;
Green and Adkins, Large Elastic Deformations, 2nd ed. 1970, ch. 5): the body under P2 alone, its mount held, would move
its unloaded face by -v, and the block answers to loads on that moved face as the linear one. v is found on
a coarser division of the block: it is a few per cent of the displacement, and needs to be known to a tenth of itself.

v is that of the elastic block: all moduli relax alike, and P2 as the square of a strain relaxes as the stress does
where strain and stress grow together.
"""

from __future__ import annotations

import math

import numpy as np

from ...kernels import kernel
from .inputs import STICK, FaceState, Fold, Pose, Scene, Scratch, SecondOrder, Shorts, Singles
from .products import combine
from .touch import turn_of

LARGEST = 0.5
"""Norm of H beyond which P2 grows no more: there a second order says nothing."""
FARTHEST = 2.0
"""The motion of a free node is extrapolated over at most so many times the step before."""


@kernel()
def shifted(pose: Pose, scene: Scene, state: FaceState, dt: float, work: Scratch) -> Pose:
    """Return the pose with the unloaded face moved to where it will be after `dt`.

    Where a node will be is known before the step is solved: one that sticks moves with the road, a free one goes on
    as it did.
    """
    second, road = scene.second, scene.road
    if second.near.shape[0] == 0:
        return pose
    cosine, sine = math.cos(pose.angle), math.sin(pose.angle)
    travel, turned, across = turn_of(road, dt)
    flat = math.isinf(road.radius)
    ahead = min(dt, FARTHEST * state.pace[0])
    for i in range(state.shift.shape[0]):
        if state.code[i] == STICK:
            x, y = state.place[i, 0], state.place[i, 1]
            if flat:
                x += travel
            else:
                up = y + road.radius
                x, y = x * turned + up * across, up * turned - x * across - road.radius
            gx, gy = x - pose.x, y - pose.y
            work.moved[0, i] = cosine * gx + sine * gy - second.free[i, 0]
            work.moved[1, i] = cosine * gy - sine * gx - second.free[i, 1]
            work.moved[2, i] = state.place[i, 2] - second.free[i, 2]
        else:
            for c in range(3):
                going = state.w[i, c] + state.shift[i, c] + ahead * (state.rate[i, c] + state.flow[i, c])
                work.moved[c, i] = pose.unloaded[i, c] + going - second.free[i, c]
    shift(pose, second, work)
    return Pose(pose.x, pose.y, pose.angle, work.unloaded, pose.bend, pose.rise)


@kernel()
def follow_up(pose: Pose, second: SecondOrder, state: FaceState, dt: float, work: Scratch) -> None:
    """Remember the shift that `shifted` found for a `pose`."""
    if second.near.shape[0] == 0:
        return
    for i in range(state.shift.shape[0]):
        for c in range(3):
            shift = work.unloaded[i, c] - pose.unloaded[i, c]
            state.flow[i, c] = (shift - state.shift[i, c]) / dt
            state.shift[i, c] = shift
    state.pace[0] = dt


@kernel()
def rest(pose: Pose, scene: Scene, state: FaceState, work: Scratch) -> Pose:
    """Return the pose with the face of the block as the mount bends it, free of force."""
    if scene.second.near.shape[0] == 0:
        return pose
    for _ in range(3):
        shifted(pose, scene, state, 0.0, work)
        follow_up(pose, scene.second, state, 1.0, work)
    state.flow[:], state.pace[0] = 0.0, 0.0
    return Pose(pose.x, pose.y, pose.angle, work.unloaded, pose.bend, pose.rise)


@kernel()
def shift(pose: Pose, second: SecondOrder, work: Scratch) -> None:
    """Write the face of `pose` moved by v to `work.unloaded`, for displacements `work.moved` of the face."""
    _strain(pose, second, work)
    _stress(second, work.gradient)
    _answer(second, work)
    three = np.uintp(3)
    for i in range(second.near.shape[0]):
        x, y, z = 0.0, 0.0, 0.0
        for k in range(4):
            j, share = three * np.uintp(second.near[i, k]), second.share[i, k]  # without a sign: no check of one
            x += share * work.coarse[j]
            y += share * work.coarse[j + np.uintp(1)]
            z += share * work.coarse[j + np.uintp(2)]
        work.unloaded[i, 0] = pose.unloaded[i, 0] + x
        work.unloaded[i, 1] = pose.unloaded[i, 1] + y
        work.unloaded[i, 2] = pose.unloaded[i, 2] + z


@kernel()
def _strain(pose: Pose, second: SecondOrder, work: Scratch) -> None:
    """Write the displacement gradients of the elements, and of their images, to `work.gradient`."""
    for c in range(3):
        combine(second.gather, work.moved[c], work.third)
        for k in range(work.third.size):
            work.coarse[3 * k + c] = work.third[k] * np.float32(second.gradient_unit)
    combine(second.gradient_even, _sizes(second.even, work.coarse), work.even)
    if second.flip.size == 0:
        work.gradient[:] = work.even
    else:
        combine(second.gradient_odd, _sizes(second.odd, work.coarse), work.odd)
        _unfold(second.flip, work.even, work.odd, work.gradient)
    if pose.bend.size > 0:
        work.gradient[:] += pose.bend


@kernel()
def _answer(second: SecondOrder, work: Scratch) -> None:
    """Write v of the coarser face for the stresses `work.gradient` to `work.coarse`."""
    work.gradient[:] *= np.float32(second.spread_unit)
    work.coarse[:] = np.float32(0.0)
    if second.flip.size == 0:
        work.even[:] = work.gradient
    else:
        _refold(second.flip, work.gradient, work.even, work.odd)
        _add_motions(second.spread_odd, second.odd, work.odd, work.coarse)
    _add_motions(second.spread_even, second.even, work.even, work.coarse)


@kernel()
def _sizes(fold: Fold, vector: Singles) -> Singles:
    """Return the size of each motion of a fold in a vector (3 c,)."""
    sizes = np.empty(fold.left.size, dtype=np.float32)
    for k in range(sizes.size):
        sizes[k] = fold.own[k] * vector[fold.left[k]] + fold.other[k] * vector[fold.right[k]]
    return sizes


@kernel()
def _add_motions(spread: Shorts, fold: Fold, stress: Singles, vector: Singles) -> None:
    sizes = np.empty(fold.left.size, dtype=np.float32)
    combine(spread, stress, sizes)
    for k in range(sizes.size):
        vector[fold.left[k]] += np.float32(fold.own[k]) * sizes[k]
        vector[fold.right[k]] += np.float32(fold.other[k]) * sizes[k]


@kernel()
def _unfold(flip: Singles, even: Singles, odd: Singles, both: Singles) -> None:
    m = even.size // 9
    for c in range(9):
        one, other, sign = even[c * m : c * m + m], odd[c * m : c * m + m], flip[c]
        here, image = both[2 * c * m : 2 * c * m + m], both[2 * c * m + m : 2 * c * m + 2 * m]
        for k in range(m):
            here[k] = one[k] + other[k]
            image[k] = sign * (one[k] - other[k])


@kernel()
def _refold(flip: Singles, both: Singles, even: Singles, odd: Singles) -> None:
    m = even.size // 9
    for c in range(9):
        one, other, sign = even[c * m : c * m + m], odd[c * m : c * m + m], flip[c]
        here, image = both[2 * c * m : 2 * c * m + m], both[2 * c * m + m : 2 * c * m + 2 * m]
        for k in range(m):
            one[k] = here[k] + sign * image[k]
            other[k] = here[k] - sign * image[k]


@kernel(reorder=True)
def _stress(second: SecondOrder, gradient: Singles) -> None:
    """Replace the gradients H, component by component, with P2 over E."""
    e = gradient.size // 9
    lame, twice = np.float32(second.lame), np.float32(2.0 * second.shear)
    half = np.float32(0.5)
    largest = np.float32(LARGEST * LARGEST)
    for k in range(e):
        h00, h01, h02 = gradient[k], gradient[e + k], gradient[2 * e + k]
        h10, h11, h12 = gradient[3 * e + k], gradient[4 * e + k], gradient[5 * e + k]
        h20, h21, h22 = gradient[6 * e + k], gradient[7 * e + k], gradient[8 * e + k]
        a, b, c = half * (h01 + h10), half * (h02 + h20), half * (h12 + h21)
        u, v, w = half * (h01 - h10), half * (h02 - h20), half * (h12 - h21)
        trace = h00 + h11 + h22
        norm = h00 * h00 + h01 * h01 + h02 * h02 + h10 * h10 + h11 * h11 + h12 * h12
        norm += h20 * h20 + h21 * h21 + h22 * h22
        scale = largest / max(norm, largest)
        # eps^2
        s00, s11, s22 = h00 * h00 + a * a + b * b, a * a + h11 * h11 + c * c, b * b + c * c + h22 * h22
        s01, s02, s12 = h00 * a + a * h11 + b * c, h00 * b + a * c + b * h22, a * b + h11 * c + c * h22
        # H^T H/2 - eps^2
        x00 = half * (h00 * h00 + h10 * h10 + h20 * h20) - s00
        x11 = half * (h01 * h01 + h11 * h11 + h21 * h21) - s11
        x22 = half * (h02 * h02 + h12 * h12 + h22 * h22) - s22
        x01 = half * (h00 * h01 + h10 * h11 + h20 * h21) - s01
        x02 = half * (h00 * h02 + h10 * h12 + h20 * h22) - s02
        x12 = half * (h01 * h02 + h11 * h12 + h21 * h22) - s12
        # s, and the part of P2 that is symmetric: C : X - s eps + tr(eps) s
        r = lame * trace
        t00, t11, t22 = r + twice * h00, r + twice * h11, r + twice * h22
        t01, t02, t12 = twice * a, twice * b, twice * c
        y = lame * (x00 + x11 + x22)
        p00 = y + twice * x00 - (r * h00 + twice * s00) + trace * t00
        p11 = y + twice * x11 - (r * h11 + twice * s11) + trace * t11
        p22 = y + twice * x22 - (r * h22 + twice * s22) + trace * t22
        p01 = twice * x01 - (r * a + twice * s01) + trace * t01
        p02 = twice * x02 - (r * b + twice * s02) + trace * t02
        p12 = twice * x12 - (r * c + twice * s12) + trace * t12
        # and W s, W = (0 u v; -u 0 w; -v -w 0)
        gradient[k] = scale * (p00 + u * t01 + v * t02)
        gradient[e + k] = scale * (p01 + u * t11 + v * t12)
        gradient[2 * e + k] = scale * (p02 + u * t12 + v * t22)
        gradient[3 * e + k] = scale * (p01 - u * t00 + w * t02)
        gradient[4 * e + k] = scale * (p11 - u * t01 + w * t12)
        gradient[5 * e + k] = scale * (p12 - u * t02 + w * t22)
        gradient[6 * e + k] = scale * (p02 - v * t00 - w * t01)
        gradient[7 * e + k] = scale * (p12 - v * t01 - w * t11)
        gradient[8 * e + k] = scale * (p22 - v * t02 - w * t12)
