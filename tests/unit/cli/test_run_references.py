"""All outstanding references in one command: what a user can rely on when it is stopped, or when a case fails."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import yaml

from tread_validate.cli.app import run
from tread_validate.cli.side_by_side import VerbRun, run_side_by_side
from tread_validate.reference.outstanding import cost
from tread_validate.study import load_study

TIMES = ("wall_time_s", "us_per_element_step")


@pytest.fixture
def place(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a study of three rig passes on a coarse mesh and its decks; no references yet."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "reference_data").mkdir()
    (tmp_path / "reference_data" / "belt").symlink_to(root / "reference_data" / "belt")
    data = yaml.safe_load((root / "config" / "study.yaml").read_text(encoding="utf-8"))
    rig = data["runs"][0]
    rig.update(block="rectangle", temperature_degC=22.0, interference_mm=0.2, speed_rpm=[450.0, 500.0, 600.0])
    data.update(name="small", runs=[rig])
    del data["mesh_of_path"]
    data["spring"]["variants"] = ["paper"]
    data["deck"].update(element_size_mm=4.0, layers=2, constant_friction_variant=False)
    (tmp_path / "study.yaml").write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
    assert run(["deck", "study.yaml", "--all", "-o", "fe_inputs/small"]) == 0
    return tmp_path


def filed(place: Path) -> list[str]:
    found = sorted((place / "reference_data" / "fe" / "embedded").glob("*/record.yaml"))
    return [str(yaml.safe_load(path.read_text(encoding="utf-8"))["case_id"]) for path in found]


def gone(group: int) -> bool:
    """Whether the last process of a group ends within ten seconds."""
    for _ in range(100):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False


def test_each_run_is_the_one_that_a_process_of_its_own_gives(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Histories and tables to the byte, records but for times; each has its log and times; a second call runs none."""
    assert run(["run-references", "study.yaml", "--jobs", "1"]) == 0
    said = capsys.readouterr().out
    names = [case.case_id for case in load_study("study.yaml").cases()]
    assert [line.split(": ")[0] for line in said.splitlines() if ", filed" in line] == ["1 of 3", "2 of 3", "3 of 3"]
    assert filed(place) == names
    (name, *_) = names[1:]
    deck = place / "fe_inputs" / "small" / name
    assert run(["fe", f"{deck}/{name}.inp", "--user", f"{deck}/vfric.f", "-o", f"alone/{name}.csv"]) == 0
    together = place / "results" / "small" / "fe" / "reference"
    for alone in (place / "alone").glob("*.csv"):
        assert alone.read_bytes() == (together / alone.name).read_bytes(), alone.name
    records = [yaml.safe_load((folder / f"{name}.yaml").read_text()) for folder in (place / "alone", together)]
    one, other = ({key: value for key, value in record.items() if key not in TIMES} for record in records)
    assert one == other
    for each in names:
        assert "100 % done" in (place / "logs" / "small" / "fe" / f"{each}.log").read_text(encoding="utf-8")
        head, values = (place / "logs" / "small" / "benchmarks" / "fe" / f"{each}.tsv").read_text().splitlines()
        assert head.split("\t") == ["s", "max_rss", "cpu_time"]
        assert all(float(value) > 0.0 for value in values.split("\t"))
    capsys.readouterr()
    assert run(["run-references", "study.yaml"]) == 0
    assert capsys.readouterr().out.splitlines() == ["3 of 3 references of engine embedded are current"]


