"""Explicit dynamics of a model: its state, its steps, and what is sampled on the way."""

from __future__ import annotations

import math
import time as clock_module
from collections.abc import Callable

import numba
import numpy as np
from numpy.typing import NDArray

from ..errors import EngineError, InputError
from .blocks import Blocks, pack, set_bulk_viscosity, set_masses
from .constraints import gather_amplitudes, gather_bodies, gather_loads, gather_prescribed
from .element_full_kernel import FULL_WORK_ROWS
from .element_kernel import LANES, WORK_ROWS
from .energy import kinetic_energy, largest_strain
from .explicit_kernel import BAD_FRICTION, CHUNKS, INVERTED, advance
from .kernel_data import (
    CLOCK_ROWS,
    STEP_NUMBER,
    STEP_TIME,
    TOTAL_TIME,
    WORK_SUMS,
    Bodies,
    Elements,
    Nodes,
    Prescribed,
)
from .model import Model
from .pairs import PairData, gather_pairs, held_nodes
from .relaxation import step_coefficients
from .sampling import Samples, take_sample
from .stability import StableIncrement
from .step_kernel import evaluate_amplitudes
from .steps import Step
from .user_friction import UserRoutine

Floats = NDArray[np.float64]
Progress = Callable[[float, float], None]
SAFETY = 0.95  # of the bound on the stable increment
DEFAULT_SAMPLES = 200
ENERGY_SAMPLES = 250
CHECKS = 40  # of the stable increment, a step


