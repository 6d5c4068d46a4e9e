"""The data package that declares every shared reference table: schema, source, licence, checksum."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import InputError, one_line
from ..yaml_text import read_yaml

DESCRIPTOR = "datapackage.yaml"
SOURCED = ("origin", "license", "sources", "uncertainty")


def load_descriptor(folder: Path | str) -> dict[str, Any]:
    """Read ``datapackage.yaml``; raises `InputError` where it is no mapping with a list of resources."""
    source = Path(folder) / DESCRIPTOR
    data = read_yaml(source)
    if not isinstance(data, dict) or not isinstance(data.get("resources"), list) or not data["resources"]:
        raise InputError(f"{source}: resources", "nothing", "a list of at least one resource")
    for index, resource in enumerate(data["resources"]):
        where = f"{source}: resources[{index}]"
        if not isinstance(resource, dict) or not isinstance(resource.get("path"), str):
            raise InputError(where, "no path", "a mapping with a path below this folder")
        if "://" in resource["path"]:
            raise InputError(f"{where}.path", one_line(resource["path"], 80), "a file below this folder")
        for key in SOURCED:
            if not resource.get(key):
                raise InputError(f"{where}.{key}", "nothing", "what this reference is and how far it can be trusted")
        if "hash" not in resource:
            raise InputError(f"{where}.hash", "nothing", "sha256:... of the file")
    return data


def validate_package(folder: Path | str) -> tuple[str, ...]:
    """Validate every resource against its schema and checksum, offline; return the resources' names.

    Raises `InputError` for the first fault, with file, row and field. Works by Frictionless Data Package v1
    (https://specs.frictionlessdata.io/data-package/).
    """
    from frictionless import FrictionlessException, Package

    base = Path(folder)
    descriptor = load_descriptor(base)
    for resource in descriptor["resources"]:
        if not (base / resource["path"]).is_file():
            raise InputError(base / resource["path"], "no such file", f"the file that {DESCRIPTOR} declares")
    try:
        package = Package.from_descriptor(descriptor, basepath=str(base))
        report = package.validate()
    except FrictionlessException as error:
        raise InputError(base / DESCRIPTOR, one_line(str(error)), "a valid data package") from None
    if report.errors:
        raise InputError(base / DESCRIPTOR, one_line(report.errors[0].message), "a valid data package")
    for task in report.tasks:
        # a wrong cell also changes the checksum: name the cell first
        faults = sorted(task.errors, key=lambda item: item.type in ("hash-count", "byte-count"))
        for fault in faults:
            place = base / str(task.place or task.name)
            row = getattr(fault, "row_number", None)
            field = getattr(fault, "field_name", None)
            where = f"{place}" + (f":{row}" if row else "") + (f": {field}" if field else "")
            raise InputError(where, one_line(fault.message, 240), "data as the schema and checksum declare")
    return tuple(str(resource["name"]) for resource in descriptor["resources"])
