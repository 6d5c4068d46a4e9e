"""Decks of the paper's study in one process: time to build, to write, to lint, and their size.

Target: all 52 cases built and written within 8 s.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

from tread_validate import deck
from tread_validate.deck.lint import lint
from tread_validate.study import load_study


def main() -> None:
    study = load_study(Path(__file__).resolve().parents[1] / "config" / "study.yaml")
    cases = [case if case.creep_ratio is not None else case.with_creep(0.003) for case in study.cases()]
    deck.build(cases[0])  # imports and the Prony fit
    start = time.perf_counter()
    for case in cases:
        deck.build(case)
    built = time.perf_counter() - start
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        for case in cases:
            deck.write(case, Path(folder) / case.case_id)
        written = time.perf_counter() - start
        size = sum(path.stat().st_size for path in Path(folder).rglob("*") if path.is_file())
        start = time.perf_counter()
        for case in (cases[0], cases[-1]):
            lint(Path(folder) / case.case_id / f"{case.case_id}.inp")
        linted = 0.5 * (time.perf_counter() - start)
    print(f"{len(cases)} decks: built in {built:.2f} s, built and written in {written:.2f} s (target 8 s)")
    print(f"size on disk {size / 1e6:.0f} MB; lint {linted:.2f} s a deck")


if __name__ == "__main__":
    main()
