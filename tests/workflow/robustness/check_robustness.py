"""`make test-robustness`: kill -9 at random moments, two runs at once, full and read-only disks.

Usage: python tests/workflow/robustness/check_robustness.py [--kills 20] [--study FILE] [--seed 0]

Each kill starts from an empty folder, ends the whole process group, runs again to the end and compares every table and
the report's page with those of a run left alone. Full and read-only disks are small file systems in memory, which
takes root.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
BIN = Path(sys.executable).parent


class Folder:
    """A working folder with the workflow's inputs; the code stays where it is."""

    def __init__(self, path: Path, study: Path) -> None:
        self.path = path
        for name in ("config", "reference_data"):
            shutil.copytree(ROOT / name, path / name, ignore=shutil.ignore_patterns("fe"))
        shutil.copyfile(study, path / "config" / "study.yaml")

    def command(self) -> list[str]:
        """What `make report` runs, in this folder."""
        profile = str(ROOT / "workflow" / "profiles" / "default")
        call = ["sh", str(ROOT / "workflow" / "setup" / "locked.sh"), str(BIN / "snakemake")]
        call += ["--snakefile", str(ROOT / "Snakefile"), "--profile", profile, "--cores", "2"]
        return [*call, "--config", "study=config/study.yaml"]

    def start(self) -> subprocess.Popen[str]:
        environment = {**os.environ, "PATH": f"{BIN}{os.pathsep}{os.environ['PATH']}"}
        log = (self.path / "run.log").open("a")
        try:
            return subprocess.Popen(
                self.command(),
                cwd=self.path,
                env=environment,
                stdout=log,
                stderr=log,
                start_new_session=True,
                text=True,
            )
        finally:
            log.close()

    def finish(self) -> None:
        running = self.start()
        if running.wait(timeout=1800) != 0:
            raise SystemExit(f"a run failed: {self.path / 'run.log'}")

    def digests(self) -> dict[str, str]:
        """SHA-256 of every table and of the report's page."""
        name = "liu2010"
        files = [*(self.path / "results" / name / "tables").iterdir(), self.path / "reports" / name / "index.html"]
        return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}

    def leftovers(self) -> list[str]:
        """Half-written files that a finished run should not leave; hidden temporary ones are not taken for results."""
        folders = ("results", "reports", "fe_inputs")
        return [str(p) for f in folders for p in (self.path / f).rglob(".*") if p.is_file() and p.suffix != ".gitkeep"]

    def clean(self) -> None:
        for name in ("results", "reports", "fe_inputs", ".snakemake", "logs"):
            shutil.rmtree(self.path / name, ignore_errors=True)


def kills(folder: Folder, count: int, rng: random.Random) -> None:
    """Kill a run at random moments, run again, compare."""
    started = time.monotonic()
    folder.finish()
    whole = time.monotonic() - started
    expected = folder.digests()
    print(f"left alone: {whole:.0f} s, {len(expected)} files", flush=True)
    same = killed = 0
    while killed < count:
        folder.clean()
        begun = time.monotonic()
        running = folder.start()
        moment = rng.uniform(0.02, 0.98) * whole
        try:
            running.wait(timeout=moment)
            whole = time.monotonic() - begun  # faster than thought: not counted
            continue
        except subprocess.TimeoutExpired:
            os.killpg(running.pid, signal.SIGKILL)
            running.wait()
        killed += 1
        left = len(folder.leftovers())
        folder.finish()
        equal = folder.digests() == expected
        same += equal
        assessment = "same" if equal else "DIFFERENT"
        print(f"kill {killed}: at {moment:.1f} of {whole:.0f} s; {assessment}; {left} temporary file(s)", flush=True)
    print(f"kills: {same} of {count} gave the same tables and page", flush=True)
    if same != count:
        raise SystemExit(1)


def two_at_once(folder: Folder) -> None:
    """Start a second run while one is at work."""
    expected = folder.digests()
    folder.clean()
    first = folder.start()
    time.sleep(3.0)
    done = subprocess.run(folder.command(), cwd=folder.path, capture_output=True, text=True, timeout=600, check=False)
    line = done.stderr.strip()
    print(f"second run: exit code {done.returncode}: {line}", flush=True)
    if first.wait(timeout=1800) != 0 or folder.digests() != expected:
        raise SystemExit("the first run suffered")
    if done.returncode != 2 or "another run is at work" not in line or "\n" in line:
        raise SystemExit("the second run was not refused in one line")


def disks(folder: Path, study: Path) -> None:
    """Write decks and spring runs to a full and to a read-only file system."""
    if os.geteuid() != 0:
        raise SystemExit("full and read-only disks are checked as root only")
    for kind, options in (("full", "size=256k"), ("read-only", "size=256k,ro")):
        place = folder / kind
        place.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(place)], check=True)
        try:
            for verb in ("deck", "spring"):
                call = [str(BIN / "tread-validate"), verb, str(study), "--all", "-o", str(place / verb)]
                done = subprocess.run(call, capture_output=True, text=True, timeout=600, check=False)
                line = done.stderr.strip().splitlines()[-1:]
                empty = [p for p in place.rglob("*") if p.is_file() and p.stat().st_size == 0]
                print(f"{kind} disk, {verb}: exit code {done.returncode}: {' '.join(line)}", flush=True)
                if done.returncode != 2 or "Traceback" in done.stderr or empty:
                    raise SystemExit(f"{kind} disk, {verb}: {done.stderr[-500:]} {empty}")
        finally:
            subprocess.run(["umount", str(place)], check=True)


def main() -> int:
    """Run every check."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--study", type=Path, default=Path(__file__).with_name("study.yaml"))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="robustness-") as temporary:
        disks(Path(temporary), arguments.study.resolve())
        folder = Folder(Path(temporary) / "work", arguments.study)
        kills(folder, arguments.kills, random.Random(arguments.seed))
        two_at_once(folder)
    print("robust")
    return 0


if __name__ == "__main__":
    sys.exit(main())
