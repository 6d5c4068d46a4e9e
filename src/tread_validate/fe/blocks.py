"""Elements packed into blocks of lanes: gradients, hourglass data, masses, and the stable step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from . import element_kernel as kernel
from .element_full_kernel import POINTS
from .gauss import CORNERS, gauss_points, highest_frequency_squared, mean_gradients
from .hyperelastic import stiffened
from .mesh import Mesh
from .model import Model
from .relaxation import Relaxation, relaxation_of

Floats = NDArray[np.float64]
LANES = kernel.LANES
HOURGLASS_PATTERNS = np.stack(
    [
        CORNERS[:, 1] * CORNERS[:, 2],
        CORNERS[:, 0] * CORNERS[:, 2],
        CORNERS[:, 0] * CORNERS[:, 1],
        CORNERS[:, 0] * CORNERS[:, 1] * CORNERS[:, 2],
    ]
)
# c in the energy (c/2) G V (sum of squared gradients) q^2 of an hourglass mode of amplitude q.
HOURGLASS_COEFFICIENT = 0.05


@dataclass
class Blocks:
    """Element data in the layout of the kernel, and the same per element.

    Attributes
    ----------
    conn : (blocks, 8, LANES) int32; geo, state : (blocks, rows, LANES); kind : (blocks,) int32
    order : (blocks * LANES,) int
        Element index in each lane, -1 where a lane is empty; a fully integrated element has one for each Gauss point.
    reduced_blocks : int
        Blocks of one-point elements; those of Gauss points come after them.
    full : (f,) int
        The fully integrated elements; point_volume (f, 8) and point_gradients (f, 8, 3, 8) are theirs.
    spectra : list of Relaxation
        One per row of the material tables (material and temperature).
    gradients : (m, 3, 8); volume, density, shear, bulk, hourglass, bulk_linear, damping : (m,)
    mass : (n,) nodal masses
    slots, slot_start : ints
        Where in the flat force array each node gathers from: rows of `LANES`, x then y then z.
    """

    conn: NDArray[np.int32]
    geo: Floats
    state: Floats
    kind: NDArray[np.int32]
    order: NDArray[np.int64]
    spectra: list[Relaxation]
    kind_of_element: NDArray[np.int64]
    gradients: Floats
    volume: Floats
    density: Floats
    shear: Floats
    bulk: Floats
    hourglass: Floats
    bulk_linear: Floats
    damping: Floats
    mass: Floats
    slots: NDArray[np.int32]
    slot_start: NDArray[np.int32]
    connectivity: NDArray[np.int64]
    reduced_blocks: int
    full: NDArray[np.int64]
    point_volume: Floats
    point_gradients: Floats

    @property
    def terms(self) -> int:
        """Number of Prony recursions an element carries."""
        return max((spectrum.times.size for spectrum in self.spectra), default=0)

    @property
    def neo_hookean(self) -> NDArray[np.bool_]:
        """Which elements follow the neo-Hookean law, (m,)."""
        return np.array([spectrum.neo_hookean for spectrum in self.spectra])[self.kind_of_element]

    def frequency_squared(self, gradient_of_displacement: Floats | None = None) -> Floats:
        """Return a bound on the square of each element's highest angular frequency, (m,).

        With lumped mass rho V/8 and M = sum b b^T over the nodes, the dilatation and shear of the one-point element
        give 8 (lambda tr M + 2 G max eig M)/rho; it reduces to 4 c^2 sum 1/l^2 for a nearly incompressible brick.
        Gradients follow the deformation when F - 1, shape (m, 3, 3), is given. A fully integrated element has its own
        stiffness matrix instead.
        """
        trace, largest = self._moments(gradient_of_displacement)
        return self._frequency_squared(trace, largest, gradient_of_displacement)

    def stable_increments(self, gradient_of_displacement: Floats) -> Floats:
        """Return a bound on each element's stable increment under the bulk viscosity that is set, (m,).

        2 (sqrt(1 + x^2) - x)/omega; x = 4 b1 rho c L tr M/(rho omega) + beta omega/2 is the damping ratio of the
        dilatation, beta that of the material.
        """
        trace, largest = self._moments(gradient_of_displacement)
        omega = np.sqrt(self._frequency_squared(trace, largest, gradient_of_displacement))
        ratio = 4.0 * self.bulk_linear * trace / (self.density * omega) + 0.5 * self.damping * omega
        return np.asarray(2.0 * (np.sqrt(1.0 + ratio**2) - ratio) / omega, dtype=np.float64)

    def _moments(self, gradient_of_displacement: Floats | None) -> tuple[Floats, Floats]:
        """Return the trace and the largest eigenvalue of M, each (m,)."""
        b = self.gradients
        if gradient_of_displacement is not None:
            f = gradient_of_displacement + np.eye(3)
            b = np.asarray(np.linalg.solve(np.swapaxes(f, 1, 2), b), dtype=np.float64)
        m = b @ np.swapaxes(b, 1, 2)
        largest: Floats = np.linalg.eigvalsh(m)[:, 2].astype(np.float64)
        return np.asarray(np.trace(m, axis1=1, axis2=2), dtype=np.float64), largest

    def _frequency_squared(self, trace: Floats, largest: Floats, gradient_of_displacement: Floats | None) -> Floats:
        shear, bulk = stiffened(self.shear, self.bulk, self.neo_hookean, gradient_of_displacement)
        lame = np.maximum(bulk - 2.0 / 3.0 * shear, 0.0)
        whole = 8.0 * (lame * trace + 2.0 * shear * largest) / self.density
        found = np.maximum(whole, self.hourglass / (self.density * self.volume))
        if self.full.size:
            volume, gradients = self.point_volume, self.point_gradients
            if gradient_of_displacement is not None:
                f = gradient_of_displacement[self.full] + np.eye(3)
                volume = volume * np.linalg.det(f)[:, None]
                gradients = np.linalg.solve(np.swapaxes(f, 1, 2)[:, None], gradients).astype(np.float64)
            own = self.full
            found[own] = highest_frequency_squared(volume, gradients, shear[own], bulk[own], self.density[own])
        return np.asarray(found, dtype=np.float64)


def pack(model: Model, duration: float) -> Blocks:
    """Build the blocks of a model for a run of `duration`; raises `InputError` for an element without volume."""
    mesh = model.mesh
    corners = mesh.coordinates[mesh.connectivity]
    volume, gradients = mean_gradients(corners)
    full = np.flatnonzero(mesh.full)
    point_volume, point_gradients = gauss_points(corners[full])
    least = volume.copy()
    least[full] = np.minimum(least[full], 8.0 * point_volume.min(axis=1, initial=np.inf))
    bad = np.flatnonzero(~(least > 0))
    if bad.size:
        label = mesh.element_labels[bad[0]]
        raise InputError(f"element {label}", f"volume {least[bad[0]]:g}", "a positive volume (node order of C3D8R)")
    kinds, spectra, section_of = _kinds(model, duration)
    shear = np.array([spectra[k].shear for k in kinds])
    bulk = np.array([spectra[k].bulk for k in kinds])
    density = np.array([model.sections[s].material.density for s in section_of])
    hourglass = _hourglass_stiffness(model, section_of, kinds, spectra, gradients, volume)
    hourglass[full] = 0.0
    order, reduced_blocks = _order(kinds, mesh.full)
    blocks = Blocks(
        conn=np.zeros((0, 8, LANES), dtype=np.int32),
        geo=np.zeros((order.size // LANES, kernel.GEO_ROWS, LANES)),
        state=np.zeros((order.size // LANES, kernel.STATE_ROWS, LANES)),
        kind=kinds[order.reshape(-1, LANES)[:, 0]].astype(np.int32),
        order=order,
        spectra=spectra,
        kind_of_element=kinds,
        gradients=gradients,
        volume=volume,
        density=density,
        shear=shear,
        bulk=bulk,
        hourglass=hourglass,
        bulk_linear=np.zeros(volume.size),
        damping=np.array([model.sections[s].material.damping for s in section_of]),
        mass=np.zeros(0),
        slots=np.zeros(0, dtype=np.int32),
        slot_start=np.zeros(0, dtype=np.int32),
        connectivity=mesh.connectivity,
        reduced_blocks=reduced_blocks,
        full=full,
        point_volume=point_volume,
        point_gradients=point_gradients,
    )
    _fill(blocks, mesh, corners)
    set_masses(blocks, mesh)
    return blocks


def _kinds(model: Model, duration: float) -> tuple[NDArray[np.int64], list[Relaxation], NDArray[np.int64]]:
    """Return the material row of each element (material and temperature), the rows, and each element's section."""
    count = model.mesh.element_labels.size
    kinds = np.zeros(count, dtype=np.int64)
    section_of = np.zeros(count, dtype=np.int64)
    spectra: list[Relaxation] = []
    for number, section in enumerate(model.sections):
        section_of[section.elements] = number
        material = section.material
        if material.trs is None or not material.prony.size or model.temperature is None:
            kinds[section.elements] = len(spectra)
            spectra.append(relaxation_of(material, 0.0, duration))
            continue
        mean = model.temperature[model.mesh.connectivity[section.elements]].mean(axis=1).round(3)
        for value in np.unique(mean):
            kinds[section.elements[mean == value]] = len(spectra)
            spectra.append(relaxation_of(material, float(value), duration))
    return kinds, spectra, section_of


