"""The order of blocks and gaps round the tyre, rib by rib."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from ..fields import Name, NonNegative, Positive, Sourced, Strict
from ..model_file import read_model
from ..units import MM

MOST_BLOCKS = 5_000
CLOSURE = 1e-9  # relative: ribs of one tyre have one circumference


class Pitch(Strict):
    """One kind of pitch: a block and the gap behind it."""

    block_mm: Positive = Field(description="block length in the rolling direction, mm")
    gap_mm: NonNegative = Field(description="gap between this block and the next, mm")


class Rib(Strict):
    """One row of blocks round the tyre."""

    name: Name
    sequence: Annotated[tuple[Name, ...], Field(min_length=1)] = Field(description="pitch names in order of contact")
    repeat: Annotated[int, Field(ge=1, le=MOST_BLOCKS)] = Field(1, description="how often the sequence runs round")
    offset_mm: NonNegative = Field(0.0, description="how much later, in mm of belt, this rib's first block touches")
    width_mm: Positive | None = Field(None, description="width of the rib's blocks; the study's block where left out")


@dataclass(frozen=True)
class RibBlocks:
    """Blocks of one size on one rib, and where on the circumference their leading ends are.

    Attributes
    ----------
    rib : str
    block_length : float, m
    block_width : float or None, m
        None: as in the study.
    positions : tuple of float, m
        Arc from the tyre's mark to the leading end, against the travel: the block touches at position / V.
    """

    rib: str
    block_length: float
    block_width: float | None
    positions: tuple[float, ...]


class PitchSequence(Sourced):
    """The pitch sequence of a whole tyre."""

    schema_version: Literal[1]
    name: Name
    pitches: Annotated[dict[Name, Pitch], Field(min_length=1)]
    ribs: Annotated[tuple[Rib, ...], Field(min_length=1, max_length=20)]

    @model_validator(mode="after")
    def _closes(self) -> Self:
        if len({rib.name for rib in self.ribs}) < len(self.ribs):
            raise ValueError("ribs: got one name twice, expected a name of its own for each rib")
        for index, rib in enumerate(self.ribs):
            for name in rib.sequence:
                if name not in self.pitches:
                    raise ValueError(
                        f"ribs[{index}].sequence: got {name}, expected one of {', '.join(sorted(self.pitches))}"
                    )
            if len(rib.sequence) * rib.repeat > MOST_BLOCKS:
                raise ValueError(
                    f"ribs[{index}]: got {len(rib.sequence) * rib.repeat} blocks, expected at most {MOST_BLOCKS}"
                )
        first = self._rib_length(self.ribs[0])
        for index, rib in enumerate(self.ribs):
            length = self._rib_length(rib)
            if abs(length - first) > CLOSURE * first:
                raise ValueError(
                    f"ribs[{index}]: got {length:.9g} mm round the tyre, expected {first:.9g} mm as the first rib"
                )
        return self

    def _rib_length(self, rib: Rib) -> float:
        return rib.repeat * sum(self.pitches[name].block_mm + self.pitches[name].gap_mm for name in rib.sequence)

    @property
    def circumference(self) -> float:
        """Belt length round the tyre, m."""
        return self._rib_length(self.ribs[0]) * MM

    def blocks_on(self, rib: Rib) -> int:
        """Return the number of blocks on a rib."""
        return rib.repeat * len(rib.sequence)

    def placements(self) -> tuple[RibBlocks, ...]:
        """Return every block of every rib, those of one size together."""
        placed: list[RibBlocks] = []
        for rib in self.ribs:
            by_length: dict[float, list[float]] = {}
            position = rib.offset_mm
            for name in rib.sequence * rib.repeat:
                pitch = self.pitches[name]
                by_length.setdefault(pitch.block_mm, []).append(position * MM)
                position += pitch.block_mm + pitch.gap_mm
            width = None if rib.width_mm is None else rib.width_mm * MM
            placed += [RibBlocks(rib.name, length * MM, width, tuple(at)) for length, at in by_length.items()]
        return tuple(placed)


def load_pitch_sequence(path: Path | str) -> PitchSequence:
    """Read a pitch sequence (YAML); every fault is one `InputError` line with the key that is wrong."""
    return read_model(path, PitchSequence)
