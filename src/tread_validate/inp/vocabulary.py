"""Names of keywords, parameters and values, and the language's rules for writing them short.

A name may be abbreviated as long as it stays unique, and blanks in it do not count; an exact match comes first.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Literal

from ..yaml_text import load_yaml

Place = Literal["model", "step", "any"]


@dataclass(frozen=True)
class KeywordEntry:
    """Form of one keyword.

    Attributes
    ----------
    place : str
        ``model`` (before the first step), ``step`` (inside one) or ``any``.
    required, optional : frozenset of str
        Parameter names.
    values : dict of str to tuple of str
        Parameters whose values are a closed list.
    fields : tuple of int or None
        Least and most fields of a data line; None where this depends on more than the keyword.
    lines : tuple of int
        Least and most data lines (the most may be -1: any number).
    numeric : bool
        Whether every field of a data line is a number.
    parents : tuple of str
        Keywords one of which must precede it, with nothing but other options in between.
    open : bool
        Known by name and place only: parameters are not checked.
    """

    place: Place
    required: frozenset[str] = frozenset()
    optional: frozenset[str] = frozenset()
    values: dict[str, tuple[str, ...]] | None = None
    fields: tuple[int, int] | None = None
    lines: tuple[int, int] = (0, -1)
    numeric: bool = False
    parents: tuple[str, ...] = ()
    open: bool = False

    def values_of(self, parameter: str) -> tuple[str, ...]:
        """Return the closed list of a parameter's values; empty where any value goes."""
        return (self.values or {}).get(parameter, ())


PARENT_OF_NAMED = {"material": ("MATERIAL",), "interaction": ("SURFACE INTERACTION",)}


def _keyword(entry: dict[str, Any]) -> KeywordEntry:
    fields, lines = entry.get("fields"), entry.get("lines", (0, -1))
    return KeywordEntry(
        place=entry["place"],
        required=frozenset(entry.get("required", ())),
        optional=frozenset(entry.get("optional", ())),
        values={name: tuple(values) for name, values in entry.get("values", {}).items()},
        fields=None if fields is None else (fields[0], fields[1]),
        lines=(lines[0], lines[1]),
        numeric=entry.get("numbers", False),
        parents=tuple(entry.get("below", ())),
    )


@cache
def keywords(dialect: str = "abaqus") -> dict[str, KeywordEntry]:
    """Return every keyword of a dialect (``abaqus`` or ``calculix``) by its full name."""
    text = (files("tread_validate.inp") / "keywords.yaml").read_text(encoding="utf-8")
    content = load_yaml(text, "keywords.yaml", fast=True)
    found = {name: _keyword(entry) for name, entry in content["keywords"].items()}
    for group, listed in content["named"].items():
        if group == "calculix" and dialect != "calculix":
            continue
        place: Place = {"step": "step", "any": "any", "calculix": "any"}.get(group, "model")  # type: ignore[assignment]  # get widens the literals of the table
        for name in listed.split(","):
            entry = KeywordEntry(place, parents=PARENT_OF_NAMED.get(group, ()), open=True)
            found.setdefault(" ".join(name.split()), entry)
    return found


def full_name(text: str, names: tuple[str, ...]) -> str | None:
    """Return the one of `names` that `text` (upper case) is or abbreviates, blanks not counted; None where none or two.

    Examples
    --------
    >>> full_name("HOURGL", ("HOURGLASS", "NAME"))
    'HOURGLASS'
    """
    if text in names:
        return text
    squeezed = text.replace(" ", "")
    if not squeezed:
        return None
    found = [name for name in names if name.replace(" ", "").startswith(squeezed)]
    exact = [name for name in found if name.replace(" ", "") == squeezed]
    if exact:
        return exact[0]
    return found[0] if len(found) == 1 else None


@cache
def keyword_name(text: str) -> str:
    """Return the full name of a keyword as written (upper case, single blanks); the text itself where there is none."""
    return full_name(text, tuple(keywords())) or text


@cache
def parameter_name(keyword: str, text: str) -> str:
    """Return the full name of a parameter of `keyword`; the text itself where there is none."""
    known = keywords().get(keyword)
    if known is None:
        return text
    return full_name(text, tuple(sorted(known.required | known.optional))) or text


@cache
def value_name(keyword: str, parameter: str, text: str) -> str:
    """Return the full value of a parameter with a closed list of values; the text itself where there is none."""
    known = keywords().get(keyword)
    listed = known.values_of(parameter) if known is not None else ()
    return (full_name(text, listed) if listed else None) or text
