"""Running a deck in ABAQUS/Explicit where there is one: submit, wait for a licence, check the end, extract.

Nothing here has been run against ABAQUS itself; the tests use an executable that stands in for it. What a user with a
licence should look at first is listed in docs/own_data.md.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pydantic import Field

from ...errors import EngineError, one_line
from ...fields import NonNegative, Positive, Strict
from ...inp import read_deck
from ...model_file import as_model
from ...yaml_text import read_mapping
from .importer import Imported, import_history

EXTRACTION_SCRIPT = Path(__file__).parent / "scripts" / "extract_odb.py"
FINISHED = "THE ANALYSIS HAS COMPLETED SUCCESSFULLY"
NO_LICENCE = re.compile(
    r"licen[sc]e.{0,80}(not available|unavailable|denied|exceeded|insufficient|could not|failed|timed out|not found)"
    r"|(insufficient|not enough|no available).{0,40}(licen[sc]e|token)"
    r"|FLEXnet|FlexNet Licensing error",
    re.IGNORECASE | re.DOTALL,
)
TAIL = 4000  # characters of a log that are searched and shown


class AbaqusSettings(Strict):
    """How ABAQUS is called on this machine or cluster.

    `queue` is put before the call and must wait for the job to end, as ``srun`` or ``sbatch --wait`` do.
    """

    command: str = Field("abaqus", min_length=1, description="the executable, with fixed arguments where needed")
    queue: str = Field("", description="command put before it, such as `srun --licenses=abaqus:5`")
    arguments: str = Field("double=both", description="further job arguments")
    cpus: int = Field(1, ge=1, le=1024)
    licence_wait_s: NonNegative = Field(3600.0, description="how long to try again while there is no licence token")
    licence_retry_s: Positive = Field(60.0, description="pause between two tries")
    time_limit_s: Positive = Field(86_400.0, description="longest time of one try")


@dataclass(frozen=True)
class _Try:
    code: int
    text: str


def load_settings(path: Path | str | None) -> AbaqusSettings:
    """Read the ``abaqus`` section of an engine settings file (YAML); defaults without a file.

    Raises
    ------
    InputError
        An unknown key or a value out of range.
    """
    if path is None:
        return AbaqusSettings.model_validate({})
    return as_model(read_mapping(path).get("abaqus", {}), AbaqusSettings, path, "abaqus")


def run_abaqus(
    deck: Path | str,
    user: Path | str | None,
    folder: Path | str,
    settings: AbaqusSettings,
    *,
    say: Callable[[str], None] = print,
    sleep: Callable[[float], None] = time.sleep,
    clock: Callable[[], float] = time.monotonic,
) -> Imported:
    """Run a deck and return its checked history and record.

    Parameters
    ----------
    deck, user : path
        The deck and, where it asks for one, its friction routine.
    folder : path
        Working folder; made where missing. The job's files stay there.
    settings : Settings
    say : function of one line
        Progress.

    Raises
    ------
    EngineError
        No executable, no licence within the wait, an analysis that did not complete, an extraction that failed.
    InputError
        A result that does not fit its deck.
    """
    source = Path(deck)
    command = shlex.split(settings.command)
    if shutil.which(command[0]) is None:
        raise EngineError(
            f"no executable {command[0]}: run {source.name} on a machine that has ABAQUS and bring the forces back "
            "with `tread-validate import-abaqus`"
        )
    work = Path(folder)
    work.mkdir(parents=True, exist_ok=True)
    job = source.stem
    _copy(source, work / source.name)
    for included in read_deck(source).files[1:]:
        _copy(included, work / included.relative_to(source.resolve().parent))
    arguments = [f"job={job}", f"input={source.name}"]
    if user is not None:
        routine = routine_name(Path(user), os.name)
        _copy(Path(user), work / routine)
        arguments.append(f"user={routine}")
    arguments += [*shlex.split(settings.arguments), f"cpus={settings.cpus}", "ask_delete=OFF", "interactive"]
    started = clock()
    waited = _solve([*shlex.split(settings.queue), *command, *arguments], work, job, settings, say, sleep, clock)
    wall = clock() - started - waited
    _check_finished(work, job)
    table = work / f"{job}_forces.csv"
    table.unlink(missing_ok=True)
    say(f"{job}: extracting forces")
    done = _call([*command, "python", str(EXTRACTION_SCRIPT), f"{job}.odb", "-o", table.name], work, settings)
    if done.code != 0 or not table.is_file():
        raise EngineError(f"{job}: extraction failed (exit code {done.code}): {one_line(done.text[-300:])}")
    imported = import_history(table, source, user)
    record = {
        **imported.record,
        "imported": False,
        "arguments": " ".join(arguments),
        "wall_time_s": round(wall, 3),
        "licence_wait_s": round(waited, 3),
    }
    return Imported(imported.history, record)


def routine_name(user: Path, system: str) -> str:
    """Return what a Fortran source is called on a system (`os.name`): on Windows ABAQUS takes ``.for``, else ``.f``."""
    return user.with_suffix(".for").name if system == "nt" and user.suffix == ".f" else user.name


def _solve(
    call: list[str],
    work: Path,
    job: str,
    settings: AbaqusSettings,
    say: Callable[[str], None],
    sleep: Callable[[float], None],
    clock: Callable[[], float],
) -> float:
    """Run the job, again as long as there is no licence; return the time spent waiting, s."""
    waited = 0.0
    while True:
        for stale in (f"{job}.odb", f"{job}.sta", f"{job}.lck"):
            (work / stale).unlink(missing_ok=True)
        say(f"{job}: {shlex.join(call)}")
        before = clock()
        done = _call(call, work, settings)
        if done.code == 0:
            return waited
        log = done.text[-TAIL:] + _tail(work / f"{job}.log")
        if not NO_LICENCE.search(log):
            raise EngineError(f"{job}: ABAQUS ended with exit code {done.code}: {one_line(log[-300:])}")
        waited += clock() - before
        if waited + settings.licence_retry_s > settings.licence_wait_s:
            raise EngineError(f"{job}: no licence within {settings.licence_wait_s:g} s (licence_wait_s)")
        say(f"{job}: no licence yet, next try in {settings.licence_retry_s:g} s")
        sleep(settings.licence_retry_s)
        waited += settings.licence_retry_s


def _call(call: list[str], work: Path, settings: AbaqusSettings) -> _Try:
    try:
        done = subprocess.run(
            call,
            cwd=work,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=settings.time_limit_s,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise EngineError(f"{shlex.join(call[:3])}: longer than {settings.time_limit_s:g} s (time_limit_s)") from None
    except OSError as error:
        raise EngineError(f"{call[0]}: {error.strerror}") from None
    return _Try(done.returncode, done.stdout.decode("utf-8", errors="replace"))


def _check_finished(work: Path, job: str) -> None:
    status = _tail(work / f"{job}.sta")
    if FINISHED not in status:
        last = status.strip().splitlines()[-1] if status.strip() else "no status file"
        raise EngineError(f"{job}: the analysis did not complete; {job}.sta ends with: {one_line(last, 200)}")
    if not (work / f"{job}.odb").is_file():
        raise EngineError(f"{job}: no {job}.odb in {work}")


def _tail(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace")[-TAIL:] if path.is_file() else ""


def _copy(source: Path, target: Path) -> None:
    if source.resolve() != target.resolve():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
