"""The condensed block against exact elasticity, and against another code's quadratic elements."""

import numpy as np
import pytest

from tread_validate.spring.condensed.body import BodySettings, FreeShape, make_body
from tread_validate.spring.condensed.condense import assemble, condense
from tread_validate.spring.condensed.element import IncompatibleField, lame_constants
from tread_validate.spring.condensed.finite_strain import (
    division,
    face_motions,
    second_order_arrays,
    second_order_of,
)
from tread_validate.spring.condensed.inputs import Operator, Pose, scratch
from tread_validate.spring.condensed.operators import FaceOperators
from tread_validate.spring.condensed.products import loads
from tread_validate.spring.condensed.second_order import shift
from tread_validate.spring.condensed.store import converged_ratios
from tread_validate.spring.condensed.stuck import stuck_ratios_of
from tread_validate.spring.condensed.symmetry import folded, folds, spread
from tread_validate.spring.stiffness import static_ratios
from tread_validate.study import Block

NU = 0.47
COARSE = BodySettings(face_size=2.5e-3, layers=4)


def block(**changes):
    plan = {"origin": "assumed", "source": "test", "shape": "rectangle", "length_mm": 25, "width_mm": 20}
    return Block(**{**plan, "height_mm": 8, "mounting": "flat", **changes})


SKEWED = block(shape="parallelogram", skew_deg=30)
RING = FreeShape(1 / 0.092, False, 0.92)


@pytest.mark.parametrize(("plan", "shape"), [(block(), FreeShape()), (SKEWED, FreeShape()), (SKEWED, RING)])
def test_uniform_strain_leaves_no_force_inside_the_block(plan, shape):
    """Patch test: a linear displacement field is in equilibrium at every inner node of any mesh, to round-off."""
    body = make_body(plan, shape, COARSE)
    gradient = np.array([[0.01, -0.02, 0.03], [0.005, 0.02, -0.01], [0.0, 0.01, -0.03]])
    if body.half:
        gradient[2, :2] = 0.0  # the plane of symmetry carries no shear and does not move
        gradient[:2, 2] = 0.0
    force = (assemble(body, NU) @ (body.nodes @ gradient.T).ravel()).reshape(-1, 3)
    face, n = np.arange(body.nodes.shape[0]), body.nodes_per_layer
    inner = (face >= n) & (face < face.size - n)
    rim = np.abs(body.nodes[:, 2]) > 0.0099
    along = np.tile(body.along, body.layers + 1)
    place = body.nodes[:, 2] * np.tan(np.deg2rad(plan.skew_deg))
    inner &= ~rim & (np.abs(along + place) < 0.0124) & (np.abs(body.nodes[:, 2]) > (1e-9 if body.half else -1))
    assert inner.sum() > 20
    assert np.abs(force[inner]).max() < 1e-12 * np.abs(force).max()


def test_a_mount_that_moves_takes_an_unloaded_block_along():
    """Exact: a rigid translation of the mount is the same translation of the free face, to round-off."""
    body = make_body(SKEWED, FreeShape(), COARSE)
    follow, knots = condense(body, NU).follow, body.knots.size
    for component in (0, 1):
        moved = follow[:, component * knots : (component + 1) * knots].sum(axis=1).reshape(-1, 3)
        assert np.allclose(moved, np.eye(3)[component], atol=1e-12)


def test_without_poissons_effect_a_block_presses_as_uniaxial_springs():
    """nu = 0: E A d/h whether the face sticks or slides, and any element size is exact."""
    body = make_body(block(), FreeShape(), COARSE)
    ratios = static_ratios(body, condense(body, 0.0), 0.0, 8e-3)
    assert ratios.normal == pytest.approx(1.0, rel=1e-10)
    assert ratios.normal_sliding == pytest.approx(1.0, rel=1e-10)


def test_condensing_does_not_change_the_stiffness_that_a_direct_solve_finds():
    """Same mesh, same elements, one sparse solve in place of the layer-by-layer elimination: equal to 1e-9."""
    body = make_body(SKEWED, RING, COARSE)
    matrix = condense(body, NU).stiffness
    for component in (0, 1, 2):
        whole = uniform_motion(body, component).ravel()
        energy = whole @ (assemble(body, NU) @ whole)
        face = np.tile(np.eye(3)[component], body.nodes_per_layer)
        assert face @ matrix @ face == pytest.approx(energy, rel=1e-9)


