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
from ..inp.symmetry import whole, whole_force
from ..provenance import sha256_text
from ..units import DECK_LENGTH, DECK_STRESS
from ..yaml_text import write_yaml
from .energy import COLUMNS as ENERGY_COLUMNS
from .explicit import Simulation

JOULE = 1.0 / DECK_LENGTH  # N mm -> N m
AXES = ("x", "y", "z")


@dataclass(frozen=True)
class FeResult:
    """Histories of the last step of a deck, SI; of the whole block where the deck models half of it.

    Attributes
    ----------
    history : History
        Normal force = +y, tangential force = -x component of the contact force on the body.
    energies : DataFrame
        ``time_s`` and energies in J: internal = recoverable strain + viscoelastic dissipation + artificial (hourglass);
        total = kinetic + internal + bulk viscous + frictional - external work, 0 at the start of the run.
    reactions : DataFrame
        ``time_s`` and the sum of the forces that hold prescribed nodes, N.
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
        for name, table in (("energies", self.energies), ("contact", self.contact), ("face", self.face)):
            write_text(target.with_name(f"{target.stem}_{name}.csv"), table.to_csv(index=False, float_format="%.8g"))
        text = self.history.to_csv()
        write_text(target, text)
        record = {**self.record, "history_sha256": sha256_text(text)}
        write_yaml(record_file, record)


def collect(simulation: Simulation, record: Mapping[str, Any], provenance: Mapping[str, str]) -> FeResult:
    """Turn a finished simulation into a result."""
    s = simulation.samples
    time = np.array(s.time)
    deck = simulation.model.deck
    normal = whole_force(deck, np.array(s.normal))
    tangential = whole_force(deck, np.array(s.tangential))
    force = normal + tangential
    history = History(time, force[:, 1], -force[:, 0], np.array(s.slipping), provenance)
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
    return FeResult(history, energies, reactions, contact, _face(simulation), record)


def _face(simulation: Simulation) -> pd.DataFrame:
    """Return the slave face of the first pair half way between the first and the last contact."""
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
    return table
