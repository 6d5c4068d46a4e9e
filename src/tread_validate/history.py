"""The force history of one block pass, and its CSV form."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bounds import first_beyond
from .columns import read_columns
from .errors import InputError, one_line
from .files import write_text
from .provenance import sha256_text
from .units import IN_MS

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

COLUMNS = ("time_s", "normal_force_N", "tangential_force_N", "slipping_fraction")
NEEDED = COLUMNS[:2]
"""What every history has; a model that does not know the others leaves them out."""
OPTIONAL = ("tangential_force", "slipping_fraction")
FORMATS = ("%.9f", "%.5f", "%.5f", "%.5f")
CHECKSUM = "rows_sha256"
"""Key of the provenance under which a history carries the digest of its own numbers."""
MINUS_NOTHING = re.compile(r"-(0\.0+)(?=[,\n])")  # what rounds to zero has no sign; a time of -1e-6 s keeps its own


@dataclass(frozen=True)
class History:
    """Forces of the road on the block during one pass.

    Attributes
    ----------
    time : (n,) array, s
        Strictly increasing; t = 0 is when the first point of the block touches.
    normal_force : (n,) array, N
        Compression is positive.
    tangential_force : (n,) array, N
        Force of the road on the block, positive towards the leading edge (-x); nan throughout where it is not given.
    slipping_fraction : (n,) array, 0..1
        Share of the touching area that slips; nan throughout where it is not given.
    provenance : mapping of str to str
        Case id, producer, version, commit, input digests.
    """

    time: NDArray[np.float64]
    normal_force: NDArray[np.float64]
    tangential_force: NDArray[np.float64]
    slipping_fraction: NDArray[np.float64]
    provenance: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("time", "normal_force", "tangential_force", "slipping_fraction"):
            values = np.asarray(getattr(self, name), dtype=np.float64)
            values.flags.writeable = False
            object.__setattr__(self, name, values)
        check(self, "history")

    @classmethod
    def of(
        cls,
        time: ArrayLike,
        normal_force: ArrayLike,
        tangential_force: ArrayLike | None = None,
        slipping_fraction: ArrayLike | None = None,
        provenance: Mapping[str, str] | None = None,
    ) -> History:
        """Return a history of the columns that are known; the others count as not given."""
        first = np.asarray(time, dtype=np.float64)
        unknown = np.full(first.shape, np.nan)
        return cls(
            first,
            np.asarray(normal_force, dtype=np.float64),
            unknown if tangential_force is None else np.asarray(tangential_force, dtype=np.float64),
            unknown if slipping_fraction is None else np.asarray(slipping_fraction, dtype=np.float64),
            {} if provenance is None else provenance,
        )

    @property
    def gives_tangential(self) -> bool:
        """Whether the tangential force is known."""
        return not bool(np.isnan(self.tangential_force[0]))

    @property
    def gives_slip(self) -> bool:
        """Whether the slipping share is known."""
        return not bool(np.isnan(self.slipping_fraction[0]))

    def with_provenance(self, provenance: Mapping[str, str]) -> History:
        """Return the same forces with another provenance."""
        return replace(self, provenance=provenance)

    def with_checksum(self) -> History:
        """Return the same history with the digest of its numbers in its provenance."""
        return self.with_provenance({**self.provenance, CHECKSUM: self.digest()})

    def to_frame(self) -> pd.DataFrame:
        """Return the history as a data frame, with the columns that are given, units in their names."""
        import pandas as pd

        return pd.DataFrame(dict(zip(self._names(), self._columns(), strict=True)))

    def plot(self, axes: Axes | None = None, label: str | None = None) -> Axes:
        """Draw normal (solid) and tangential force (dashed) in N against time in ms; returns the axes."""
        from matplotlib import pyplot

        ax = axes if axes is not None else pyplot.subplots()[1]
        name = label if label is not None else self.provenance.get("producer", "")
        (line,) = ax.plot(IN_MS * self.time, self.normal_force, label=f"{name} N".strip())
        if self.gives_tangential:
            ax.plot(IN_MS * self.time, self.tangential_force, "--", color=line.get_color(), label=f"{name} T".strip())
        ax.set_xlabel("time, ms")
        ax.set_ylabel("force, N")
        ax.legend()
        return ax

    def __repr__(self) -> str:
        """Say whose history it is, how long and how large."""
        who = " ".join(self.provenance[key] for key in ("producer", "case_id") if key in self.provenance)
        tangential = (
            f", T {self.tangential_force.min():.4g} to {self.tangential_force.max():.4g} N"
            if self.gives_tangential
            else ", T not given"
        )
        return (
            f"<History {who + ': ' if who else ''}{self.time.size} samples to {IN_MS * self.time[-1]:.4g} ms, "
            f"peak N {self.normal_force.max():.4g} N{tangential}>"
        )

    def write_csv(self, path: Path | str) -> None:
        """Write the history with its provenance in ``# key: value`` lines, atomically."""
        write_text(path, self.to_csv())

    def digest(self) -> str:
        """Return the SHA-256 of the numbers alone: another commit or date in the provenance does not change it."""
        rows = [line for line in self.to_csv().splitlines() if not line.startswith("#")]
        return sha256_text("\n".join(rows))

    def to_csv(self) -> str:
        """Return the CSV text (time to 1 ns, forces to 10 µN) of the columns that are given."""
        head = "".join(f"# {one_line(str(k))}: {one_line(str(v))}\n" for k, v in self.provenance.items())
        names = self._names()
        rows = io.StringIO()
        formats = [form for name, form in zip(COLUMNS, FORMATS, strict=True) if name in names]
        np.savetxt(rows, np.column_stack(self._columns()) + 0.0, fmt=formats, delimiter=",")
        return head + ",".join(names) + "\n" + MINUS_NOTHING.sub(r"\1", rows.getvalue())

    def _names(self) -> tuple[str, ...]:
        given = (True, True, self.gives_tangential, self.gives_slip)
        return tuple(name for name, known in zip(COLUMNS, given, strict=True) if known)

    def _columns(self) -> list[NDArray[np.float64]]:
        columns = (self.time, self.normal_force, self.tangential_force, self.slipping_fraction)
        names = self._names()
        return [column for name, column in zip(COLUMNS, columns, strict=True) if name in names]

    @classmethod
    def read_csv(cls, path: Path | str) -> History:
        """Read a history; columns beyond the four that are known are left aside.

        Raises `InputError` for a wrong header, a row of another length, a non-number or unsorted times.
        """
        table = read_columns(path, NEEDED, COLUMNS[2:], gaps=True)
        for name, values in table.values.items():
            if not np.all(np.isfinite(values)):
                row = int(np.argmin(np.isfinite(values)))
                where = f"{path}: {name.removesuffix('_N')}, sample {row + 1}"
                raise InputError(where, values[row], "a finite number (leave out a column that is not known)")
        try:
            time, normal, tangential, slipping = (table.values.get(name) for name in COLUMNS)
            assert time is not None  # they are needed
            assert normal is not None
            return cls.of(time, normal, tangential, slipping, table.comments)
        except InputError as error:
            where = error.where.replace("history", str(path), 1)
            raise InputError(where, error.found, error.expected) from None


