"""A wheel has all that a run needs: outside a clone, without the network."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

pytest.importorskip("setuptools")


def test_wheel_has_every_file_of_the_package_and_runs_in_a_bare_folder(root: Path, tmp_path: Path) -> None:
    """Built without isolation, so that nothing is fetched; `new-model`, then a spring run and a deck of its study."""
    clone, wheels, unpacked, bare = (tmp_path / name for name in ("clone", "wheels", "unpacked", "bare"))
    left_out = shutil.ignore_patterns("__pycache__", "*.egg-info", "*.nbi", "*.nbc")
    shutil.copytree(root / "src", clone / "src", ignore=left_out)
    for file in (*root.glob("LICENSE*"), root / "pyproject.toml", root / "README.md"):
        shutil.copy(file, clone)
    build = ["pip", "wheel", ".", "--no-deps", "--no-build-isolation", "--no-index", "-q", "-w", str(wheels)]
    made = subprocess.run([sys.executable, "-m", *build], cwd=clone, capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stderr
    (wheel,) = wheels.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(unpacked)
    package = {path.relative_to(clone / "src") for path in (clone / "src" / "tread_validate").rglob("*")}
    assert not [name for name in package if not (unpacked / name).exists()]

    bare.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(unpacked)}

    def verb(*arguments: str) -> str:
        command = [sys.executable, "-m", "tread_validate.cli.app", *arguments]
        done = subprocess.run(command, cwd=bare, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    verb("new-model", "mine", "--kind", "python", "-o", ".")
    case = next(word for word in verb("cases", "study.yaml").split() if word.startswith("rig-"))
    verb("spring", "study.yaml", "--case", case, "-o", "history.csv")
    header = (bare / "history.csv").read_text(encoding="utf-8")
    assert "# code: unknown" not in header
    assert "# code: " in header
    verb("deck", "study.yaml", "--case", case, "-o", "decks")
    assert (bare / "decks" / case / "vfric.f").is_file()
