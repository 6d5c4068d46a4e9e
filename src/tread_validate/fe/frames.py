"""Frames for ParaView: displacement, velocity, contact forces and stress at even intervals of the last step."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..files import atomic_path
from .explicit import Simulation
from .stress import element_stress

FRAMES = 40


class FrameWriter:
    """Writes ``frame_0000.vtu`` and so on while a simulation runs its last step."""

    def __init__(self, simulation: Simulation, folder: Path, frames: int = FRAMES) -> None:
        self.simulation = simulation
        self.folder = folder
        self.interval = simulation.model.steps[-1].period / frames
        self.number = 0

    def __call__(self, step_time: float) -> None:
        """Write a frame when its time has come."""
        if step_time + 1e-12 < self.number * self.interval:
            return
        import meshio

        simulation = self.simulation
        mesh = simulation.model.mesh
        used = np.unique(mesh.connectivity)
        renumber = np.full(mesh.node_labels.size, -1)
        renumber[used] = np.arange(used.size)
        displacement = simulation.displacement()
        pressure = np.zeros(mesh.node_labels.size)
        state = np.zeros(mesh.node_labels.size)
        for data in simulation.pairs:
            pair = data.pair
            force = np.linalg.norm(pair.force[:, 0], axis=1)
            pressure[pair.slaves] += np.divide(force, pair.area, out=np.zeros_like(force), where=pair.area > 0)
            state[pair.slaves] = np.maximum(state[pair.slaves], pair.slipping)
        grid = meshio.Mesh(
            mesh.coordinates[used] + displacement[used],
            [("hexahedron", renumber[mesh.connectivity])],
            point_data={
                "displacement": displacement[used],
                "contact_pressure": pressure[used],
                "contact_state": state[used],
            },
            cell_data={"stress": [element_stress(simulation)]},
        )
        with atomic_path(self.folder / f"frame_{self.number:04d}.vtu") as temporary:
            meshio.write(temporary, grid, file_format="vtu")
        self.number += 1
