"""A working model to start from: source, study, test and a page that says how to run it."""

from __future__ import annotations

import re
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Literal, get_args

from ..errors import InputError
from ..files import write_text

Kind = Literal["python", "command", "octave", "histories"]
KINDS: tuple[Kind, ...] = get_args(Kind)
NAME = re.compile(r"[a-z][a-z0-9_]{0,17}")

BEFORE = {
    "python": "`NAME.py` holds the model; it is found beside its study, and from anywhere after `pip install .`\n",
    "command": "`NAME.c` holds the model; `make` builds it.\n",
    "octave": "`NAME.m` holds the model; it needs GNU Octave 7 or later.\n",
    "histories": "`make_histories.py` stands for the program, wherever it ran, that made `histories/`.\n\n```sh\n"
    "tread-validate case study.yaml --all -o cases\npython make_histories.py\n```\n",
}
PREPARE = {
    "python": "",
    "command": 'subprocess.run(["make"], cwd=HERE, check=True)\n',
    "octave": 'if shutil.which("octave-cli") is None:\n        pytest.skip("GNU Octave is not installed")\n',
    "histories": 'export = ["tread-validate", "case", "study.yaml", "--all", "-o", "cases"]\n'
    "    subprocess.run(export, cwd=HERE, check=True)\n"
    '    subprocess.run([sys.executable, "make_histories.py"], cwd=HERE, check=True)\n',
}


def skeleton(name: str, kind: Kind) -> dict[str, str]:
    """Return the files of a new model, path to text; raises `InputError` for a name that cannot be one."""
    if not NAME.fullmatch(name):
        raise InputError("new-model: name", name, "a small letter, then letters, digits or _, at most 18 in all")
    place = files(__package__) / "skeleton"
    texts = _texts(place / "common") | _texts(place / kind)
    model = texts.pop("model.yaml")
    runs = kind != "histories"
    replaced = {
        "MODEL\n": model,
        "BEFORE\n": BEFORE[kind],
        "TRUST": "--trust-models " if runs else "",
        "MAKE": " TRUST_MODELS=1" if runs else "",
        "    PREPARE\n": f"    {PREPARE[kind]}" if PREPARE[kind] else "",
    }
    found = {}
    for file, text in texts.items():
        for marker, value in replaced.items():
            text = text.replace(marker, value)
        found[file.replace("NAME", name)] = _used_imports(text).replace("NAME", name)
    return found


def write_skeleton(folder: Path, name: str, kind: Kind) -> tuple[Path, ...]:
    """Write a new model into `folder`, which must not hold any of its files; returns what was written."""
    texts = skeleton(name, kind)
    for file in texts:
        if (folder / file).exists():
            raise InputError(folder / file, "a file", "a folder without it: nothing is overwritten")
    for file, text in texts.items():
        write_text(folder / file, text)
    return tuple(folder / file for file in texts)


def _texts(folder: Traversable) -> dict[str, str]:
    return {item.name: item.read_text("utf-8") for item in folder.iterdir() if item.is_file()}


def _used_imports(text: str) -> str:
    """Drop the imports that a kind's test does not need, and add the one that only one does."""
    if "import shutil\n" in text and "shutil." not in text:
        text = text.replace("import shutil\n", "")
    if "sys.executable" in text and "import sys\n" not in text:
        text = text.replace("import subprocess\n", "import subprocess\nimport sys\n")
    return text
