"""Yesterday's names of the spring variants: read for one version more, and said."""

import subprocess
import sys
from pathlib import Path

import pytest

from tread_validate.model_names import RENAMED, current_name
from tread_validate.spring import variants
from tread_validate.study import SpringSettings


def test_a_study_with_yesterdays_names_runs_todays_variants_and_is_told_so():
    with pytest.warns(FutureWarning) as told:
        settings = SpringSettings(variants=("paper", "bonded", "coupled"))
    assert settings.variants == ("paper", "shape_factor", "condensed")
    assert ["'bonded' is called 'shape_factor'" in str(one.message) for one in told] == [True, False]
    assert set(RENAMED.values()) <= set(variants())
    assert not set(RENAMED) & set(variants())


def test_todays_names_pass_without_a_word():
    assert [current_name(name) for name in variants()] == list(variants())


def test_the_command_line_says_the_new_name_in_one_line(paper_study):
    arguments = ["spring", str(paper_study), "--case", "no-such-case", "--variant", "coupled_coarse"]
    program = Path(sys.executable).with_name("tread-validate")
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    first, *_ = done.stderr.splitlines()
    assert first.endswith(
        "spring variant 'coupled_coarse' is called 'condensed_coarse' since 0.2; the old name goes with 0.3"
    )
