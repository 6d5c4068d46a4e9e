"""A Frictionless data package that ships with the results: every table with its columns, units and checksum."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...provenance import sha256_file
from ...yaml_text import write_yaml
from .catalogue import TABLES
from .row import TableColumn, TableRow

PACKAGE = "datapackage.yaml"


def write_package(folder: Path, study: str, commit: str) -> None:
    """Write ``datapackage.yaml`` for the tables that lie in `folder`; https://specs.frictionlessdata.io/."""
    resources = [_resource(kind, folder / f"{name}.csv") for name, kind in TABLES.items()]
    package = {
        "name": f"tread-validate-{study.replace('_', '-')}",
        "title": f"Comparison of the runs of study {study}",
        "description": f"Made by tread-validate, code {commit}. Units are SI unless a column says otherwise.",
        "resources": [resource for resource in resources if resource],
    }
    write_yaml(folder / PACKAGE, package)


def schema(kind: type[TableRow]) -> dict[str, Any]:
    """Return the table schema of a row class."""
    return {
        "fields": [_field(item, item.name in kind.key) for item in kind.columns()],
        "primaryKey": list(kind.key),
        "missingValues": [""],
    }


def _resource(kind: type[TableRow], path: Path) -> Mapping[str, Any]:
    if not path.is_file():
        return {}
    return {
        "name": kind.table.replace("_", "-"),
        "path": path.name,
        "title": kind.title,
        "profile": "tabular-data-resource",
        "format": "csv",
        "encoding": "utf-8",
        "hash": f"sha256:{sha256_file(path)}",
        "schema": schema(kind),
    }


def _field(item: TableColumn, in_key: bool) -> dict[str, Any]:
    found: dict[str, Any] = {"name": item.name, "type": "string" if item.kind == "list" else item.kind}
    found["description"] = item.description
    if item.unit:
        found["unit"] = item.unit
    if item.kind in ("number", "integer", "boolean") and not item.optional and not in_key:
        found["constraints"] = {"required": True}
    return found
