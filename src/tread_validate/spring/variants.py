"""The registry of spring-model variants: a name and how to make a ready-to-run pass from a case."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from functools import cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..source_code import UNKNOWN, digest_of
from ..study import Case

Array = NDArray[np.float64]


class Pass(Protocol):
    """What a variant makes of a case: forces of the block at any creep ratio, on a uniform clock from first contact."""

    @property
    def step(self) -> float:
        """Time between rows of `forces`, s."""

    def forces(self, creep_ratio: float) -> Array:
        """Return normal force, shear force (N, positive like lambda), touching and slipping area (m2), (n, 4)."""

    def net_shear_impulse(self, creep_ratio: float) -> float:
        """Return the time integral of the shear force over the pass, N s."""


Make = Callable[[Case], Pass]

# name -> where the variant is made ("module:function", below this package), and one line for a reader. A module is
# imported when its variant is run, and code digests read this table: a change in one variant leaves the others as
# they are.
BUILT_IN: Mapping[str, tuple[str, str]] = {
    "paper": ("block_pass:prepare", "independent springs with lumped mass, section 4 of the paper"),
    "light": (
        "block_pass:prepare_light",
        "the same with a hundredth of the lumped mass: near the massless limit |F_l| = mu_k F_r",
    ),
    "shape_factor": (
        "shape_factor:prepare_shape_factor",
        "the paper's springs with the block's apparent moduli, from one static elastic solve",
    ),
    "shape_factor_theory": (
        "shape_factor:prepare_shape_factor_theory",
        "the same with moduli from shape-factor theory, for rectangles",
    ),
    "condensed": (
        "condensed.face_pass:prepare_condensed",
        "springs that know their neighbours: the block condensed on to its face, 8 elements a height",
    ),
    "condensed_coarse": ("condensed.face_pass:prepare_coarse", "the same with 4 elements a height, for many runs"),
}
COMMON = ("spring.run", "spring.summary", "spring.block_pass")
"""Code behind every variant: the run, its summary, and the paper's model, which finds the creep of free rolling."""

_ADDED: dict[str, tuple[Make, str]] = {}


def register(name: str, make: Make, summary: str) -> None:
    """Add a variant; `make` turns a case into a pass, `summary` is one line for a reader."""
    _ADDED[name] = (make, summary)


def variants() -> dict[str, str]:
    """Return the known variants and their one-line summaries."""
    known = {name: summary for name, (_, summary) in BUILT_IN.items()}
    return known | {name: summary for name, (_, summary) in _ADDED.items()}


def pass_of(case: Case, variant: str = "paper") -> Pass:
    """Return the case ready to run; raises `InputError` for an unknown variant or a case that cannot be."""
    return _maker(variant)(case)


@cache
def code_digest(variant: str) -> str:
    """Return the digest of the code that can change a variant's results; ``unknown`` for one that was added.

    Raises `InputError` for an unknown variant.
    """
    if variant in _ADDED:
        return UNKNOWN
    if variant not in BUILT_IN:
        raise InputError("spring variant", variant, f"one of {', '.join(variants())}")
    module, _, _ = BUILT_IN[variant][0].partition(":")
    return digest_of((*COMMON, f"spring.{module}"))


def _maker(variant: str) -> Make:
    if variant in _ADDED:
        return _ADDED[variant][0]
    if variant not in BUILT_IN:
        raise InputError("spring variant", variant, f"one of {', '.join(variants())}")
    module, _, function = BUILT_IN[variant][0].partition(":")
    make: Make = getattr(importlib.import_module(f"{__package__}.{module}"), function)
    return make
