"""The user friction routine: one source per kind of law, its constants as properties in the deck.

The constants travel as ``PROPERTIES`` of ``*FRICTION, USER=FRIC`` and not inside the Fortran: one compiled routine
then serves every deck of the same kind of law, and a user changes a constant where the other inputs are.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from ..friction import FORMS, FrictionLaw


@dataclass(frozen=True)
class UserFriction:
    """A friction law as ABAQUS is given it.

    Attributes
    ----------
    source : str
        Fortran (fixed form) of VFRIC.
    properties : tuple of float
        Its properties, in deck units (MPa, mm/s); their meaning is in the source's comments.
    """

    source: str
    properties: tuple[float, ...]


def user_friction(law: FrictionLaw) -> UserFriction:
    """Return VFRIC and its properties for `law`."""
    return UserFriction(source(law.kind), properties(law))


def properties(law: FrictionLaw) -> tuple[float, ...]:
    """Return the properties of VFRIC for `law`: the static coefficient first, then the law's own."""
    return law.deck_properties


@cache
def source(kind: str) -> str:
    """Return the Fortran text of VFRIC for a form of law, by its name."""
    folder = files("tread_validate.deck") / "templates"
    head = (
        "c     VFRIC: friction between tread block and road.\n"
        "c     For ABAQUS/Explicit, contact pairs, kinematic, double precision.\n"
        "c     Units of the deck: mm, tonne, s, MPa, N.\n"
        f"c     Law: {kind}. Its constants are the properties in the deck.\n"
        "c     Sticks while the force that stops the slip is no more than\n"
        "c     props(1) times the normal force; else the force is mu times\n"
        "c     the normal force, and never more than what stops the slip.\n"
        "c\n"
    )
    frame = (folder / "vfric.f").read_text(encoding="utf-8")
    return head + frame + FORMS[kind].fortran
