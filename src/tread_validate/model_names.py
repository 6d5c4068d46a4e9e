"""Names that models had in earlier versions; they are read for one version more, with a warning."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

RENAMED: Mapping[str, str] = {
    "bonded": "shape_factor",
    "bonded_theory": "shape_factor_theory",
    "coupled": "condensed",
    "coupled_coarse": "condensed_coarse",
}
"""Name until 0.1 -> name since; the old ones go with 0.3."""


def current_name(name: str) -> str:
    """Return today's name of a spring variant, with a `FutureWarning` for one of yesterday; others as they are."""
    if name not in RENAMED:
        return name
    warnings.warn(
        f"spring variant {name!r} is called {RENAMED[name]!r} since 0.2; the old name goes with 0.3",
        FutureWarning,
        stacklevel=2,
    )
    return RENAMED[name]