def _hourglass_stiffness(
    model: Model,
    section_of: NDArray[np.int64],
    kinds: NDArray[np.int64],
    spectra: list[Relaxation],
    gradients: Floats,
    volume: Floats,
) -> Floats:
    """Return the stiffness of each element's hourglass amplitudes.

    STIFFNESS takes the instantaneous shear modulus, RELAX STIFFNESS the long-term one.
    """
    out = np.zeros(section_of.size)
    squares = (gradients**2).sum(axis=(1, 2)) * volume
    for number, section in enumerate(model.sections):
        mine = section_of == number
        shear, _ = section.material.shear_and_bulk()
        relaxed = shear * (1.0 - float(section.material.prony[:, 0].sum()))
        modulus = shear if section.hourglass == "STIFFNESS" else relaxed
        out[mine] = section.hourglass_scale * HOURGLASS_COEFFICIENT * modulus * squares[mine]
    return out


def _order(kinds: NDArray[np.int64], full: NDArray[np.bool_]) -> tuple[NDArray[np.int64], int]:
    """Return the element in each lane, and the number of blocks of one-point elements, which come first.

    Elements of one kind in their order, fully integrated ones once a Gauss point, padded to whole blocks with -1.
    """
    parts = []
    reduced_blocks = 0
    for whole, lanes in ((False, 1), (True, POINTS)):
        for kind in np.unique(kinds[full == whole]):
            own = np.repeat(np.flatnonzero((kinds == kind) & (full == whole)), lanes)
            parts.append(np.concatenate([own, np.full(-own.size % LANES, -1)]))
        if not whole:
            reduced_blocks = sum(part.size for part in parts) // LANES
    return np.concatenate(parts), reduced_blocks


