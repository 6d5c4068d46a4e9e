"""One way in and out for YAML: whatever is wrong is one line with file, key, what stands there and what should."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import tread_validate
from tread_validate.errors import InputError
from tread_validate.fields import Positive, Strict
from tread_validate.model_file import read_model
from tread_validate.yaml_text import load_yaml, read_mapping, write_yaml, yaml_text

KEYS = st.text(st.characters(categories=["L", "N"]), min_size=1, max_size=8)
LINES = st.text(st.characters(exclude_categories=["C", "Zl", "Zp"]), max_size=12)  # what stands on one line
DATA = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | LINES,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3),
    max_leaves=8,
)


class Wheel(Strict):
    diameter_mm: Positive


class Rig(Strict):
    wheels: tuple[Wheel, ...]


@given(DATA)
def test_what_is_written_reads_back(data: object) -> None:
    assert load_yaml(yaml_text(data), "memory") == data


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("wheels: [{diameter_mm: -1}]", "wheels[0].diameter_mm: got -1, expected greater than 0"),
        (
            "wheels: [{diameter_mm: 1.0e+9}]",
            "wheels[0].diameter_mm: got 1000000000.0, expected a number from 1 to 10000 mm",
        ),
        ("wheels: [{diameter_mm: 1, spokes: 3}]", "wheels[0].spokes: got an unknown key"),
        ("wheels: [{}]", "wheels[0].diameter_mm: got nothing"),
        ("- 1", "got list, expected a mapping of keys"),
        ("a: [1", "rig.yaml:1: got"),
        ("a: 1\na: 2", "rig.yaml:2: got key a given twice"),
        ("a: !!python/object/apply:os.system [ls]", "rig.yaml:1: got"),
        ("a: .nan\nb: !!timestamp 99", "rig.yaml"),
    ],
)
def test_every_fault_is_one_line_with_its_place(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="expected") as refused:
        read_model(path, Rig)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_broken_record_is_input_not_a_fault_of_the_program(tmp_path: Path) -> None:
    """A record cut off in the middle of a line."""
    path = tmp_path / "record.yaml"
    write_yaml(path, {"history_sha256": "0" * 64, "checks": ["a", "b"]})
    whole = path.read_text("utf-8")
    assert read_mapping(path)["checks"] == ["a", "b"]
    path.write_text(whole + "checks: [", encoding="utf-8")
    with pytest.raises(InputError, match=r"record\.yaml"):
        read_mapping(path)


def test_no_other_module_reads_or_writes_yaml_or_tells_a_validation_error() -> None:
    package = Path(tread_validate.__file__).parent
    for path in package.rglob("*.py"):
        text = path.read_text("utf-8")
        if path.name != "yaml_text.py":
            assert not re.search(r"\byaml\.\w*(load|dump)", text), path
        assert text.count("error.errors(") == (path.name == "model_file.py"), path
