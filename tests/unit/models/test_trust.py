"""A study is data: reading one executes nothing, and what it names runs only after the user has said so."""

from __future__ import annotations

import sys

import pytest

from tread_validate.cli.app import run
from tread_validate.models.trust import VARIABLE, untrusted
from tread_validate.study import load_study


@pytest.fixture
def harmful(tmp_path, study_with, monkeypatch):
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "settings"))
    harm = tmp_path / "harm"
    (tmp_path / "harmful.py").write_text(f"open({str(harm)!r}, 'w')\n")
    return harm, {
        "command": study_with(kind="command", command=f"{sys.executable} harmful.py {{case}} {{history}}"),
        "python": study_with(kind="python", object="harmful:forces"),
    }


@pytest.mark.parametrize("kind", ["command", "python"])
def test_untrusted_model_is_refused_in_one_line_and_does_not_run(kind, harmful, tmp_path, capsys):
    harm, studies = harmful
    assert run(["cases", str(studies[kind])]) == 0
    capsys.readouterr()
    assert run(["model", str(studies[kind]), "--model", "mine", "-o", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "--trust-models" in said
    assert not harm.exists()


def test_word_on_the_command_line_in_the_environment_or_in_the_settings_is_enough(harmful, tmp_path, monkeypatch):
    study = load_study(harmful[1]["command"])
    assert untrusted(study) == ("mine",)
    assert untrusted(study, said=True) == ()
    monkeypatch.setenv(VARIABLE, "1")
    assert untrusted(study) == ()
    monkeypatch.delenv(VARIABLE)
    settings = tmp_path / "settings" / "tread_validate" / "settings.yaml"
    settings.parent.mkdir(parents=True)
    settings.write_text("trusted_folders: [/nowhere]\n")
    assert untrusted(study) == ("mine",)
    settings.write_text(f"trusted_folders: ['{tmp_path}']\n")
    assert untrusted(study) == ()


def test_histories_made_elsewhere_need_no_trust(study_with):
    assert untrusted(load_study(study_with(kind="histories", folder="made"))) == ()


@pytest.mark.parametrize(
    "command",
    ["./model", "./model {case}", "{case} {history}", "./model {case} {history} {title}", "./model '{case} {history}"],
)
def test_command_without_its_placeholders_is_refused_by_the_study(command, study_with, capsys):
    assert run(["cases", str(study_with(kind="command", command=command))]) == 2
    assert "command" in capsys.readouterr().err
