"""The page that lists the studies reported here, with what each comes to."""

from __future__ import annotations

import html
import json
from collections.abc import Sequence
from pathlib import Path

from ..errors import InputError
from ..files import read_text, write_text

ASSESSMENT = "assessment.json"
HEAD = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Tread-block validation reports</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; max-width: 50rem; margin: 2rem auto; padding: 0 1rem; color: #1f2328; }
h2 { font-size: 1.1rem; margin: 1.6rem 0 .2rem; }
ul { margin: 0; padding-left: 1.2rem; }
@media (prefers-color-scheme: dark) { body { background: #0d1117; color: #e6edf3; } a { color: #6cb6ff; } }
</style>
</head>
<body>
<h1>Tread-block validation reports</h1>
"""


def write_landing(reports: Path, own: Path, title: str, lines: Sequence[str]) -> Path:
    """Keep a study's assessment beside its report and list all studies in ``index.html`` of the reports' folder."""
    facts = {"study": own.name, "title": title, "lines": list(lines)}
    write_text(own / ASSESSMENT, json.dumps(facts, indent=2, ensure_ascii=False) + "\n")
    parts = [HEAD]
    for file in sorted(reports.glob(f"*/{ASSESSMENT}")):
        name = file.parent.name
        if not (file.parent / "index.html").is_file():
            continue
        found = _read(file)
        parts.append(f'<h2><a href="{html.escape(name)}/index.html">{html.escape(name)}</a>: ')
        parts.append(f"{html.escape(str(found.get('title', '')))}</h2>\n<ul>\n")
        parts += [f"<li>{html.escape(line)}</li>\n" for line in _lines(found)]
        parts.append(f'</ul>\n<p><a href="{html.escape(name)}/report.pdf">report.pdf</a></p>\n')
    parts.append("</body>\n</html>\n")
    target = reports / "index.html"
    write_text(target, "".join(parts))
    return target


def _lines(found: dict[str, object]) -> list[str]:
    lines = found.get("lines")
    return [str(line) for line in lines] if isinstance(lines, list) else []


def _read(file: Path) -> dict[str, object]:
    try:
        data = json.loads(read_text(file))
    except (ValueError, InputError):
        return {"lines": ["its assessment cannot be read: make its report anew"]}
    return data if isinstance(data, dict) else {}
