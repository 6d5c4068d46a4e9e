"""What models are compared with: published numbers, finite element runs and their records."""

from .fe_store import Reference, check_store, fe_path, load_fe
from .manifest import validate_package
from .published import PublishedValue, load_published

__all__ = ["PublishedValue", "Reference", "check_store", "fe_path", "load_fe", "load_published", "validate_package"]
