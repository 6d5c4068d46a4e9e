"""One point of the map: FE on two coarse meshes, their limit, and every model's forces."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import EngineError, InputError
from ..source_code import code_digest, digest_of
from ..spring import run
from ..spring.variants import code_digest as model_digest
from ..study import Case
from ..units import IN_MM, IN_US
from .groups import groups_of, kind_of

MODELS = ("paper", "shape_factor", "condensed_coarse", "condensed")
QUANTITIES = ("normal", "impulse", "positive", "negative")
"""Peak N, impulse of N, positive and negative peak of T."""
MESHES = (4, 6)
"""Elements per height, along, across and over it."""
DAMPING_US = 1.0
"""Stiffness damping of the decks, at least. Below it faces that slide at a coefficient above some 0.5 flutter, on
finer meshes more: at mu 0.86 (D/h 0.0075, R/l 9) both meshes gave T 54.8 and 47.1 N with 0.2 us, 58.2 and 58.3 N with
1 us, 58.4 and 58.4 N with 5 us; N 74.3 and 71.6, 75.6 and 75.6, 75.6 and 75.6 N."""
ORDER = 2.0
"""Order with which the engine's peaks converge: 2, 1, 0.5 mm on the study's rig block give -14.8, -12.2, -11.6 N."""


def forces_of(history: Any) -> dict[str, float]:
    """Return the quantities of a history, N and N s."""
    tangential = history.tangential_force
    return {
        "normal": float(history.normal_force.max()),
        "impulse": float(np.trapezoid(history.normal_force, history.time)),
        "positive": max(float(tangential.max()), 0.0),
        "negative": min(float(tangential.min()), 0.0),
    }


def fe_code() -> dict[str, str]:
    """Return the digests of the code behind an FE part: the engine, and what makes decks."""
    return {"engine": code_digest("fe"), "decks": digest_of(("deck.model",))}


def deck_digests(case: Case) -> list[str]:
    """Return the digests of the problems that the decks of both meshes pose."""
    from ..deck import write
    from ..inp import DeckFiles

    found = []
    for parts in MESHES:
        with tempfile.TemporaryDirectory(prefix="tread-validate-") as folder:
            write(meshed(case, parts), Path(folder))
            files = DeckFiles(Path(folder) / f"{case.case_id}.inp", Path(folder) / "vfric.f")
            found.append(files.problem.digest)
    return found


def models_bound(case: Case) -> dict[str, dict[str, str]]:
    """Return what each model's part of a point belongs to: the case and the model's code."""
    return {model: {"case_digest": case.digest(), "code": model_digest(model)} for model in MODELS}


def fe_point(case: Case) -> dict[str, Any]:
    """Run the engine on both meshes; never raises for what the engine refuses.

    Returns
    -------
    dict
        ``bound`` (case, meshes, code, decks), ``fe_<n>`` (forces), ``residual_<n>``, ``artificial_<n>`` and
        ``impact_<n>`` (energies), ``unsteadiness_<n>``, ``alternation_<n>``, ``seconds``; or ``refused``: why.
    """
    begin = time.monotonic()
    found: dict[str, Any] = {}
    decks: list[str] = []
    try:
        for parts in MESHES:
            run_, digest = _fe_run(case, parts)
            found |= run_
            decks.append(digest)
    except (InputError, EngineError) as error:
        found = {"refused": str(error)}
    bound = {"case_digest": case.digest(), "meshes": list(MESHES), "code": fe_code(), "decks": decks}
    return {"bound": bound, **found, "seconds": round(time.monotonic() - begin, 2)}


def limit_of(fe: Mapping[str, Any]) -> dict[str, float]:
    """Return the forces that both meshes tend to."""
    coarse, fine = (fe[f"fe_{parts}"] for parts in MESHES)
    share = 1.0 / ((MESHES[1] / MESHES[0]) ** ORDER - 1.0)
    return {name: fine[name] + share * (fine[name] - coarse[name]) for name in QUANTITIES}


def meshed(case: Case, parts: int) -> Case:
    """Return the case with `parts` elements per height; half of a block that z = 0 halves."""
    whole = case.block.shape != "rectangle" or case.block.mesh is not None
    settings = case.deck.model_copy(update={
        "element_size_mm": case.height * IN_MM / parts, "layers": parts, "history_interval_us": _interval(case),
        "field_frames": 1, "constant_friction_variant": False, "symmetry": "full" if whole else "half",
        "stiffness_damping_us": max(case.deck.stiffness_damping_us, DAMPING_US),
    })  # fmt: skip
    return replace(case, deck=settings)


def _fe_run(case: Case, parts: int) -> tuple[dict[str, Any], str]:
    from ..deck import write
    from ..fe import run_deck

    with tempfile.TemporaryDirectory(prefix="tread-validate-") as folder:
        write(meshed(case, parts), Path(folder))
        deck = Path(folder) / f"{case.case_id}.inp"
        result = run_deck(deck, deck.with_name("vfric.f"))
    balance = result.record["energy_balance"]
    found = {
        f"fe_{parts}": forces_of(result.history),
        f"residual_{parts}": float(balance["balance_error"]),
        f"artificial_{parts}": float(balance["artificial_share"]),
        f"impact_{parts}": float(balance["impact_share"]),
        f"unsteadiness_{parts}": float(result.record["unsteadiness"]),
        f"alternation_{parts}": float(result.record["alternation"]),
    }
    return found, str(result.record["deck_digest"])


def _interval(case: Case) -> float:
    """Return the time between samples, us: 400 over the pass."""
    from ..geometry import path_of

    return float(np.clip(IN_US * path_of(case).contact_duration / 400.0, 2.0, 100.0))


def model_point(case: Case, model: str) -> dict[str, Any]:
    """Run a model on the case: its forces, or ``refused``: why."""
    try:
        return forces_of(run(case, model))
    except (InputError, EngineError) as error:
        return {"refused": str(error)}


def whole_point(case: Case, fe: Mapping[str, Any], models: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Put both parts of a point together; it says why where either was refused."""
    point = {**fe, "case_id": case.case_id, "kind": kind_of(case), "groups": asdict(groups_of(case))}
    refused = [f"{model}: {found['refused']}" for model, found in models.items() if "refused" in found]
    if "refused" in fe:
        return point
    point["limit"] = limit_of(fe)
    return point | ({"refused": "; ".join(refused)} if refused else {"models": dict(models)})
