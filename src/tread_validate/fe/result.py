"""What a run gives, in SI units, and how it is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from ..files import write_text
from ..history import History
from ..inp.symmetry import is_half, whole, whole_force
from ..provenance import sha256_text
from ..units import DECK_LENGTH, DECK_STRESS
from ..yaml_text import write_yaml
from .axes import Axes, found_axes
from .energy import COLUMNS as ENERGY_COLUMNS
from .explicit import Simulation
from .quality import alternation, energy_balance, reference_quality, unsteadiness

JOULE = 1.0 / DECK_LENGTH  # N mm -> N m
LENGTH = 1.0 / DECK_LENGTH
AXES = ("x", "y", "z")


@dataclass(frozen=True)
class FeResult:
    """Histories of the last step of a deck, SI; of the whole block where the deck models half of it.

    Attributes
    ----------
    history : History
        Normal and tangential force: components of the contact force on the body along the normal, and against the
        direction of travel, of `axes`.
    energies : DataFrame
        ``time_s`` and energies in J: internal = recoverable strain + viscoelastic dissipation + artificial (hourglass);
        total = kinetic + internal + bulk viscous + frictional - external work, 0 at the start of the run.
    reactions : DataFrame
        ``time_s`` and the sum of the forces that hold prescribed nodes, N.
    nodes : DataFrame
        What ``*NODE OUTPUT, NSET=`` asks for: ``time_s``, set, node label, displacement (m), velocity (m/s), reaction
        (N).
    contact : DataFrame
        ``time_s``, normal (CFN) and frictional (CFS) contact force on the body, N.
    face : DataFrame
        Slave nodes of the first pair half way through contact: place before the run (m), normal pressure and frictional
        traction (Pa), state (0 open, 1 sticks, 2 slips). Empty without contact.
    record : mapping
        Engine, version, digests, increments, wall time.
    """

    history: History
    energies: pd.DataFrame
    reactions: pd.DataFrame
    nodes: pd.DataFrame
    contact: pd.DataFrame
    face: pd.DataFrame
    record: Mapping[str, Any]

    def write(self, path: Path | str) -> None:
        """Write the history CSV, ``<stem>_energies.csv``, ``_contact.csv``, ``_face.csv``, and the record last.

        Each appears whole or not at all; without the record ``<stem>.yaml`` a run is not finished.
        """
        target = Path(path)
        record_file = target.with_suffix(".yaml")
        record_file.unlink(missing_ok=True)
        tables = {"energies": self.energies, "contact": self.contact, "face": self.face, "reactions": self.reactions}
        if len(self.nodes):
            tables["nodes"] = self.nodes
        for name, table in tables.items():
            write_text(target.with_name(f"{target.stem}_{name}.csv"), table.to_csv(index=False, float_format="%.8g"))
        text = self.history.to_csv()
        write_text(target, text)
        record = {**self.record, "history_sha256": sha256_text(text)}
        write_yaml(record_file, record)


def collect(
    simulation: Simulation, record: Mapping[str, Any], provenance: Mapping[str, str], axes: Axes | None = None
) -> FeResult:
    """Turn a finished simulation into a result; `axes` are found from the road where not given."""
    s = simulation.samples
    time = np.array(s.time)
    deck = simulation.model.deck
    normal = whole_force(deck, np.array(s.normal))
    tangential = whole_force(deck, np.array(s.tangential))
    force = normal + tangential
    axes = axes or found_axes(normal)
    history = History(time, force @ axes.normal_vector, -force @ axes.travel_vector, np.array(s.slipping), provenance)
    energies = pd.DataFrame(s.energy, columns=list(ENERGY_COLUMNS))
    energies[list(ENERGY_COLUMNS[1:])] *= JOULE * whole(deck)
    reaction = whole_force(deck, np.array(s.reaction))
    reactions = pd.DataFrame({"time_s": time, **{f"reaction_{a}_N": reaction[:, i] for i, a in enumerate(AXES)}})
    contact = pd.DataFrame(
        {
            "time_s": time,
            **{f"cfn_{a}_N": normal[:, i] for i, a in enumerate(AXES)},
            **{f"cfs_{a}_N": tangential[:, i] for i, a in enumerate(AXES)},
        }
    )
    balance = energy_balance(energies)
    scatter = unsteadiness(history.normal_force, history.tangential_force)
    chatter = alternation(np.array(s.slip_state), *(np.array(x, dtype=np.float64) for x in (s.pressure, s.traction)))
    pressure = max((float(sample.max()) for sample in s.pressure if sample.size), default=0.0)
    told = {
        **record,
        "axes": {"normal": axes.normal, "travel": axes.travel},
        "energy_balance": balance,
        "unsteadiness": scatter,
        "alternation": chatter,
        "largest": {"log_strain": simulation.strain, "contact_pressure_Pa": pressure / DECK_STRESS},
        "reference_quality": reference_quality(balance, scatter, chatter),
    }
    return FeResult(history, energies, reactions, _nodes(simulation), contact, _face(simulation), told)


def _nodes(simulation: Simulation) -> pd.DataFrame:
    """Return the histories of nodes that the last step asks for; reference nodes of bodies hold the whole block."""
    model = simulation.model
    asked = model.steps[-1].node_history
    references = [body.reference for body in model.rigid_bodies]
    time = np.array(simulation.samples.time)
    parts = []
    for name, request in asked.items():
        state = np.array(simulation.samples.nodes[name])  # (samples, 3, nodes, 3)
        holds = np.isin(request.nodes, references)
        state[:, 2, holds] = whole_force(model.deck, state[:, 2, holds])
        labels = model.mesh.node_labels[request.nodes]
        table = {"time_s": np.repeat(time, labels.size), "nset": name, "node": np.tile(labels, time.size)}
        for row, (word, unit, factor) in enumerate((("U", "m", LENGTH), ("V", "m_s", LENGTH), ("RF", "N", 1.0))):
            if word in request.variables:
                for i, axis in enumerate(AXES):
                    table[f"{word.lower()}_{axis}_{unit}"] = factor * state[:, row, :, i].ravel()
        parts.append(pd.DataFrame(table))
    return pd.concat(parts) if parts else pd.DataFrame()


def _face(simulation: Simulation) -> pd.DataFrame:
    """Return the slave face of the first pair half way through contact, a half with its mirror image."""
    columns = ["x_m", "y_m", "z_m", "pressure_Pa", "traction_x_Pa", "traction_z_Pa", "state"]
    s = simulation.samples
    touching = np.flatnonzero([state.size > 0 and bool((state > 0).any()) for state in s.slip_state])
    if not touching.size:
        return pd.DataFrame(columns=columns)
    middle = int((touching[0] + touching[-1]) // 2)
    slaves = simulation.pairs[0].pair.slaves
    place = simulation.model.mesh.coordinates[slaves] / DECK_LENGTH
    traction = s.traction[middle] / DECK_STRESS
    values = np.column_stack([place, s.pressure[middle] / DECK_STRESS, traction[:, 0], traction[:, 2]])
    table = pd.DataFrame(values, columns=columns[:-1])
    table["state"] = s.slip_state[middle]
    return _mirrored(table) if is_half(simulation.model.deck) else table


def _mirrored(face: pd.DataFrame) -> pd.DataFrame:
    """Return a face of z >= 0 with its mirror image."""
    other = face[face["z_m"] > 0.0]
    return pd.concat([face, other.assign(z_m=-other["z_m"], traction_z_Pa=-other["traction_z_Pa"])], ignore_index=True)
