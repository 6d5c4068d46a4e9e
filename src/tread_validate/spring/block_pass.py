"""One block pass: the case turned into the kernels' inputs, its elements run and added up."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..errors import EngineError, InputError
from ..geometry import Path, path_of
from ..study import Case
from ..units import MM
from .assembly import add_element, block_forces
from .element import run_element
from .element_record import COLUMNS
from .inputs import KernelLaw, Memory, Motion, Rubber
from .memory import TICKS, memory_of
from .rubber import law_of, series_of

Array = NDArray[np.float64]

LONGEST_STEP = 20e-6
"""Nodes are no further apart than this, s, so that a record is fine enough to compare ..."""
ENOUGH_NODES = 1500
"""... or than the contact time over this, where that is longer,"""
FEWEST_NODES = 600
"""and never further than the contact time over this."""
MARGIN = 1.1
"""An element is followed for its geometric contact time by this factor."""
SLIP_TOLERANCE = 5e-5
"""Error of lambda allowed in a slip sub-step, as a fraction of the interference."""


@dataclass(frozen=True)
class BlockPass:
    """A case ready to run at any creep ratio.

    Attributes
    ----------
    case_id : str
    path : Path
    rubber : Rubber
    law : KernelLaw
    step : float, s
        Node step: an element's transit time over a whole number.
    """

    case_id: str
    path: Path
    rubber: Rubber
    law: KernelLaw
    step: float
    element_length: float

    @cached_property
    def memory(self) -> Memory:
        """Weights of the hereditary recursion."""
        return memory_of(self.rubber, self.step)

    @cached_property
    def element_nodes(self) -> int:
        """Nodes of one element's record."""
        transit = float(self.path.columns.arc_offset(self.path.profile.extent)) / self.path.speed
        contact = self.path.contact_duration - (transit if self.path.columns.are_equal else 0.0)
        return math.ceil(MARGIN * contact / self.step) + 8

    @cached_property
    def block_nodes(self) -> int:
        """Nodes of the block's record."""
        if not self.path.columns.are_equal:
            return self.element_nodes
        return self.element_nodes + math.ceil(self.path.profile.extent / self.path.speed / self.step) + 1

    def motion(self, creep_ratio: float) -> Motion:
        """Return path and road for the kernels, the road at ``speed (1 + creep_ratio)``."""
        line, road = self.path.line, self.path.road
        return Motion(
            line.code,
            line.parameters,
            line.table,
            self.path.speed,
            line.speed_ratio,
            0.0 if road.is_plane else 1.0 / road.radius,
            self.path.speed * (1.0 + creep_ratio),
        )

    def element(self, creep_ratio: float, s: float = 0.0) -> tuple[Array, float]:
        """Return the record ((nodes, 16), see `element`) of the element at `s` (m) and its time of release (s).

        With equal columns the clock starts at the element's own first contact, else the block's. Raises `EngineError`
        for an element that never lets go.
        """
        columns, path = self.path.columns, self.path
        height = float(columns.column_height(s))
        arc, first_tick = path.first_contact_arc, 0
        if not columns.are_equal:
            arc -= float(columns.arc_offset(s))
            touch = self._touch_time(s)
            if math.isnan(touch):
                return np.zeros((self.element_nodes, COLUMNS)), 0.0
            first_tick = math.ceil(touch / self.step * TICKS - 1e-6)
        tick_length = path.speed * self.step / TICKS
        corners = np.array([math.ceil((corner - arc) / tick_length) for corner in path.line.corners], dtype=np.int64)
        record = np.zeros((self.element_nodes, COLUMNS))
        release = run_element(
            self.motion(creep_ratio),
            self.rubber,
            self.law,
            self.memory,
            height,
            arc,
            first_tick,
            corners,
            SLIP_TOLERANCE * path.interference,
            record,
        )
        if release < 0:
            raise EngineError(
                f"case {self.case_id}: the element at {s / MM:g} mm still touches after {record.shape[0]} steps"
            )
        return record, release * self.step / TICKS

    def forces(self, creep_ratio: float) -> Array:
        """Return normal force, shear force (N, positive like lambda), touching and slipping area (m2), (nodes, 4)."""
        profile = self.path.profile
        if self.path.columns.are_equal:
            record, _ = self.element(creep_ratio)
            return block_forces(
                record, self.step, self.path.speed, profile.positions, profile.jumps, profile.kinks, self.block_nodes
            )
        forces = np.zeros((self.block_nodes, 4))
        edges, middles = self.elements()
        for area, s in zip(profile.cell_areas(edges), middles, strict=True):
            record, _ = self.element(creep_ratio, float(s))
            add_element(record, float(area), forces)
        return forces

    def elements(self) -> tuple[Array, Array]:
        """Return the ends (n+1,) and the middles (n,) of the block's elements, m from its leading end."""
        extent = self.path.profile.extent
        edges = np.linspace(0.0, extent, max(round(extent / self.element_length), 1) + 1)
        return edges, 0.5 * (edges[1:] + edges[:-1])

    def net_shear_impulse(self, creep_ratio: float) -> float:
        """Return the time integral of the shear force over the pass, N s, positive like lambda (T is its negative)."""
        if self.path.columns.are_equal:
            record, _ = self.element(creep_ratio)
            return float(record[-1, 5]) * self.path.profile.area
        return float(np.sum(self.forces(creep_ratio)[:, 1])) * self.step

    def _touch_time(self, s: float) -> float:
        """Return when the free face at `s` (m) first meets the road, s; nan if it never does."""
        from scipy.optimize import brentq

        times = np.linspace(-0.05, 1.05, 401) * self.path.contact_duration
        inside = np.flatnonzero(self.path.indentation(s, times) > 0.0)
        if inside.size == 0:
            return math.nan
        k = int(inside[0])
        return float(brentq(lambda t: float(self.path.indentation(s, t)), times[k - 1], times[k], xtol=1e-12))


