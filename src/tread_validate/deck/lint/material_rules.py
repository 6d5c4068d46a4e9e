"""Rules on materials: density, elasticity linear or hyperelastic, Prony series, shift."""

from __future__ import annotations

from ...inp import DataLine, Deck, KeywordBlock
from .findings import Findings
from .names import Names
from .syntax import is_number, number
from .table import LAWS

TAKEN, STIFFEST = 20.0, 100.0
"""K/G that ABAQUS/Explicit takes for D1 = 0, and the most its manual advises."""


def check_material(deck: Deck, names: Names, name: str, block: KeywordBlock, used: bool, findings: Findings) -> None:
    """Check the options of one material: what it must have, and constants that it can have."""
    options = _options(deck, block)
    if names.explicit and used and "DENSITY" not in options and not names.gaps:
        findings.add(block, "no-density", f"material {name} has no *DENSITY, which *DYNAMIC, EXPLICIT needs")
    if used and names.mechanical and not LAWS & set(options) and not names.gaps and not _unknown(options):
        findings.add(block, "no-stiffness", f"material {name} has no *ELASTIC or *HYPERELASTIC")
    _check_elastic(options, names, findings)
    if "HYPERELASTIC" in options:
        _check_hyperelastic(options, names, findings)
    if "VISCOELASTIC" in options:
        _check_prony(options["VISCOELASTIC"], findings)
        _check_moduli(options, findings)
        given = any(one.parameters.get("TYPE") == "TEMPERATURE" for one in deck.named("INITIAL CONDITIONS"))
        if "TRS" in options and not given and not names.gaps and next(deck.named("TEMPERATURE"), None) is None:
            findings.add(options["TRS"], "no-temperature", "*TRS without *INITIAL CONDITIONS, TYPE=TEMPERATURE")


def _check_elastic(options: dict[str, KeywordBlock], names: Names, findings: Findings) -> None:
    isotropic = "ELASTIC" in options and (options["ELASTIC"].parameters.get("TYPE") or "ISOTROPIC") == "ISOTROPIC"
    for keyword in ("DENSITY", *(("ELASTIC",) if isotropic else ())):
        for line in options[keyword].data[:1] if keyword in options else ():
            value = line.fields[0]
            if is_number(value) and number(value) <= 0.0 and (keyword == "ELASTIC" or names.explicit):
                findings.add(line, "material-value", f"*{keyword} {value}: expected > 0")
    if isotropic:
        for line in options["ELASTIC"].data:
            ratio = line.fields[1] if len(line.fields) > 1 else "0"
            if not is_number(ratio):
                continue
            nu = number(ratio)
            if nu <= -1.0 or nu > 0.5 or (nu == 0.5 and names.explicit):
                findings.add(line, "material-value", f"Poisson's ratio {ratio}: expected more than -1, less than 0.5")


def _check_hyperelastic(options: dict[str, KeywordBlock], names: Names, findings: Findings) -> None:
    """Check a hyperelastic law: alone in its material; C10 and D1 of the neo-Hookean one."""
    block = options["HYPERELASTIC"]
    if "ELASTIC" in options:
        other = options["ELASTIC"].line
        findings.add(block, "two-laws", f"*HYPERELASTIC beside *ELASTIC in line {other}: one of them gives the stress")
    if not {"NEO HOOKE", "NEO HOOKEAN"} & set(block.parameters) or "TEST DATA INPUT" in block.parameters:
        return
    for line in block.data:
        fields = [*line.fields, "", ""]
        if not is_number(fields[0]) or (fields[1] and not is_number(fields[1])):
            findings.add(line, "not-a-number", f"*HYPERELASTIC: {line.text[:40]}: expected C10, D1")
            continue
        c10, d1 = number(fields[0]), number(fields[1]) if fields[1] else 0.0
        if c10 <= 0.0 or d1 < 0.0:
            findings.add(line, "material-value", f"C10 = {c10:g}, D1 = {d1:g}: expected C10 > 0, D1 >= 0")
        elif names.explicit:
            _check_compressibility(line, c10, d1, findings)


def _check_compressibility(line: DataLine, c10: float, d1: float, findings: Findings) -> None:
    """Check the ratio K/G = 1/(D1 C10) that C10 and D1 make, as Poisson's ratio at small strain."""
    if d1 == 0.0:
        text = (
            f"D1 = 0: ABAQUS/Explicit takes K = {TAKEN:g} G, Poisson's ratio 0.475; write D1 = {1 / (TAKEN * c10):.4g}"
        )
        findings.add(line, "compressibility", text)
        return
    ratio = 1.0 / (d1 * c10)
    nu = (3.0 * ratio - 2.0) / (6.0 * ratio + 2.0)
    if ratio > STIFFEST:
        text = f"D1 makes K = {ratio:.4g} G, Poisson's ratio {nu:.4g}: K > {STIFFEST:g} G is noisy and slow"
        findings.add(line, "compressibility", text)
    elif nu < 0.0:
        findings.add(line, "compressibility", f"D1 makes K = {ratio:.4g} G, Poisson's ratio {nu:.4g}: negative")


def _unknown(options: dict[str, KeywordBlock]) -> bool:
    """Whether a material has an option that may be a law of its own (known by name only, or not at all)."""
    from ...inp.vocabulary import keywords

    known = keywords()
    return any(word not in known or known[word].open for word in options)


def _options(deck: Deck, material: KeywordBlock) -> dict[str, KeywordBlock]:
    """Return the options of a material, by keyword."""
    from ...inp.vocabulary import keywords

    known = keywords()
    found: dict[str, KeywordBlock] = {}
    start = deck.blocks.index(material)
    for block in deck.blocks[start + 1 :]:
        entry = known.get(block.keyword)
        if entry is not None and not entry.parents:
            break
        found.setdefault(block.keyword, block)
    return found


def _check_prony(block: KeywordBlock, findings: Findings) -> None:
    if block.parameters.get("TIME") != "PRONY":
        return
    shear = bulk = 0.0
    for line in block.data:
        fields = line.fields
        if not 1 <= len(fields) <= 3 or not all(is_number(text) for text in fields if text):
            if not 1 <= len(fields) <= 3:
                findings.add(line, "field-count", f"Prony term: {len(fields)} fields, expected g, k, tau")
            continue
        g, k, tau = (number(text) if text else 0.0 for text in (*fields, "", "")[:3])
        if g < 0.0 or k < 0.0 or tau <= 0.0:
            findings.add(line, "prony", f"Prony term {line.text}: expected g >= 0, k >= 0, tau > 0")
        shear, bulk = shear + g, bulk + k
    if len(block.data) and (shear >= 1.0 or bulk >= 1.0):
        ratio = max(shear, bulk)
        where = block.data[0] if len(block.data) == 1 else block
        findings.add(where, "prony", f"Prony ratios add up to {ratio:.6g}: expected less than 1, or nothing is left")


def _check_moduli(options: dict[str, KeywordBlock], findings: Findings) -> None:
    """Say which moduli a viscoelastic material's constants are where the deck leaves it to the default."""
    prony = options["VISCOELASTIC"]
    left = 1.0 - sum(number(line.fields[0]) for line in prony.data if line.fields and is_number(line.fields[0]))
    for keyword in ("ELASTIC", "HYPERELASTIC"):
        if keyword in options and "MODULI" not in options[keyword].parameters and 0.0 < left < 1.0:
            text = (
                f"*{keyword} without MODULI: its constants are the long-term ones, at once {1 / left:.3g} times as much"
            )
            findings.add(options[keyword], "moduli", text)