def test_passes_that_fail_are_named_while_the_others_are_filed(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One routine ends the process, one does not compile; once mended only those two run."""
    first, second, third = (case.case_id for case in load_study("study.yaml").cases())
    routines = [place / "fe_inputs" / "small" / name / "vfric.f" for name in (first, second)]
    sound = routines[0].read_text(encoding="utf-8")
    routines[0].write_text(sound.replace("      return\n", "      call abort()\n      return\n"), encoding="utf-8")
    routines[1].write_text(sound.replace("      return\n", "      retrun\n"), encoding="utf-8")
    assert run(["run-references", "study.yaml", "--jobs", "1"]) == 3
    said = capsys.readouterr()
    assert f"{first}, failed: its process was ended by SIGABRT" in said.out
    assert f"{second}, failed: fe_inputs/small/{second}/vfric.f:" in said.out
    assert said.err == f"tread-validate: 2 passes failed: {first}, {second}\n"
    assert filed(place) == [third]
    for routine in routines:
        routine.write_text(sound, encoding="utf-8")
    assert run(["run-references", "study.yaml", "--jobs", "1"]) == 0
    assert f"2 of 2: {second}" in capsys.readouterr().out
    assert filed(place) == [first, second, third]


def test_an_interrupt_leaves_what_is_done_filed_and_nothing_half_written(place: Path) -> None:
    """Ctrl-C while a pass runs: code 130, no process stays, the next call goes on with the rest."""
    names = [case.case_id for case in load_study("study.yaml").cases()]
    slow = place / "fe_inputs" / "small" / names[2] / "vfric.f"  # the shortest pass comes last
    sound = slow.read_text(encoding="utf-8")
    slow.write_text(sound.replace("      return\n", "      call sleep(1)\n      return\n"), encoding="utf-8")
    verb = [str(Path(sys.executable).with_name("tread-validate")), "run-references", "study.yaml", "--jobs", "1"]
    command = ["env", "--default-signal=INT", *verb]  # a shell's background job, as CI may be, ignores the interrupt
    going = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
    assert going.stdout is not None
    for line in going.stdout:
        if line.startswith("2 of 3"):
            break
    time.sleep(1.0)
    os.killpg(going.pid, signal.SIGINT)
    going.stdout.close()
    assert going.wait(timeout=60) == 130
    assert gone(going.pid)
    assert filed(place) == names[:2]
    runs = place / "results" / "small" / "fe" / "reference"
    assert {path.name[: len(names[0])] for path in runs.iterdir()} == set(names[:2])
    slow.write_text(sound, encoding="utf-8")
    assert run(["run-references", "study.yaml", "--jobs", "1"]) == 0
    assert filed(place) == names


def test_a_finished_run_that_is_not_filed_is_not_run_again(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """References lost, runs kept: they are filed as they are; runs of another routine are not taken for today's."""
    assert run(["run-references", "study.yaml", "--references", "first"]) == 0
    routine = place / "fe_inputs" / "small" / load_study("study.yaml").cases()[0].case_id / "vfric.f"
    routine.write_text(routine.read_text().replace("      return\n", "      call flush(6)\n      return\n"))
    capsys.readouterr()
    assert run(["run-references", "study.yaml", "--references", "second"]) == 0
    said = capsys.readouterr().out
    assert said.count("was run before, filed") == 2
    assert "3 of 3 run and filed under second/fe" in said


def test_a_slower_road_and_a_finer_mesh_cost_more(place: Path) -> None:
    """The order in which passes begin: by contact time, and with the cube and more of the mesh."""
    slow, _, fast = load_study("study.yaml").cases()
    assert cost(slow) > cost(fast)
    data = yaml.safe_load(Path("study.yaml").read_text())
    data["deck"].update(element_size_mm=2.0, layers=4)
    Path("fine.yaml").write_text(yaml.safe_dump(data))
    assert cost(load_study("fine.yaml").cases()[2]) == pytest.approx(16.0 * cost(fast))


def test_a_verb_that_fails_leaves_its_process_to_the_next(tmp_path: Path) -> None:
    """Wrong input is told in its own line, with its own exit code, and the process goes on."""
    jobs = [
        VerbRun("bad", ("schema", "--none"), tmp_path / "bad.log"),
        VerbRun("good", ("fe", "--help"), tmp_path / "good.log"),
    ]
    bad, good = run_side_by_side(jobs, 1)
    assert (bad.code, good.code, good.fault) == (2, 0, "")
    assert "--none" in bad.fault
    assert "FE engine" in (tmp_path / "good.log").read_text(encoding="utf-8")
