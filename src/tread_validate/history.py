"""The force history of one block pass, and its CSV form."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from .errors import InputError, one_line
from .files import read_text, write_text
from .provenance import sha256_text

COLUMNS = ("time_s", "normal_force_N", "tangential_force_N", "slipping_fraction")


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
        Force of the road on the block, positive towards the leading edge (-x).
    slipping_fraction : (n,) array, 0..1
        Share of the touching area that slips.
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

    def write_csv(self, path: Path | str) -> None:
        """Write the history with its provenance in ``# key: value`` lines, atomically."""
        write_text(path, self.to_csv())

    def digest(self) -> str:
        """Return the SHA-256 of the numbers alone: another commit or date in the provenance does not change it."""
        rows = [line for line in self.to_csv().splitlines() if not line.startswith("#")]
        return sha256_text("\n".join(rows))

    def to_csv(self) -> str:
        """Return the CSV text (time to 1 ns, forces to 10 µN)."""
        head = "".join(f"# {one_line(str(k))}: {one_line(str(v))}\n" for k, v in self.provenance.items())
        rows = io.StringIO()
        np.savetxt(
            rows,
            np.column_stack([self.time, self.normal_force, self.tangential_force, self.slipping_fraction]) + 0.0,
            fmt=["%.9f", "%.5f", "%.5f", "%.5f"],
            delimiter=",",
        )
        return head + ",".join(COLUMNS) + "\n" + rows.getvalue().replace("-0.00000", "0.00000")

    @classmethod
    def read_csv(cls, path: Path | str) -> History:
        """Read a history; raises `InputError` for a wrong header, a non-number or unsorted times."""
        lines = read_text(path).splitlines()
        provenance: dict[str, str] = {}
        start = 0
        while start < len(lines) and lines[start].startswith("#"):
            key, _, value = lines[start][1:].partition(":")
            provenance[key.strip()] = value.strip()
            start += 1
        header = tuple(name.strip() for name in lines[start].split(",")) if start < len(lines) else ()
        if header != COLUMNS:
            raise InputError(f"{path}:{start + 1}", ",".join(header) or "no header", "header " + ",".join(COLUMNS))
        for number, line in enumerate(lines[start + 1 :], start + 2):
            if line.count(",") != len(COLUMNS) - 1:
                raise InputError(f"{path}:{number}", line, "four numbers")
        try:
            table = pd.read_csv(io.StringIO("\n".join(lines[start:])), dtype=np.float64)
        except (ValueError, pd.errors.ParserError) as error:
            raise InputError(path, error, "numbers only below the header") from None
        time, normal, tangential, slipping = (table[name].to_numpy(dtype=np.float64) for name in COLUMNS)
        try:
            return cls(time, normal, tangential, slipping, provenance)
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
        if not np.all(np.isfinite(values)):
            row = int(np.argmin(np.isfinite(values)))
            raise InputError(f"{where}: {name}, sample {row + 1}", values[row], "a finite number")
    steps = np.diff(history.time)
    if not np.all(steps > 0):
        row = int(np.argmax(steps <= 0)) + 1
        raise InputError(f"{where}: time, sample {row + 1}", history.time[row], "a time after the one before")
