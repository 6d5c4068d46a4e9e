"""Running CalculiX and reading its forces."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
import time as clock
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import provenance
from ..errors import EngineError, one_line
from ..files import read_text
from ..history import History
from ..inp import problem_of
from ..source_code import code_digest
from ..yaml_text import write_yaml
from .subset import ElasticDeck, read_elastic_deck
from .write import Resolution, dialect

TOTAL = re.compile(r"total force .* for set (\w+) and time\s+([0-9.E+-]+)")
STRAIN_MEASURE = (
    "neo-Hookean with the deck's initial moduli (within about 1 % of logarithmic strain at 2.5 % compression)"
)


@dataclass(frozen=True)
class CalculixResult:
    """A pass as CalculiX solved it.

    Attributes
    ----------
    history : History
    mount_force : (n, 2) array, N
        What holds the mount, in space, at the times of `history`: the opposite of the contact force in equilibrium.
    record : dict
    """

    history: History
    mount_force: NDArray[np.float64]
    record: dict[str, Any]

    def write(self, path: Path | str) -> None:
        """Write the history and, last, its record beside it."""
        target = Path(path)
        target.with_suffix(".yaml").unlink(missing_ok=True)
        self.history.write_csv(target)
        record = {**self.record, "history_sha256": provenance.sha256_file(target)}
        write_yaml(target.with_suffix(".yaml"), record)


def run_deck(
    path: Path | str,
    user: Path | str | None = None,
    *,
    resolution: Resolution | None = None,
    command: str = "ccx",
    folder: Path | None = None,
    time_limit: float = 86_400.0,
    threads: int = 1,
) -> CalculixResult:
    """Run a deck of the elastic-Coulomb subset.

    Parameters
    ----------
    path, user : path
        The deck and, for VFRIC with Coulomb's law, its routine.
    resolution : Resolution, optional
    command : str
        The executable.
    folder : path, optional
        Where the job's files stay; a temporary folder otherwise.

    Raises
    ------
    InputError
        A deck outside the subset.
    EngineError
        No executable, no convergence, no forces.
    """
    deck = read_elastic_deck(path, user)
    choice = resolution or Resolution()
    text = dialect(deck, choice)
    if shutil.which(command) is None:
        raise EngineError(f"no executable {command} (Debian: apt-get install calculix-ccx)")
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        return _run(deck, text, Path(path), user, choice, command, folder, time_limit, threads)
    with tempfile.TemporaryDirectory(prefix="calculix-") as temporary:
        return _run(deck, text, Path(path), user, choice, command, Path(temporary), time_limit, threads)


def _run(
    deck: ElasticDeck,
    text: str,
    source: Path,
    user: Path | str | None,
    choice: Resolution,
    command: str,
    folder: Path,
    time_limit: float,
    threads: int,
) -> CalculixResult:
    (folder / "job.inp").write_text(text, encoding="utf-8")
    for old in ("job.dat", "job.frd", "job.sta", "job.cvg"):
        (folder / old).unlink(missing_ok=True)
    started = clock.monotonic()
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads), "CCX_NPROC_RESULTS": "1"}
    try:
        done = subprocess.run(
            [command, "job"],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=time_limit,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise EngineError(f"{deck.case_id}: CalculiX took longer than {time_limit:g} s") from None
    wall = clock.monotonic() - started
    log = done.stdout.decode("utf-8", errors="replace")
    if done.returncode != 0 or "*ERROR" in log or "Job finished" not in log:
        found = [line for line in log.splitlines() if "*ERROR" in line] or log.strip().splitlines()[-1:]
        raise EngineError(
            f"{deck.case_id}: CalculiX ended with code {done.returncode}: {one_line(' '.join(found[:3]))}"
        )
    totals = read_totals(folder / "job.dat")
    history, mount = _history(deck, totals)
    digest = problem_of(source, None if user is None else read_text(user)).digest
    code = code_digest("calculix")
    record: dict[str, Any] = {
        "case_id": deck.case_id,
        "engine": "calculix",
        "version": version_of(log),
        "commit": provenance.commit(),
        "code": code,
        "deck_digest": digest,
        "deck_sha256": provenance.sha256_file(source),
        "user_sha256": "" if user is None else provenance.sha256_file(user),
        "solution": "quasi-static, in the frame of the road",
        "strain_measure": "neo-Hookean, as the deck has it" if deck.neo_hookean else STRAIN_MEASURE,
        "elements": int(deck.elements.shape[0]),
        "steps": int(history.time.size),
        "largest_step_s": deck.durations[-1] / choice.pass_increments,
        "contact_stiffness_MPa_per_mm": choice.contact_stiffness * deck.young,
        "stick_stiffness_MPa_per_mm": choice.stick_ratio * choice.contact_stiffness * deck.young,
        "dropped": list(deck.dropped),
        "slipping": "not available",
        "wall_time_s": round(wall, 3),
    }
    notes = {
        "case_id": deck.case_id,
        "producer": "fe/calculix",
        "version": str(record["version"]),
        "engine": "calculix",
        "code": code,
        "deck_digest": digest,
        "slipping": "not available",
    }
    history = History(history.time, history.normal_force, history.tangential_force, history.slipping_fraction, notes)
    return CalculixResult(history, mount, record)


def read_totals(path: Path) -> dict[str, NDArray[np.float64]]:
    """Return the total forces of each printed node set: rows of time, fx, fy, fz."""
    if not path.is_file():
        raise EngineError(f"CalculiX wrote no {path.name}")
    totals: dict[str, list[list[float]]] = {}
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    for index, line in enumerate(lines):
        found = TOTAL.search(line)
        if found is None:
            continue
        row = next((text for text in lines[index + 1 : index + 4] if text.strip()), "")
        try:
            values = [float(found.group(2)), *(float(word) for word in row.split()[:3])]
        except ValueError:
            raise EngineError(f"{path.name}:{index + 1}: forces that are no numbers: {one_line(row, 60)}") from None
        totals.setdefault(found.group(1), []).append(values)
    if not {"ROAD_NODES", "MOUNT"} <= set(totals):
        raise EngineError(f"{path.name}: no total forces of road and mount")
    return {name: np.array(rows) for name, rows in totals.items()}


def version_of(log: str) -> str:
    """Return the version that CalculiX prints."""
    found = re.search(r"CalculiX Version\s+([\w.]+)", log)
    return found.group(1) if found else "not stated"


def _history(deck: ElasticDeck, totals: dict[str, NDArray[np.float64]]) -> tuple[History, NDArray[np.float64]]:
    """Return the pass: the road is held with the force that it exerts on the block."""
    lead_in = float(sum(deck.durations[:-1]))
    road, mount = totals["ROAD_NODES"], totals["MOUNT"]
    kept = road[:, 0] > lead_in * (1.0 + 1e-6)
    total = road[kept, 0]
    force = deck.road.into_space(road[kept, 1:3], total)
    held = deck.road.into_space(mount[kept, 1:3], total)
    time = np.concatenate([[0.0], total - lead_in])
    whole = 2.0 if deck.symmetry else 1.0
    force, held = whole * np.vstack([np.zeros(2), force]), whole * np.vstack([np.zeros(2), held])
    zeros = np.zeros_like(time)
    return History(time, force[:, 1], -force[:, 0], zeros), held
