"""Compiled kernels after an edit: the machine code that runs is that of the sources that stand there."""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numba import typeof

import tread_validate
from tread_validate import kernels
from tread_validate.kernels import KernelCache, kernel

PACKAGE = Path(tread_validate.__file__).parent

# Each line: a callee doubled in its file, and a caller in another file that shows it.
EDITS = {
    "friction/kernel.py": """
_plain = kinetic_kernel
@kernel()
def kinetic_kernel(*arguments):
    return 2.0 * _plain(*arguments)
""",
    "spring/condensed/inputs.py": "\nFREE = 7\n",
    "spring/condensed/contact.py": "\nPLAIN = _kinetic\n@kernel()\ndef _kinetic(*of):\n    return 2.0 * PLAIN(*of)\n",
    "fe/amplitude.py": """
_plain = amplitude_at
@kernel()
def amplitude_at(*arguments):
    value, area, row = _plain(*arguments)
    return 2.0 * value, area, row
""",
    "fe/contact_kernel.py": "\nTOUCHED = coulomb\n@kernel()\ndef coulomb(*arguments):\n    TOUCHED(*arguments)\n",
}
CALLERS = """
import json
import numpy as np
from tread_validate.fe.explicit_kernel import advance
from tread_validate.fe.step_kernel import evaluate_amplitudes
from tread_validate.spring.condensed.march import march
from tread_validate.spring.condensed.step import _follow
from tread_validate.spring.inputs import KernelLaw
from tread_validate.spring.slip import kinetic

one, two, zero = np.ones(1), np.ones(2), np.zeros(1)
value, area = np.zeros(1), np.zeros(1)
rows = np.array([0, 2])
evaluate_amplitudes(
    rows, np.arange(2.0), two, np.arange(2.0), np.array([False]), zero, np.array([0]), 0.5, value, area
)
q, moved = np.zeros((2, 3)), np.zeros(6, dtype=np.float32)
_follow(np.eye(6, dtype=np.float32), np.array([0, 1]), np.ones((2, 3)), 0, 2, moved, q)
print(json.dumps({
    "friction to spring": kinetic(KernelLaw(0.9, 0, np.array([0.7]), one, one, np.ones((1, 1))), 1.0, 1.0),
    "state code to step": q[0, 0],
    "amplitude to FE step": value[0],
    "march": march._cache._cache_file.digest,
    "advance": advance._cache._cache_file.digest,
}))
"""


def run(folder: Path, script: str) -> Any:
    """Run a script on the copy of the package in `folder` and return the JSON it prints."""
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    environment.pop("NUMBA_CACHE_DIR", None)
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=False, cwd=folder
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_an_edit_of_a_callee_in_any_file_is_seen_by_its_callers_and_so_is_its_return(tmp_path: Path) -> None:
    """Doubled friction, amplitude and a changed state code show in other files' kernels; taken back, they are gone."""
    copy = tmp_path / "tread_validate"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    before = run(tmp_path, CALLERS)
    sources = {name: (copy / name).read_text(encoding="utf-8") for name in EDITS}
    for name, edit in EDITS.items():
        (copy / name).write_text(sources[name] + edit, encoding="utf-8")
    after = run(tmp_path, CALLERS)
    for name, source in sources.items():
        (copy / name).write_text(source, encoding="utf-8")
        os.utime(copy / name, (0, 0))  # an unpacked archive or a checkout may set any time
    assert before["friction to spring"] == 0.7
    assert after["friction to spring"] == 1.4
    assert after["amplitude to FE step"] == 2.0 * before["amplitude to FE step"] == 2.0
    assert before["state code to step"] == 1.0  # a free node follows the forces
    assert after["state code to step"] == 0.0  # 0 no longer stands for free
    assert after["march"] != before["march"]
    assert after["advance"] != before["advance"]
    assert run(tmp_path, CALLERS) == before


def test_only_one_module_compiles() -> None:
    """Every kernel goes through the one decorator."""
    compiling = set()
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_bytes())):
            names = {getattr(node, "id", ""), getattr(node, "attr", ""), getattr(node, "name", "")}
            if names & {"jit", "njit", "guvectorize", "cfunc"}:
                compiling.add(path.relative_to(PACKAGE).as_posix())
    assert compiling == {"kernels.py"}


class Before(NamedTuple):
    first: float
    second: float


def test_named_tuples_are_told_apart_by_their_fields(tmp_path: Path) -> None:
    """Numba's signature leaves the fields out: swapped, the old machine code would read the wrong one."""
    dispatcher: Any = kernel()(lambda pair: pair.first)
    cache: KernelCache = dispatcher._cache._cache_file
    cache.folder = tmp_path

    class Swapped(NamedTuple):
        second: float
        first: float

    Swapped.__name__, Swapped.__qualname__ = Before.__name__, Before.__qualname__
    cache.save(((typeof(Before(1.0, 2.0)),), "x86"), "code")
    assert cache.load(((typeof(Before(3.0, 4.0)),), "x86")) == "code"
    assert cache.load(((typeof(Swapped(1.0, 2.0)),), "x86")) is None


def test_versions_long_gone_leave_the_disk(tmp_path: Path) -> None:
    """The newest few digests of a kernel are kept, others go; an emptied or cut file is compiled anew."""
    dispatcher: Any = kernel()(lambda x: x)
    for number in range(9):
        cache = KernelCache(tmp_path, dispatcher, {})
        cache.digest = f"{number:064x}"[::-1]
        cache.save("key", number)
        os.utime(cache._path("key"), (number, number))
    assert len(list(tmp_path.iterdir())) <= kernels.KEPT + 1
    assert cache.load("key") == 8
    cache._path("key").write_bytes(cache._path("key").read_bytes()[:-3])
    assert cache.load("key") is None
    cache.flush()
    assert not list(tmp_path.iterdir())


def test_a_numba_whose_cache_cannot_be_bound_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """No silent return to stale code."""
    monkeypatch.setattr(numba, "njit", lambda **_: lambda function: SimpleNamespace(_cache=None, py_func=function))
    with pytest.raises(RuntimeError, match=r"numba .* keeps its cache in another way"):
        kernel()(lambda x: x)


def test_what_cannot_be_frozen_into_a_digest_is_refused() -> None:
    """An object of the package that is neither function, number nor tuple: its state would be missed."""
    with pytest.raises(RuntimeError, match="cannot be bound"):
        kernels._value(KernelCache(Path(), kernel()(lambda x: x), {}))
    assert kernels._value(np.arange(3)) != kernels._value(np.arange(3.0))
