"""Run a braked block that slides at a constant coefficient through its patch on three meshes, and what time step costs.

Usage: python examples/hard_passes/sliding.py [PAGE] (five minutes on one core; without PAGE the tables are printed)
"""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from hard_passes import meshed, write_or_print

from tread_validate import deck, fe, load_study, spring
from tread_validate.friction import Coulomb
from tread_validate.study import Case

SIZES = (2.0, 1.0, 0.5)
SLIDING = ((0.2, 2.0, 16.7), (0.35, 2.0, 16.7), (0.5, 2.0, 16.7), (0.5, 3.0, 30.0), (0.5, 3.0, 3.0))
"""mu, creep ratio (per cent), speed (m/s)."""
DAMPING = (0.2, 1.0)
"""Stiffness-proportional damping, us: of the decks, and what quiets the face."""
STEPS = (0.95, 0.5, 0.25, 0.1)
"""Shares of the stable increment."""
ENERGY = ("small_shallow", "small_sliding", "small_braking")
MARKS = ("<!-- steady sliding -->", "<!-- /steady sliding -->")


def run(case: Case, share: float | None = None) -> fe.FeResult:
    """Run a case, its increment a share of the stable one."""
    with tempfile.TemporaryDirectory() as folder:
        deck.write(case, Path(folder))
        path = Path(folder) / f"{case.case_id}.inp"
        if share is not None:
            text = path.read_text(encoding="utf-8")
            path.write_text(
                text.replace("*DYNAMIC, EXPLICIT", f"*DYNAMIC, EXPLICIT, SCALE FACTOR={share}"), encoding="utf-8"
            )
        return fe.run_deck(path, path.with_name("vfric.f"))


def ratio(result: fe.FeResult) -> float:
    """Return |T|/N over the second half of the time in which N is above half its peak."""
    normal, tangential = result.history.normal_force, result.history.tangential_force
    pressed = np.flatnonzero(normal > 0.5 * normal.max())
    second = slice(pressed[len(pressed) // 2], pressed[-1])
    return float(abs(tangential[second].sum()) / normal[second].sum())


def slid(base: Case, mu: float, creep: float, speed: float, damping: float, size: float) -> fe.FeResult:
    """Run the small block at one coefficient, creep (per cent), speed (m/s), damping (us) and mesh (mm)."""
    law = Coulomb(kind="coulomb", origin="assumed", source="one number", kinetic_coefficient=mu)
    case = meshed(replace(base, friction=law, creep_ratio=0.01 * creep, speed=speed), size)
    return run(replace(case, deck=case.deck.model_copy(update={"stiffness_damping_us": damping})))


def sliding_rows(base: Case) -> list[str]:
    """Return the rows of T/N over mu."""
    rows = []
    for mu, creep, speed in SLIDING:
        for damping in DAMPING:
            results = [slid(base, mu, creep, speed, damping, size) for size in SIZES]
            found = ", ".join(f"{ratio(result):.4f}" for result in results)
            chatter = ", ".join(f"{100 * result.record['alternation']:.2g}" for result in results)
            worth = ["yes" if result.record["reference_quality"]["usable"] else "no" for result in results]
            open_ = max(result.record["energy_balance"]["balance_error"] for result in results)
            rows.append(
                f"| {mu:g} | {creep:g} % | {speed:g} | {damping:g} | {found} | {chatter} | {', '.join(worth)}"
                f" | {100 * open_:.1g} |"
            )
            print(rows[-1], flush=True)
    return rows


def energy_rows(cases: dict[str, Case]) -> list[str]:
    """Return the rows of the energy unaccounted for against the increment, 1 mm."""
    rows = []
    for name in ENERGY:
        shares = [run(meshed(cases[name], 1.0), share).record["energy_balance"]["balance_error"] for share in STEPS]
        rows.append(f"| {name.replace('_', '')} | " + " | ".join(f"{100 * share:.1e}" for share in shares) + " |")
        print(rows[-1], flush=True)
    return rows


def main() -> None:
    """Run both and write the tables."""
    study = load_study(Path(__file__).with_name("study.yaml"))
    cases = {case.run: case for case in spring.resolve_creep(study.cases())}
    table = "\n".join(
        [
            "| mu | creep | V, m/s | damping, us | T/N: 2, 1, 0.5 mm | `alternation`, % | reference | energy open, % |",
            "|---" * 8 + "|",
            *sliding_rows(cases["small_braking"]),
            "",
            "| Energy open, %, 1 mm; increment over the stable one | " + " | ".join(map(str, STEPS)) + " |",
            "|---" * 5 + "|",
            *energy_rows(cases),
        ]
    )
    write_or_print(MARKS, table)


if __name__ == "__main__":
    main()
