"""Rules on surfaces, contact pairs, friction and VFRIC, and output requests."""

from __future__ import annotations

import math
import re

import numpy as np

from ...inp import DataLine, Deck, KeywordBlock, label
from ...inp.vocabulary import keywords
from .elements import face_count
from .findings import Findings
from .names import Names
from .syntax import is_number, number

ANALYTICAL = frozenset({"CYLINDER", "REVOLUTION", "SEGMENTS"})


def check_contact(deck: Deck, names: Names, findings: Findings) -> None:
    """Check surfaces, pairs and the friction between them."""
    for block in deck.named("SURFACE"):
        kind = block.parameters.get("TYPE") or "ELEMENT"
        if kind == "ELEMENT":
            _check_element_surface(block, names, findings)
        elif kind == "NODE":
            for line in block.data:
                if names.nodes_of(line.fields[0]) is None:
                    findings.add(line, "dangling-nset", f"*SURFACE: there is no node or node set {line.fields[0]}")
        elif kind in ANALYTICAL:
            _check_profile(block, kind, findings)
    analytical = {name for name, block in names.named["SURFACE"].items() if block.parameters.get("TYPE") in ANALYTICAL}
    held = {block.parameters.get("ANALYTICAL SURFACE") or "" for block in deck.named("RIGID BODY")}
    lost = any(name and not names.has("SURFACE", name) for name in held)  # a body whose surface is misspelt
    for name in sorted(analytical - held if not names.gaps and not lost else ()):
        findings.add(names.named["SURFACE"][name], "loose-surface", f"analytical surface {name} is in no *RIGID BODY")
    for block in deck.named("CONTACT PAIR"):
        _check_pair(block, names, analytical, findings)
    if names.explicit:
        _check_place_of_pairs(deck, findings)
    _check_friction(deck, names, findings)
    _check_references(deck, names, findings)
    _check_output(deck, names, findings)


def _check_references(deck: Deck, names: Names, findings: Findings) -> None:
    """Check the surfaces that ties, couplings and general contact name."""
    for block in deck.named("TIE", "CONTACT INCLUSIONS", "CONTACT EXCLUSIONS"):
        for line in block.data:
            for text in line.fields[:2]:
                if text and not names.has("SURFACE", text) and names.nodes_of(text) is None:
                    findings.add(line, "dangling-surface", f"*{block.keyword}: there is no *SURFACE {text}")
    for block in deck.named("COUPLING"):
        surface = block.parameters.get("SURFACE")
        if surface and not names.has("SURFACE", surface):
            findings.add(block, "dangling-surface", f"*COUPLING: there is no *SURFACE {surface}")
        reference = block.parameters.get("REF NODE")
        if reference and names.nodes_of(reference) is None:
            findings.add(block, "dangling-nset", f"*COUPLING, REF NODE={reference}: there is no such node or set")


def _check_element_surface(block: KeywordBlock, names: Names, findings: Findings) -> None:
    if {"COMBINE", "CROP", "TRIM"} & set(block.parameters) and "COMBINE" in block.parameters:
        for line in block.data:
            for text in line.fields:
                if text and not names.has("SURFACE", text):
                    findings.add(line, "dangling-surface", f"*SURFACE, COMBINE: there is no *SURFACE {text}")
        return
    for line in block.data:
        target = line.fields[0] if line.fields else ""
        face = (line.fields[1] if len(line.fields) > 1 else "").upper()
        ids = names.elements_of(target) if target else None
        if target and ids is None:
            findings.add(line, "dangling-elset", f"*SURFACE: there is no element or element set {target}")
        if ids is None or not ids.size or not re.fullmatch(r"S\d+", face):
            continue
        mine = [part for part in names.elements if np.isin(ids, part.ids).any()]
        counts = [face_count(part.kind) for part in mine]
        known = [count for count in counts if count is not None]
        if known and len(known) == len(counts) and not 1 <= int(face[1:]) <= max(known):
            findings.add(line, "surface-face", f"*SURFACE: face {face}: expected S1 to S{max(known)}")


