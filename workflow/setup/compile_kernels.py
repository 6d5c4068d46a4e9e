"""Compile every kernel once, at set-up, so that no first run of a user has to wait in silence.

Usage: compile_kernels.py STUDY
"""

from __future__ import annotations

import shutil
import sys
import time
from dataclasses import replace

import tread_validate as tv
from tread_validate.spring import resolve_creep

BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"
RIG = "rig-rectangle-22c-0p1mm-600rpm"


def small(case):
    """Return the case on a coarse mesh and a short patch: the same kernels, a fraction of a second of FE."""
    deck = case.deck.model_copy(update={"element_size_mm": 4.0, "layers": 2, "field_frames": 1})
    return replace(case, deck=deck)


def main():
    """Say what is compiled, and how long it took."""
    study = tv.load_study(sys.argv[1])
    belt, rig = (resolve_creep([study.case(name)])[0] for name in (BELT, RIG))
    parts = {
        "independent springs": lambda: [tv.run(case, "paper") for case in (belt, rig)],
        "condensed face": lambda: [tv.run(case, "condensed_coarse") for case in (belt, rig)],
        "face in a host's hands": lambda: tv.TreadBlock(rig, "condensed_coarse").start((0.0, 9e-3), 0.0),
    }
    if shutil.which("gfortran"):
        parts["explicit FE engine"] = lambda: tv.run_fe(small(rig))
    for number, (name, work) in enumerate(parts.items(), 1):
        begin = time.monotonic()
        print(f"Compiling kernels {number}/{len(parts)}: {name} ...", end=" ", flush=True)
        work()
        print(f"{time.monotonic() - begin:.0f} s", flush=True)


if __name__ == "__main__":
    main()
