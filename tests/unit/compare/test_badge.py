"""A badge says what the summary says."""

from __future__ import annotations

import json
from xml.etree import ElementTree

import pytest

from tread_validate.cli.app import run
from tread_validate.compare.badge import AMBER, GREEN, GREY, RED, badge_of
from tread_validate.errors import InputError

SVG = "{http://www.w3.org/2000/svg}"


def peak(adequate, inadequate, cases=4, compared=4):
    return {
        "quantity": "peak_normal_force",
        "metric": "scalar",
        "cases": cases,
        "compared": compared,
        "adequate": adequate,
        "inadequate": inadequate,
    }


def summary(folder, baseline=None, quantity=None):
    models = [{"model": "spring:paper", "reference": "fe:embedded", "quantities": [quantity or peak(4, 0)]}]
    path = folder / "summary.json"
    path.write_text(json.dumps({"schema_version": 1, "study": "s", "models": models, "baseline": baseline}))
    return path


def baseline(flips=0, moved=0):
    return {"rows": 9, "moved_rows": moved, "flips": [{"row": "x"}] * flips}


@pytest.mark.parametrize(
    ("found", "message", "color"),
    [
        (None, "no baseline", GREY),
        (baseline(), "no assessment flipped", GREEN),
        (baseline(moved=1), "1 row moved", AMBER),
        (baseline(flips=2, moved=3), "2 assessments flipped", RED),
    ],
)
def test_badge_of_a_study_tells_what_moved(tmp_path, found, message, color):
    badge = badge_of(summary(tmp_path, found))
    assert (badge.message, badge.color) == (message, color)


def test_nothing_compared_is_never_green(tmp_path):
    path = summary(tmp_path, baseline(), peak(0, 0, compared=0))
    assert badge_of(path).color == GREY
    assert badge_of(path, "paper").color == GREY


@pytest.mark.parametrize(("good", "bad", "color"), [(4, 0, GREEN), (2, 2, AMBER), (0, 4, RED), (0, 0, GREY)])
def test_badge_of_a_model_counts_cases_that_are_good_enough(tmp_path, good, bad, color):
    badge = badge_of(summary(tmp_path, None, peak(good, bad)), "paper")
    assert badge.message == f"spring:paper: peak N good enough in {good} of 4"
    assert badge.color == color


def test_model_that_is_not_there_is_named_with_those_that_are(tmp_path):
    with pytest.raises(InputError, match="one of spring:paper"):
        badge_of(summary(tmp_path), "mine")


def test_verb_writes_picture_and_endpoint_and_refuses_other_files(tmp_path, capsys):
    path = summary(tmp_path, baseline(flips=1))
    assert run(["badge", str(path), "-o", str(tmp_path / "b.svg")]) == 0
    root = ElementTree.parse(tmp_path / "b.svg").getroot()
    assert [text.text for text in root.iter(f"{SVG}text")] == ["tread_validate", "1 assessment flipped"]
    assert root.get("aria-label") == "tread_validate: 1 assessment flipped"
    assert run(["badge", str(path), "-o", str(tmp_path / "b.json")]) == 0
    endpoint = json.loads((tmp_path / "b.json").read_text())
    assert endpoint == {"schemaVersion": 1, "label": "tread_validate", "message": "1 assessment flipped", "color": RED}
    assert run(["badge", str(path), "-o", str(tmp_path / "b.png")]) == 2
    (tmp_path / "other.json").write_text("[]")
    assert run(["badge", str(tmp_path / "other.json"), "-o", str(tmp_path / "c.svg")]) == 2
    assert not (tmp_path / "c.svg").exists()
    assert "summary.json" in capsys.readouterr().err
