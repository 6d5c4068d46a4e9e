"""Running a job, with an executable that stands in for ABAQUS."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tread_validate.errors import EngineError, InputError
from tread_validate.reference.abaqus import AbaqusSettings, load_settings, run_abaqus
from tread_validate.reference.abaqus.runner import routine_name

STAND_IN = Path(__file__).parent / "stand_in"
COMMAND = str(STAND_IN / "abaqus")


def plan(folder: Path, **more: object) -> None:
    path = folder / "stand_in.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), **more}))


def test_job_is_submitted_extracted_and_recorded(deck, user, work):
    said: list[str] = []
    imported = run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND, cpus=2), say=said.append)
    call = (work / "calls.txt").read_text()
    assert call == (
        "job=belt-22c-0p2mm-10mps input=belt-22c-0p2mm-10mps.inp user=vfric.f double=both cpus=2 "
        "ask_delete=OFF interactive\n"
    )
    assert imported.history.normal_force.max() == pytest.approx(200.0, rel=1e-3)
    assert imported.record["version"] == "Abaqus/Explicit 6.14-1"
    assert imported.record["slipping"].startswith("share of touching nodes")
    assert "deck_sha256: equal" in imported.record["checks"]
    assert "user_sha256: equal" in imported.record["checks"]


def test_queue_command_comes_first(deck, user, work, tmp_path):
    queue = tmp_path / "queue"
    queue.write_text('#!/bin/sh\necho "$@" > queued.txt\nshift\nexec "$@"\n')
    queue.chmod(0o755)
    run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND, queue=f"{queue} --wait"), say=lambda _: None)
    assert (work / "queued.txt").read_text().startswith("--wait " + COMMAND + " job=")


def test_missing_licence_is_waited_for(deck, user, work):
    """Two refusals, then a licence: two pauses of 60 s, no more."""
    plan(work, without_licence=2)
    pauses: list[float] = []
    imported = run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND), say=lambda _: None, sleep=pauses.append)
    assert pauses == [60.0, 60.0]
    assert imported.record["licence_wait_s"] >= 120.0


def test_wait_for_a_licence_ends(deck, user, work):
    plan(work, without_licence=99)
    pauses: list[float] = []
    settings = AbaqusSettings(command=COMMAND, licence_wait_s=200.0)
    with pytest.raises(EngineError, match="no licence within 200 s"):
        run_abaqus(deck, user, work, settings, say=lambda _: None, sleep=pauses.append)
    assert len(pauses) <= 3


@pytest.mark.parametrize(
    ("behaviour", "says"),
    [({"crash": True}, "user subroutines"), ({"incomplete": True}, "did not complete")],
)
def test_failed_job_is_an_engine_error_in_its_own_words(deck, user, work, behaviour, says):
    plan(work, **behaviour)
    with pytest.raises(EngineError, match=says):
        run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND), say=lambda _: None)


def test_failed_job_leaves_no_result_of_an_earlier_one(deck, user, work):
    """An .odb of a run before must not be taken for this run's."""
    run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND), say=lambda _: None)
    plan(work, crash=True)
    with pytest.raises(EngineError):
        run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND), say=lambda _: None)
    assert not list(work.glob("*.odb"))


def test_without_the_executable_the_way_round_is_named(deck, user, work):
    with pytest.raises(EngineError, match="import-abaqus"):
        run_abaqus(deck, user, work, AbaqusSettings(command="no-such-abaqus"), say=lambda _: None)


def test_job_that_hangs_is_stopped(deck, user, work, tmp_path):
    slow = tmp_path / "slow"
    slow.write_text("#!/bin/sh\nexec sleep 60\n")
    slow.chmod(0o755)
    with pytest.raises(EngineError, match="time_limit_s"):
        run_abaqus(deck, user, work, AbaqusSettings(command=str(slow), time_limit_s=0.5), say=lambda _: None)


def test_settings_file_is_checked(tmp_path):
    path = tmp_path / "engines.yaml"
    path.write_text("abaqus: {command: abq2023, licence_wait_s: 10}\n")
    assert load_settings(path).command == "abq2023"
    for text, says in (
        ("abaqus: {license_wait_s: 10}\n", "abaqus.license_wait_s"),
        ("abaqus: {cpus: 0}\n", "abaqus.cpus"),
        ("abaqus: [1]\n", "mapping"),
        ("abaqus: {\n", "YAML"),
    ):
        path.write_text(text)
        with pytest.raises(InputError, match=says):
            load_settings(path)


def test_files_that_the_deck_includes_go_with_the_job(deck, user, work):
    """The mesh lies beside the deck in its own file; the job finds it where the deck says."""
    text = deck.read_text()
    head, mesh = text.split("*NODE", 1)
    deck.with_name("mesh-block.inp").write_text("*NODE" + mesh.split("*STEP", 1)[0])
    deck.write_text(head + "*INCLUDE, INPUT=mesh-block.inp\n*STEP" + mesh.split("*STEP", 1)[1])
    plan(work, odb=json.loads((work / "stand_in.json").read_text())["odb"])
    run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND), say=lambda _: None)
    assert (work / "mesh-block.inp").read_text() == deck.with_name("mesh-block.inp").read_text()


def test_forces_of_half_a_block_are_doubled(deck, user, work):
    """A deck with a set SYMMETRY_PLANE models half the block: 200 N there are 400 N of the whole."""
    deck.write_text(deck.read_text().replace("*STEP", "*NSET, NSET=SYMMETRY_PLANE\n1\n*STEP", 1))
    imported = run_abaqus(deck, user, work, AbaqusSettings(command=COMMAND), say=lambda _: None)
    assert imported.history.normal_force.max() == pytest.approx(400.0, rel=1e-3)
    assert imported.record["symmetry"] == "half, forces doubled"


@pytest.mark.parametrize(
    ("user", "system", "called"),
    [
        ("vfric.f", "posix", "vfric.f"),
        ("vfric.f", "nt", "vfric.for"),
        ("vfriction.f", "nt", "vfriction.for"),
        ("v.obj", "nt", "v.obj"),
    ],
)
def test_a_routine_has_the_ending_that_the_system_expects(user, system, called):
    assert routine_name(Path(user), system) == called


@pytest.mark.parametrize(("variant", "routine"), [("-constant-friction", None), ("-general-contact", "vfriction.f")])
def test_a_case_s_other_decks_run_as_jobs_of_their_own_names(deck, user, work, variant, routine):
    """The heading is the case's; the job is the deck's name, and its routine is the one that is checked."""
    other = deck.with_name(f"{deck.stem}{variant}.inp")
    other.write_bytes(deck.read_bytes())
    own = None
    if routine is not None:
        own = user.with_name(routine)
        own.write_text(user.read_text() + "c     for general contact\n")
    imported = run_abaqus(other, own, work, AbaqusSettings(command=COMMAND), say=lambda _: None)
    call = (work / "calls.txt").read_text()
    assert call.startswith(f"job={other.stem} input={other.name} " + ("" if routine is None else f"user={routine} "))
    checks = imported.record["checks"]
    assert any(check.startswith(f"case id: job says {other.stem}") for check in checks)
    assert ("user_sha256: equal" in checks) == (routine is not None)
