"""Write a synthetic rig record with the faults of a real one: python make_record.py faulty.csv."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from tread_validate.reference.rig_synthetic import synthetic_record

ZERO = 40.0  # degrees: wheel angle at which the cell's normal axis faces the road


def main(path: Path) -> None:
    """Twelve revolutions: drift, noise, one without contact, a gap, forces in axes that turn with the wheel, in kN."""
    record = synthetic_record(revolutions=12, drift=0.0).record
    assert record.wheel_angle is not None
    time = np.arange(record.wheel_angle.size) / record.sampling_rate
    normal, tangential = record.normal_force.copy(), record.tangential_force.copy()
    turn = int(0.2 * record.sampling_rate)  # samples a revolution at 300 rpm
    normal[5 * turn : 6 * turn] = tangential[5 * turn : 6 * turn] = 0.0  # lifted
    # the synthetic wheel meets the road at 120 degrees; the cell is mounted so that it faces the road at ZERO
    t = np.mod(record.wheel_angle - np.radians(120.0) + np.pi, 2.0 * np.pi) - np.pi
    angle = np.mod(t + np.radians(ZERO), 2.0 * np.pi)
    cell_normal = normal * np.cos(t) + tangential * np.sin(t) + 2.0 * time
    cell_tangential = tangential * np.cos(t) - normal * np.sin(t) - 1.0 * time
    lines = ["# origin: synthetic", "# shape: rectangle", "# temperature_degC: 22", "# interference_mm: 0.2",
             "t [s];Fn [kN];Ft [kN];phi [deg]"]  # fmt: skip
    for k in range(time.size):
        if not 8 * turn + 900 <= k < 8 * turn + 960:  # 60 samples that were not stored
            row = (time[k], cell_normal[k] / 1e3, cell_tangential[k] / 1e3, np.degrees(angle[k]))
            lines.append(";".join(f"{value:.7g}" for value in row).replace(".", ","))
    path.write_text("\n".join(lines) + "\n", encoding="latin-1")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
