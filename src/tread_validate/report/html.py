"""The report as one self-contained HTML page."""

from __future__ import annotations

import base64
import hashlib
import itertools
import json
import re
import zlib
from collections.abc import Iterable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from .content import Figures, FirstScreen, Report, Row, Table
from .marks import by_origin

SCRIPTS = (
    "start.js",
    "svg.js",
    "figures.js",
    "chart.js",
    "chart_reader.js",
    "filter.js",
    "sort.js",
    "browser.js",
    "heatmap.js",
    "scatter.js",
    "end.js",
)


def render(report: Report) -> str:
    """Return the page's text: every asset inside, no address outside itself.

    The page's Content-Security-Policy names its one script by its SHA-256 and allows no connection, so markup that
    came in with a study could neither run nor call out even if it were not escaped, which it is. What is not needed at
    once (histories, figures, folded tables) lies in the page deflated, and is inflated when it is asked for.
    """
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(str(_templates())),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(
        by_origin=by_origin, groups=_groups, kind=lambda item: type(item).__name__, data_uri=_data_uri, shape=_shape
    )
    data = {
        **_packed(report.page_data),
        "figures": _figures(report),
        "numbers": _numbers(report),
        "tables": _folded(report, environment),
    }
    script = "\n".join(_asset(name) for name in SCRIPTS)
    return (
        environment.get_template("index.html.j2")
        .render(
            report=report,
            style=Markup(_asset("style.css")),
            data=embed_json(data),
            script=Markup(script),
            policy=_policy(script),
        )
        .lstrip()
    )


def embed_json(data: Any) -> Markup:
    """Return `data` as JSON that is safe inside a script element: no ``<``, ``>``, ``&`` or line separators."""
    text = json.dumps(data, ensure_ascii=True, separators=(",", ":"), sort_keys=True, allow_nan=False)
    for sign in "<>&":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return Markup(text)


def deflated(text: str) -> str:
    """Return a text as base64 of its raw deflate stream, as the page inflates it."""
    packer = zlib.compressobj(9, wbits=-15)
    return base64.b64encode(packer.compress(text.encode("utf-8")) + packer.flush()).decode("ascii")


def _packed(data: Mapping[str, Any]) -> dict[str, Any]:
    """Return the page's data with what its charts need deflated."""
    return {
        key: deflated(str(embed_json(value))) if key in ("heat", "scatter") else value for key, value in data.items()
    }


def _figures(report: Report) -> dict[str, str]:
    """Return every figure that the page shows below its first screen, deflated."""
    drawn = [item for section in report.sections for item in section.items if isinstance(item, Figures)]
    shown = [figure for item in drawn if not item.pdf_only for figure in item.items]
    return {figure.key: deflated(figure.svg.read_text(encoding="utf-8")) for figure in shown}


def _numbers(report: Report) -> dict[str, str]:
    """Return the numbers behind every figure that the page shows, as deflated CSV."""
    items = [item for section in report.sections for item in section.items]
    shown = [figure for item in items if isinstance(item, Figures) and not item.pdf_only for figure in item.items]
    shown += [item.picture for item in items if isinstance(item, FirstScreen) and item.picture is not None]
    return {figure.key: deflated(figure.data.read_text(encoding="utf-8")) for figure in shown if figure.data}


def _folded(report: Report, environment: jinja2.Environment) -> dict[str, str]:
    """Return the HTML of every table that is folded away, deflated."""
    set_table = environment.get_template("macros.html.j2").module.table  # type: ignore[attr-defined]  # jinja2 makes the module at run time
    tables = [item for section in report.sections for item in section.items if isinstance(item, Table) and item.folded]
    return {table.key: deflated(str(set_table(table))) for table in tables}


def _shape(path: Path) -> str:
    """Return the style that keeps an SVG's place, so that the page does not move when it is drawn."""
    found = re.search(r'<svg [^>]*?width="([0-9.]+)pt" height="([0-9.]+)pt"', path.read_text(encoding="utf-8"))
    if found is None:
        return ""
    width, height = (round(float(text)) for text in found.groups())
    return f"aspect-ratio: {width} / {height}"


def _groups(rows: Iterable[Row]) -> list[tuple[str, list[Row]]]:
    return [(name, list(members)) for name, members in itertools.groupby(rows, key=lambda row: row.group)]


def _data_uri(path: Path) -> str:
    return "data:image/svg+xml;base64," + base64.b64encode(path.read_bytes()).decode("ascii")


def _policy(script: str) -> str:
    digest = base64.b64encode(hashlib.sha256(script.encode("utf-8")).digest()).decode("ascii")
    return f"default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"


def _templates() -> Path:
    return Path(str(resources.files("tread_validate.report").joinpath("templates")))


def _asset(name: str) -> str:
    return (_templates() / name).read_text(encoding="utf-8")
