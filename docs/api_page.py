"""The page of the front door, from its docstrings."""

from __future__ import annotations

import inspect
import re

import tread_validate as tv
from tread_validate.history import History

PARAMETER = re.compile(r"[a-z_][\w, ]* : ")
METHODS = ("of", "read_csv", "write_csv", "to_frame", "plot")


def api_page() -> str:
    """Return docs/generated/api.md: every name of the front door with its signature and docstring."""
    parts = [
        "# The front door: `import tread_validate as tv`",
        "`import tread_validate` loads nothing else; each name loads its part of the package when it is first used. "
        "The examples are run by the tests, from the top of a clone.",
    ]
    for name in tv.__all__:
        item = getattr(tv, name)
        if inspect.isclass(item):
            parts += [f"## `tv.{name}`", _doc(item)]
        elif not isinstance(item, str):
            function = getattr(__import__("tread_validate.api", fromlist=[name]), name)
            parts += [f"## `tv.{name}{_signature(function)}`", _doc(function)]
    parts += ["## Of a `History`"]
    for name in METHODS:
        method = getattr(History, name)
        parts += [f"### `{name}{_signature(method)}`", _doc(method)]
    return "\n\n".join(parts) + "\n"


def _signature(function: object) -> str:
    return str(inspect.signature(function)).replace("'", "")  # type: ignore[arg-type]


def _doc(item: object) -> str:
    """Return a docstring as Markdown: examples and tables of parameters as they stand."""
    lines, out, code = (inspect.getdoc(item) or "").splitlines(), [], False
    underlined = {index for index, line in enumerate(lines) if line and set(line) == {"-"}}
    for index, line in enumerate(lines):
        block = line.startswith((">>>", "...")) or (code and line.strip() != "")
        if block != code:
            out += ["```python" if block else "```", *([] if block else [""])]
            code = block
        if index in underlined:
            continue
        if not code and PARAMETER.match(line):
            line = f"- `{line}`"
        out.append(f"**{line}**\n" if index + 1 in underlined else line.replace("``", "`") if not code else line)
    return "\n".join([*out, *(["```"] if code else [])])


if __name__ == "__main__":
    print(api_page())
