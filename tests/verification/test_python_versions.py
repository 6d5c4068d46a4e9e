"""Other Python versions: the digests of the code, and with `make test-pythons` the whole small study.

An interpreter is looked for by its name on PATH and then with pyenv. The small study (a rig case and a belt case,
coarse mesh: decks, FE engine, spring model, tables) is run in a throw-away virtual environment of each, with the
versions of ``constraints.txt``; the baseline that this Python accepts must hold there, and the decks be the same bytes.
"""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

OTHERS = tuple(name for name in ("3.11", "3.12", "3.13") if name != f"{sys.version_info[0]}.{sys.version_info[1]}")
DIGESTS = (
    "import json; from tread_validate.source_code import PARTS, code_digest as d; print(json.dumps([*map(d, PARTS)]))"
)
WANTED = "WITH_PYTHONS"
ACCEPT = ("tread-validate", "accept", "--reason", "made by the test", "--who", "test", "--allow-dirty")


def interpreter(version: str) -> str | None:
    """Return the path of an interpreter of this version that starts."""
    places = [shutil.which(f"python{version}")]
    if shutil.which("pyenv"):
        home = subprocess.run(["pyenv", "root"], capture_output=True, text=True, check=False).stdout.strip()
        places += [str(path) for path in sorted(Path(home, "versions").glob(f"{version}.*/bin/python"))]
    for place in places:
        if place and subprocess.run([place, "-c", ""], capture_output=True, check=False).returncode == 0:
            return place
    return None


def found(version: str) -> str:
    python = interpreter(version)
    if python is None:
        pytest.skip(f"no Python {version} on this machine: not tried with it")
    return python


def ran(*command: str, **options: Any) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("version", OTHERS)
def test_digests_of_the_code_do_not_depend_on_the_python_version(version: str, root: Path) -> None:
    """A run of another Python counts as one of the same code; nothing but the standard library is needed."""
    ours, theirs = (
        json.loads(ran(python, "-c", DIGESTS, env={"PYTHONPATH": str(root / "src"), "PYTHONDONTWRITEBYTECODE": "1"}))
        for python in (sys.executable, found(version))
    )
    assert ours == theirs


def environment(python: str, folder: Path, root: Path) -> Path:
    """Make a virtual environment with the pinned packages that the project runs on; returns its commands' folder."""
    ran(python, "-m", "venv", str(folder))
    needed = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["project"]["dependencies"]
    pip = (str(folder / "bin" / "python"), "-m", "pip", "install", "-q", "-c", str(root / "constraints.txt"))
    ran(*pip, "setuptools", "wheel")
    ran(*pip, *needed)
    ran(*pip, "--no-build-isolation", "--no-deps", "--editable", str(root))
    return folder / "bin"


def small_study(folder: Path, helper: ModuleType, binaries: Path) -> Any:
    """Run the FE engine, the spring model and the comparison on the small study in a workspace of its own."""
    helper.BINARIES = binaries
    folder.mkdir(exist_ok=True)
    small = helper.make_small(folder)
    for cache in folder.rglob("__pycache__"):
        shutil.rmtree(cache)  # kernels compiled by the other Python
    small.study(belt=True)
    for target in ("reference", "checked"):
        done = small.snakemake(target)
        assert done.returncode == 0, done.stdout + done.stderr
    return small


def decks(small: Any) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted((small.folder / "fe_inputs").rglob("*.inp"))}


@pytest.fixture(scope="module")
def helper(root: Path) -> ModuleType:
    if WANTED not in os.environ:
        told = ", ".join(version for version in OTHERS if interpreter(version)) or "none found"
        pytest.skip(f"decks and tables on other Python versions ({told}) not tried here: make test-pythons")
    spec = importlib.util.spec_from_file_location("small_study", root / "tests" / "workflow" / "small_study.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["small_study"] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def ours(helper: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The small study run by this Python, with its baseline accepted."""
    small = small_study(tmp_path_factory.mktemp("ours"), helper, Path(sys.executable).parent)
    done = small.run(*ACCEPT)
    assert done.returncode == 0, done.stdout + done.stderr
    assert small.check().returncode == 0
    return small


@pytest.mark.parametrize("version", OTHERS)
def test_decks_are_equal_and_tables_within_their_noise(
    version: str, ours: Any, helper: ModuleType, root: Path, tmp_path: Path
) -> None:
    """Decks byte by byte; tables by the baseline's own tolerances, FE engine, spring model and regressions in them."""
    theirs = small_study(tmp_path / "study", helper, environment(found(version), tmp_path / "venv", root))
    assert decks(theirs) == decks(ours)
    shutil.copytree(ours.folder / "reports" / "small" / "baseline", theirs.folder / "reports" / "small" / "baseline")
    done = theirs.check()
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.splitlines()[-1] == "baseline: not moved"