def check(history: History, where: str) -> None:
    """Raise `InputError` unless the four columns are finite, of one length and in order of time."""
    n = history.time.size
    if n < 2:
        raise InputError(where, f"{n} sample(s)", "at least 2 samples")
    for name in ("normal_force", "tangential_force", "slipping_fraction", "time"):
        values = getattr(history, name)
        if values.shape != (n,):
            raise InputError(f"{where}: {name}", f"shape {values.shape}", f"shape ({n},) as time has")
        if name in OPTIONAL and np.all(np.isnan(values)):
            continue
        if not np.all(np.isfinite(values)):
            row = int(np.argmin(np.isfinite(values)))
            raise InputError(f"{where}: {name}, sample {row + 1}", values[row], "a finite number")
    for name, column in zip(("time", "normal_force", "tangential_force", "slipping_fraction"), COLUMNS, strict=True):
        beyond = first_beyond(getattr(history, name), column)
        if beyond is not None:
            row, expected = beyond
            raise InputError(f"{where}: {name}, sample {row + 1}", f"{getattr(history, name)[row]:g}", expected)
    steps = np.diff(history.time)
    if not np.all(steps > 0):
        row = int(np.argmax(steps <= 0)) + 1
        raise InputError(f"{where}: time, sample {row + 1}", history.time[row], "a time after the one before")
