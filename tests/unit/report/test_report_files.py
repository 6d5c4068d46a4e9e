"""The report's files: whole, self-contained, deterministic, and blind to markup in a study."""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
import shutil
import subprocess
import zlib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.cli.app import run
from tread_validate.errors import InputError
from tread_validate.report import build_report
from tread_validate.report.figures.style import draw
from tread_validate.report.html import embed_json


def test_every_promised_file_is_there(built: Path, inputs: Any) -> None:
    """Exact: page, PDF, a copy of every table, and every figure."""
    assert (built / "index.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    assert (built / "report.pdf").read_bytes().startswith(b"%PDF-")
    copied = {path.name: path.read_bytes() for path in (built / "tables").iterdir()}
    assert copied == {path.name: path.read_bytes() for path in inputs.tables.glob("*.csv")}
    assert (built / "summary.json").read_bytes() == (inputs.tables / "summary.json").read_bytes()
    assert 'href="summary.json"' in (built / "index.html").read_text(encoding="utf-8")
    drawn = {path.stem for path in (built / "figures").glob("*.svg")}
    assert {"moduli-soft", "friction-dry", "belt-heights", "rig-sketch", "peaks-rectangle-22c"} <= drawn


def test_identical_inputs_give_identical_files(built: Path, inputs: Any, tmp_path: Path) -> None:
    """Exact: page, PDF and figures byte for byte, made by one process or two; no time of making is in them."""
    build_report(inputs.study, inputs.tables, inputs.spring, inputs.reference, inputs.decks, tmp_path, jobs=2)
    first = {path.relative_to(built): path.read_bytes() for path in built.rglob("*") if path.is_file()}
    second = {path.relative_to(tmp_path): path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    assert [name for name in first if first[name] != second.get(name)] == []
    assert first.keys() == second.keys()


def test_page_asks_for_nothing_outside_itself(built: Path) -> None:
    """Exact: an src or href is a fragment, data, or a file of the report's own folder that is there; no connection."""
    page = (built / "index.html").read_text(encoding="utf-8")
    outside = re.sub(r"<script>.*?</script>", "", page, flags=re.DOTALL)
    addresses = re.findall(r"(?:src|href)=\"([^\"]*)\"", outside)
    assert addresses
    files = [address for address in addresses if not address.startswith(("#", "data:"))]
    assert [address for address in files if not (built / address).is_file() or address.startswith("/")] == []
    assert "default-src 'none'" in html.unescape(page)
    assert "connect-src" not in page.split("</head>")[0]


def test_policy_names_the_scripts_of_the_page(built: Path) -> None:
    """Exact: the SHA-256 of the page's script is in the policy, and no other is."""
    page = (built / "index.html").read_text(encoding="utf-8")
    scripts = re.findall(r"<script>(.*?)</script>", page, flags=re.DOTALL)
    digests = {base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in scripts}
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)
    assert policy is not None
    assert set(re.findall(r"sha256-([A-Za-z0-9+/=]+)", html.unescape(policy.group(1)))) == digests
    assert len(scripts) == 1


@given(st.recursive(st.text() | st.integers(), lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner)))
def test_embedded_json_cannot_leave_its_script_element(data: Any) -> None:
    """Exact for any text: no sign that HTML reads is left, and the parsed data are the same."""
    text = str(embed_json(data))
    assert not set("<>&\u2028\u2029") & set(text)
    assert json.loads(text) == data


def test_pdf_shows_markup_as_text(built: Path, made_up: ModuleType) -> None:
    """Exact but for line breaks: the study's title reads in the PDF as it was written, typst's own signs included."""
    assert shutil.which("pdftotext") is not None, "this test needs pdftotext: apt-get install poppler-utils"
    done = subprocess.run(
        ["pdftotext", str(built / "report.pdf"), "-"], check=True, capture_output=True, text=True, timeout=60
    )
    text = "".join(done.stdout.split())
    assert "".join(made_up.NASTY.split()) in text
    assert "Howfarcanthemodelsbetrusted?" in text


def test_pdf_has_few_pages_contents_metadata_and_the_tables_attached(built: Path) -> None:
    """At most 20 pages; title, author and a date of the code; a bookmark for every section; every table attached."""
    file = str(built / "report.pdf")
    told = subprocess.run(["pdfinfo", file], check=True, capture_output=True, text=True, timeout=60).stdout
    facts = dict(line.split(":", 1) for line in told.splitlines() if ":" in line)
    assert int(facts["Pages"]) <= 20
    assert facts["Title"].strip().startswith("Tread-block validation report: ")
    assert facts["Author"].strip().startswith("tread_validate ")
    listed = subprocess.run(["pdfdetach", "-list", file], check=True, capture_output=True, text=True, timeout=60).stdout
    assert {path.name for path in (built / "tables").glob("*.csv")} <= set(re.findall(r": (\S+\.csv)", listed))
    outline = subprocess.run(
        ["pdftohtml", "-xml", "-i", "-stdout", file], check=True, capture_output=True, text=True, timeout=60
    ).stdout
    marks = re.findall(r'<item page="([0-9]+)">[0-9]+ ([^<]+)</item>', outline)
    titles = [title for _, title in marks]
    pages = [int(page) for page, _ in marks]
    assert titles[:3] == ["How far can the models be trusted?", "Method", "Results"]
    assert titles[-2:] == ["Inputs and assumptions", "Provenance"]
    assert pages == sorted(pages)
    text = subprocess.run(["pdftotext", "-layout", file, "-"], check=True, capture_output=True, text=True, timeout=60)
    sheets = text.stdout.split("\f")
    assert all(title in sheets[page - 1] for title, page in zip(titles, pages, strict=True))
    text = subprocess.run(["pdftotext", file, "-"], check=True, capture_output=True, text=True, timeout=60).stdout
    assert "Contents" in text
    assert "Method" in text


