"""What the laboratory verbs share: origin of the data, provenance, writing."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..errors import InputError, one_line
from ..files import write_text

ORIGINS = ("measured", "synthetic")


def checked_origin(path: Path, origin: str, source: str) -> tuple[str, str]:
    """Return the origin and the source line; what the command line leaves open is read from the file's name and head.

    A file that says it is synthetic, in its name or in an ``# origin: synthetic`` line, stays synthetic.
    """
    said = _head(path)
    synthetic = "synthetic" in path.name.lower() or said.get("origin", "").lower() == "synthetic"
    if origin and origin not in ORIGINS:
        raise InputError("--origin", one_line(origin, 60), f"one of {', '.join(ORIGINS)}")
    if synthetic and origin == "measured":
        raise InputError("--origin", "measured", f"synthetic, as {path.name} says of itself")
    kind = "synthetic" if synthetic else (origin or "measured")
    return kind, one_line(source or said.get("source", "") or path.name, 280)


def _head(path: Path) -> dict[str, str]:
    if not path.is_file() or path.suffix.lower() == ".tdms":
        return {}
    said: dict[str, str] = {}
    with path.open(encoding="utf-8", errors="replace") as stream:
        for line in stream:
            if not line.lstrip("\ufeff").startswith("#"):
                break
            key, colon, value = line.lstrip("\ufeff# ").partition(":")
            if colon:
                said[key.strip()] = value.strip()
    return said


def provenance(path: Path) -> dict[str, str]:
    """Return input name and checksum, and package version; no commit, so that the same input gives the same file."""
    from ..provenance import sha256_file, version

    return {"input": path.name, "input_sha256": sha256_file(path), "version": version()}


def write_all(files: Mapping[Path, str]) -> None:
    """Write several texts, each atomically."""
    for path, text in files.items():
        write_text(path, text)
