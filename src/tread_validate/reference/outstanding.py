"""Which references of a study are outstanding, what a pass costs, and which runs are already made but not filed."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..errors import InputError
from ..geometry import path_of
from ..inp import DeckFiles, deck_files
from ..source_code import code_digest
from ..study import Case
from .fe_store import ENGINE_PARTS, FeStore, Reference
from .filing import FinishedRun, read_run


def outstanding(store: FeStore, engine: str, cases: Sequence[Case], decks: Path) -> list[tuple[Case, Reference]]:
    """Return the cases whose reference is not current, each with what the store has in its place."""
    found = [(case, store.find(engine, case.case_id, deck_files(decks, case.case_id))) for case in cases]
    return [(case, reference) for case, reference in found if reference.status != "current"]


def made_today(history: Path, deck: DeckFiles, engine: str) -> FinishedRun | None:
    """Return the run in a file where it is whole, of this deck and made by the engine's code of today; else None."""
    if not history.is_file() or not history.with_suffix(".yaml").is_file():
        return None
    try:
        run = read_run(history, deck, engine)
    except InputError:
        return None
    return run if run.record.get("code") == code_digest(ENGINE_PARTS[engine]) else None


def cost(case: Case) -> float:
    """Return what the pass of a case costs against that of others: elements times increments, roughly."""
    deck, block = case.deck, case.block
    along = deck.element_size_mm * deck.element_length_ratio
    half = 0.5 if block.shape == "rectangle" and deck.symmetry != "full" else 1.0
    elements = half * deck.layers * block.length_mm * block.width_mm / (along * deck.element_size_mm)
    return elements * path_of(case).contact_duration / min(along, block.height_mm / deck.layers)
