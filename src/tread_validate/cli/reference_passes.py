"""The passes of all outstanding references, run side by side and filed one by one as they end."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from ..errors import InputError
from ..files import write_text
from ..inp import deck_files
from ..reference import FeStore
from ..reference.filing import FinishedRun, drop_unused_blocks, file_run
from ..reference.outstanding import cost, made_today, outstanding
from ..study import Case, LoadedStudy
from .side_by_side import Done, VerbRun, run_side_by_side

ENGINE = "embedded"


@dataclass(frozen=True)
class Places:
    """Folders of decks (read), runs, and logs (``fe/ID.log``, ``benchmarks/fe/ID.tsv``)."""

    decks: Path
    runs: Path
    logs: Path

    def run(self, case_id: str) -> FinishedRun | None:
        """Return a case's run where it is whole, of today's deck and code."""
        return made_today(self.runs / f"{case_id}.csv", deck_files(self.decks, case_id), ENGINE)

    def job(self, case: Case) -> VerbRun:
        """Return the run of a case as `tread-validate fe`."""
        name, deck = case.case_id, deck_files(self.decks, case.case_id)
        arguments = ("fe", str(deck.deck), "--user", str(deck.user), "-o", str(self.runs / f"{name}.csv"))
        return VerbRun(name, arguments, self.logs / "fe" / f"{name}.log")

    def write_times(self, done: Done) -> None:
        """Write a job's wall and processor seconds and its memory in MB, as the workflow's benchmarks are written."""
        values = (done.seconds, done.memory, done.cpu_seconds)
        cells = "\t".join(f"{value:.4f}" if value == value else "NA" for value in values)
        write_text(self.logs / "benchmarks" / "fe" / f"{done.job.name}.tsv", f"s\tmax_rss\tcpu_time\n{cells}\n")


@dataclass
class Filing:
    """Files runs, and says after each case how many are done and how long the rest will take.

    Attributes
    ----------
    left : dict
        Cost of every case that is not done, by its id.
    failures, refused : list of str
        Cases whose pass failed; cases whose run differs from the filed one beyond noise.
    """

    store: FeStore
    study: str
    replace: bool
    say: Callable[[str], None]
    left: dict[str, float]
    filed: int = 0
    failures: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)
    cases: int = field(init=False)
    spent: float = 0.0
    begun: float = 0.0

    def __post_init__(self) -> None:
        self.cases = len(self.left)

    def begin(self) -> None:
        """Take note that passes begin to run."""
        self.begun = monotonic()

    def file(self, name: str, run: FinishedRun, how: str) -> None:
        """File a run; `how` it came about is said."""
        try:
            file_run(self.store, run, study=self.study, replace=self.replace)
        except InputError as error:
            self.refused.append(name)
            self._tell(name, f"{how}, not filed: {error}")
        else:
            self.filed += 1
            self._tell(name, f"{how}, filed")

    def failed(self, done: Done) -> None:
        """Say that a case has no run, and why."""
        self.failures.append(done.job.name)
        self._tell(done.job.name, f"failed: {done.fault or 'its run is not of its deck'}")

    def _tell(self, name: str, how: str) -> None:
        cost_of_it, time_left = self.left.pop(name), ""
        if self.begun:
            self.spent += cost_of_it
            rest = (monotonic() - self.begun) * sum(self.left.values()) / self.spent
            time_left = f"; about {rest:.0f} s to go" if self.left else ""
        self.say(f"{self.cases - len(self.left)} of {self.cases}: {name}, {how}{time_left}")


def run_outstanding(
    study: LoadedStudy, store: FeStore, places: Places, *, jobs: int, replace: bool, say: Callable[[str], None]
) -> Filing:
    """Run and file what is outstanding, the longest first so that no process is left alone at the end.

    Parameters
    ----------
    jobs : int
        Processes side by side.
    replace : bool
        Whether a run may take the place of a filed one that differs beyond noise.
    say : callable
        Told why each case is to run, and a line as each ends.

    Returns
    -------
    Filing
        With what failed or was refused.
    """
    cases = study.cases()
    wanted = outstanding(store, ENGINE, cases, places.decks)
    for case, reference in wanted:
        say(f"{case.case_id}: {reference.status.replace('_', ' ')}, {reference.reason}")
    say(f"{len(cases) - len(wanted)} of {len(cases)} references of engine {ENGINE} are current")
    progress = Filing(store, study.model.name, replace, say, {case.case_id: cost(case) for case, _ in wanted})
    todo = list[Case]()
    for case, _ in wanted:
        run = places.run(case.case_id)
        if run is None:
            todo.append(case)
        else:
            progress.file(case.case_id, run, "was run before")
    todo.sort(key=lambda case: -progress.left[case.case_id])
    progress.begin()
    with closing(run_side_by_side([places.job(case) for case in todo], jobs)) as ended:
        for done in ended:
            places.write_times(done)
            run = None if done.fault else places.run(done.job.name)
            if run is None:
                progress.failed(done)
            else:
                progress.file(done.job.name, run, f"{done.seconds:.1f} s")
    drop_unused_blocks(store)
    if wanted:
        say(f"{progress.filed} of {len(wanted)} run and filed under {store.root}")
    return progress
