"""A wrong study is one clear line: file, key, found, expected."""

from __future__ import annotations

import math

import pytest

from tread_validate.cli.app import run
from tread_validate.errors import InputError
from tread_validate.study import load_study

FAULTS = {
    "missing key": ({"compounds.surrogate.exponent": ...}, "compounds.surrogate.exponent"),
    "misspelt key": ({"compounds.surrogate.exponnent": 0.25}, "compounds.surrogate.exponnent"),
    "misspelt key in a block": ({"blocks.rectangle.lenght_mm": 25.0}, "blocks.rectangle.lenght_mm"),
    "negative length": ({"blocks.rectangle.length_mm": -25.0}, "blocks.rectangle.length_mm"),
    "NaN": ({"blocks.rectangle.width_mm": math.nan}, "blocks.rectangle.width_mm"),
    "infinite": ({"runs.0.speed_rpm": [150.0, math.inf]}, "runs[0].speed_rpm[1]"),
    "not a number": ({"runs.0.interference_mm": "thin"}, "runs[0].interference_mm"),
    "true for a number": ({"runs.1.creep_percent": True}, "runs[1].creep_percent"),
    "true in a list of numbers": ({"runs.0.speed_rpm": [150.0, True]}, "runs[0].speed_rpm"),
    "false for a length": ({"blocks.rectangle.width_mm": False}, "blocks.rectangle.width_mm"),
    "negative in a list": ({"runs.0.interference_mm": [0.1, -0.2]}, "runs[0].interference_mm[1]"),
    "unknown block": ({"runs.0.block": "hexagon"}, "runs[0].block"),
    "unknown friction law": ({"runs.1.friction": "ice"}, "runs[1].friction"),
    "unknown law kind": ({"friction_laws.road.kind": "magic"}, "friction_laws.road"),
    "interference beyond the block's height": ({"runs.1.interference_mm": 8.5}, "runs[1].interference_mm"),
    "below the WLF pole": ({"runs.1.temperature_degC": -95.0}, "runs[1].temperature_degC"),
    "rpm on a belt": ({"runs.1.speed_rpm": 100.0, "runs.1.speed_m_s": ...}, "runs[1].speed_rpm"),
    "two speeds": ({"runs.1.speed_rpm": 100.0}, "runs[1]"),
    "a level twice": ({"runs.0.temperature_degC": [22.0, 22.0]}, "runs[0]"),
    "missing file": ({"paths.mid_top.file": "nowhere.yaml"}, "paths.mid_top.file"),
    "line break in the title": ({"title": "Belt\n*STEP"}, "title"),
    "line break in the name": ({"name": "belt\n*STEP"}, "name"),
    "a run that leaves its folder": ({"runs.0.name": "../../etc"}, "runs[0].name"),
    "skewed rectangle": ({"blocks.rectangle.skew_deg": 10.0}, "blocks.rectangle"),
    "sipes beyond the block": (
        {"blocks.rectangle.sipes": [{"position_mm": 24.9, "width_mm": 0.6}]},
        "blocks.rectangle",
    ),
    "another schema version": ({"schema_version": 2}, "schema_version"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_fault_is_one_line_with_file_and_key(fault, altered_study, capsys):
    changes, key = FAULTS[fault]
    path = altered_study(changes)
    with pytest.raises(InputError) as caught:
        load_study(path).cases()
    message = str(caught.value)
    assert message.startswith(f"{path}: {key}")
    assert ": got " in message
    assert ", expected " in message
    assert "\n" not in message
    assert run(["cases", str(path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize(
    ("content", "found"),
    [
        (b"", "an empty file"),
        (b"\x00\x01\x02 binary \xff", "binary data"),
        (b"- a\n- list\n", "list"),
        (b"a: [1, 2\nb: 3\n", "expected ',' or ']'"),
        (b"name: a\nname: b\n", "given twice"),
        (b"a: !!python/object/apply:os.system ['true']\n", "could not determine a constructor"),
        (b"a: &x 1\nb: *x\n", "YAML aliases"),
    ],
)
def test_file_that_is_no_study_is_one_line(tmp_path, content, found):
    path = tmp_path / "study.yaml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"study\.yaml") as caught:
        load_study(path)
    assert found in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("creep", "place", "expected"),
    [
        (25, "", "less than 20 or 'free_rolling'"),
        ([0.3, -30.0], "[1]", "greater than -20 or 'free_rolling'"),
        ("fast", "", "a valid number"),
    ],
)
def test_creep_out_of_range_is_told_the_range_and_the_word(altered_study, creep, place, expected):
    """A union has more than one way to be right; a number out of range is told the range first."""
    with pytest.raises(InputError) as caught:
        load_study(altered_study({"runs.1.creep_percent": creep}))
    assert f"runs[1].creep_percent{place}: got " in str(caught.value)
    assert expected in str(caught.value)
    assert "free_rolling" in str(caught.value)


def test_missing_study_is_exit_code_2(tmp_path, capsys):
    assert run(["cases", str(tmp_path / "none.yaml")]) == 2
    assert "no such file" in capsys.readouterr().err
