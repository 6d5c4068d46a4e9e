"""Progress of a run: a bar with the time left on a terminal, a line for every tenth otherwise."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import TextIO

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn


@contextlib.contextmanager
def shown_progress(name: str, stream: TextIO) -> Iterator[Callable[[float, float], None]]:
    """Yield a function of the share done (0..1) and the seconds left that shows both on `stream`."""
    if not stream.isatty():
        yield _Lines(name, stream)
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TextColumn("{task.fields[left]}"))
    with Progress(*columns, console=Console(file=stream), transient=True) as bar:
        task = bar.add_task(name, total=1.0, left="")

        def update(share: float, left: float) -> None:
            bar.update(task, completed=share, left=f"{left:.0f} s left")

        yield update


class _Lines:
    """Prints a line when another tenth is done."""

    def __init__(self, name: str, stream: TextIO) -> None:
        self.name = name
        self.stream = stream
        self.tenth = 0

    def __call__(self, share: float, left: float) -> None:
        tenth = int(10.0 * share + 1e-9)
        if tenth > self.tenth:
            self.tenth = tenth
            print(f"{self.name}: {10 * tenth} % done, {left:.0f} s left", file=self.stream, flush=True)