SIPED = block(sipes=[{"position_mm": 7.9, "width_mm": 0.6, "depth_mm": 6.0}])
SOLID = [(block(), FreeShape()), (block(), RING), (SKEWED, FreeShape()), (SKEWED, RING)]


@pytest.mark.parametrize(("plan", "shape"), [*SOLID, (SIPED, RING)])
def test_even_and_odd_motions_together_are_the_whole_block(plan, shape):
    """The Schur complement of the assembled matrix, inside out, is what the folded elimination leaves: round-off."""
    body = make_body(plan, shape, COARSE)
    assert (folds(body) is None) == bool(plan.sipes)
    whole, n = assemble(body, NU).toarray(), 3 * body.nodes_per_layer
    face, inside, mount = slice(0, n), slice(n, n * body.layers), slice(n * body.layers, None)
    solved = np.linalg.solve(whole[inside, inside], np.hstack([whole[inside, face], whole[inside, mount]]))
    stiffness = whole[face, face] - whole[face, inside] @ solved[:, :n]
    follow = np.linalg.solve(stiffness, whole[face, inside] @ solved[:, n:] @ body.mount_shapes())
    found = condense(body, NU)
    assert np.abs(found.stiffness - stiffness).max() < 1e-12 * np.abs(stiffness).max()
    assert np.abs(found.follow - follow).max() < 1e-11


@pytest.mark.parametrize(("plan", "shape"), SOLID)
def test_folded_products_of_a_face_are_those_of_the_whole_matrix(plan, shape):
    """Even part + odd part = all, to single precision; and the parts put together are the matrix, to round-off."""
    body = make_body(plan, shape, COARSE)
    matrix, parts = condense(body, NU).stiffness, folds(body)
    again = np.zeros_like(matrix)
    for fold in parts:
        spread(folded(matrix, fold), fold, again)
    assert np.abs(again - matrix).max() < 1e-13 * np.abs(matrix).max()
    blocks = [np.ascontiguousarray(each, dtype=np.float32) for each in (matrix, *(folded(matrix, f) for f in parts))]
    q, out = np.sin(np.arange(matrix.shape[0])), np.empty(matrix.shape[0])
    loads(Operator(*blocks), *parts, q, out)
    assert np.abs(out - matrix @ q).max() < 1e-5 * np.abs(matrix @ q).max()


@pytest.mark.parametrize(("plan", "shape"), [*SOLID, (SIPED, RING)])
def test_a_window_is_the_inverse_of_its_part_of_the_compliance(plan, shape):
    """Also on the trailing half of a symmetric face, where it is taken from its image: to single precision."""
    body = make_body(plan, shape, COARSE)
    matrix = condense(body, NU).stiffness
    parts = FaceOperators(body, lambda: matrix)
    first, cells = parts.windows.first, parts.windows.first.size - 1
    for a, b in ((0, 1), (0, 2), (1, 3), (cells - 2, cells), (0, cells)):
        parts.add(a, b)
        inside = slice(3 * first[a], 3 * first[b])
        exact = np.linalg.inv(np.linalg.inv(matrix)[inside, inside])
        at, size = parts.windows.offset[a, b], exact.shape[0]
        found = parts.windows.pool[at : at + size**2].reshape(size, size)
        assert np.abs(found - exact).max() < 1e-6 * np.abs(exact).max()


@pytest.mark.parametrize(("plan", "shape"), [*SOLID, (SIPED, RING)])
def test_two_motions_of_the_face_are_enough_for_normal_and_shear_stiffness(plan, shape):
    """A banded solve for them agrees with the condensed matrix to round-off."""
    body = make_body(plan, shape, COARSE)
    ratios = static_ratios(body, condense(body, NU), NU, 8e-3)
    assert stuck_ratios_of(plan, body, NU, 8e-3) == pytest.approx((ratios.normal, ratios.shear), rel=1e-11)


