"""What is compared: every quantity of a pass and every score of a pair of histories, a row each."""

from .catalogue import HEADLINE, HISTORIES, HISTORY_METRIC, HISTORY_METRICS, SCALAR, SCALARS
from .contact import Contact, contact_window
from .quantity import FORCE_TOLERANCE, ErrorType, HistoryMetric, Noise, Quantity, Scale
from .scalars import Scalars, scalars
from .statistics import Statistics, statistics
from .tolerance import Tolerance, Tolerances, tolerances

__all__ = [
    "FORCE_TOLERANCE", "HEADLINE", "HISTORIES", "HISTORY_METRIC", "HISTORY_METRICS", "SCALAR", "SCALARS", "Contact",
    "ErrorType", "HistoryMetric", "Noise", "Quantity", "Scalars", "Scale", "Statistics", "Tolerance", "Tolerances",
    "contact_window", "scalars", "statistics", "tolerances",
]  # fmt: skip
