"""Time of the imports and of the loop of a model's developer, as whole processes.

    python benchmarks/loop_speed.py

Least of three in seconds of processor and wall, the interpreter's own start taken off the imports. Targets: `import
tread_validate` 0.05 s, `tread_validate.spring` 0.7 s, `check-model --model paper` of the paper's study 10 s.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time

ROUNDS = 3
IMPORTS = (("tread_validate", 0.05), ("tread_validate.spring", 0.7))
LOOP = 10.0


def least(command: list[str]) -> tuple[float, float]:
    """Return the least wall time and the least processor time of some runs of a command, in s."""
    walls, used = [], []
    for _ in range(ROUNDS):
        before, start = os.times(), time.perf_counter()
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1, 3):
            raise SystemExit(done.stderr)
        after = os.times()
        walls.append(time.perf_counter() - start)
        used.append(after.children_user + after.children_system - before.children_user - before.children_system)
    return min(walls), min(used)


def main() -> int:
    print(f"load of this machine: {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    empty = least([sys.executable, "-c", "pass"])
    for name, target in IMPORTS:
        wall, used = least([sys.executable, "-c", f"import {name}"])
        print(f"import {name}: {wall - empty[0]:.3f} s, {used - empty[1]:.3f} s of processor; target {target:g} s")
    with tempfile.TemporaryDirectory() as folder:
        verb = [sys.executable, "-m", "tread_validate.cli.app", "check-model", "config/study.yaml", "--model", "paper"]
        wall, used = least([*verb, "-o", folder])
    print(f"check-model --model paper: {wall:.1f} s, {used:.1f} s of processor; target {LOOP:g} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