class Simulation:
    """A model under way.

    Parameters
    ----------
    model : Model
    routine : UserRoutine or None
        The compiled VFRIC where the deck asks for one.
    threads : int
        1 or more; the answer does not depend on it.
    """

    def __init__(self, model: Model, routine: UserRoutine | None = None, threads: int = 1) -> None:
        self.model = model
        self.routine = routine
        self.threads = min(threads, numba.config.NUMBA_NUM_THREADS)  # type: ignore[attr-defined]  # numba sets it at run time
        self.duration = sum(step.period for step in model.steps)
        self.blocks: Blocks = pack(model, self.duration)
        self._scale_masses()
        count = model.mesh.node_labels.size
        mass = self.blocks.mass
        self.nodes = Nodes(
            x0=np.append(model.mesh.coordinates, np.zeros((1, 3)), axis=0).ravel(),
            u=np.zeros(3 * count + 3),
            v=np.append(model.velocity, np.zeros((1, 3)), axis=0).ravel(),
            force=np.zeros(3 * count + 3),
            load=np.zeros(3 * count + 3),
            inverse_mass=np.append(np.divide(1.0, mass, out=np.zeros(count), where=mass > 0), 0.0),
        )
        self.nodes.v.reshape(-1, 3)[:-1][mass == 0] = 0.0
        self.elements = self._elements()
        self.bodies: Bodies = gather_bodies(model, mass)
        self.clock = np.zeros(CLOCK_ROWS)
        self.work = np.zeros(WORK_SUMS)
        self.increments = 0
        self.kernel_seconds = 0.0
        self.smallest = math.inf
        self.largest = 0.0
        self.strain = 0.0
        self.samples = Samples()
        self.start_energy = kinetic_energy(self.nodes.v, mass)
        self.pairs: list[PairData] = []
        self.observer: Callable[[float], None] | None = None
        self.prescribed: Prescribed
        self.stability: StableIncrement | None = None

    def _scale_masses(self) -> None:
        """Apply the fixed mass scaling of the first step; later steps keep it."""
        for number, step in enumerate(self.model.steps):
            for elements, factor, target, kind in step.mass_scaling:
                if number:
                    raise InputError(
                        step.where, "mass scaling in a later step", "*FIXED MASS SCALING in the first step"
                    )
                if factor is not None:
                    self.blocks.density[elements] *= factor
                if target is not None:
                    stable = 2.0 / np.sqrt(self.blocks.frequency_squared()[elements])
                    ratio = (target / stable) ** 2
                    self.blocks.density[elements] *= ratio if kind == "UNIFORM" else np.maximum(ratio, 1.0)
        set_masses(self.blocks, self.model.mesh)

    def _elements(self) -> Elements:
        b = self.blocks
        kinds = len(b.spectra)
        elastic = np.array([[2.0 * s.shear, s.bulk, *s.long_term, s.damping, float(s.neo_hookean)] for s in b.spectra])
        self.weights = np.zeros((kinds, b.terms, 2))
        self.times = np.ones((kinds, b.terms))
        for row, spectrum in enumerate(b.spectra):
            self.weights[row, : spectrum.times.size] = spectrum.weights
            self.times[row, : spectrum.times.size] = spectrum.times
        return Elements(
            conn=b.conn,
            geo=b.geo,
            state=b.state,
            hist=np.zeros((b.kind.size, b.terms, 6, LANES)),
            decay=np.zeros((kinds, b.terms)),
            gain=np.zeros((kinds, b.terms, 2)),
            elastic=elastic,
            kind=b.kind,
            out=np.zeros((b.kind.size, 24, LANES)),
            work=np.zeros((CHUNKS, max(WORK_ROWS, FULL_WORK_ROWS) * LANES)),
            slots=b.slots,
            slot_start=b.slot_start,
            reduced=np.array([b.reduced_blocks]),
        )

    def displacement(self) -> Floats:
        """Return the node displacements, (n, 3)."""
        return np.array(self.nodes.u.reshape(-1, 3)[:-1], dtype=np.float64)

    def stable_increment(self, step: Step) -> float:
        """Return the automatic increment at this moment, times the safety factor.

        From the highest frequency of the whole mesh; of its elements one by one where the step asks for that or no node
        is free.
        """
        b = self.blocks
        free = ~held_nodes(self.model, self.bodies, self.prescribed)
        if step.element_by_element or not (free & (b.mass > 0.0)).any():
            gradient = np.einsum("nac,nja->ncj", self.nodes.u.reshape(-1, 3)[b.connectivity], b.gradients)
            return step.scale * SAFETY * float(b.stable_increments(gradient).min())
        if self.stability is None:
            self.stability = StableIncrement(b, free)
        return step.scale * SAFETY * self.stability.increment(self.nodes.u.reshape(-1, 3)[:-1])

    def run(self, progress: Progress | None = None) -> None:
        """Run every step; samples are those of the last one.

        Raises
        ------
        EngineError
            An element turned inside out or a number overflowed.
        InputError
            The friction routine returned a force out of range.
        """
        begun = clock_module.monotonic()
        for number, step in enumerate(self.model.steps):
            self.samples = Samples()
            kept = number == len(self.model.steps) - 1
            self._begin(number, step)
            if progress is not None and number == 0:
                progress(0.0, math.inf)
            interval = step.history_interval or step.period / DEFAULT_SAMPLES
            every = max(1, round(step.period / interval / ENERGY_SAMPLES))
            check = step.period / CHECKS
            next_check = 0.0
            mark = 0
            dt = 0.0
            done = 0.0
            while done < step.period * (1.0 - 1e-12):
                if done >= next_check or step.increment is not None:
                    dt = self._increment(step, step.period - done)
                    next_check += check
                wanted = (mark * interval - done) / dt
                left = round((step.period - done) / dt)
                count = min(max(1, math.ceil(wanted - 1e-9) + 1), left)
                self._advance(count, dt)
                done = self.clock[STEP_TIME]
                while mark * interval <= done - dt + 1e-9 * dt:
                    mark += 1
                last = done >= step.period * (1.0 - 1e-12)
                if kept or last:
                    take_sample(self, dt, energies=len(self.samples.time) % every == 0 or last)
                else:
                    self.strain = largest_strain(self.elements, self.strain)
                if self.observer is not None and kept:
                    self.observer(done)
                if progress is not None:
                    share = self.clock[TOTAL_TIME] / self.duration
                    spent = clock_module.monotonic() - begun
                    progress(share, spent * max(1.0 / share - 1.0, 0.0))

    def _begin(self, number: int, step: Step) -> None:
        self.clock[STEP_TIME] = 0.0
        self.clock[STEP_NUMBER] = number + 1
        self.amplitudes, rows = gather_amplitudes(step, self.clock[TOTAL_TIME])
        a = self.amplitudes
        evaluate_amplitudes(
            a.row, a.time, a.table, a.area_table, a.smooth, a.base, a.guess, self.clock[TOTAL_TIME], a.value, a.area
        )
        mass = self.blocks.mass
        self.prescribed = gather_prescribed(self.model, step, rows, a, self.nodes.u, self.bodies, mass)
        self.loads = gather_loads(step, rows)
        self.nodes.load[:] = 0.0
        before = {data.contact.slave + "/" + data.contact.master: data for data in self.pairs}
        self.pairs = gather_pairs(self.model, step, self.bodies, self.prescribed, mass, self.nodes.u, self.routine)
        for data in self.pairs:
            old = before.get(data.contact.slave + "/" + data.contact.master)
            if old is not None:
                data.pair.force[:] = old.pair.force
                data.arguments.arrays["statev"][:] = old.arguments.arrays["statev"]
        self.stability = None  # other nodes may be held
        set_bulk_viscosity(self.blocks, self.model, step.linear_viscosity, step.quadratic_viscosity)
        if number == 0:
            self._kernel(0, 1.0, np.zeros(3, dtype=np.int64))  # compile or load before the clock runs

    def _increment(self, step: Step, left: float) -> float:
        """Choose the increment so that the step ends exactly, and set the Prony coefficients for it."""
        wanted = step.increment or self.stable_increment(step)
        dt = left / max(1, math.ceil(left / wanted - 1e-9))
        for row in range(len(self.blocks.spectra)):
            decay, gain = step_coefficients(self.times[row], self.weights[row], dt)
            self.elements.decay[row] = decay
            self.elements.gain[row] = gain
        self.smallest = min(self.smallest, dt)
        self.largest = max(self.largest, dt)
        return dt

    def _advance(self, count: int, dt: float) -> None:
        fault = np.zeros(3, dtype=np.int64)
        begun = clock_module.perf_counter()
        self._kernel(count, dt, fault)
        self.kernel_seconds += clock_module.perf_counter() - begun
        self.increments += count
        if fault[0] == INVERTED:
            raise EngineError(
                f"an element turned inside out at {self.clock[TOTAL_TIME]:.6g} s: increment too long or mesh too coarse"
            )
        if fault[0] == BAD_FRICTION:
            raise self._friction_error(int(fault[1]), int(fault[2]))

    def _kernel(self, count: int, dt: float, fault: NDArray[np.int64]) -> None:
        numba.set_num_threads(self.threads)
        advance(
            count, dt, self.clock, self.elements, self.nodes, self.amplitudes, self.prescribed, self.loads, self.bodies,
            tuple(data.pair for data in self.pairs), self.work, fault,
        )  # fmt: skip

    def _friction_error(self, number: int, contact: int) -> InputError:
        data = self.pairs[number]
        pair = data.pair
        node = data.labels[pair.touching[contact]]
        force = pair.tangential[contact]
        source = self.routine.source if self.routine else data.contact.where
        return InputError(
            f"{source}: VFRIC at {self.clock[TOTAL_TIME]:.6g} s, node {node}",
            f"fTangential = {force[0]:g}, {force[1]:g}",
            f"finite, the first between {-pair.stick_force[contact]:g} and 0",
        )