def test_every_table_has_a_line_of_help(built: Path) -> None:
    """Exact: a question mark behind every title, with words behind it, folded tables too."""
    page = (built / "index.html").read_text(encoding="utf-8")
    folded = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL).group(1))["tables"]  # type: ignore[union-attr]
    texts = [page, *(zlib.decompress(base64.b64decode(text), wbits=-15).decode() for text in folded.values())]
    heads = [head for text in texts for head in re.findall(r'<div class="table-head">.*?</div>', text, re.DOTALL)]
    assert len(heads) > 10
    assert [head for head in heads if not re.search(r'<details class="help">.*?<span>[^<]{20,}', head, re.DOTALL)] == []


def test_no_cell_of_a_table_is_empty_or_nan(built: Path) -> None:
    """Exact: every cell on the page says something; what is not known is a dash."""
    page = (built / "index.html").read_text(encoding="utf-8")
    folded = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL).group(1))["tables"]  # type: ignore[union-attr]
    inflated = [zlib.decompress(base64.b64decode(text), wbits=-15).decode("utf-8") for text in folded.values()]
    whole = "".join([page, *inflated])
    assert re.findall(r"<td[^>]*>\s*</td>", whole) == []
    assert re.findall(r">\s*(?:nan|NaN|None|true|false)\s*<", whole) == []


def test_figure_keeps_its_legend_off_the_data(made_up: ModuleType, tmp_path: Path) -> None:
    """Exact: a legend's box, however many its entries, lies above the axes' box."""
    for count in (2, 5, 9):
        canvas_made: list[Any] = []

        def paint(axes: Any, count: int = count, kept: list[Any] = canvas_made) -> None:
            for index in range(count):
                axes.plot([0, 1], [index, index + 1], label=f"source number {index}")
            axes.set(xlabel="time, ms", ylabel="force, N")
            axes.legend()
            kept.append(axes)

        draw(tmp_path, f"figure-{count}", "t", "c", paint)
        axes = canvas_made[0]
        figure = axes.get_figure()
        box = figure.legends[0].get_window_extent()
        assert box.y0 >= axes.get_window_extent().y1
        assert box.x1 <= figure.bbox.x1
        assert axes.get_legend() is None


def test_report_says_what_is_missing_or_stale_in_words(built: Path) -> None:
    """Exact: 18 cases, one without a reference run and one whose run belongs to an older deck."""
    page = (built / "index.html").read_text(encoding="utf-8")
    assert "16 of 18 current; 1 without a run; 1 stale (made from another deck, inputs or code)" in page


def test_mesh_that_is_not_there_is_said_and_not_drawn(built: Path) -> None:
    """Exact: no deck was written, so the page says so by name."""
    page = (built / "index.html").read_text(encoding="utf-8")
    assert "no mesh at rig-rectangle-22c-0p1mm-150rpm/mesh.vtu" in page


@pytest.mark.parametrize("name", ["cases", "errors", "claims", "assumed"])
def test_missing_table_is_named(inputs: Any, tmp_path: Path, name: str) -> None:
    """Exact: one line with the file; nothing is written."""
    broken = shutil.copytree(inputs.tables, tmp_path / "tables")
    (broken / f"{name}.csv").unlink()
    with pytest.raises(InputError, match=rf"{name}\.csv: got no such file"):
        build_report(inputs.study, broken, inputs.spring, inputs.reference, inputs.decks, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_table_without_a_column_is_wrong_input(inputs: Any, tmp_path: Path) -> None:
    """Exact: exit code 2, file and column in one line."""
    broken = shutil.copytree(inputs.tables, tmp_path / "tables")
    text = (broken / "errors.csv").read_text(encoding="utf-8")
    (broken / "errors.csv").write_text(text.replace("assessment", "vredict", 1), encoding="utf-8")
    with pytest.raises(InputError, match=r"errors\.csv:1: got no column assessment"):
        build_report(inputs.study, broken, inputs.spring, inputs.reference, inputs.decks, tmp_path / "out")


def test_verb_writes_the_report_and_names_its_files(
    inputs: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exact: exit code 0 and two lines, page and PDF."""
    options = ["--tables", str(inputs.tables), "--spring", str(inputs.spring), "--references", str(tmp_path)]
    code = run(["report", str(inputs.study), *options, "--decks", str(inputs.decks), "-o", str(tmp_path / "out")])
    assert code == 0
    assert capsys.readouterr().out.split() == [str(tmp_path / "out" / name) for name in ("index.html", "report.pdf")]
