"""Reading YAML safely: no tags, no aliases, no key twice."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from .errors import InputError


class _SafeLoader(yaml.SafeLoader):
    """Safe YAML that refuses a key given twice."""


def _mapping_without_duplicates(loader: _SafeLoader, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
    seen: set[Any] = set()
    for key_node, _ in node.value:
        key = loader.construct_object(key_node, deep=True)
        try:
            twice = key in seen
            seen.add(key)
        except TypeError:
            raise yaml.constructor.ConstructorError(
                None, None, "a key that is not plain text", key_node.start_mark
            ) from None
        if twice:
            raise yaml.constructor.ConstructorError(None, None, f"key {key} given twice", key_node.start_mark)
    return yaml.SafeLoader.construct_mapping(loader, node, deep)


_SafeLoader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping_without_duplicates)


def load_yaml(text: str, source: Path | str) -> Any:
    """Load one YAML document safely; a syntax fault is an `InputError` with its line."""
    if text.count("&") and "*" in text and any(token in text for token in ("<<:", ": *", "- *", ", *", "[*")):
        raise InputError(source, "YAML aliases", "values written out")
    try:
        return yaml.load(text, Loader=_SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"{source}:{mark.line + 1}" if mark is not None else str(source)
        problem = getattr(error, "problem", None) or str(error)
        raise InputError(where, problem, "well-formed YAML") from None
    except (ValueError, RecursionError) as error:
        raise InputError(source, f"{type(error).__name__}: {error}", "well-formed YAML") from None
