"""The part of the ABAQUS keyword language that the engine runs: keywords, parameters and where they stand.

Anything outside this table stops the run with its line. What changes the answer is never skipped.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..errors import InputError
from ..inp import Deck, KeywordBlock

Level = Literal["model", "step", "both"]


@dataclass(frozen=True)
class Keyword:
    """What the engine accepts of one keyword.

    Attributes
    ----------
    level : model, step or both
        Where it may stand.
    parameters : mapping of name to the values accepted
        An empty tuple accepts any value (also none).
    required : tuple of str
        Parameters that must be there.
    """

    level: Level
    parameters: dict[str, tuple[str, ...]]
    required: tuple[str, ...] = ()


ANY: tuple[str, ...] = ()

SUBSET: dict[str, Keyword] = {
    "HEADING": Keyword("model", {}),
    "PREPRINT": Keyword("model", {"ECHO": ANY, "MODEL": ANY, "HISTORY": ANY, "CONTACT": ANY}),
    "NODE": Keyword("model", {"NSET": ANY}),
    "ELEMENT": Keyword("model", {"TYPE": ("C3D8R", "C3D8"), "ELSET": ANY}, ("TYPE",)),
    "NSET": Keyword("model", {"NSET": ANY, "GENERATE": ANY, "ELSET": ANY, "INTERNAL": ANY, "UNSORTED": ANY}, ("NSET",)),
    "ELSET": Keyword("model", {"ELSET": ANY, "GENERATE": ANY, "INTERNAL": ANY, "UNSORTED": ANY}, ("ELSET",)),
    "SURFACE": Keyword(
        "model", {"NAME": ANY, "TYPE": ("ELEMENT", "CYLINDER", "REVOLUTION"), "INTERNAL": ANY}, ("NAME",)
    ),
    "MATERIAL": Keyword("model", {"NAME": ANY}, ("NAME",)),
    "DENSITY": Keyword("model", {}),
    "ELASTIC": Keyword("model", {"TYPE": ("ISOTROPIC",), "MODULI": ("INSTANTANEOUS", "LONG TERM")}),
    "HYPERELASTIC": Keyword("model", {"NEO HOOKE": ANY, "MODULI": ("INSTANTANEOUS", "LONG TERM")}, ("NEO HOOKE",)),
    "VISCOELASTIC": Keyword("model", {"TIME": ("PRONY",)}, ("TIME",)),
    "TRS": Keyword("model", {"DEFINITION": ("WLF",)}),
    "DAMPING": Keyword("model", {"BETA": ANY}, ("BETA",)),
    "SOLID SECTION": Keyword("model", {"ELSET": ANY, "MATERIAL": ANY, "CONTROLS": ANY}, ("ELSET", "MATERIAL")),
    "SECTION CONTROLS": Keyword("model", {"NAME": ANY, "HOURGLASS": ("STIFFNESS", "RELAX STIFFNESS")}, ("NAME",)),
    "RIGID BODY": Keyword(
        "model", {"REF NODE": ANY, "TIE NSET": ANY, "PIN NSET": ANY, "ANALYTICAL SURFACE": ANY}, ("REF NODE",)
    ),
    "AMPLITUDE": Keyword(
        "both",
        {
            "NAME": ANY,
            "DEFINITION": ("TABULAR", "SMOOTH STEP"),
            "TIME": ("STEP TIME", "TOTAL TIME"),
            "VALUE": ("RELATIVE", "ABSOLUTE"),
            "SCALEX": ANY,
            "SCALEY": ANY,
        },
        ("NAME",),
    ),
    "INITIAL CONDITIONS": Keyword("model", {"TYPE": ("TEMPERATURE", "VELOCITY", "ROTATING VELOCITY")}, ("TYPE",)),
    "SURFACE INTERACTION": Keyword("model", {"NAME": ANY}, ("NAME",)),
    "SURFACE BEHAVIOR": Keyword("model", {"PRESSURE-OVERCLOSURE": ("HARD",)}),
    "FRICTION": Keyword("model", {"USER": ("FRIC",), "DEPVAR": ANY, "PROPERTIES": ANY}),
    "BOUNDARY": Keyword("both", {"TYPE": ("DISPLACEMENT", "VELOCITY"), "AMPLITUDE": ANY, "OP": ("MOD", "NEW")}),
    "STEP": Keyword("step", {"NAME": ANY, "NLGEOM": ("YES",)}),
    "DYNAMIC": Keyword(
        "step",
        {"EXPLICIT": ANY, "DIRECT USER CONTROL": ANY, "ELEMENT BY ELEMENT": ANY, "SCALE FACTOR": ANY},
        ("EXPLICIT",),
    ),
    "BULK VISCOSITY": Keyword("step", {}),
    "FIXED MASS SCALING": Keyword("step", {"FACTOR": ANY, "DT": ANY, "TYPE": ("BELOW MIN", "UNIFORM"), "ELSET": ANY}),
    "CLOAD": Keyword("step", {"AMPLITUDE": ANY, "OP": ("MOD", "NEW")}),
    "DLOAD": Keyword("step", {"AMPLITUDE": ANY, "OP": ("MOD", "NEW")}),
    "DSLOAD": Keyword("step", {"AMPLITUDE": ANY, "OP": ("MOD", "NEW")}),
    "CONTACT PAIR": Keyword(
        "step",
        {"INTERACTION": ANY, "MECHANICAL CONSTRAINT": ("KINEMATIC",), "CPSET": ANY, "OP": ("ADD",)},
        ("INTERACTION",),
    ),
    "OUTPUT": Keyword(
        "step",
        {
            "HISTORY": ANY,
            "FIELD": ANY,
            "TIME INTERVAL": ANY,
            "NUMBER INTERVAL": ANY,
            "TIME MARKS": ANY,
            "VARIABLE": ANY,
            "NAME": ANY,
        },
    ),
    "NODE OUTPUT": Keyword("step", {"NSET": ANY, "VARIABLE": ANY}),
    "ELEMENT OUTPUT": Keyword("step", {"ELSET": ANY, "VARIABLE": ANY, "DIRECTIONS": ("YES", "NO")}),
    "CONTACT OUTPUT": Keyword("step", {"CPSET": ANY, "VARIABLE": ANY, "SURFACE": ANY, "SECOND SURFACE": ANY}),
    "ENERGY OUTPUT": Keyword("step", {"ELSET": ANY, "VARIABLE": ANY}),
    "RESTART": Keyword("step", {"WRITE": ANY, "NUMBER INTERVAL": ANY, "TIME MARKS": ANY}, ("WRITE",)),
    "END STEP": Keyword("step", {}),
}


def check_subset(deck: Deck) -> None:
    """Stop at the first keyword, parameter or value that the engine does not run.

    Raises
    ------
    InputError
        With file and line.
    """
    inside = False
    for block in deck.blocks:
        if block.keyword == "STEP":
            if inside:
                raise InputError(f"{block.where}: *STEP", "a step inside a step", "*END STEP first")
            inside = True
        check_block(block, inside)
        if block.keyword == "END STEP":
            inside = False
    if inside:
        raise InputError(f"{deck.path.name}", "no *END STEP", "every step closed")


def check_block(block: KeywordBlock, inside_step: bool) -> None:
    """Check one block against the table."""
    where = f"{block.where}: *{block.keyword}"
    rule = SUBSET.get(block.keyword)
    if rule is None:
        raise InputError(where, "a keyword outside the engine's subset", "one of those in docs/fe_engine.md")
    if rule.level != "both" and (rule.level == "step") != inside_step:
        raise InputError(where, "inside a step" if inside_step else "outside a step", f"{rule.level} data")
    for name in rule.required:
        if name not in block.parameters:
            raise InputError(where, f"no parameter {name}", f"{name}=...")
    for name, value in block.parameters.items():
        if name not in rule.parameters:
            known = ", ".join(rule.parameters) or "none"
            raise InputError(where, f"parameter {name}", f"a parameter the engine runs ({known})")
        accepted = rule.parameters[name]
        if accepted and value is not None and value not in accepted:
            raise InputError(f"{where}, {name}", value, " or ".join(accepted))