def quadratic_ratios(parts):
    """Normal stiffness (stuck, sliding) and shear stiffness over the uniaxial springs', from scikit-fem."""
    import skfem
    from skfem.helpers import ddot, sym_grad, trace

    x, y, z = (np.linspace(0, end, n + 1) for end, n in zip((25.0, 8.0, 10.0), parts, strict=True))
    basis = skfem.Basis(skfem.MeshHex.init_tensor(x, y, z), skfem.ElementVector(skfem.ElementHex2()), intorder=4)
    shear = 0.5 / (1 + NU)
    lame = 2 * shear * NU / (1 - 2 * NU)

    @skfem.BilinearForm
    def elastic(u, v, _):
        a, b = sym_grad(u), sym_grad(v)
        return lame * trace(a) * trace(b) + 2 * shear * ddot(a, b)

    matrix = elastic.assemble(basis).tocsr()
    place = basis.doflocs
    component = np.zeros(basis.N, dtype=int)
    for dofs in (basis.nodal_dofs, basis.facet_dofs, basis.edge_dofs, basis.interior_dofs):
        for k in range(3):
            component[dofs[k::3]] = k
    face, mount, middle = place[1] == 0, place[1] == 8.0, place[2] == 0
    results = []
    for moved, held in ((1, face), (1, face & (component == 1)), (0, face)):
        u = np.where(face & (component == moved), 1.0, 0.0)
        fixed = np.flatnonzero(held | mount | (middle & (component == 2)))
        u = skfem.solve(*skfem.condense(matrix, np.zeros(basis.N), x=u, D=fixed))
        results.append(2 * float(u @ matrix @ u) * 8 / 500)
    return results[0], results[1], results[2] / shear


def test_extrapolated_stiffness_agrees_with_quadratic_elements_of_another_code():
    """scikit-fem, 27-node bricks, 4 x 2 x 2 and 8 x 4 x 4, extrapolated with the order 1.316 that its own meshes of 4,
    6, 8 and 12 elements show: the stuck block agrees to 1 %, what is left of the corner singularities; the sliding
    and the sheared one, with half as many singular edges that matter, too."""
    ours = converged_ratios(block(), FreeShape(), NU)
    coarse, fine = (np.array(quadratic_ratios(parts)) for parts in ((4, 2, 2), (8, 4, 4)))
    stuck, sliding, shear = fine + (fine - coarse) / (2**1.316 - 1)
    assert ours.normal == pytest.approx(stuck, rel=1e-2)
    assert ours.normal_sliding == pytest.approx(sliding, rel=1e-2)
    assert ours.shear == pytest.approx(shear, rel=1e-2)
    # conforming elements are stiffer than the body, so the limit lies below both
    assert ours.normal < fine[0] < coarse[0]


def uniform_motion(body, component):
    """Displacements of all nodes, (all, 3), when the face moves by one metre."""
    unit = np.tile(np.eye(3)[component], body.nodes_per_layer)
    unit[3 * body.on_symmetry_plane[body.on_symmetry_plane < body.nodes_per_layer] + 2] = 0.0
    return (face_motions(body, NU) @ unit).reshape(-1, 3)


def moved_face(body, plan, poissons_ratio, displacement, knots=None):
    """Shift of second order of the unloaded face, (n, 3), for displacements of the face and of the mount's knots."""
    arrays = second_order_arrays(plan, FreeShape(), body, poissons_ratio)
    second = second_order_of(arrays, body, poissons_ratio)
    work = scratch(body.along.size, 0, second)
    work.moved[:] = np.reshape(displacement, (-1, 3)).T
    bend = np.zeros(0, dtype=np.float32) if knots is None else arrays["bend"] @ knots.astype(np.float32)
    shift(Pose(0.0, 0.0, 0.0, body.face.copy(), bend), second, work)
    return work.unloaded - body.face


def stiffening(d, poissons_ratio):
    """Force on the stuck face pressed by d over the linear one, less 1; a quadrature point an element."""
    body = make_body(block(), FreeShape(), division(block()))
    press = np.zeros((body.along.size, 3))
    press[:, 1] = d
    matrix = condense(body, poissons_ratio).stiffness
    moved = moved_face(body, block(), poissons_ratio, press)
    linear, whole = (float((matrix @ u.ravel()).reshape(-1, 3)[:, 1].sum()) for u in (press, press - moved))
    return whole / linear - 1.0


def test_logarithmic_strain_stiffens_a_bar_without_poissons_effect_by_half_its_strain():
    """nu = 0: force E A ln(h/(h - d)) = E A (d/h)(1 + d/(2h) + ...); single precision leaves 1e-4 of that."""
    assert stiffening(1e-4, 0.0) == pytest.approx(1e-4 / (2 * 8e-3), rel=1e-3)


