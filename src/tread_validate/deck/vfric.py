"""The user friction routine: one source per kind of law, its constants as properties in the deck.

The constants travel as ``PROPERTIES`` of ``*FRICTION, USER=FRIC`` and not inside the Fortran: one compiled routine
then serves every deck of the same kind of law, and a user changes a constant where the other inputs are.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from ..friction import FORMS, FrictionLaw

PAIRS, GENERAL = "FRIC", "FRICTION"
"""Values of ``*FRICTION, USER=``: VFRIC for contact pairs, VFRICTION for general contact."""
STATES = {PAIRS: 1, GENERAL: 2}
"""State variables that each routine keeps (``DEPVAR``)."""


@dataclass(frozen=True)
class UserFriction:
    """A friction law as ABAQUS is given it.

    Attributes
    ----------
    source : str
        Fortran (fixed form) of VFRIC.
    properties : tuple of float
        Its properties, in deck units (MPa, mm/s); their meaning is in the source's comments.
    general_source : str
        Fortran (fixed form) of VFRICTION, for general contact; the same properties.
    """

    source: str
    properties: tuple[float, ...]
    general_source: str


def user_friction(law: FrictionLaw, mass_per_area: float = 0.0) -> UserFriction:
    """Return VFRIC and its properties for `law` and the face nodes' mass per area, t/mm2."""
    return UserFriction(source(law.kind), properties(law, mass_per_area), source(law.kind, GENERAL))


def properties(law: FrictionLaw, mass_per_area: float = 0.0) -> tuple[float, ...]:
    """Return the properties of VFRIC: the static coefficient, the law's own, and the face nodes' mass per area (t/mm2).

    With a mass of 0 the law is taken at the slip speed with which a point arrives, not at the one it is left with.
    """
    return (*law.deck_properties, mass_per_area)


@cache
def source(kind: str, contact: str = PAIRS) -> str:
    """Return the Fortran text of VFRIC (`contact` FRIC) or VFRICTION (FRICTION) for a form of law, by its name."""
    folder = files("tread_validate.deck") / "templates"
    pairs = contact == PAIRS
    name, use = ("VFRIC", "contact pairs, kinematic") if pairs else ("VFRICTION", "general contact")
    state = "statev(1,n) is 1 where slave node n" if pairs else "state(1,1,k) is 1 where contact point k"
    head = (
        f"c     {name}: friction between tread block and road.\n"
        f"c     For ABAQUS/Explicit, {use}.\n"
        f"c     Run with user={name.lower()}.f double=both (on Windows .for).\n"
        "c     Units of the deck: mm, tonne, s, MPa, N.\n"
        f"c     Law: {kind}. Its constants are the properties in the deck.\n"
        "c     A point at rest stays so while the force that stops its slip is\n"
        "c     no more than props(1) times the normal force. Else it slips: the\n"
        "c     force is mu times the normal force, mu at the pressure and the\n"
        "c     slip speed that this force leaves the point, until mu times the\n"
        "c     normal force can stop it; then it is at rest again.\n"
        "c     props(nProps) is the mass of the face nodes per area: with it\n"
        "c     fStickForce tells the slip speed that a force leaves.\n"
        f"c     {state} slips.\n"
        "c\n"
    )
    frame = (folder / ("vfric.f" if pairs else "vfriction.f")).read_text(encoding="utf-8")
    slip = (folder / "fricsl.f").read_text(encoding="utf-8")
    return head + frame + slip + FORMS[kind].fortran