def _fill(blocks: Blocks, mesh: Mesh, corners: Floats) -> None:
    order = blocks.order
    used = order >= 0
    own = order[used]
    dummy = mesh.node_labels.size
    conn = np.full((order.size, 8), dummy, dtype=np.int32)
    conn[used] = mesh.connectivity[own]
    blocks.conn = np.ascontiguousarray(3 * conn.reshape(-1, LANES, 8).transpose(0, 2, 1)).astype(np.int32)
    rows: Floats = np.zeros((order.size, kernel.GEO_ROWS))
    rows[used, : kernel.GEO_G] = blocks.gradients[own].reshape(own.size, 24)
    offsets = np.einsum("ha,eaj->ehj", HOURGLASS_PATTERNS, corners[own])
    rows[used, kernel.GEO_G : kernel.GEO_VOLUME] = offsets.reshape(own.size, 12)
    rows[used, kernel.GEO_VOLUME] = blocks.volume[own]
    rows[used, kernel.GEO_HOURGLASS] = blocks.hourglass[own]
    points = used & (np.arange(order.size) >= blocks.reduced_blocks * LANES)
    at = np.searchsorted(blocks.full, order[points]), np.flatnonzero(points) % POINTS
    rows[points, : kernel.GEO_G] = blocks.point_gradients[at].reshape(-1, 24)
    rows[points, kernel.GEO_G : kernel.GEO_VOLUME] = 0.0
    rows[points, kernel.GEO_VOLUME] = blocks.point_volume[at]
    blocks.geo[:] = rows.reshape(-1, LANES, kernel.GEO_ROWS).transpose(0, 2, 1)
    blocks.state[:, kernel.STATE_U : kernel.STATE_U + 3] = 1.0
    lane = np.flatnonzero(used)
    first = (lane // LANES * 24 * LANES + lane % LANES)[:, None] + 3 * LANES * np.arange(8)
    node = mesh.connectivity[own].ravel()
    sorting = np.argsort(node, kind="stable")
    blocks.slots = first.ravel()[sorting].astype(np.int32)
    blocks.slot_start = np.searchsorted(node[sorting], np.arange(dummy + 1)).astype(np.int32)


def set_masses(blocks: Blocks, mesh: Mesh) -> None:
    """Lump rho V/8 of each element on its nodes."""
    share = np.repeat(blocks.density * blocks.volume / 8.0, 8)
    blocks.mass = np.bincount(mesh.connectivity.ravel(), share, mesh.node_labels.size).astype(np.float64)


def set_bulk_viscosity(blocks: Blocks, model: Model, linear: float, quadratic: float) -> None:
    """Write the bulk viscosity of a step into the blocks: b1 rho c L and rho (b2 L)^2, with L = 2 c/omega."""
    wave = np.sqrt((blocks.bulk + 4.0 / 3.0 * blocks.shear) / blocks.density)
    length = 2.0 * wave / np.sqrt(blocks.frequency_squared())
    one = np.ones(blocks.volume.size)
    two = np.ones(blocks.volume.size)
    for section in model.sections:
        one[section.elements] = section.linear_scale
        two[section.elements] = section.quadratic_scale
    blocks.bulk_linear = linear * one * blocks.density * wave * length
    rows = np.zeros((blocks.order.size, 2))
    used = blocks.order >= 0
    own = blocks.order[used]
    rows[used, 0] = blocks.bulk_linear[own]
    rows[used, 1] = (blocks.density * (quadratic * two * length) ** 2)[own]
    first = kernel.GEO_BULK_LINEAR
    blocks.geo[:, first : first + 2] = rows.reshape(-1, LANES, 2).transpose(0, 2, 1)
