"""`tread-validate file-references`: put finished FE runs into the reference store."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    histories: Annotated[list[Path] | None, typer.Argument(help="histories with their records beside them")] = None,
    engine: Annotated[str, typer.Option("--engine", help="whose runs they are")] = "embedded",
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
    convergence: Annotated[
        Path | None, typer.Option("--convergence", help="folder with rig.yaml and belt.yaml of the mesh study")
    ] = None,
) -> None:
    """File runs under reference_data/fe/<engine>/, each with its record and the mesh error that remains.

    Example: tread-validate file-references results/fe/embedded/*.csv --convergence reference_data/fe/mesh
    """
    import pandas as pd

    from ..compare.scores.energy import energy_shares
    from ..errors import InputError
    from ..files import write_bytes
    from ..provenance import sha256_file
    from ..reference import fe_path
    from ..yaml_text import read_mapping, write_yaml

    errors = {}
    for kind in ("rig", "belt") if convergence is not None else ():
        errors[kind] = read_mapping(Path(str(convergence)) / f"{kind}.yaml")
    filed = 0
    for history in histories or []:
        record_file = history.with_suffix(".yaml")
        record = read_mapping(record_file)
        digest = sha256_file(history)
        if record.get("history_sha256") != digest:
            raise InputError(record_file, "another checksum", f"history_sha256 {digest[:12]}... of {history.name}")
        case_id = history.stem
        record["case_id"] = case_id
        study = errors.get(case_id.partition("-")[0])
        if study is not None:
            record["mesh_error"] = study["mesh_error"]
            record["mesh_error_from"] = f"three meshes of {study['case_id']}, {study['method']}"
        energies = history.with_name(f"{history.stem}_energies.csv")
        if energies.is_file():
            record["energy"] = energy_shares(pd.read_csv(energies))
        target = fe_path(references, engine, case_id)
        face = history.with_name(f"{history.stem}_face.csv")
        if face.is_file():
            write_bytes(target.with_name(f"{case_id}_face.csv"), face.read_bytes())
        write_bytes(target, history.read_bytes())
        write_yaml(target.with_suffix(".yaml"), record)
        filed += 1
    typer.echo(f"{filed} runs of engine {engine} filed under {references / 'fe' / engine}")
