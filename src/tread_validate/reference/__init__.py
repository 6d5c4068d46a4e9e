"""What models are compared with: published numbers, finite element runs and their records."""

from .fe_store import Reference, fe_path, load_fe, validate_store
from .manifest import validate_package
from .published import PublishedValue, load_published

__all__ = ["PublishedValue", "Reference", "fe_path", "load_fe", "load_published", "validate_package", "validate_store"]
