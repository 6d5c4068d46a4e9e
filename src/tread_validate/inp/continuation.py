"""Whether a keyword line that ends with a comma goes on in the next line."""

from __future__ import annotations

import re

from .deck import split_commas
from .vocabulary import keywords, parameter_name

SHORTEST = 3  # letters of an abbreviated parameter without a value in a line of its own


def goes_on(keyword: str, following: str) -> bool:
    """Whether a line is the rest of a keyword line that ended with a comma: parameters, and not data."""
    if not following or following.startswith("*") or keyword == "HEADING":
        return False
    name, equals, _ = split_commas(following)[0].partition("=")
    name = " ".join(name.upper().split())
    known = keywords().get(keyword)
    if known is None or known.open:
        return bool(equals) or re.fullmatch(r"[A-Z][A-Z \-]*", name) is not None
    full = parameter_name(keyword, name)
    if full in known.required | known.optional and (equals or full == name or len(name) >= SHORTEST):
        return True
    return bool(equals) and keyword != "PARAMETER"