def test_second_order_stiffening_predicts_a_full_nonlinear_solve():
    """Newton's method on the finite-strain equilibrium at 0.1 mm, on another division: 5 % of the second order
    (2.02 % of N against 2.09 %; 1.97 and 1.95 % on finer ones)."""
    body = make_body(block(), FreeShape(), BodySettings(2e-3, 4))
    ratio = nonlinear_force(body, 1e-4) / (nonlinear_force(body, 1e-7) * 1e3)
    assert ratio - 1 == pytest.approx(stiffening(1e-4, NU), rel=0.05)


def test_a_block_that_turns_with_its_mount_keeps_its_shape_to_third_order():
    """A mount turned by an angle takes the unloaded face along; small displacements leave phi^2/2 of the place, which
    would be a strain. With the second order what is left falls with the third power of the angle or faster."""
    plan = block()
    body = make_body(plan, FreeShape(), COARSE)
    follow = condense(body, NU).follow
    left, small = [], []
    for angle in (0.1, 0.2):
        turned = np.concatenate([(np.cos(angle) - 1.0) * body.knots, np.sin(angle) * body.knots])
        face = (follow @ turned).reshape(-1, 3)
        moved = moved_face(body, plan, NU, face, turned)
        x, y = body.face[:, 0], body.face[:, 1]
        cosine, sine = np.cos(angle), np.sin(angle)
        exact = np.column_stack([(cosine - 1.0) * x - sine * y, sine * x + (cosine - 1.0) * y])
        small.append(np.abs(face[:, :2] - exact).max())
        left.append(np.abs((face + moved)[:, :2] - exact).max())
    assert left[1] < 0.25 * small[1]
    assert left[1] / left[0] > 7.0


def nonlinear_force(body, d):
    """Force (m2 per Pa) on the face pressed by d, by modified Newton with the linear tangent."""
    from scipy.sparse.linalg import splu

    field = IncompatibleField(body.nodes[body.elements], NU)
    count, n = body.nodes.shape[0], body.nodes_per_layer
    u = d * uniform_motion(body, 1)
    bubbles = field.amplitudes(u[body.elements])
    matrix = assemble(body, NU)
    inside = np.arange(3 * n, 3 * n * body.layers)
    solver = splu(matrix[inside][:, inside].tocsc())
    plane = 3 * body.on_symmetry_plane + 2
    for _ in range(30):
        for _ in range(2):
            inner = residual(field, u[body.elements], bubbles)[:, 8:].reshape(-1, 9, 1)
            bubbles = bubbles - np.linalg.solve(field._inner, inner).reshape(-1, 3, 3)
        nodal = residual(field, u[body.elements], bubbles)[:, :8]
        force = np.zeros((count, 3))
        np.add.at(force, body.elements.ravel(), nodal.reshape(-1, 3))
        force.ravel()[plane] = 0.0
        step = np.zeros(3 * count)
        step[inside] = -solver.solve(force.ravel()[inside])
        u = u + step.reshape(-1, 3)
        bubbles = bubbles + field.amplitudes(step.reshape(-1, 3)[body.elements])
        if np.abs(step).max() < 1e-9 * d:
            break
    return force[:n, 1].sum()


def residual(field, displacement, bubbles):
    total = np.zeros((displacement.shape[0], 11, 3))
    for point, (shapes, _) in enumerate(field.at_points):
        gradient, volume = field.gradient(displacement, bubbles, point)
        total += np.einsum("mij,mnj,m->mni", piola_stress(gradient, NU), shapes, volume)
    return total


def piola_stress(gradient, poissons_ratio):
    """First Piola-Kirchhoff stress (m, 3, 3), per Pa of Young's modulus, of Cauchy stress = C : ln V."""
    lame, shear = lame_constants(1.0, poissons_ratio)
    deformation = gradient + np.eye(3)
    squared, axes = np.linalg.eigh(deformation @ np.swapaxes(deformation, 1, 2))
    strain = 0.5 * np.log(squared)
    dilation = strain.sum(axis=1)
    principal = lame * dilation[:, None] + 2.0 * shear * strain
    cauchy = np.einsum("mk,mik,mjk->mij", principal, axes, axes)
    return np.exp(dilation)[:, None, None] * cauchy @ np.linalg.inv(np.swapaxes(deformation, 1, 2))
