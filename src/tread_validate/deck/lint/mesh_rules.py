"""Rules on elements, sections and materials."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...inp import Deck, KeywordBlock
from .findings import Findings
from .names import Names
from .syntax import is_number, number
from .table import HEXAHEDRA, KEYWORDS, SECTION_KEYWORDS, SECTIONLESS

MOST = 5
"""Findings of one rule at most in one element block; the last says how many more there are."""

# natural coordinates of a hexahedron's corners
CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], dtype=float
)


def check_mesh(deck: Deck, names: Names, findings: Findings) -> None:
    """Check that elements have nodes, a positive Jacobian and one section with a whole material."""
    _check_element_nodes(names, findings)
    _check_sections(deck, names, findings)
    for name, block in names.named.get("MATERIAL", {}).items():
        _check_material(deck, names, name, block, findings)


def _check_element_nodes(names: Names, findings: Findings) -> None:
    order = np.argsort(names.node_ids)
    sorted_ids = names.node_ids[order]
    for part in names.elements:
        if not part.ids.size:
            continue
        if not sorted_ids.size:
            findings.add(part.block, "undefined-node", "elements without any node")
            continue
        place = np.clip(np.searchsorted(sorted_ids, part.nodes), 0, sorted_ids.size - 1)
        missing = sorted_ids[place] != part.nodes
        bad = np.flatnonzero(missing.any(axis=1))
        for count, row in enumerate(bad[:MOST]):
            node = int(part.nodes[row][missing[row]][0])
            more = f" (and {bad.size - MOST} more elements)" if count == MOST - 1 and bad.size > MOST else ""
            findings.add(part.lines[row], "undefined-node", f"element {part.ids[row]}: there is no node {node}{more}")
        if part.kind not in HEXAHEDRA:
            continue
        whole = np.flatnonzero(~missing.any(axis=1))
        least = _least_jacobian(names.coordinates[order][place[whole]])
        bad = whole[least <= 0.0]
        for count, row in enumerate(bad[:MOST]):
            more = f" (and {bad.size - MOST} more elements)" if count == MOST - 1 and bad.size > MOST else ""
            findings.add(part.lines[row], "negative-jacobian", f"element {part.ids[row]} is inside out or folded{more}")


def _least_jacobian(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the least Jacobian determinant at the corners and the centre of (m, 8, 3) hexahedra."""
    least = np.full(corners.shape[0], np.inf)
    for at in (*CORNERS, np.zeros(3)):
        factor = 1.0 + CORNERS * at
        gradient = 0.125 * np.stack(
            [
                CORNERS[:, 0] * factor[:, 1] * factor[:, 2],
                CORNERS[:, 1] * factor[:, 0] * factor[:, 2],
                CORNERS[:, 2] * factor[:, 0] * factor[:, 1],
            ]
        )
        with np.errstate(all="ignore"):  # absurd coordinates: the determinant is then no number, and is reported
            least = np.minimum(least, np.linalg.det(np.einsum("dk,mkx->mdx", gradient, corners)))
    return least


def _check_sections(deck: Deck, names: Names, findings: Findings) -> None:
    owner: dict[int, KeywordBlock] = {}
    for block in deck.blocks:
        if block.keyword not in SECTION_KEYWORDS:
            continue
        elset = (block.parameters.get("ELSET") or "").upper()
        ids = names.elsets.get(elset)
        if ids is None:
            findings.add(block, "dangling-elset", f"*{block.keyword}: there is no element set {elset or '(none)'}")
        else:
            for element in ids.tolist():
                if element in owner and owner[element] is not block:
                    findings.add(
                        block, "two-sections", f"element {element} already has a section in line {owner[element].line}"
                    )
                    break
            owner.update(dict.fromkeys(ids.tolist(), block))
        for parameter, kind in (
            ("MATERIAL", "MATERIAL"),
            ("CONTROLS", "SECTION CONTROLS"),
            ("ORIENTATION", "ORIENTATION"),
        ):
            name = block.parameters.get(parameter)
            if name and not names.has(kind, name):
                rule = f"dangling-{parameter.lower()}"
                findings.add(block, rule, f"*{block.keyword}, {parameter}={name}: there is no such *{kind}")
    for part in names.elements:
        if part.kind in SECTIONLESS:
            continue
        bare = [index for index, element in enumerate(part.ids.tolist()) if element not in owner]
        if bare:
            more = f" (and {len(bare) - 1} more)" if len(bare) > 1 else ""
            findings.add(part.lines[bare[0]], "no-section", f"element {part.ids[bare[0]]} has no section{more}")


def _check_material(deck: Deck, names: Names, name: str, block: KeywordBlock, findings: Findings) -> None:
    options = _options(deck, block)
    if names.explicit and "DENSITY" not in options:
        findings.add(block, "no-density", f"material {name} has no *DENSITY, which *DYNAMIC, EXPLICIT needs")
    if not {"ELASTIC", "HYPERELASTIC", "HYPERFOAM", "USER MATERIAL"} & set(options):
        findings.add(block, "no-stiffness", f"material {name} has no *ELASTIC or *HYPERELASTIC")
    for keyword, least in (("DENSITY", 0.0), ("ELASTIC", 0.0)):
        for line in options[keyword].data[:1] if keyword in options else ():
            value = line.fields[0]
            if is_number(value) and number(value) <= least:
                findings.add(line, "material-value", f"*{keyword} {value}: expected > 0")
    if "ELASTIC" in options and (options["ELASTIC"].parameters.get("TYPE") or "ISOTROPIC") == "ISOTROPIC":
        for line in options["ELASTIC"].data:
            ratio = line.fields[1] if len(line.fields) > 1 else "0"
            if is_number(ratio) and not -1.0 < number(ratio or "0") < 0.5:
                findings.add(line, "material-value", f"Poisson's ratio {ratio}: expected more than -1, less than 0.5")
    if "VISCOELASTIC" in options:
        _check_prony(options["VISCOELASTIC"], findings)
        if "TRS" in options and not any(
            one.parameters.get("TYPE") == "TEMPERATURE" for one in deck.named("INITIAL CONDITIONS")
        ):
            findings.add(options["TRS"], "no-temperature", "*TRS without *INITIAL CONDITIONS, TYPE=TEMPERATURE")


def _options(deck: Deck, material: KeywordBlock) -> dict[str, KeywordBlock]:
    """Return the options of a material, by keyword."""
    found: dict[str, KeywordBlock] = {}
    start = deck.blocks.index(material)
    for block in deck.blocks[start + 1 :]:
        known = KEYWORDS.get(block.keyword)
        if known is None or not known.parents:
            break
        found.setdefault(block.keyword, block)
    return found


def _check_prony(block: KeywordBlock, findings: Findings) -> None:
    if block.parameters.get("TIME") != "PRONY":
        return
    shear = bulk = 0.0
    for line in block.data:
        fields = line.fields
        if len(fields) != 3 or not all(is_number(text) for text in fields if text):
            if len(fields) != 3:
                findings.add(line, "field-count", f"Prony term: {len(fields)} fields, expected g, k, tau")
            continue
        g, k, tau = (number(text) if text else 0.0 for text in fields)
        if g < 0.0 or k < 0.0 or tau <= 0.0:
            findings.add(line, "prony", f"Prony term {line.text}: expected g >= 0, k >= 0, tau > 0")
        shear, bulk = shear + g, bulk + k
    if block.data and (shear >= 1.0 or bulk >= 1.0):
        ratio = max(shear, bulk)
        findings.add(block, "prony", f"Prony ratios add up to {ratio:.6g}: expected less than 1, or nothing is left")
