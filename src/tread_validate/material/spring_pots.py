"""Spring-pots in series and in parallel: the fractional solids of the literature in one form.

Koeller, J. Appl. Mech. 51 (1984) 299-307, doi:10.1115/1.3167616.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .exact import power, quarter_turn_part


def spring_pots(
    angular_frequency: ArrayLike, reference: float, branches: Sequence[Sequence[tuple[float, float]]]
) -> NDArray[np.complex128]:
    """Return E*(w) = sum over branches of 1/(sum of 1/(E (i w/w_ref)^a)), complex, in the unit of the moduli.

    `angular_frequency` and `reference` in rad/s, > 0; a branch is a series of (E, a), E > 0 at the reference frequency
    and a in 0..1 (0 is a spring, 1 a dashpot).
    """
    ratio = np.asarray(angular_frequency, dtype=np.float64) / reference
    total = np.zeros(ratio.shape, dtype=np.complex128)
    for branch in branches:
        compliance = np.zeros(ratio.shape, dtype=np.complex128)
        for modulus, exponent in branch:
            cosine, sine = quarter_turn_part(exponent)
            size = 1.0 / (modulus * power(ratio, exponent))
            compliance.real += size * cosine
            compliance.imag -= size * sine
        square = compliance.real * compliance.real + compliance.imag * compliance.imag
        total.real += compliance.real / square
        total.imag -= compliance.imag / square
    return total
