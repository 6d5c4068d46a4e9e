"""CalculiX as a second open engine for elastic blocks with Coulomb friction.

The pass is solved quasi-statically in the frame of the road: what CalculiX lacks (Prony series, VFRIC) is refused by
name, what a quasi-static run has no use for (mass, bulk viscosity) is dropped and listed in the record.
"""

from .engine import CalculixResult, run_deck
from .subset import ElasticDeck, read_elastic_deck
from .write import Resolution, dialect

__all__ = ["CalculixResult", "ElasticDeck", "Resolution", "dialect", "read_elastic_deck", "run_deck"]
