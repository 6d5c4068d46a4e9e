"""The points of the map on disk: FE and models apart, each bound to the code that made it, run side by side.

``<folder>/<case_id>.fe.json`` and ``.models.json`` are written when they are whole, so that a study that is stopped
goes on where it was. FE is run again where the case, the meshes, the engine or the decks have changed, a model where
its code has; one of them never makes the other stale.
"""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass, field
from multiprocessing import get_context, parent_process
from pathlib import Path
from typing import Any

from ..files import read_text, write_text
from ..geometry import path_of
from ..study import Case
from .points import MESHES, MODELS, deck_digests, fe_code, fe_point, model_point, models_bound, whole_point

Say = Callable[[str], None]
More = Callable[[], bool]
Data = dict[str, Any]


def run_points(cases: Sequence[Case], folder: Path, say: Say, more: More, jobs: int = 1) -> list[Data]:
    """Return the whole points, running parts that are missing or stale while `more()` holds.

    A part that the engine or a model refuses says why and counts as run, until code or case change.

    Parameters
    ----------
    folder : path
        Where the parts lie.
    say : callable
        Told one line a point.
    jobs : int
        Processes beside each other; 1 runs all in this one.
    """
    keys, progress = models_bound, Progress(cases, say)
    known = {case.case_id: _current(case, folder) for case in cases}
    progress.begin([case for case in cases if "fe" not in known[case.case_id]])
    todo = [case for case in cases if _missing(known[case.case_id])]
    for case, found in _run(todo, known, more, jobs):
        if "fe" in found and "fe" not in known[case.case_id]:
            write_text(folder / f"{case.case_id}.fe.json", json.dumps(found["fe"], indent=1))
            progress.done(case, found["fe"])
        text = {"bound": keys(case), "forces": found["models"]}
        write_text(folder / f"{case.case_id}.models.json", json.dumps(text, indent=1))
        known[case.case_id] = found
    return [
        whole_point(case, known[case.case_id]["fe"], known[case.case_id]["models"])
        for case in cases
        if not _missing(known[case.case_id])
    ]


def _missing(known: Mapping[str, Any]) -> bool:
    return "fe" not in known or set(known["models"]) != set(MODELS)


def _current(case: Case, folder: Path) -> Data:
    """Return the parts of a point that belong to the case and code of today: ``fe`` where it does, and ``models``."""
    found: Data = {"models": {}}
    fe = _read(folder / f"{case.case_id}.fe.json")
    if fe is not None and _fe_is_current(case, fe):
        found["fe"] = fe
    models = _read(folder / f"{case.case_id}.models.json")
    if models is not None:
        bound, today = models.get("bound", {}), models_bound(case)
        forces = models.get("forces", {})
        found["models"] = {model: forces[model] for model in MODELS if model in forces and bound[model] == today[model]}
    return found


def _fe_is_current(case: Case, fe: Mapping[str, Any]) -> bool:
    bound, code = fe.get("bound", {}), fe_code()
    if bound.get("case_digest") != case.digest() or bound.get("meshes") != list(MESHES):
        return False
    if bound["code"]["engine"] != code["engine"]:
        return False
    # other code that makes decks need not make other decks
    return bound["code"]["decks"] == code["decks"] or ("refused" not in fe and bound["decks"] == deck_digests(case))


def _work(case: Case, known: Data) -> Data:
    """Run the parts of a point that are missing."""
    fe = known["fe"] if "fe" in known else fe_point(case)
    models = {model: known["models"].get(model) or model_point(case, model) for model in MODELS}
    return {"fe": fe, "models": models}


def end_with_parent() -> None:
    """End this process when the one that started it has ended, however it ended: a pool's processes wait for ever."""
    parent = parent_process()

    def wait_for_it() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=wait_for_it, daemon=True).start()


def _run(cases: Sequence[Case], known: Mapping[str, Data], more: More, jobs: int) -> Iterator[tuple[Case, Data]]:
    waiting = iter(cases)
    if jobs == 1:
        for case in waiting:
            if not more():
                return
            yield case, _work(case, known[case.case_id])
        return
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=end_with_parent) as pool:
        running: dict[Future[Data], Case] = {}
        while True:
            while len(running) < jobs and more() and (following := next(waiting, None)) is not None:
                running[pool.submit(_work, following, known[following.case_id])] = following
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(future), future.result()


def cost(case: Case) -> float:
    """Return what FE of a point costs against others: elements times increments, of half a block where that serves."""
    block = case.block
    half = 0.5 if block.shape == "rectangle" else 1.0
    elements = block.length_mm * block.width_mm / block.height_mm**2
    return half * elements * path_of(case).contact_duration / case.height


@dataclass
class Progress:
    """Says after each point how long the rest will take, by what the points so far took for their cost."""

    cases: Sequence[Case]
    say: Say
    left: dict[str, float] = field(default_factory=dict)
    spent: float = 0.0
    began: float = field(default_factory=time.monotonic)

    def begin(self, missing: Sequence[Case]) -> None:
        """Take note of the points whose FE is still to run."""
        self.left = {case.case_id: cost(case) for case in missing}
        self.say(f"{len(self.cases) - len(missing)} of {len(self.cases)} points have their FE, {len(missing)} to run")

    def done(self, case: Case, fe: Mapping[str, Any]) -> None:
        """Tell that a point is done."""
        self.spent += self.left.pop(case.case_id)
        minutes = (time.monotonic() - self.began) / 60.0
        rest = minutes * sum(self.left.values()) / self.spent
        told = f"refused, {fe['refused']}" if "refused" in fe else f"{fe['seconds']:.0f} s of FE"
        count = f"{len(self.cases) - len(self.left)} of {len(self.cases)}"
        self.say(f"{count}: {case.case_id}, {told}; {minutes:.0f} min so far, about {rest:.0f} to go")


def _read(path: Path) -> Data | None:
    if not path.is_file():
        return None
    try:
        data = json.loads(read_text(path))
    except json.JSONDecodeError:
        return None
    return data if isinstance(data, dict) else None
