"""What the project says of itself in several places is one thing."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

import tread_validate
from tread_validate.cli.app import run


@pytest.fixture
def project(root: Path) -> dict[str, Any]:
    return tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["project"]


def test_one_version(root: Path, project: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    version = project["version"]
    assert tread_validate.__version__ == version
    assert f"version: {version}\n" in (root / "CITATION.cff").read_text("utf-8")
    assert f"\n## {version}" in (root / "CHANGELOG.md").read_text("utf-8")
    assert run(["--version"]) == 0
    assert capsys.readouterr().out.startswith(f"tread-validate {version}, code ")


def test_every_dependency_has_a_lower_bound_and_a_tested_version_above_it(root: Path, project: dict[str, Any]) -> None:
    pins = dict(re.findall(r"^([\w.-]+)==([\d.]+)", (root / "constraints.txt").read_text("utf-8").lower(), re.M))
    listed = [
        *project["dependencies"],
        *(item for extra in project["optional-dependencies"].values() for item in extra),
    ]
    for item in listed:
        if item == "parso<0.8":  # reads Python 2.7, which later ones do not
            continue
        name, _, least = item.lower().partition(">=")
        assert least, item
        pin = pins.get(name) or pins[name.replace("-", "_")]
        assert [int(n) for n in pin.split(".")] >= [int(n) for n in least.split(".")], item


def test_what_runs_before_a_commit_is_make_lint_and_before_a_push_what_ci_runs(root: Path) -> None:
    makefile = (root / "Makefile").read_text("utf-8")
    recipe = makefile[makefile.index("\nlint:") :].split("\n\n")[0]
    config = yaml.safe_load((root / ".pre-commit-config.yaml").read_text("utf-8"))
    assert [repo["repo"] for repo in config["repos"]] == ["local"]
    hooks = config["repos"][0]["hooks"]
    commit = [hook["entry"].replace(".venv/bin/", "") for hook in hooks if "stages" not in hook]
    assert commit == re.findall(r"@\$\(BIN\)/(.*)", recipe)
    assert [hook["entry"] for hook in hooks if hook.get("stages") == ["pre-push"]] == [".ci/run"]
    assert "exec make test" in (root / ".ci" / "run").read_text("utf-8")


def test_recipes_name_what_is_there(root: Path) -> None:
    """Every file and folder that the page on adding things names exists."""
    package = Path(tread_validate.__file__).parent
    names = re.findall(
        r"`([\w./-]+(?:\.py|\.yaml|\.csv|\.md|/))`", (root / "docs" / "contributing.md").read_text("utf-8")
    )
    assert len(names) > 12
    for name in names:
        places = [root / name, package / name, *package.rglob(name if "/" not in name else "no-such")]
        assert any(place.exists() for place in places), name


def test_every_test_that_a_page_names_is_there(root: Path) -> None:
    """What a page says is held by a test, is."""
    pages = [*root.glob("*.md"), *(root / "docs").rglob("*.md")]
    named = {
        (page.name, name)
        for page in pages
        if page.name != "CHANGELOG.md"
        for name in re.findall(r"[\w./-]*\btest_\w+\.py", page.read_text("utf-8"))
    }
    assert len(named) > 12
    there = [str(file.relative_to(root / "tests")) for file in (root / "tests").rglob("test_*.py")]
    gone = [
        (page, name)
        for page, name in named
        if not any(f"/{file}".endswith(f"/{name.removeprefix('tests/')}") for file in there)
    ]
    assert gone == []
