"""Unit factors: multiply a value in the named unit to get SI, or an SI value by ``IN_...`` to get it in the unit.

Inside the package every quantity is SI, angles in rad, temperatures in degC. Decks are in mm, tonne, s, MPa, N.
"""

from __future__ import annotations

import math

MILLI, KILO, MEGA, GIGA = 1e-3, 1e3, 1e6, 1e9

MM, MS = 1e-3, 1e-3
KPA, MPA, GPA = 1e3, 1e6, 1e9
DEG = math.pi / 180.0
RPM = 2.0 * math.pi / 60.0
PERCENT = 1e-2
US = 1e-6
MEGABYTE = 1e6  # bytes

# not 1/MM and so on: a product with a whole power of ten is rounded once
IN_MM, IN_UM, IN_MS, IN_US, IN_GRAM = 1e3, 1e6, 1e3, 1e6, 1e3
IN_KPA, IN_MPA = 1e-3, 1e-6

DECK_UNITS = "mm, tonne, s, MPa, N, degC"
DECK_LENGTH = 1e3  # m -> mm
DECK_STRESS = 1e-6  # Pa -> MPa
DECK_DENSITY = 1e-12  # kg/m3 -> tonne/mm3
