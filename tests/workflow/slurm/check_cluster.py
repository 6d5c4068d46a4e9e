"""`make test-cluster`: a 200-run study locally and through sbatch, one job killed and resumed; the tables are the same.

Usage: python tests/workflow/slurm/check_cluster.py [--passes 200] [--folder DIR]

`--passes` says how many of the 200 cases the FE engine runs as well (spring model, decks and tables always take all).
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from cluster import one_node

from tread_validate.study import load_study

ROOT = Path(__file__).resolve().parents[3]
STUDY = Path(__file__).with_name("study.yaml").relative_to(ROOT)
SNAKEMAKE = [sys.executable, "-m", "snakemake"]
GROUP = 12  # FE passes to a job in this test


class Side:
    """One of the two ways to run the study, with folders of its own."""

    def __init__(self, name: str, folder: Path, passes: list[str]) -> None:
        self.name = name
        self.folder = folder / name
        self.results = self.folder / "results"
        self.references = self.folder / "reference_data"
        shutil.copytree(ROOT / "reference_data", self.references, ignore=shutil.ignore_patterns("fe"))
        own = self.results / load_study(STUDY).model.name
        self.fe = [str(own / "fe" / "embedded" / f"{case}.csv") for case in passes]
        self.tables_folder = own / "tables"
        self.tables = str(self.tables_folder / "errors.csv")

    def call(self, profile: list[str], targets: list[str], log: str, environment: dict[str, str]) -> int:
        """Run Snakemake to the end and return its exit code."""
        with (self.folder / log).open("w") as stream:
            return subprocess.run(
                self.command(profile, targets), cwd=ROOT, env=environment, stdout=stream, stderr=stream, check=False
            ).returncode

    def command(self, profile: list[str], targets: list[str]) -> list[str]:
        config = [f"study={STUDY}", f"decks={self.folder / 'fe_inputs'}", f"results={self.results}"]
        config += [f"references={self.references}", f"reports={self.folder / 'reports'}"]
        config += [f"logs={self.folder / 'logs'}"]
        return [*SNAKEMAKE, *profile, "--nolock", "--config", *config, "--", *targets]

    def file_references(self) -> None:
        """File the FE runs as references of their cases."""
        decks = self.folder / "fe_inputs" / load_study(STUDY).model.name
        call = ["tread-validate", "file-references", *self.fe, "--references", str(self.references)]
        call += ["--decks", str(decks)]
        subprocess.run(call, check=True, stdout=subprocess.DEVNULL)


def queue(environment: dict[str, str]) -> list[list[str]]:
    """Return job id, state and name of every job that Slurm knows."""
    call = ["squeue", "-h", "-t", "all", "-o", "%i %T %j"]
    done = subprocess.run(call, env=environment, capture_output=True, text=True, timeout=60, check=True)
    return [line.split(maxsplit=2) for line in done.stdout.splitlines()]


def kill_one(side: Side, slurm: list[str], environment: dict[str, str]) -> tuple[int, int]:
    """Start the FE passes, cancel a job that has finished some of its passes; return exit code and passes done."""
    with (side.folder / "killed.log").open("w") as stream:
        call = side.command([*slurm, "--retries", "0"], side.fe)
        running = subprocess.Popen(call, cwd=ROOT, env=environment, stdout=stream, stderr=stream)
        while running.poll() is None:
            if sum(Path(path).is_file() for path in side.fe) >= 2:
                active = [job for job, state, _ in queue(environment) if state == "RUNNING"]
                subprocess.run(["scancel", "--signal=KILL", "--full", active[0]], env=environment, check=True)
                subprocess.run(["scancel", active[0]], env=environment, check=True)
                print(f"slurm: cancelled job {active[0]}", flush=True)
                break
            time.sleep(0.5)
        code = running.wait()
    return code, sum(Path(path).is_file() for path in side.fe)


def main() -> int:
    """Run both sides and compare."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--passes", type=int, default=200)
    parser.add_argument("--folder", type=Path)
    arguments = parser.parse_args()
    os.chdir(ROOT)
    folder = arguments.folder or Path(tempfile.mkdtemp(prefix="cluster-"))
    folder.mkdir(parents=True, exist_ok=True)
    cases = [case.case_id for case in load_study(STUDY).cases()]
    passes = cases[:: max(1, len(cases) // arguments.passes)][: arguments.passes]
    path = str(Path(sys.executable).parent) + os.pathsep + os.environ["PATH"]
    plain = {**os.environ, "PATH": path}
    os.environ["PATH"] = path
    local, remote = Side("local", folder, passes), Side("slurm", folder, passes)
    cores = os.cpu_count() or 1
    here = ["--profile", "workflow/profiles/default", "--cores", str(cores)]

    started = time.monotonic()
    if local.call(here, [local.tables, *local.fe], "run.log", plain) != 0:
        raise SystemExit(f"the local run failed: {local.folder / 'run.log'}")
    local.file_references()
    if local.call(here, [local.tables], "tables.log", plain) != 0:
        raise SystemExit(f"the local tables failed: {local.folder / 'tables.log'}")
    print(f"local: {len(cases)} cases, {len(passes)} FE passes in {time.monotonic() - started:.0f} s", flush=True)

    with one_node(folder / "cluster", cores) as slurm_environment:
        environment = {**plain, **slurm_environment}
        environment["PATH"] = path + os.pathsep + "/usr/sbin"
        slurm = ["--profile", "workflow/profiles/slurm", "--slurm-status-command", "squeue"]
        slurm += ["--default-resources", "mem_mb=1500", "runtime=15", "slurm_partition=main"]
        slurm += ["--group-components", f"passes={GROUP}", "--seconds-between-status-checks", "5"]
        slurm += ["--slurm-no-account", "--slurm-init-seconds-before-status-checks", "5"]
        started = time.monotonic()
        code, done = kill_one(remote, slurm, environment)
        print(f"slurm: stopped with code {code}, {done} of {len(passes)} FE passes done", flush=True)
        if code == 0 or not 0 < done < len(passes):
            raise SystemExit("the cancelled job did not stop the run half way")
        if remote.call(slurm, [remote.tables, *remote.fe], "resumed.log", environment) != 0:
            raise SystemExit(f"the resumed run failed: {remote.folder / 'resumed.log'}")
        remote.file_references()
        if remote.call(slurm, [remote.tables], "tables.log", environment) != 0:
            raise SystemExit(f"the tables failed: {remote.folder / 'tables.log'}")
        jobs = queue(environment)
        seconds = time.monotonic() - started
    states: dict[str, int] = {}
    for _, state, _ in jobs:
        states[state] = states.get(state, 0) + 1
    print(f"slurm: {len(jobs)} jobs {states} in {seconds:.0f} s", flush=True)
    return compare(local, remote)


def compare(local: Side, remote: Side) -> int:
    """Print and return whether every table is the same to the byte."""
    names = sorted(path.name for path in local.tables_folder.iterdir())
    others = sorted(path.name for path in remote.tables_folder.iterdir())
    different = [
        name
        for name in names
        if name in others and (local.tables_folder / name).read_bytes() != (remote.tables_folder / name).read_bytes()
    ]
    if names != others or different:
        print(f"tables differ: {different or set(names) ^ set(others)}")
        return 1
    print(f"{len(names)} tables, byte-identical")
    return 0


if __name__ == "__main__":
    sys.exit(main())
