"""The examples for continuous integration are valid by the services' published schemas."""

from __future__ import annotations

import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    ("name", "schema"),
    [("github-workflow.yml", "vendor.github-workflows"), ("gitlab-ci.yml", "vendor.gitlab-ci")],
)
def test_example_is_valid_by_the_service_s_schema(name, schema, root):
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", schema, f"examples/ci/{name}"]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_schema_would_find_a_fault(root, tmp_path):
    text = (root / "examples" / "ci" / "github-workflow.yml").read_text()
    (tmp_path / "broken.yml").write_text(text.replace("runs-on: ubuntu-latest", "runs_on: ubuntu-latest"))
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.github-workflows", "broken.yml"]
    assert subprocess.run(command, cwd=tmp_path, capture_output=True, check=False).returncode == 1
