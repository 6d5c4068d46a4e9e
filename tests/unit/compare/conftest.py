"""A small study, run by the spring model, with references that are made up from another variant."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import yaml

from tread_validate.compare import build_tables
from tread_validate.history import History
from tread_validate.inp import DeckFiles
from tread_validate.provenance import sha256_file
from tread_validate.reference import FeStore
from tread_validate.reference.filing import file_run, read_run
from tread_validate.source_code import code_digest
from tread_validate.spring import resolve_creep, run
from tread_validate.spring.summary import summary_csv, summary_row
from tread_validate.study import load_study

ROOT = Path(__file__).resolve().parents[3]
SMALL = {"interference_mm": [0.1, 0.2], "speed_rpm": [150.0, 300.0, 600.0]}


@dataclass(frozen=True)
class Workspace:
    """A folder with a study, its spring runs, made-up references and the tables made from them."""

    folder: Path

    @property
    def study(self) -> Path:
        return self.folder / "config" / "study.yaml"

    @property
    def tables(self) -> Path:
        return self.folder / "tables"

    @property
    def references(self) -> Path:
        return self.folder / "reference_data"

    @property
    def decks(self) -> Path:
        return self.folder / "fe_inputs"

    def build(self, out: str = "tables") -> Path:
        """Build the tables into `out`."""
        build_tables(self.study, self.folder / "spring", self.references, self.folder / out, self.decks)
        return self.folder / out

    def write_study(self, change: Callable[[str], str] = lambda text: text) -> None:
        """Write the paper's study with fewer levels and with a change to its text."""
        text = change((ROOT / "config" / "study.yaml").read_text(encoding="utf-8"))
        data = yaml.safe_load(text)
        data["runs"][0].update(SMALL)
        data["spring"]["variants"] = ["paper"]
        self.study.parent.mkdir(parents=True, exist_ok=True)
        self.study.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")

    def run_springs(self) -> None:
        """Run the spring model for every case."""
        rows = []
        place = self.folder / "spring" / "paper"
        for case in resolve_creep(load_study(self.study).cases()):
            history = run(case).with_checksum()
            history.write_csv(place / f"{case.case_id}.csv")
            rows.append(summary_row(case, history, "paper"))
        (place / "summary.csv").write_text(summary_csv(rows), encoding="utf-8")

    def write_references(self, factor: float = 1.3) -> None:
        """Write decks of one line and references that are the spring runs, `factor` as high."""
        store = FeStore(self.references)
        for source in sorted((self.folder / "spring" / "paper").glob("*-*.csv")):
            case_id = source.stem
            deck, user = f"*HEADING\n{case_id}\n*STEP, NAME={case_id}\n", "      SUBROUTINE VFRIC\n"
            place = self.decks / case_id
            place.mkdir(parents=True, exist_ok=True)
            (place / f"{case_id}.inp").write_text(deck, encoding="utf-8")
            (place / "vfric.f").write_text(user, encoding="utf-8")
            base = History.read_csv(source)
            history = History(
                base.time, factor * base.normal_force, factor * base.tangential_force, base.slipping_fraction
            )
            target = self.folder / "fe" / f"{case_id}.csv"
            history.write_csv(target)
            files = DeckFiles(place / f"{case_id}.inp", place / "vfric.f")
            record = {
                "case_id": case_id,
                "engine": "embedded",
                "code": code_digest("fe"),
                "deck_digest": files.problem.digest,
                "history_sha256": sha256_file(target),
                "mesh_error": 0.02,
            }
            target.with_suffix(".yaml").write_text(yaml.safe_dump(record), encoding="utf-8")
            file_run(store, read_run(target, files), study="small")

    def copy_references(self) -> None:
        """Give the folder copies of the published package and the belt, and a reference store of its own."""
        self.references.mkdir(parents=True, exist_ok=True)
        for name in ("published", "belt"):
            shutil.copytree(ROOT / "reference_data" / name, self.references / name)
        shutil.copy(ROOT / "reference_data" / "datapackage.yaml", self.references)


@pytest.fixture(scope="session")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Workspace:
    """A finished workspace; tests must not change it."""
    place = Workspace(tmp_path_factory.mktemp("workspace"))
    place.write_study()
    place.copy_references()
    place.run_springs()
    place.write_references()
    place.build()
    return place


@pytest.fixture
def copy(workspace: Workspace, tmp_path: Path) -> Workspace:
    """A workspace that a test may change."""
    shutil.copytree(workspace.folder, tmp_path / "copy")
    return Workspace(tmp_path / "copy")


@pytest.fixture(scope="session")
def half_sine() -> Callable[..., History]:
    """Half a sine of N and a whole one of T: peak 100 N and shear 30 N over 10 ms, unless told otherwise."""

    def made(peak: float = 100.0, shear: float = 30.0, duration: float = 0.01) -> History:
        t = np.linspace(0.0, duration, 801)
        wave = t / duration
        return History(t, peak * np.sin(np.pi * wave), shear * np.sin(2 * np.pi * wave), np.zeros_like(t))

    return made