def _check_profile(block: KeywordBlock, kind: str, findings: Findings) -> None:
    """Check START, LINE, CIRCL of an analytical surface; the leading lines only fix the axes."""
    lines = list(block.data)
    words = [line.fields[0].upper() if line.fields else "" for line in lines]
    if "START" not in words:
        findings.add(block, "profile", "the analytical surface has no START line")
        return
    start = words.index("START")
    if kind == "CYLINDER" and start == 2:
        axes = [_numbers(line, 0, count) for line, count in ((lines[0], 6), (lines[1], 3))]
        if any(values is None for values in axes):
            findings.add(lines[0], "profile", "axes: expected 6 coordinates, then 3")
        elif axes[0] is not None and axes[1] is not None:
            _check_axes(axes[0], axes[1], lines[0], findings)
    elif start not in (0, {"CYLINDER": 2, "REVOLUTION": 1}.get(kind, 0)):
        fixed = {"CYLINDER": "the two lines that fix the axes", "REVOLUTION": "one line, two points on the axis"}
        findings.add(lines[0], "profile", f"{start} lines before START: expected {fixed.get(kind, 'none')}")
    elif kind == "REVOLUTION" and start == 1 and _numbers(lines[0], 0, 6) is None:
        findings.add(lines[0], "profile", "axis: expected 6 coordinates")
    at = _numbers(lines[start], 1, 2)
    if at is None:
        findings.add(lines[start], "profile", "START: expected two coordinates")
        return
    if start + 1 == len(lines):
        findings.add(lines[start], "profile", "a profile of no LINE or CIRCL")
    for line, word in zip(lines[start + 1 :], words[start + 1 :], strict=True):
        count = {"LINE": 2, "CIRCL": 4, "PARAB": 4}.get(word)
        values = _numbers(line, 1, count) if count else None
        if values is None:
            form = "LINE, x, y or CIRCL, x, y, xc, yc" if count is None else f"{word} with {count} coordinates"
            findings.add(line, "profile", f"{line.text[:40]}: expected {form}")
            return
        if word == "CIRCL":
            _check_arc(at, values, line, findings)
        at = values[-2:] if word == "PARAB" else values[:2]


def _check_axes(first: list[float], second: list[float], line: DataLine, findings: Findings) -> None:
    x = [b - a for a, b in zip(first[:3], first[3:], strict=True)]
    generator = [c - a for a, c in zip(first[:3], second, strict=True)]
    lengths = math.hypot(*x), math.hypot(*generator)
    if 0.0 in lengths:
        findings.add(line, "profile", "the points that fix the axes coincide")
    elif abs(sum(a * b for a, b in zip(x, generator, strict=True))) > 1e-6 * lengths[0] * lengths[1]:
        findings.add(line, "profile", "the generator is not at a right angle to the local x axis")


def _check_arc(at: list[float], values: list[float], line: DataLine, findings: Findings) -> None:
    x, y, xc, yc = values
    begin, end = (at[0] - xc, at[1] - yc), (x - xc, y - yc)
    radii = math.hypot(*begin), math.hypot(*end)
    if abs(radii[0] - radii[1]) > 1e-6 * max(radii) or radii[0] == 0.0:
        findings.add(line, "profile", f"arc ends at radii {radii[0]:g} and {radii[1]:g}: expected one radius > 0")
        return
    cross = begin[0] * end[1] - begin[1] * end[0]
    dot = begin[0] * end[0] + begin[1] * end[1]
    angle = abs(math.degrees(math.atan2(cross, dot)))
    if angle > 179.999 or angle < 1e-6:
        findings.add(line, "arc-angle", f"an arc of {angle if angle > 1.0 else 360.0:g} deg: expected less than 180")


