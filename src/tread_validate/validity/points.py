"""One point of the map: FE on two coarse meshes, their limit, and every model's forces."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import EngineError, InputError
from ..files import read_text, write_text
from ..source_code import code_digest, digest_of
from ..spring import run
from ..spring.variants import code_digest as model_digest
from ..study import Case
from .groups import groups_of

MODELS = ("paper", "bonded", "coupled_coarse", "coupled")
QUANTITIES = ("normal", "impulse", "positive", "negative")
"""Peak N, impulse of N, positive and negative peak of T."""
MESHES = (4, 6)
"""Elements per height, along, across and over it."""
ORDER = 2.0
"""Order with which the engine's peaks converge: 2, 1, 0.5 mm on the study's rig block give -14.8, -12.2, -11.6 N."""

Say = Callable[[str], None]


def forces_of(history: Any) -> dict[str, float]:
    """Return the quantities of a history, N and N s."""
    tangential = history.tangential_force
    return {
        "normal": float(history.normal_force.max()),
        "impulse": float(np.trapezoid(history.normal_force, history.time)),
        "positive": max(float(tangential.max()), 0.0),
        "negative": min(float(tangential.min()), 0.0),
    }


def fe_point(case: Case) -> dict[str, Any]:
    """Run the engine on both meshes: their forces, the limit, how far the finer one is from it, and energy shares."""
    from ..deck import write
    from ..fe import run_deck

    found: dict[str, Any] = {}
    for parts in MESHES:
        size = case.height * 1e3 / parts
        settings = case.deck.model_copy(update={
            "element_size_mm": size, "layers": parts, "history_interval_us": _interval(case), "field_frames": 1,
            "constant_friction_variant": False,
        })  # fmt: skip
        meshed = replace(case, deck=settings)
        with tempfile.TemporaryDirectory(prefix="tread-validate-") as folder:
            write(meshed, Path(folder))
            deck = Path(folder) / f"{case.case_id}.inp"
            result = run_deck(deck, deck.with_name("vfric.f"))
        energies = result.energies
        scale = max(float(energies["internal"].max()), float(energies["external_work"].abs().max()), 1e-30)
        found[f"fe_{parts}"] = forces_of(result.history)
        found[f"residual_{parts}"] = float(energies["total"].abs().max()) / scale
        found[f"artificial_{parts}"] = float(energies["artificial"].max()) / max(
            float(energies["internal"].max()), 1e-30
        )
    coarse, fine = (found[f"fe_{parts}"] for parts in MESHES)
    share = 1.0 / ((MESHES[1] / MESHES[0]) ** ORDER - 1.0)
    found["limit"] = {name: fine[name] + share * (fine[name] - coarse[name]) for name in QUANTITIES}
    return found


def _interval(case: Case) -> float:
    """Return the time between samples, us: 400 over the pass."""
    from ..geometry import path_of

    return float(np.clip(1e6 * path_of(case).contact_duration / 400.0, 2.0, 100.0))


def model_point(case: Case, models: Sequence[str] = MODELS) -> dict[str, dict[str, float]]:
    """Run every model on the case."""
    return {model: forces_of(run(case, model)) for model in models}


def run_points(cases: Sequence[Case], folder: Path, say: Say, more: Callable[[], bool]) -> list[Mapping[str, Any]]:
    """Return the points that are done, running those that are missing or stale while `more()` holds.

    Each point is one file, ``folder/<case_id>.json``, written when it is whole: a study that is stopped goes on where
    it was. A point that the engine or a model refuses says why and counts as run.
    """
    fe, models = f"{code_digest('fe')} {digest_of(('deck.model',))}", {model: model_digest(model) for model in MODELS}
    points: list[Mapping[str, Any]] = []
    for case in cases:
        path = folder / f"{case.case_id}.json"
        known = _read(path)
        bound = {"case_digest": case.digest(), "fe": fe}
        point = known if known is not None and known.get("bound") == bound else None
        if point is None:
            if not more():
                continue
            point = {"case_id": case.case_id, "bound": bound, "kind": _kind(case), "groups": asdict(groups_of(case))}
            try:
                point |= fe_point(case)
            except (InputError, EngineError) as error:
                point["refused"] = str(error)
            say(f"{case.case_id}: {point.get('refused', 'run')}")
            write_text(path, json.dumps(point, indent=1))
        if "refused" not in point and point.get("models_bound") != models:
            try:
                point = {**point, "models": model_point(case), "models_bound": models}
            except (InputError, EngineError) as error:
                point = {**point, "refused": str(error)}
            write_text(path, json.dumps(point, indent=1))
        points.append(point)
    return points


def _kind(case: Case) -> str:
    return f"{'rig' if case.is_rig else 'belt'}, {case.block.mounting}"


def _read(path: Path) -> dict[str, Any] | None:
    if not path.is_file():
        return None
    try:
        data = json.loads(read_text(path))
    except json.JSONDecodeError:
        return None
    return data if isinstance(data, dict) else None
