"""The process in which a Python model runs: a case file in, a history file out, one line of JSON each way.

``python -m tread_validate.models.python_worker package.module:function``; what the function prints goes to the log.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import json
import os
import resource
import sys
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, TextIO

from ..case_file.document import CaseFile
from ..case_file.io import read_case
from ..errors import InputError, TreadValidateError, one_line
from ..units import MEGABYTE
from .checks import as_history

GROUP = "tread_validate.models"
"""The entry-point group of installed models."""

Function = Callable[[CaseFile], Any]


def resolve(name: str) -> Function:
    """Return the function that ``package.module:function``, or an entry point, names; raises `InputError`."""
    if ":" not in name:
        found = [point for point in importlib.metadata.entry_points(group=GROUP) if point.name == name]
        if not found:
            raise InputError("entry_point", name, f"an entry point of the group {GROUP}, in an installed package")
        name = found[0].value
    module_name, _, path = name.partition(":")
    try:
        item: Any = importlib.import_module(module_name)
        for part in path.split("."):
            item = getattr(item, part)
    except (ImportError, AttributeError) as error:
        raise InputError("object", name, f"a function that can be imported ({error})") from None
    if not callable(item):
        raise InputError("object", name, "a function")
    return item  # type: ignore[no-any-return]  # callable is all that is known of it


def main() -> None:
    """Answer the parent's requests until it closes the pipe."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # whatever the model prints is log, never an answer
    try:
        function = resolve(sys.argv[1])
    except Exception as error:  # the model's module may fail in any way while it is imported
        _say(answers, {"ready": False, "message": _message(error)})
        return
    _say(answers, {"ready": True})
    for line in sys.stdin:
        request = json.loads(line)
        _say(answers, _run(function, Path(request["case"]), Path(request["history"])))


def _run(function: Function, case: Path, target: Path) -> dict[str, Any]:
    started = time.process_time()
    try:
        history = as_history(function(read_case(case)))
    except Exception as error:  # the model's own code may raise anything: its case has failed, the others go on
        if not isinstance(error, TreadValidateError):
            traceback.print_exc()
        return {"ok": False, "message": _message(error), **_cost(started)}
    cost = _cost(started)
    history.write_csv(target)
    return {"ok": True, **cost}


def _cost(started: float) -> dict[str, float]:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return {"cpu_s": time.process_time() - started, "memory_MB": peak / MEGABYTE}


def _message(error: Exception) -> str:
    text = str(error)
    return one_line(text if isinstance(error, TreadValidateError) else f"{type(error).__name__}: {text}", 200)


def _say(stream: TextIO, answer: dict[str, Any]) -> None:
    sys.stdout.flush()  # the log is whole when the answer is there: the parent may end this process at any time after
    stream.write(json.dumps(answer) + "\n")
    stream.flush()


if __name__ == "__main__":
    main()
