"""Write data/synthetic_forces.rpt: what the Viewer would write, made from a spring model because no licence is at hand.

Usage: python make_forces.py HISTORY.csv LEAD_IN_SECONDS PASS_SECONDS > data/synthetic_forces.rpt
"""

import math
import sys

from tread_validate.history import History


def engineering(value: float) -> str:
    """Write a number as the Viewer does: six digits, exponent a multiple of three."""
    if value == 0.0:
        return "0."
    power = 3 * math.floor(math.log10(abs(value)) / 3)
    text = f"{value / 10.0**power:.6g}"
    text += "" if "." in text else "."
    return text if power == 0 else f"{text}E{power:+03d}"


def main(path: str, lead_in: float, duration: float) -> None:
    """Print the report of one history, on the clock of the whole analysis."""
    history = History.read_csv(path)
    names = [f"{name}     ASSEMBLY_FACE/ASSEMBLY_ROAD" for name in ("CFN1", "CFN2", "CFS1", "CFS2")]
    print()
    print("                  X   " + "   ".join(f"{name:>36}" for name in names))
    print()
    rows = [*zip(history.time, history.normal_force, history.tangential_force, strict=True), (duration, 0.0, 0.0)]
    for index, (time, normal, tangential) in enumerate(rows):
        if index % 4 == 0 or index == len(rows) - 1:
            cells = (lead_in + time, 0.0, normal, -tangential, 0.0)
            print("".join(f"{engineering(round(float(cell), 9)):>22}" for cell in cells))


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]))
