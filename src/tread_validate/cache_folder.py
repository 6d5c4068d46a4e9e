"""Where files are kept that only save time: compiled friction routines, factors of a block's stiffness."""

from __future__ import annotations

import os
from pathlib import Path


def cache_folder() -> Path | None:
    """Return where files are kept, or None where they are not.

    ``$TREAD_VALIDATE_CACHE`` (``off``: nowhere), else ``$XDG_CACHE_HOME/tread-validate``, else
    ``~/.cache/tread-validate``.
    """
    named = os.environ.get("TREAD_VALIDATE_CACHE", "")
    if named.lower() == "off":
        return None
    if named:
        return Path(named)
    base = os.environ.get("XDG_CACHE_HOME", "")
    try:
        return (Path(base) if base else Path.home() / ".cache") / "tread-validate"
    except RuntimeError:  # no home
        return None