def _numbers(line: DataLine, first: int, count: int) -> list[float] | None:
    fields = line.fields[first:]
    if len(fields) != count or not all(is_number(text) for text in fields):
        return None
    return [number(text) for text in fields]


def _check_pair(block: KeywordBlock, names: Names, analytical: set[str], findings: Findings) -> None:
    interaction = block.parameters.get("INTERACTION")
    if interaction and not names.has("SURFACE INTERACTION", interaction):
        findings.add(block, "dangling-interaction", f"*CONTACT PAIR: there is no *SURFACE INTERACTION {interaction}")
    for line in block.data:
        pair = [label(text) for text in line.fields[:2]]
        for name in pair:
            if name and not names.has("SURFACE", name):
                findings.add(line, "dangling-surface", f"*CONTACT PAIR: there is no *SURFACE {name}")
        if not pair or not pair[0]:
            findings.add(line, "contact-pair", "*CONTACT PAIR: expected two surfaces, or one for self-contact")
        elif pair[0] in analytical:
            findings.add(line, "contact-pair", f"analytical surface {pair[0]} must come second: it cannot be the slave")


def _check_place_of_pairs(deck: Deck, findings: Findings) -> None:
    inside = False
    for block in deck.blocks:
        inside = (inside or block.keyword == "STEP") and block.keyword != "END STEP"
        if block.keyword == "CONTACT PAIR" and not inside:
            findings.add(block, "wrong-place", "*CONTACT PAIR stands inside a step in ABAQUS/Explicit")


def _check_friction(deck: Deck, names: Names, findings: Findings) -> None:
    owner: KeywordBlock | None = None
    general = next(deck.named("CONTACT"), None)
    assigned = {
        label(line.fields[-1])
        for block in deck.named("CONTACT PROPERTY ASSIGNMENT")
        for line in block.data
        if line.fields
    }
    for line in (line for block in deck.named("CONTACT PROPERTY ASSIGNMENT") for line in block.data):
        if line.fields and line.fields[-1] and not names.has("SURFACE INTERACTION", line.fields[-1]):
            findings.add(
                line, "dangling-interaction", f"there is no *SURFACE INTERACTION {line.fields[-1] or '(blank)'}"
            )
    for position, block in enumerate(deck.blocks):
        if block.keyword in ("SURFACE INTERACTION", "CHANGE FRICTION"):
            owner = block
        if block.keyword != "FRICTION":
            continue
        if "USER" in block.parameters:
            name = (owner.parameters.get("NAME") or owner.parameters.get("INTERACTION") or "") if owner else ""
            _check_user_friction(deck, position, block, name, findings)
            kind = block.parameters["USER"] or "FRIC"
            pairs = [one for one in deck.named("CONTACT PAIR") if (one.parameters.get("INTERACTION") or "") == name]
            if kind == "FRIC" and general is not None and (name in assigned or not pairs):
                findings.add(
                    block,
                    "vfric-general-contact",
                    "USER=FRIC (VFRIC) works with contact pairs only; general contact takes USER=FRICTION (VFRICTION)",
                )
            if kind != "FRIC" and pairs:
                findings.add(
                    block,
                    "vfric-general-contact",
                    f"USER={kind} works with general contact only; a pair takes USER=FRIC",
                )
            for pair in pairs:
                if kind == "FRIC" and pair.parameters.get("MECHANICAL CONSTRAINT") == "PENALTY":
                    findings.add(
                        pair,
                        "vfric-penalty",
                        "VFRIC with MECHANICAL CONSTRAINT=PENALTY is not to be trusted: KINEMATIC",
                    )
        elif block.data and block.data[0].fields[0] and is_number(block.data[0].fields[0]):
            value = number(block.data[0].fields[0])
            if value < 0.0:
                findings.add(block.data[0], "friction-value", f"friction coefficient {value:g}: expected >= 0")


