"""The page of the engine and the engine's table of keywords are one."""

from __future__ import annotations

from pathlib import Path

from tread_validate.fe.subset import SUBSET


def test_every_keyword_of_the_subset_is_documented(root: Path) -> None:
    """docs/fe_engine.md names each keyword that the engine accepts."""
    page = (root / "docs" / "fe_engine.md").read_text(encoding="utf-8")
    missing = [word for word in SUBSET if f"*{word}" not in page]
    assert missing == []
