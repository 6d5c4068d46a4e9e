"""Checks that are switched off, each with its reason beside it."""

from __future__ import annotations

import re
from pathlib import Path

SWITCHED_OFF = re.compile(r"#\s*(?:type: ignore\[[\w-]+\]|noqa: [A-Z]+\d+)(.*)$")


def test_every_check_that_is_switched_off_has_its_reason_beside_it(root: Path) -> None:
    """In the package: a second comment on the same line, of more than one word."""
    bare = []
    for path in sorted((root / "src").rglob("*.py")):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            found = SWITCHED_OFF.search(line)
            if found and not re.match(r"\s+# \S+ \S+", found[1]):
                bare.append(f"{path.relative_to(root)}:{number}")
    assert bare == []