def _check_user_friction(deck: Deck, position: int, block: KeywordBlock, name: str, findings: Findings) -> None:
    clashing = {"ROUGH", "LAGRANGE", "ELASTIC SLIP", "SLIP TOLERANCE", "SHEAR TRACTION SLOPE", "TAUMAX", "ANISOTROPIC"}
    for parameter in sorted(clashing & set(block.parameters)):
        findings.add(
            block, "vfric-softened", f"{parameter} with USER: VFRIC gives the whole shear law and cannot be softened"
        )
    for count in ("PROPERTIES", "DEPVAR"):
        text = block.parameters.get(count, "0" if count == "DEPVAR" else None)
        if count in block.parameters and (not text or not text.isdigit()):
            findings.add(block, "vfric-properties", f"*FRICTION, {count}={text or ''}: expected a whole number")
    given = sum(len(line.fields) for line in block.data)
    asked = block.parameters.get("PROPERTIES") or "0"
    if asked.isdigit() and int(asked) != given:
        findings.add(
            block, "vfric-properties", f"*FRICTION, USER: PROPERTIES={asked}, but the data lines give {given} numbers"
        )
    for line in block.data[:-1]:
        if len(line.fields) != 8:
            findings.add(line, "vfric-properties", f"{len(line.fields)} properties, expected eight to a line")
    # softened pressure-overclosure beside it in the same interaction
    for other in (*_siblings(deck, position, -1), *_siblings(deck, position, 1)):
        softened = other.parameters.get("PRESSURE-OVERCLOSURE") or "HARD"
        if other.keyword == "SURFACE BEHAVIOR" and softened != "HARD":
            findings.add(
                other, "vfric-softened", f"PRESSURE-OVERCLOSURE={softened} with VFRIC in {name}: expected hard contact"
            )


def _siblings(deck: Deck, position: int, direction: int) -> list[KeywordBlock]:
    """Return the option blocks beside one, up to the next keyword that is no option."""
    found = []
    position += direction
    while 0 <= position < len(deck.blocks):
        block = deck.blocks[position]
        known = keywords().get(block.keyword)
        if known is None or "SURFACE INTERACTION" not in known.parents:
            break
        found.append(block)
        position += direction
    return found


def _check_output(deck: Deck, names: Names, findings: Findings) -> None:
    history = False
    for block in deck.blocks:
        if block.keyword == "OUTPUT":
            history = "HISTORY" in block.parameters
        if block.keyword in ("NODE OUTPUT", "NODE FILE", "NODE PRINT", "TRANSFORM"):
            name = block.parameters.get("NSET")
            if name and not names.has_nset(name):
                findings.add(block, "dangling-nset", f"*{block.keyword}: there is no node set {name}")
        if block.keyword in (
            "ELEMENT OUTPUT",
            "ENERGY OUTPUT",
            "EL FILE",
            "FIXED MASS SCALING",
            "MASS",
            "INTEGRATED OUTPUT",
        ):
            name = block.parameters.get("ELSET")
            if name and not names.has_elset(name):
                findings.add(block, "dangling-elset", f"*{block.keyword}: there is no element set {name}")
        if block.keyword in ("CONTACT OUTPUT", "CONTACT CONTROLS"):
            name = block.parameters.get("CPSET") or ""
            if name and not names.has("CPSET", name):
                findings.add(block, "dangling-cpset", f"*{block.keyword}: there is no *CONTACT PAIR with CPSET={name}")
            whole = {"CPSET", "SURFACE", "GENERAL CONTACT", "NSET", "VARIABLE"} & set(block.parameters)
            pairs = next(deck.named("CONTACT PAIR"), None) is not None and next(deck.named("CONTACT"), None) is None
            if block.keyword == "CONTACT OUTPUT" and names.explicit and history and not whole and pairs:
                findings.add(block, "no-cpset", "*CONTACT OUTPUT of a history needs CPSET= in ABAQUS/Explicit")
