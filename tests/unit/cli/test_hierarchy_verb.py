"""The hierarchy verb: what it writes, and what it refuses."""

import csv

import pytest

from tread_validate.cli.app import run


def test_one_part_writes_its_table_figure_and_record_and_nothing_else(paper_study, tmp_path):
    assert run(["hierarchy", str(paper_study), "--part", "compatibility", "-o", str(tmp_path)]) == 0
    with (tmp_path / "compatibility.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert rows[0]["family"] == "published"
    assert (tmp_path / "figures" / "compatibility.png").stat().st_size > 10_000
    assert sorted(path.name for path in tmp_path.iterdir()) == ["compatibility.csv", "figures", "record.yaml"]


def test_a_sample_that_is_no_power_of_two_is_wrong_input(paper_study, tmp_path, capsys):
    assert run(["hierarchy", str(paper_study), "--samples", "100", "-o", str(tmp_path)]) == 2
    assert "power of two" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_part_is_wrong_input_by_name(paper_study, tmp_path, capsys):
    assert run(["hierarchy", str(paper_study), "--part", "tea", "-o", str(tmp_path)]) == 2
    assert "tea" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("change", [{"runs.0.temperature_degC": [22.0]}, {"runs.0.speed_rpm": [300.0]}])
def test_a_study_of_one_temperature_or_one_speed_is_told_why_it_has_no_coefficients(
    change, altered_study, tmp_path, capsys
):
    """In place of a division by a range of nothing."""
    study = altered_study(change)
    assert run(["hierarchy", str(study), "--part", "compatibility", "-o", str(tmp_path / "out")]) == 0
    assert "no compatibility: it needs" in capsys.readouterr().out
    assert not (tmp_path / "out" / "compatibility.csv").exists()
