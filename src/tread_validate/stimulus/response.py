"""The response of a belt or hub to the patch force: convolution with a measured or computed transfer path."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..columns import read_columns
from ..errors import InputError
from .piecewise import transform
from .stimulus import Stimulus

IMPULSE_COLUMNS = ("time_s", "to_normal", "to_tangential")
TRANSFER_COLUMNS = ("frequency_Hz", "to_normal_real", "to_normal_imag", "to_tangential_real", "to_tangential_imag")
OPEN_END = 0.01


@dataclass(frozen=True)
class TransferFunction:
    """Response per unit force against frequency, one path for each force component.

    Attributes
    ----------
    quantity, unit : str
        Of the response; the function itself is in `unit` per N.
    time, to_normal, to_tangential
        For an impulse response: samples (s; unit per N s), linear between them. None where measured over frequency.
    frequency, normal_ratio, tangential_ratio
        For a frequency response: lines (Hz; complex, unit per N). None for an impulse response.
    """

    quantity: str
    unit: str
    time: NDArray[np.float64] | None = None
    to_normal: NDArray[np.float64] | None = None
    to_tangential: NDArray[np.float64] | None = None
    frequency: NDArray[np.float64] | None = None
    normal_ratio: NDArray[np.complex128] | None = None
    tangential_ratio: NDArray[np.complex128] | None = None

    def at(self, frequency: NDArray[np.float64]) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Return the complex ratios to normal and tangential force at frequencies in Hz."""
        if self.time is not None and self.to_normal is not None and self.to_tangential is not None:
            w = 2.0 * np.pi * frequency
            return transform(self.time, self.to_normal, w), transform(self.time, self.to_tangential, w)
        assert self.frequency is not None
        assert self.normal_ratio is not None
        assert self.tangential_ratio is not None
        ratios = [
            np.interp(frequency, self.frequency, ratio.real) + 1j * np.interp(frequency, self.frequency, ratio.imag)
            for ratio in (self.normal_ratio, self.tangential_ratio)
        ]
        for ratio in ratios:
            ratio[(frequency < self.frequency[0]) | (frequency > self.frequency[-1])] = 0.0
        return ratios[0], ratios[1]


@dataclass(frozen=True)
class Response:
    """The periodic response.

    Attributes
    ----------
    quantity, unit : str
    time, value : (n,) arrays, s and `unit`
    frequency, lines : (m,) arrays, Hz and complex `unit`
        Fourier coefficients, as in `Stimulus`.
    lowest_frequency, highest_frequency : float, Hz
        What the transfer function covers; lines outside are left out of `value` too.
    """

    quantity: str
    unit: str
    time: NDArray[np.float64]
    value: NDArray[np.float64]
    frequency: NDArray[np.float64]
    lines: NDArray[np.complex128]
    lowest_frequency: float
    highest_frequency: float


def respond(stimulus: Stimulus, function: TransferFunction) -> Response:
    """Convolve the patch force with a transfer path.

    The force is periodic, so the convolution is a product line by line: R_n = H_N(f_n) N_n + H_T(f_n) T_n. The lines
    are those of the stimulus (up to its highest frequency) and the time signal is their sum.

    Raises
    ------
    InputError
        A frequency response that ends below the stimulus's highest line.
    """
    lowest, highest = 0.0, float(stimulus.frequency[-1])
    if function.frequency is not None:
        lowest = float(function.frequency[0])
        if function.frequency[-1] < highest:
            raise InputError(
                "transfer function: frequency_Hz", f"{function.frequency[-1]:g} Hz at most", f"at least {highest:g} Hz"
            )
    to_normal, to_tangential = function.at(stimulus.frequency)
    lines = to_normal * stimulus.normal_lines + to_tangential * stimulus.tangential_lines
    samples = stimulus.time.size
    spectrum = np.zeros(samples // 2 + 1, dtype=np.complex128)
    kept = min(lines.size, (samples + 1) // 2)
    spectrum[:kept] = lines[:kept] * samples
    value = np.fft.irfft(spectrum, samples)
    return Response(function.quantity, function.unit, stimulus.time, value, stimulus.frequency, lines, lowest, highest)


def read_impulse_response(path: Path | str) -> TransferFunction:
    """Read an impulse response: CSV ``time_s,to_normal,to_tangential``, in response unit per N s.

    Lines that begin with ``#`` before the header may give ``quantity`` and ``unit`` of the response. Times start at 0
    or later and the response must have died away at the end (1 % of its peak): a cut one would ring falsely.
    """
    table, notes = _read(path, IMPULSE_COLUMNS)
    time = table[:, 0]
    if time[0] < 0.0:
        raise InputError(f"{path}: time_s", time[0], "no response before the impulse at 0 s")
    for column in (1, 2):
        peak = float(np.max(np.abs(table[:, column])))
        if abs(table[-1, column]) > OPEN_END * peak:
            raise InputError(
                f"{path}: {IMPULSE_COLUMNS[column]}, last sample",
                f"{table[-1, column]:.4g}",
                f"a response that has died away (at most {OPEN_END:.0%} of its peak, {peak:.4g})",
            )
    return TransferFunction(*notes, time=time, to_normal=table[:, 1], to_tangential=table[:, 2])


def read_transfer_function(path: Path | str) -> TransferFunction:
    """Read a frequency response: CSV with real and imaginary parts to each force, in response unit per N.

    The columns are ``frequency_Hz,to_normal_real,to_normal_imag,to_tangential_real,to_tangential_imag``.
    """
    table, notes = _read(path, TRANSFER_COLUMNS)
    if table[0, 0] < 0.0:
        raise InputError(f"{path}: frequency_Hz", table[0, 0], "frequencies of 0 Hz or more")
    return TransferFunction(
        *notes,
        frequency=table[:, 0],
        normal_ratio=table[:, 1] + 1j * table[:, 2],
        tangential_ratio=table[:, 3] + 1j * table[:, 4],
    )


def _read(path: Path | str, columns: tuple[str, ...]) -> tuple[NDArray[np.float64], tuple[str, str]]:
    """Return the table and (quantity, unit)."""
    read = read_columns(path, columns)
    table = np.column_stack([read[name] for name in columns])
    if table.shape[0] < 2:
        raise InputError(path, f"{table.shape[0]} row(s)", f"at least 2 rows of {len(columns)} numbers")
    if not np.all(np.diff(table[:, 0]) > 0):
        row = int(np.argmax(np.diff(table[:, 0]) <= 0)) + 1
        raise InputError(f"{read.where(row)}: {columns[0]}", table[row, 0], "a value above the one before")
    return table, (read.comments.get("quantity", "response"), read.comments.get("unit", "1"))
