"""Stands for the program that made the histories: reads cases/ID.json, writes histories/ID.csv.

tread-validate case study.yaml --all -o cases && python make_histories.py
"""

import csv
import json
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
TIMES = 600
COLUMNS = 200


def forces(case):
    """Return time (s), normal and tangential force (N) of a case, independent columns of the instantaneous modulus."""
    block, path, road = case["block"], case["path"], case["road"]
    columns, samples, profile = block["columns"], path["samples"], block["width_profile"]
    modulus = case["compound"]["long_term_modulus_Pa"] + sum(term["modulus_Pa"] for term in case["compound"]["terms"])
    friction = case["friction"]["static_coefficient"]

    time = np.linspace(0.0, 1.02 * case["expected_duration_s"], TIMES + 1)
    cell = columns["s_m"][-1] / COLUMNS
    s = (np.arange(COLUMNS) + 0.5) * cell
    height = np.interp(s, columns["s_m"], columns["height_m"])
    area = cell * np.interp(s, profile["s_m"], profile["width_m"])
    arc = path["first_contact_arc_m"] + path["arc_speed_m_s"] * time[:, None]
    arc = arc - np.interp(s, columns["s_m"], columns["arc_offset_m"])
    x, y, slope = (np.interp(arc, samples["arc_m"], samples[key]) for key in ("x_m", "y_m", "slope_rad"))
    x, y = x + height * np.sin(slope), y - height * np.cos(slope)
    depth = -y if road["radius_m"] is None else road["radius_m"] - np.hypot(x, y + road["radius_m"])
    pressure = modulus * np.maximum(depth, 0.0) / height

    shear = np.zeros_like(pressure)
    for row in range(1, time.size):
        moved = road["surface_speed_m_s"] * time[1] - (x[row] - x[row - 1])
        limit = friction * pressure[row]
        shear[row] = np.clip(shear[row - 1] + moved * modulus / 3.0 / height, -limit, limit)
    return time, pressure @ area, -shear @ area


def main():
    """Write the history of every case file."""
    (HERE / "histories").mkdir(exist_ok=True)
    for source in sorted((HERE / "cases").glob("*.json")):
        case = json.loads(source.read_text())
        with (HERE / "histories" / f"{case['case_id']}.csv").open("w", newline="") as stream:
            stream.write(f"# case_digest: {case['case_digest']}\n")
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(["time_s", "normal_force_N", "tangential_force_N"])
            writer.writerows((f"{value:.12g}" for value in row) for row in zip(*forces(case), strict=True))


if __name__ == "__main__":
    main()
