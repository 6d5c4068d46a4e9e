"""The linear algebra library is told to use one thread before it is loaded."""

from __future__ import annotations

import os
import subprocess
import sys

CODE = """
import os, sys
class Watch:
    def find_spec(self, name, path=None, target=None):
        if name == "numpy":
            print(os.environ.get("OPENBLAS_NUM_THREADS"))
sys.meta_path.insert(0, Watch())
import tread_validate.cli.app, numpy
"""


def test_one_thread_is_asked_for_before_the_library_reads_it() -> None:
    """Said too late it has no effect, and a fit of 5,000 points takes five times as long on two busy cores."""
    clean = {key: value for key, value in os.environ.items() if not key.endswith("_NUM_THREADS")}
    said = subprocess.run([sys.executable, "-c", CODE], env=clean, capture_output=True, text=True, check=True).stdout
    assert said.split() == ["1"]
