"""A watch over native code that cannot be interrupted: it ends the process where nothing has moved for too long."""

from __future__ import annotations

import contextlib
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator


@contextlib.contextmanager
def watched(name: str, stall_limit: float, time_limit: float, code: int) -> Iterator[Callable[[], None]]:
    """Yield a function to be called whenever the work has moved; the watch begins with its first call.

    Parameters
    ----------
    name : str
        What is watched, for the one line that is printed.
    stall_limit, time_limit : float, s
        Longest time between two calls, and in all.
    code : int
        Exit code of the process where a limit is passed: a user's routine that loops for ever holds its thread, so
        the process ends at once, without writing anything.
    """
    begun = time.monotonic()
    last: list[float] = []
    done = threading.Event()

    def watch() -> None:
        while not done.wait(min(0.2, stall_limit / 4)):
            now = time.monotonic()
            stalled = bool(last) and now - last[0] > stall_limit
            if not stalled and now - begun <= time_limit:
                continue
            limit = f"no progress for {stall_limit:g} s (does the friction routine come back?)"
            limit = limit if stalled else f"not done after {time_limit:g} s"
            print(f"tread-validate: {name}: {limit}; nothing written", file=sys.stderr, flush=True)
            os._exit(code)

    thread = threading.Thread(target=watch, name="watchdog", daemon=True)
    thread.start()
    try:
        yield lambda: last.__setitem__(slice(None), [time.monotonic()])
    finally:
        done.set()
        thread.join()
