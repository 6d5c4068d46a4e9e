"""YAML in and out: no tags, no aliases, no key twice; keys in the order in which they were put."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from .errors import InputError
from .files import read_text, write_text

# the loader in C is an order of magnitude faster; it is for long files of numbers, as it ends the process where a
# hostile file nests too deep
_FastLoader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


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


def load_yaml(text: str, source: Path | str, fast: bool = False) -> Any:
    """Load one YAML document safely; a syntax fault is an `InputError` with its line.

    `fast` is for long files of numbers: a key given twice is not noticed there.
    """
    if text.count("&") and "*" in text and any(token in text for token in ("<<:", ": *", "- *", ", *", "[*")):
        raise InputError(source, "YAML aliases", "values written out")
    try:
        return yaml.load(text, Loader=_FastLoader if fast else _SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"{source}:{mark.line + 1}" if mark is not None else str(source)
        problem = getattr(error, "problem", None) or str(error)
        raise InputError(where, problem, "well-formed YAML") from None
    except (
        ValueError,
        TypeError,
        AttributeError,
        RecursionError,
    ) as error:  # of constructors, for values that are none
        raise InputError(source, f"{type(error).__name__}: {error}", "well-formed YAML") from None


def read_yaml(path: Path | str, fast: bool = False) -> Any:
    """Read a YAML file; every fault is an `InputError` with file and line."""
    return load_yaml(read_text(path), path, fast)


def read_mapping(path: Path | str, fast: bool = False) -> dict[str, Any]:
    """Read a YAML file that holds a mapping of keys; raises `InputError` for anything else."""
    data = read_yaml(path, fast)
    if not isinstance(data, dict):
        raise InputError(path, type(data).__name__, "a mapping of keys")
    return data


def yaml_text(data: Any) -> str:
    """Return data as YAML, keys in their order, lines of at most 110 characters."""
    return str(yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=110))


def write_yaml(path: Path | str, data: Any) -> None:
    """Write data as YAML, atomically."""
    write_text(path, yaml_text(data))
