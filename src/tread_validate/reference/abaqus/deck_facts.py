"""What a deck says about the run that it asks for: enough to hold a result against it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...files import read_text
from ...inp import Deck, problem_of, read_deck
from ...inp.symmetry import whole
from ...provenance import sha256_file


@dataclass(frozen=True)
class DeckFacts:
    """Identity and scale of a deck.

    Attributes
    ----------
    case_id : str
        From ``*HEADING``.
    durations : tuple of float, s
        Of the steps; the last one is the pass.
    plan_area : float, mm2
        Bounding rectangle of the elements' nodes in the x-z plane.
    modulus : float, MPa
        Of the first ``*ELASTIC`` line.
    digest, deck_sha256, user_sha256 : str
        Binding of a result to this deck; the last is empty without a user routine.
    whole : float
        Factor from the forces of the deck to those of the block: 2 where the deck models half of it.
    """

    case_id: str
    durations: tuple[float, ...]
    plan_area: float
    modulus: float
    digest: str
    deck_sha256: str
    user_sha256: str
    whole: float = 1.0

    @property
    def pass_duration(self) -> float:
        """Length of the pass, s."""
        return self.durations[-1]

    @property
    def lead_in(self) -> float:
        """Time of all steps before the pass, s."""
        return float(sum(self.durations[:-1]))


def deck_facts(deck: Path | str, user: Path | str | None = None) -> DeckFacts:
    """Read what is needed of a deck and its friction routine.

    Raises
    ------
    InputError
        A deck without heading, steps, elastic modulus or elements.
    """
    model = read_deck(deck)
    return DeckFacts(
        case_id=_heading(model),
        durations=_durations(model),
        plan_area=_plan_area(model),
        modulus=_modulus(model),
        digest=problem_of(model, None if user is None else read_text(user)).digest,
        deck_sha256=sha256_file(deck),
        user_sha256="" if user is None else sha256_file(user),
        whole=whole(model),
    )


def _heading(model: Deck) -> str:
    for block in model.named("HEADING"):
        if block.data:
            return block.data[0].text.strip()
    raise InputError(model.path, "no *HEADING line", "the case id in *HEADING")


def _durations(model: Deck) -> tuple[float, ...]:
    found = [block.data[0].number_at(1, "a step duration") for block in model.named("DYNAMIC") if block.data]
    if not found or min(found) <= 0.0:
        raise InputError(model.path, "no *DYNAMIC step of a positive duration", "the steps of a pass")
    return tuple(found)


def _modulus(model: Deck) -> float:
    for block in model.named("ELASTIC"):
        if block.data:
            return block.data[0].number_at(0, "a modulus")
    raise InputError(model.path, "no *ELASTIC", "the compound's modulus")


def _plan_area(model: Deck) -> float:
    used: set[int] = set()
    for block in model.named("ELEMENT"):
        for line in block.data:
            used.update(int(word) for word in line.fields[1:] if word.isdigit())
    places = [
        (line.number_at(1, "x"), line.number_at(3, "z", 0.0))
        for block in model.named("NODE")
        for line in block.data
        if line.fields[0].isdigit() and int(line.fields[0]) in used
    ]
    if not places:
        raise InputError(model.path, "no nodes of elements", "*NODE and *ELEMENT")
    spans = np.ptp(np.array(places), axis=0)
    return float(spans[0] * spans[1])
