"""The guide builds, its links hold, and it names what is really there."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

from tread_validate.cli.app import VERBS


def test_guide_builds_with_every_link_checked(root, tmp_path):
    """`mkdocs build --strict` turns a broken link, anchor or image into a failure."""
    subprocess.run([sys.executable, "docs/generate.py", "--draft"], cwd=root, check=True, timeout=120)
    call = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(tmp_path / "site")]
    done = subprocess.run(call, cwd=root, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "site" / "generated" / "study_file.html").is_file()


def test_guide_without_the_reports_figures_is_not_built(root, tmp_path):
    """A figure or table that has not been made ends the build with its name; nothing stands in its place."""
    for name in ("docs", "CHANGELOG.md"):
        copy = shutil.copytree if (root / name).is_dir() else shutil.copyfile
        copy(root / name, tmp_path / name)
    call = [sys.executable, "docs/generate.py"]
    done = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 1
    assert re.match(r"re(sults|ports)/liu2010/[\w./-]+: not made yet: run `make report`", done.stderr)


def test_links_of_the_readme_work_in_a_clone(root):
    """Every file that README.md names is one that git keeps."""
    kept = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True).stdout.split()
    text = (root / "README.md").read_text(encoding="utf-8")
    links = [link for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text) if not link.startswith("http")]
    folders = {str(parent) for name in kept for parent in Path(name).parents}
    assert links
    assert [link for link in links if link.rstrip("/") not in {*kept, *folders}] == []


def test_guide_fetches_nothing_from_elsewhere(root, tmp_path):
    """The built pages load scripts, styles and images from their own folder only."""
    subprocess.run([sys.executable, "docs/generate.py", "--draft"], cwd=root, check=True, timeout=120)
    call = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--site-dir", str(tmp_path / "site")]
    subprocess.run(call, cwd=root, check=True, timeout=120, capture_output=True)
    loaded = re.compile(r"<(?:script|link|img)[^>]+(?:src|href)=\"(https?://[^\"]+)\"")
    for page in (tmp_path / "site").rglob("*.html"):
        assert loaded.findall(page.read_text(encoding="utf-8")) == [], page.name


def test_commands_in_the_guide_are_verbs(root):
    for page in [*(root / "docs").glob("*.md"), *(root / "examples").rglob("*.md"), root / "CONTRIBUTING.md"]:
        for verb in re.findall(r"tread-validate ([a-z][a-z-]+)", page.read_text(encoding="utf-8")):
            assert verb in VERBS, f"{page.name}: {verb}"


def test_citation_names_the_licence_and_version_of_the_package(root):
    citation = yaml.safe_load((root / "CITATION.cff").read_text(encoding="utf-8"))
    project = (root / "pyproject.toml").read_text(encoding="utf-8")
    assert citation["cff-version"] == "1.2.0"
    assert f'version = "{citation["version"]}"' in project
    assert f'license = "{citation["license"]}"' in project
    assert f"## {citation['version']}" in (root / "CHANGELOG.md").read_text(encoding="utf-8")


def test_workflow_catalog_metadata_names_a_profile_that_exists(root):
    usage = yaml.safe_load((root / ".snakemake-workflow-catalog.yml").read_text(encoding="utf-8"))["usage"]
    profile = Path(usage["mandatory-flags"]["flags"].split()[-1])
    assert (root / profile / "config.yaml").is_file()


def test_docs_of_another_study_run_the_papers_study_throughout(root):
    """`make docs STUDY=...` builds the guide of the paper's study, and says so: no command of it is given the other."""
    told = subprocess.run(
        ["make", "-n", "docs", "STUDY=mine.yaml"], cwd=root, capture_output=True, text=True, check=True
    )
    lines = told.stdout.splitlines()
    assert any("snakemake --config study=config/study.yaml" in line for line in lines)
    assert any("tread-validate assessment config/study.yaml" in line for line in lines)
    assert all(line.startswith("[ ") for line in lines if "mine.yaml" in line)
