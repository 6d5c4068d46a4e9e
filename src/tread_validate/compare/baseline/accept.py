"""Making a set of tables the baseline: a separate, explicit act with a reason."""

from __future__ import annotations

import datetime
import getpass
import os
import subprocess
from pathlib import Path

from ...errors import InputError, one_line
from ...provenance import commit, version
from ..tables import PeakRow, read_rows
from ..tables.made_from import PROVENANCE, read_made_from
from .delta import BROKEN
from .histories import histories_text
from .store import Acceptance, Baseline, save_baseline
from .trend import add_to_trend

SHORTEST_REASON = 8


def accept(
    tables: Path | str,
    folder: Path | str,
    reason: str,
    *,
    who: str | None = None,
    when: str | None = None,
    allow_dirty: bool = False,
    allow_stale: bool = False,
    references: Path | str = "reference_data",
) -> Baseline:
    """Write the tables as the baseline in `folder`, append their headline numbers to its trend, and return it.

    Thinned histories of the runs go with them; `references` is where those of the FE runs lie.

    Raises
    ------
    InputError
        For a reason that says nothing; a working tree with uncommitted changes, or tables made by other code than
        that of the commit, unless `allow_dirty`; rows that are stale or corrupt, unless `allow_stale` (`check` goes
        on failing for them).
    """
    if len(one_line(reason).strip()) < SHORTEST_REASON:
        raise InputError("--reason", repr(one_line(reason)), f"a reason of {SHORTEST_REASON} characters or more")
    facts = read_made_from(tables)
    made_by = facts.commit
    if not allow_dirty:
        changed = uncommitted(Path(folder))
        if changed:
            found = f"{len(changed)} uncommitted changes, first {changed[0]}"
            raise InputError("working tree", found, "a clean tree, or --allow-dirty")
        if made_by != commit():
            raise InputError(Path(tables) / PROVENANCE, f"tables of commit {made_by}", f"{commit()}, or --allow-dirty")
    broken = [row for row in read_rows(Path(tables) / "peaks.csv", PeakRow) if row.status in BROKEN]
    if broken and not allow_stale:
        first = broken[0]
        raise InputError(
            f"{tables}: {first.source}, {first.case_id}",
            f"{first.status} ({len(broken)} such runs)",
            "current runs and references, or --allow-stale",
        )
    acceptance = Acceptance(
        reason=one_line(reason),
        who=one_line(who or author()),
        when=when or datetime.datetime.now(datetime.UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        commit=made_by,
        version=version(),
        study=facts.study,
        study_digest=facts.study_digest,
    )
    made = save_baseline(folder, tables, acceptance, histories_text(Path(tables), Path(references)))
    add_to_trend(folder, tables, acceptance)
    return made


def uncommitted(folder: Path) -> tuple[str, ...]:
    """Return tracked files with uncommitted changes, those of the baseline itself apart.

    Outside a git repository nothing can be told: `InputError`.
    """
    inside = Path(os.path.abspath(folder))
    lines = _git("status", "--porcelain", "--untracked-files=no")
    top = Path(_git("rev-parse", "--show-toplevel").strip())
    names = [line[3:].split(" -> ")[-1].strip('"') for line in lines.splitlines() if line.strip()]
    return tuple(name for name in names if inside not in (top / name).parents)


def author() -> str:
    """Return who accepts: git's user name, else the login name."""
    try:
        return _git("config", "user.name").strip() or getpass.getuser()
    except InputError:
        return getpass.getuser()


def _git(*arguments: str) -> str:
    environment = {**os.environ, "GIT_OPTIONAL_LOCKS": "0"}
    try:
        done = subprocess.run(
            ["git", *arguments], check=True, capture_output=True, text=True, timeout=20, env=environment
        )
    except (OSError, subprocess.SubprocessError):
        raise InputError("working tree", "no git repository here", "a git checkout, or --allow-dirty") from None
    return done.stdout
