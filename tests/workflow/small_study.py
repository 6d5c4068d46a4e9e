"""A workspace with a small study and a copy of the package's source, to run, edit and run again. Not a test."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
BINARIES = Path(sys.executable).parent


@dataclass(frozen=True)
class Small:
    """The workspace; commands run in it as a user's would, on the copied source."""

    folder: Path

    @property
    def source(self) -> Path:
        return self.folder / "src" / "tread_validate"

    def study(self, name: str = "small", file: str = "config/study.yaml", belt: bool = False, **deck: object) -> Path:
        """Write a study of two cases on a coarse mesh, rigs or a warm rig and a sliding belt, and return its file."""
        data = yaml.safe_load((ROOT / "config" / "study.yaml").read_text(encoding="utf-8"))
        rig, tyre = data["runs"]
        rig.update(block="rectangle", temperature_degC=22.0, interference_mm=0.2, speed_rpm=[450.0, 600.0])
        data.update(name=name, runs=[rig])
        if belt:
            rig.update(temperature_degC=45.0, speed_rpm=600.0)
            data["runs"].append(dict(tyre, path="simplified", creep_percent=0.3))
        del data["mesh_of_path"]
        data["spring"]["variants"] = ["paper"]
        data["deck"].update({"element_size_mm": 4.0, "layers": 4, "constant_friction_variant": False, **deck})
        path = self.folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
        return path

    def run(self, *command: str) -> subprocess.CompletedProcess[str]:
        environment = {
            **os.environ,
            "PATH": f"{BINARIES}{os.pathsep}{os.environ['PATH']}",
            "PYTHONPATH": str(self.folder / "src"),
        }
        return subprocess.run(
            command, cwd=self.folder, env=environment, capture_output=True, text=True, timeout=900, check=False
        )

    def snakemake(self, *arguments: str, study: str = "config/study.yaml") -> subprocess.CompletedProcess[str]:
        options = ("--cores", "2", "--show-failed-logs", "--config", f"study={study}", "--")
        return self.run("snakemake", *options, *arguments)

    def assessment(self, study: str = "config/study.yaml") -> subprocess.CompletedProcess[str]:
        return self.run("tread-validate", "assessment", study, "--gate")

    def check(self, study: str = "config/study.yaml") -> subprocess.CompletedProcess[str]:
        """Do what `make check` does."""
        made = self.snakemake("checked", study=study)
        assert made.returncode == 0, made.stdout + made.stderr
        return self.assessment(study)

    def edit(self, file: str, old: str, new: str) -> str:
        """Change one place of the copied source; returns the text as it was."""
        path = self.source / file
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{file}: {text.count(old)} times: {old}"
        path.write_text(text.replace(old, new), encoding="utf-8")
        return text

    def restore(self, file: str, text: str) -> None:
        (self.source / file).write_text(text, encoding="utf-8")


def make_small(folder: Path) -> Small:
    """Copy what a run needs: source with its compiled kernels, workflow, published references; no FE runs."""
    for name in ("workflow", "Snakefile"):
        (folder / name).symlink_to(ROOT / name)
    (folder / "config").mkdir(parents=True)
    for name in ("workflow.yaml", "engines.yaml"):
        shutil.copy(ROOT / "config" / name, folder / "config")
    shutil.copytree(ROOT / "src" / "tread_validate", folder / "src" / "tread_validate")
    shutil.copytree(
        ROOT / "reference_data", folder / "reference_data", ignore=lambda path, names: {"fe", "hierarchy"} & set(names)
    )
    return Small(folder)
