"""Lighter SVG: the same picture in fewer digits."""

from __future__ import annotations

import re

LINE = re.compile(r' d="([^"]*)"( transform)?')
PLACE = re.compile(r'(<use [^>]*x=")([-0-9.]+)(" y=")([-0-9.]+)"')
NUMBER = re.compile(r"-?[0-9]+\.[0-9]{3,}")


def lighter(text: str) -> str:
    """Return a matplotlib drawing with its coordinates in hundredths of a point; outlines of letters are left alone."""

    def line(found: re.Match[str]) -> str:
        return found[0] if found[2] else f' d="{NUMBER.sub(lambda number: _short(number[0]), found[1])}"'

    def place(found: re.Match[str]) -> str:
        return f'{found[1]}{_short(found[2])}{found[3]}{_short(found[4])}"'

    return PLACE.sub(place, LINE.sub(line, text))


def _short(text: str) -> str:
    return f"{float(text):.2f}".rstrip("0").rstrip(".")
