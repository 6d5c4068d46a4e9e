"""What the tables were made from."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from ..provenance import commit, sha256_file, version
from ..reference import ENGINE_PARTS
from ..source_code import code_digest
from ..spring.variants import code_digest as variant_code
from ..study import Case, LoadedStudy
from .regression.coefficients import SPEEDS_ASSUMED, ZERO_ASSUMED
from .regression.line import REFERENCE_TEMPERATURE
from .runs import Runs
from .tables import AssumedRow

PACKAGES = ("numpy", "scipy", "numba", "pandas", "pydantic", "objective-rating-metrics", "frictionless")


def provenance(
    study: LoadedStudy, cases: Sequence[Case], runs: Runs, sources: Sequence[str], reference_dir: Path
) -> dict[str, Any]:
    """Return commit, versions, input digests and the state of every source; nothing that changes from run to run."""
    files = {study.source, *(path for case in cases for path in case.input_files())}
    files |= {reference_dir / "datapackage.yaml", reference_dir / "published" / "published.csv"}
    return {
        "commit": commit(),
        "version": version(),
        "study": study.model.name,
        "study_digest": study.digest,
        "code": {
            "compare": code_digest("compare"),
            **{f"fe:{engine}": code_digest(part) for engine, part in ENGINE_PARTS.items()},
            **{f"spring:{variant}": variant_code(variant) for variant in study.model.spring.variants},
        },
        "packages": {name: metadata.version(name) for name in PACKAGES},
        "inputs": {_shown(path, study.root): sha256_file(path) for path in sorted(files) if path.is_file()},
        "sources": {
            source: dict(sorted(Counter(run.status for (name, _), run in runs.items() if name == source).items()))
            for source in sources
        },
    }


def assumed_inputs(cases: Sequence[Case]) -> list[AssumedRow]:
    """Return every assumed or synthetic input with the number of cases that depend on it."""
    found: dict[tuple[str, str], tuple[str, int]] = {}
    for case in cases:
        for name, item in (
            (f"compound {case.compound_name}", case.compound),
            (f"friction law {case.friction_name}", case.friction),
            (f"block {case.block_name}", case.block),
            (f"path {case.path_name}", case.path),
        ):
            if item.origin in ("assumed", "synthetic"):
                source, count = found.get((name, item.origin), (item.source, 0))
                found[name, item.origin] = (source, count + 1)
    rows = [AssumedRow(name, origin, source, count) for (name, origin), (source, count) in found.items()]
    rig = sum(case.path.gives_coefficients for case in cases)
    if rig:
        zero = f"{REFERENCE_TEMPERATURE:g} degC; the paper does not print it"
        speeds = "the paper prints the lowest, the highest and one other speed of the rig"
        rows += [
            AssumedRow(ZERO_ASSUMED.removesuffix(" (assumed)"), "assumed", zero, rig),
            AssumedRow(SPEEDS_ASSUMED.removesuffix(" (assumed)"), "assumed", speeds, rig),
        ]
    return rows


def _shown(path: Path, root: Path) -> str:
    try:
        return Path(os.path.abspath(path)).relative_to(os.path.abspath(root)).as_posix()
    except ValueError:
        return path.name
