"""Which history belongs to which block of the sequence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ..errors import InputError
from ..history import History
from ..study import Case
from ..units import MM
from .pitch import RibBlocks

SAME_LENGTH = 1e-6  # m


def belt_case(case: Case) -> Case:
    """Return the case, which must be a belt case with a known creep ratio."""
    if not case.path.on_tyre:
        raise InputError(f"case {case.case_id}: path", case.path_name, "a belt: nothing else is a tyre")
    if case.creep_ratio is None:
        raise InputError(f"case {case.case_id}: creep_ratio", "none", "a resolved free-rolling case")
    return case


def resized(case: Case, placement: RibBlocks) -> Case:
    """Return the case with the block of a placement: its length and, where the rib gives one, its width.

    Raises
    ------
    InputError
        A block with sipes whose length differs from the sequence's: where the sipes would go is not known.
    """
    length = placement.block_length
    width = case.width if placement.block_width is None else placement.block_width
    if abs(length - case.length) < SAME_LENGTH and abs(width - case.width) < SAME_LENGTH:
        return case
    if case.block.sipes and abs(length - case.length) >= SAME_LENGTH:
        raise InputError(
            f"rib {placement.rib}: block_mm", f"{length / MM:g}", f"{case.length / MM:g}, the length of the siped block"
        )
    block = case.block.model_copy(update={"length_mm": length / MM, "width_mm": width / MM})
    return replace(case, block=block)


def by_model(case: Case, run: Callable[[Case], History]) -> Callable[[RibBlocks], History]:
    """Return the history of each block size by running a model, once per size."""
    known: dict[tuple[float, float | None], History] = {}

    def history_of(placement: RibBlocks) -> History:
        size = (placement.block_length, placement.block_width)
        if size not in known:
            known[size] = run(resized(case, placement))
        return known[size]

    return history_of


def by_history(case: Case, history: History, where: str) -> Callable[[RibBlocks], History]:
    """Return one given history for every block; the sequence must have no other block than the case's."""

    def history_of(placement: RibBlocks) -> History:
        if resized(case, placement) is not case:
            width = case.width if placement.block_width is None else placement.block_width
            raise InputError(
                where,
                f"the history of a {case.length / MM:g} x {case.width / MM:g} mm block",
                f"one of {placement.block_length / MM:g} x {width / MM:g} mm for rib {placement.rib}",
            )
        return history

    return history_of
