"""What models are compared with: published numbers, finite element runs and their records."""

from .fe_store import ENGINE_PARTS, FeStore, Reference, check_engine
from .manifest import validate_package
from .published import PublishedValue, load_published

__all__ = [
    "ENGINE_PARTS", "FeStore", "PublishedValue", "Reference", "check_engine", "load_published", "validate_package",
]  # fmt: skip
