"""Cases that stand for others: one for each kind of path and block, or for each kind of path, chosen by one rule."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence

from ..geometry import FAMILIES
from .case import Case


def by_family(cases: Iterable[Case]) -> dict[str, tuple[Case, ...]]:
    """Return the cases of every family of paths, in their order."""
    known = tuple(cases)
    return {family: tuple(case for case in known if case.path.family == family) for family in FAMILIES}


def path_and_block(case: Case) -> tuple[str, str]:
    """Return what a mesh study holds for: the kind of path and the block."""
    return case.path.kind, case.block_name


def path_kind(case: Case) -> str:
    """Return the kind of path."""
    return case.path.kind


def typical_cases(cases: Sequence[Case], group: Callable[[Case], Hashable]) -> tuple[Case, ...]:
    """Return one case of every group, in the order of the study.

    Of the group's levels the lower middle one is taken, factor by factor: interference, speed, temperature, creep
    ratio. A case at a given creep ratio goes before a free-rolling one, and the first in the study where several are
    left.
    """
    groups: dict[Hashable, list[Case]] = {}
    for case in cases:
        groups.setdefault(group(case), []).append(case)
    return tuple(_middle(members) for members in groups.values())


def _middle(cases: list[Case]) -> Case:
    driven = [case for case in cases if not case.free_rolling]
    left = driven or cases
    factors: tuple[Callable[[Case], float], ...] = (
        lambda case: case.interference,
        lambda case: case.speed,
        lambda case: case.temperature,
        lambda case: case.creep_ratio or 0.0,
    )
    for factor in factors:
        level = _lower_middle(map(factor, left))
        left = [case for case in left if factor(case) == level]
    return left[0]


def _lower_middle(values: Iterable[float]) -> float:
    levels = sorted(set(values))
    return levels[(len(levels) - 1) // 2]
