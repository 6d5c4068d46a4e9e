"""Decks of the paper's study in one process: time to build, to write, to lint, and their size; lint of a million lines.

Targets: 20 ms of processor time a deck; a deck of a million lines linted within 10 s.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np

from tread_validate import deck
from tread_validate.deck.lint import lint
from tread_validate.study import load_study


def main() -> None:
    study = load_study(Path(__file__).resolve().parents[1] / "config" / "study.yaml")
    cases = [case if case.creep_ratio is not None else case.with_creep(0.003) for case in study.cases()]
    deck.build(cases[0])  # imports and the Prony fit
    start = time.process_time()
    for case in cases:
        deck.build(case)
    built = time.process_time() - start
    with tempfile.TemporaryDirectory() as folder:
        start = time.process_time()
        for case in cases:
            deck.write(case, Path(folder) / case.case_id)
        written = time.process_time() - start
        size = sum(path.stat().st_size for path in Path(folder).rglob("*") if path.is_file())
        start = time.process_time()
        for case in (cases[0], cases[-1]):
            lint(Path(folder) / case.case_id / f"{case.case_id}.inp")
        linted = 0.5 * (time.process_time() - start)
        lines = million(Path(folder) / "million.inp")
        start = time.process_time()
        assert lint(Path(folder) / "million.inp") == []
        large = time.process_time() - start
    per_deck = 1e3 / len(cases)
    print(
        f"{len(cases)} decks, processor time a deck: built in {built * per_deck:.1f} ms, "
        f"written in {written * per_deck:.1f} ms (target 20 ms)"
    )
    print(f"size on disk {size / 1e6:.0f} MB; lint {linted:.2f} s a deck; {lines} lines in {large:.1f} s (target 10 s)")


def million(file: Path, edge: int = 80) -> int:
    """Write a deck of a part with edge^3 bricks and return its number of lines."""
    nodes = np.arange((edge + 1) ** 3).reshape((edge + 1,) * 3)
    low, high = slice(None, -1), slice(1, None)
    corners = [(low, low, low), (high, low, low), (high, high, low), (low, high, low)]
    corners += [(low, low, high), (high, low, high), (high, high, high), (low, high, high)]
    bricks = np.stack([nodes[corner] for corner in corners], axis=-1).reshape(-1, 8) + 1
    places = np.stack(np.meshgrid(*[0.1 * np.arange(edge + 1)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    lines = ["*HEADING", "million", "*PART, NAME=P", "*NODE"]
    lines += [f"{i}, {x:.6f}, {y:.6f}, {z:.6f}" for i, (x, y, z) in enumerate(places.tolist(), 1)]
    lines.append("*ELEMENT, TYPE=C3D8R, ELSET=ALL")
    lines += [f"{i}, " + ", ".join(map(str, brick)) for i, brick in enumerate(bricks.tolist(), 1)]
    lines += ["*SOLID SECTION, ELSET=ALL, MATERIAL=M", ",", "*END PART", "*ASSEMBLY, NAME=A"]
    lines += ["*INSTANCE, NAME=I, PART=P", "*END INSTANCE", "*END ASSEMBLY", "*MATERIAL, NAME=M", "*DENSITY", "1E-9,"]
    lines += ["*ELASTIC", "5., 0.47", "*STEP", "*DYNAMIC, EXPLICIT", ", 1.", "*BOUNDARY", "I.1, 1, 3", "*END STEP"]
    file.write_text("\n".join(lines) + "\n")
    return len(lines)


if __name__ == "__main__":
    main()
