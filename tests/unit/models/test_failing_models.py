"""A model that fails on a case loses that case only, with one line that says why."""

from __future__ import annotations

import json
import time

import pytest

GOOD = """
import json, sys
case = json.load(open(sys.argv[1]))
n = 50
end = case["expected_duration_s"]
rows = [(end * i / n, 100.0 * i * (n - i) / n**2, 0.0) for i in range(n + 1)]
"""
WRITE = """
with open(sys.argv[2], "w") as out:
    out.write("time_s,normal_force_N,tangential_force_N\\n")
    for row in rows:
        out.write(",".join(map(repr, row)) + "\\n")
"""
FIRST = "first = case['speed_m_s'] < 2.0\n"  # the first of the two cases

FAULTS = {
    "exits non-zero": ("if first: sys.exit('no such rubber')\n", "exit code 1: no such rubber"),
    "dies of a signal": ("import os\nif first: os.kill(os.getpid(), 9)\n", "signal SIGKILL"),
    "writes nothing": ("if first: sys.exit(0)\n", "got no history"),
    "writes NaN": ("if first: rows[7] = (rows[7][0], float('nan'), 0.0)\n", "normal_force, sample 8: got nan"),
    "writes infinity": ("if first: rows[7] = (rows[7][0], float('inf'), 0.0)\n", ":9: normal_force_N: got 'inf'"),
    "has compression negative": ("if first: rows = [(t, -n, q) for t, n, q in rows]\n", "expected compression to be"),
    "feels nothing": ("if first: rows = [(t, 0.0, q) for t, n, q in rows]\n", "no force at any time"),
    "stops half way": ("if first: rows = rows[:20]\n", "expected the whole pass"),
    "goes back in time": ("if first: rows[9] = rows[3]\n", "expected a time after the one before"),
    "writes one row": ("if first: rows = rows[:1]\n", "expected at least 2 samples"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_fault_of_one_case_is_one_line_and_the_other_case_runs(fault, run_script, tmp_path):
    source, said = FAULTS[fault]
    failed, ran = run_script(GOOD + FIRST + source + WRITE)
    assert (failed.status, ran.status) == ("failed", "ran")
    assert said in failed.message
    assert "\n" not in failed.message
    assert not (tmp_path / "out" / f"{failed.case_id}.csv").exists()
    assert (tmp_path / "out" / f"{ran.case_id}.csv").exists()


def test_model_that_hangs_is_ended_with_all_that_it_started(run_script):
    hang = "import subprocess, time\nif first:\n    subprocess.Popen(['sleep', '60'])\n    time.sleep(60)\n"
    started = time.monotonic()
    failed, ran = run_script(GOOD + FIRST + hang + WRITE, time_limit_s=1.0)
    assert time.monotonic() - started < 30.0
    assert "time limit of 1 s" in failed.message
    assert ran.status == "ran"


def test_history_that_says_it_is_of_another_case_is_refused(run_script):
    swapped = WRITE.replace(
        'out.write("time_s', 'out.write("# case_digest: " + "0" * 64 + "\\n")\n    out.write("time_s'
    )
    failed, _ = run_script(GOOD + swapped)
    assert "case_digest: got 000000000000" in failed.message


def test_history_of_a_failed_run_is_not_left_from_an_earlier_one(run_script, tmp_path):
    (first, _) = run_script(GOOD + WRITE)
    assert first.status == "ran"
    (again, _) = run_script("raise SystemExit(3)")
    assert again.status == "failed"
    assert list((tmp_path / "out").glob("*.csv")) == []


def test_run_for_all_cases_that_stops_half_way_keeps_what_it_has_computed(run_script):
    source = """
import json, os, sys
names = sorted(os.listdir(sys.argv[1]))
for count, name in enumerate(names):
    if count == 2:
        sys.exit("licence lost")
    case = json.load(open(os.path.join(sys.argv[1], name)))
    end = case["expected_duration_s"]
    with open(os.path.join(sys.argv[2], name.replace(".json", ".csv")), "w") as out:
        out.write("time_s,normal_force_N\\n0,0\\n%r,1\\n%r,0\\n" % (end / 2, end))
"""
    outcomes = run_script(source, cases=4, placeholders="{cases} {folder}")
    assert [outcome.status for outcome in outcomes] == ["ran", "ran", "failed", "failed"]
    assert "licence lost" in outcomes[3].message
    assert all(outcome.shared_run for outcome in outcomes)


def test_arguments_reach_the_program_as_they_are_and_no_shell_reads_them(run_script, tmp_path):
    source = GOOD + "assert sys.argv[3:] == ['$HOME', ';', 'touch', 'harm', 'a b'], sys.argv\n" + WRITE
    outcomes = run_script(source, placeholders="{case} {history} $HOME ; touch harm 'a b'")
    assert [outcome.message for outcome in outcomes] == ["", ""]
    assert not (tmp_path / "harm").exists()


def test_environment_and_working_folder_are_the_study_s(run_script, tmp_path):
    (tmp_path / "inner").mkdir()
    asks = "import os\nassert os.environ['MODULUS'] == '3'\nassert os.getcwd().endswith('inner')\n"
    outcomes = run_script(
        GOOD + asks + WRITE, script="../mine.py", environment={"MODULUS": "3"}, working_folder="inner"
    )
    assert [outcome.message for outcome in outcomes] == ["", ""]


def test_cost_is_the_processor_time_of_the_run(run_script):
    """0.3 s of processor time are asked for; starting Python adds some, and a loaded machine does not."""
    burn = "import time\nwhile time.process_time() < 0.3: pass\n"
    (outcome, _) = run_script(GOOD + burn + WRITE)
    assert outcome.cpu_s is not None
    assert 0.3 <= outcome.cpu_s < 1.5
    assert outcome.memory_MB is not None
    assert 3.0 < outcome.memory_MB < 100.0


def test_outcome_is_filed_beside_the_history(run_script, tmp_path):
    (outcome, _) = run_script(GOOD + WRITE)
    filed = json.loads((tmp_path / "out" / f"{outcome.case_id}.json").read_text())
    assert filed["case_digest"] == outcome.case_digest
    assert filed["code_digest"] == outcome.code_digest
