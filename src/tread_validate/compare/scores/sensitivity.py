"""How much each score hangs on window and sampling, measured on one pair of real histories."""

from __future__ import annotations

from collections.abc import Iterator

from ...history import History
from ..quantities import HISTORIES, contact_window
from ..tables import Sensitivity
from .align import SAMPLES, AlignedPair, align, window
from .iso18571 import SAMPLES as ISO_SAMPLES
from .iso18571 import iso18571
from .metrics import relative_rms, sprague_geers

FINE = (501, 8001)
ISO_LENGTHS = (101, 201, 801)
WIDER = 0.10


def sensitivity(reference: History, predicted: History, case_id: str) -> tuple[Sensitivity, ...]:
    """Return every score as it is reported and under other windows and samplings, with the change."""
    usual = window(reference, predicted)
    length = usual[1] - usual[0]
    wider = (usual[0] - WIDER * length, usual[1] + WIDER * length)
    variations: list[tuple[str, tuple[float, float], int, int]] = [
        ("as reported", usual, SAMPLES, ISO_SAMPLES),
        ("window 10 % wider at both ends", wider, SAMPLES, ISO_SAMPLES),
        ("window of the reference's contact", contact_window(reference), SAMPLES, ISO_SAMPLES),
        *((f"{n} samples", usual, n, 0) for n in FINE),
        *((f"{n} samples", usual, 0, n) for n in ISO_LENGTHS),
        ("10 kHz", usual, 0, max(21, 1 + round(1e4 * length))),
    ]
    rows: list[Sensitivity] = []
    base: dict[tuple[str, str], float] = {}
    for name, limits, fine, coarse in variations:
        for quantity in HISTORIES:
            for metric, samples, value in _scores(reference, predicted, quantity, limits, fine, coarse):
                base.setdefault((metric, quantity), value)
                change = value - base[metric, quantity]
                rows.append(Sensitivity(metric, quantity, case_id, name, samples, value, change))
    return tuple(rows)


def _scores(
    reference: History, predicted: History, quantity: str, limits: tuple[float, float], fine: int, coarse: int
) -> Iterator[tuple[str, int, float]]:
    if fine:
        pair: AlignedPair = align(reference, predicted, fine, limits)
        a, b = pair.forces(quantity)
        sprague = sprague_geers(pair.time, a, b)
        yield "relative_rms", fine, relative_rms(a, b)
        yield "sprague_geers_m", fine, sprague.magnitude
        yield "sprague_geers_p", fine, sprague.phase
        yield "sprague_geers_c", fine, sprague.comprehensive
    if coarse:
        a, b = align(reference, predicted, coarse, limits).forces(quantity)
        yield "iso18571_r", coarse, iso18571(a, b).overall
