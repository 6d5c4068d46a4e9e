"""The study file's reference as a page, generated from the models' JSON schema."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from .schema import study_schema

Schema = Mapping[str, Any]
TOP = "study file"


def study_reference() -> str:
    """Return a Markdown page: every section of a study file, every key with type, range, default and meaning."""
    schema = json.loads(study_schema())
    definitions: dict[str, Schema] = schema["$defs"]
    lines = [
        "# The study file",
        "",
        "Generated from the models that validate a study; `tread-validate schema` writes the same as a JSON schema,",
        "for editors that complete and check YAML. A key that is not listed is refused. Units are in the keys.",
        "",
    ]
    lines += _section(TOP, schema, definitions)
    for name in _reachable(schema, definitions):
        lines += _section(name, definitions[name], definitions)
    return "\n".join(lines).rstrip() + "\n"


def _section(name: str, schema: Schema, definitions: Mapping[str, Schema]) -> list[str]:
    title = "Top level" if name == TOP else f"`{name}`"
    lines = [f"## {title}", ""]
    if name != TOP and schema.get("description"):
        lines += [_plain(schema["description"]), ""]
    if "properties" not in schema:
        return [*lines, _type(schema), ""]
    required = set(schema.get("required", ()))
    lines += ["| Key | Type | Default | Meaning |", "|---|---|---|---|"]
    for key, item in schema["properties"].items():
        default = "required" if key in required else _default(item.get("default"))
        lines.append(f"| `{key}` | {_type(item)} | {default} | {_plain(item.get('description', ''))} |")
    return [*lines, ""]


def _reachable(schema: Schema, definitions: Mapping[str, Schema]) -> list[str]:
    """Return the names of the definitions with keys of their own, in the order in which a reader meets them."""
    found: list[str] = []

    def visit(item: Any) -> None:
        if isinstance(item, Mapping):
            reference = str(item.get("$ref", "")).removeprefix("#/$defs/")
            if reference and reference not in found:
                found.append(reference)
                visit(definitions[reference])
            for key, value in item.items():
                if key not in ("$defs", "discriminator"):
                    visit(value)
        elif isinstance(item, list):
            for value in item:
                visit(value)

    visit({key: value for key, value in schema.items() if key != "$defs"})
    return [name for name in found if "properties" in definitions[name]]


def _type(item: Schema) -> str:
    if "$ref" in item:
        name = item["$ref"].removeprefix("#/$defs/")
        return f"[{name}](#{name.lower()})"
    for key in ("anyOf", "oneOf"):
        if key in item:
            return " or ".join(dict.fromkeys(_type(part) for part in item[key]))
    if "const" in item:
        return f"`{item['const']}`"
    if "enum" in item:
        return ", ".join(f"`{value}`" for value in item["enum"])
    kind = item.get("type", "any")
    if kind == "array":
        if "prefixItems" in item:
            return "[" + ", ".join(_type(part) for part in item["prefixItems"]) + "]"
        return f"list of {_type(item.get('items', {}))}{_count(item)}"
    if kind == "object":
        inner: Any = item.get("additionalProperties") or next(iter(item.get("patternProperties", {}).values()), {})
        return f"mapping of name to {_type(inner)}" if isinstance(inner, Mapping) and inner else "mapping"
    if kind == "null":
        return "left out"
    words = {"number": "number", "integer": "whole number", "string": "text", "boolean": "true or false"}
    return words.get(str(kind), str(kind)) + _range(item)


def _range(item: Schema) -> str:
    signs = (("exclusiveMinimum", ">"), ("minimum", ">="), ("exclusiveMaximum", "<"), ("maximum", "<="))
    parts = [f"{sign} {item[key]:g}" for key, sign in signs if key in item]
    if "maxLength" in item:
        parts.append(f"at most {item['maxLength']} characters")
    return f" ({', '.join(parts)})" if parts else ""


def _count(item: Schema) -> str:
    return f" (at most {item['maxItems']})" if "maxItems" in item else ""


def _default(value: Any) -> str:
    """Return a default as code; that of a section with keys of its own is in that section."""
    return "its keys' own" if isinstance(value, Mapping) else f"`{json.dumps(value, ensure_ascii=False)}`"


def _plain(text: str) -> str:
    return " ".join(text.replace("|", "\\|").split())