def prepare(case: Case, mass_factor: float = 1.0) -> BlockPass:
    """Return a case ready to run.

    Per unit of face area, so that the elements may be of any width: E(t) and G = E/(2 (1 + nu)) of Eq. (8) of the
    paper, and the lumped mass m = M/(2n), Eq. (11), as rho h_t/2, which `mass_factor` scales.

    Raises `InputError` for a path, an interference or a data file that will not do.
    """
    path = path_of(case)
    series, friction = series_of(case), law_of(case)
    rubber = Rubber(
        series.long_term_modulus,
        np.ascontiguousarray(series.moduli),
        np.ascontiguousarray(series.relaxation_times),
        0.5 / (1.0 + case.compound.poissons_ratio),
        mass_factor * 0.5 * case.compound.density_kg_m3 * case.height,
    )
    law = KernelLaw(friction.static_coefficient, *friction.kernel_arguments)
    element_length = case.spring.element_length_mm * MM
    if element_length > path.profile.extent:
        raise InputError(
            "spring.element_length_mm",
            case.spring.element_length_mm,
            f"at most the block, {path.profile.extent / MM:g} mm",
        )
    return BlockPass(case.case_id, path, rubber, law, _step(case, path, element_length), element_length)


def _step(case: Case, path: Path, element_length: float) -> float:
    """Return the node step: a whole fraction of an element's transit time, so that shifts are whole steps."""
    transit = element_length / path.speed
    contact = path.contact_duration
    longest = min(max(LONGEST_STEP, contact / ENOUGH_NODES), contact / FEWEST_NODES)
    parts = math.ceil(1.0 / case.spring.step_fraction - 1e-9)
    return transit / (parts * math.ceil(transit / (2.0 * longest) - 1e-9))


def prepare_light(case: Case) -> BlockPass:
    """Return the case ready to run, with a hundredth of the lumped mass."""
    return prepare(case, mass_factor=1e-2)
