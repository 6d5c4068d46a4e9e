"""The report's page in headless Chromium: a made-up study whose texts are full of markup."""

from __future__ import annotations

import csv
import io
import struct
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

FIRST = "rig-rectangle-22c-0p1mm-150rpm"
OTHER = "rig-parallelogram-22c-0p1mm-150rpm"
DESK, PHONE = (1400, 1000), (390, 844)
LARGEST = 4_000_000  # bytes
UNKNOWN = "document.getElementById('case-unknown').textContent"
CHART = "document.getElementById('case-plot')"
POINTS = "document.getElementById('scatter-plot')"


@pytest.fixture
def open_page(tab: Any, page: Path) -> Any:
    """Open the page at desk width."""
    tab.open(page.as_uri(), *DESK)
    _charts(tab)
    return tab


@pytest.fixture(scope="module")
def read_page(new_tab: Any, page: Path) -> Iterator[Any]:
    """Open the page once for the tests that only look."""
    with new_tab() as tab:
        tab.open(page.as_uri(), *DESK)
        _charts(tab)
        yield tab


def _charts(tab: Any) -> None:
    """Go to both charts, so that they are drawn."""
    for place, chart in (("browser", CHART), ("scatter", POINTS)):
        tab.js(f"document.getElementById('{place}').scrollIntoView()")
        tab.until(f"{chart}.data !== undefined && {chart}.querySelector('svg') !== null")


def test_page_loads_without_complaints_or_network_requests(read_page: Any, page: Path) -> None:
    """Exact: nothing in the console, and one request, the page itself (data: and blob: addresses are not requests)."""
    assert read_page.complaints == []
    assert [address for address in read_page.requests if not address.startswith(("data:", "blob:"))] == [page.as_uri()]
    assert page.stat().st_size < LARGEST


def test_markup_in_a_study_is_shown_as_text(read_page: Any) -> None:
    """Exact: title and notes read as written; no script of theirs ran and no element of theirs exists."""
    title = read_page.js("document.querySelector('h1').textContent")
    assert title.startswith("</script><script>document.title='caught'</script><img src=x onerror=alert(1)>")
    assert "caught" not in read_page.js("document.title").split("–")[0]
    assert read_page.js("document.querySelectorAll('img[src=\"x\"]').length") == 0
    assert read_page.js("document.querySelectorAll('script').length") == 1


def test_policy_stops_a_script_that_is_put_into_the_page(open_page: Any) -> None:
    """Exact: an inline script added later does not run, because the policy names the page's own scripts by digest."""
    insert = "const s = document.createElement('script'); s.textContent = 'window.ran = 1'; document.body.append(s);"
    assert open_page.js(f"(() => {{ {insert} return window.ran ?? 'no'; }})()") == "no"


def test_browser_opens_with_a_case_that_has_histories(read_page: Any) -> None:
    """Exact: two sources times three panels are drawn, and the errors of that case stand beside them."""
    assert read_page.js("TV.browser.current()") == FIRST
    assert read_page.js("document.getElementById('case-plot').data.length") == 6
    assert read_page.js("document.querySelectorAll('#case-errors tr:not(.group)').length") == 3


def test_all_errors_of_a_case_are_a_button_away(open_page: Any) -> None:
    """Exact: peak forces and overall scores at first, every error of the case after the button, and back."""
    rows = "document.querySelectorAll('#case-errors tr:not(.group)').length"
    for wanted in (9, 3, 9):
        open_page.click("#case-all")
        open_page.until(f"{rows} === {wanted}")


def test_series_is_hidden_and_shown_by_its_key_and_time_is_zoomed(open_page: Any) -> None:
    """Exact: Enter on a key takes its three curves away and brings them back; a drag along x shows that part alone."""
    curves = f"[...{CHART}.querySelectorAll('g[clip-path] path')].length"
    assert open_page.js(curves) == 6
    for left in (3, 6):
        open_page.js(f"{CHART}.querySelector('.key').focus()")
        open_page.key("Enter")
        assert open_page.js(curves) == left
    labels = f"[...{CHART}.querySelectorAll('text')].map(t => t.textContent).join()"
    whole = open_page.js(labels)
    open_page.js(f"{CHART}.scrollIntoView({{block: 'center'}})")
    x, y = open_page.js(f"(r => [r.x, r.y])({CHART}.getBoundingClientRect())")
    for kind, across in (("mousePressed", 200), ("mouseMoved", 300), ("mouseReleased", 300)):
        open_page.send(
            "Input.dispatchMouseEvent", type=kind, x=x + across, y=y + 200, button="left", buttons=1, clickCount=1
        )
    assert open_page.js(labels) != whole
    open_page.click("#case-plot .whole")
    assert open_page.js(labels) == whole


def test_values_under_the_pointer_are_told(open_page: Any) -> None:
    """Exact: an arrow key on the focused chart tells time, both sources' forces and their units."""
    open_page.js(f"{CHART}.focus()")
    for _ in range(5):
        open_page.key("ArrowRight")
    told = open_page.js(f"[...{CHART}.querySelectorAll('.tip div')].map(line => line.textContent)")
    assert told[0].startswith("time from first contact, ms: ")
    assert any(line.startswith("Built-in explicit FE: ") and line.endswith(" N") for line in told)


def test_browser_switches_cases_by_factor(open_page: Any) -> None:
    """Exact: choosing the other shape keeps every other factor; the address names the new case."""
    open_page.click("#factor-block label:nth-of-type(2)")
    open_page.until(f"TV.browser.current() === '{OTHER}'")
    assert open_page.js("location.hash") == f"#case={OTHER}"
    assert "parallelogram" in open_page.js("document.getElementById('case-title').textContent")


def test_browser_goes_to_a_path_with_other_factors(open_page: Any) -> None:
    """Exact: on the belt there is no 22 degC; the nearest belt case is shown and only its factors are offered."""
    open_page.click("#factor-path label:nth-of-type(2)")
    open_page.until("TV.browser.current().startsWith('belt-')")
    assert open_page.js("document.getElementById('factor-block').hidden") is True
    assert open_page.js("document.getElementById('factor-creep').hidden") is False


def test_browser_is_usable_with_the_keyboard_alone(open_page: Any) -> None:
    """Exact: Tab reaches the factor, an arrow key chooses its next level; Enter works the buttons."""
    open_page.js("document.querySelector('#factor-path input:checked').focus()")
    open_page.key("Tab")
    assert open_page.js("document.activeElement.name") == "factor-block"
    open_page.key("ArrowRight")
    open_page.until(f"TV.browser.current() === '{OTHER}'")
    open_page.js("document.getElementById('case-previous').focus()")
    open_page.key("Enter")
    open_page.until(f"TV.browser.current() !== '{OTHER}'")


def test_stale_reference_is_said_in_words_and_not_drawn(open_page: Any) -> None:
    """Exact: the stale FE history exists as a file but only the model's three panels are drawn."""
    open_page.js("location.hash = 'case=rig-parallelogram-45c-0p2mm-150rpm'")
    open_page.until(f"{CHART}.data.length === 3")
    assert "stale (made from another deck" in open_page.js("document.getElementById('case-status').textContent")


def test_link_to_a_case_opens_it(tab: Any, page: Path) -> None:
    """Exact: the page opened with a case in its address shows that case."""
    tab.open(f"{page.as_uri()}#case={OTHER}", *DESK)
    assert tab.js("TV.browser.current()") == OTHER


@pytest.mark.parametrize("hash_", ["#case=no-such-case", "#case=<img src=x>", "#case=%"])
def test_link_to_an_unknown_case_says_so(tab: Any, page: Path, hash_: str) -> None:
    """Exact: the first case is shown, the page names what it has not, and nothing is complained of."""
    tab.open(page.as_uri() + hash_, *DESK)
    tab.until("!document.getElementById('case-unknown').hidden")
    assert tab.js("TV.browser.current()") == FIRST
    assert f"has no case {hash_.removeprefix('#case=')}" in tab.js(
        "document.getElementById('case-unknown').textContent"
    )
    assert tab.complaints == []


@pytest.mark.parametrize(("size", "mobile"), [((1440, 900), False), ((768, 1024), False), (PHONE, True)])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_first_screen_holds_models_picture_and_references(
    tab: Any, page: Path, size: tuple[int, int], mobile: bool, scheme: str
) -> None:
    """Exact: sentence, a row for the model, picture, references, baseline and inputs end above the window's lower edge.

    No sideways scrolling, and no violation of the accessibility rules that axe-core checks, in light and in dark.
    """
    tab.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
    tab.open(page.as_uri(), *size, mobile=mobile)
    lowest = "Math.max(...[...document.querySelectorAll(s)].map(e => e.getBoundingClientRect().bottom))"
    parts = [
        ".first .lead",
        "#model-spring-paper .why",
        ".first-picture svg",
        ".facts div:last-child",
    ]
    for part in parts:
        assert 0 < tab.js(f"(s => {lowest})({part!r})") <= size[1], part
    assert tab.js("document.documentElement.scrollWidth <= window.innerWidth") is True
    background = tab.js("getComputedStyle(document.body).backgroundColor")
    assert background == {"light": "rgb(255, 255, 255)", "dark": "rgb(18, 22, 27)"}[scheme]
    _charts(tab)
    assert _violations(tab) == []


def _violations(tab: Any) -> list[str]:
    """Run axe-core on the page and return what it finds, with the elements."""
    axe = resources.files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")
    tab.js(f"(() => {{ {axe}; return 1; }})()")
    found = tab.js(
        "axe.run().then(r => r.violations.map(v => v.id + ': ' + v.nodes.map(n => n.html).slice(0, 3).join(' ')))"
    )
    return list(found)


def test_case_is_chosen_within_twenty_stops(tab: Any, page: Path) -> None:
    """Exact: with Tab and Enter alone, from the top of the page to a factor of the case browser."""
    tab.open(page.as_uri(), *DESK)
    stops = 0
    while not tab.js("(document.activeElement?.name ?? '').startsWith('factor-')"):
        if tab.js("document.activeElement?.hash === '#browser'"):
            tab.key("Enter")
        tab.key("Tab")
        stops += 1
        assert stops < 20


def test_window_that_is_resized_leaves_the_chart_its_height(open_page: Any) -> None:
    """Exact: the chart is 560 pixels tall at every width."""
    for width in (1400, 700, 1100):
        open_page.send("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        open_page.until(f"Math.round({CHART}.getBoundingClientRect().height) === 560")


def test_filter_leaves_the_rows_that_hold_the_words(open_page: Any) -> None:
    """Exact: of the folded table of every statistic, opened, the rows of one group of cases."""
    open_page.js("document.querySelector(\"details[data-table='ensemble']\").open = true")
    rows = "[...document.querySelectorAll('#table-ensemble tbody tr:not(.group):not([hidden])')]"
    open_page.until(f"{rows}.length === 10")
    open_page.js("document.querySelector(\"input[data-table='table-ensemble']\")?.focus()")
    open_page.send("Input.insertText", text="PEAK normal")
    names = f"{rows}.map(row => row.cells[0].textContent.toLowerCase())"
    open_page.until(f"{rows}.length < 10")
    left = open_page.js(names)
    assert left
    assert all("peak" in name and "normal" in name for name in left)
    assert len(left) == open_page.js(
        "[...document.querySelectorAll('#table-ensemble tbody tr:not(.group)')]"
        ".filter(row => /peak/i.test(row.textContent) && /normal/i.test(row.textContent)).length"
    )
    links = open_page.js("document.querySelector(\"details[data-table='ensemble'] a[download]\").getAttribute('href')")
    assert links == "tables/ensemble.csv"


def test_every_figure_is_saved_as_svg_png_and_csv_out_of_the_page_alone(open_page: Any) -> None:
    """Exact: every figure and both charts have three buttons; each makes a file of its kind that is not empty."""
    keys = open_page.js("[...new Set([...document.querySelectorAll('button.save')].map(b => b.dataset.of))]")
    figures = open_page.js("document.querySelectorAll('figure').length")
    assert len(keys) == figures + 2
    assert open_page.js("document.querySelectorAll('button.save').length") == 3 * len(keys)
    start = "new Uint8Array(await b.arrayBuffer())"
    for key in keys:
        head = {
            kind: bytes(open_page.js(f"TV.figures.made('{key}', '{kind}').then(async ([b]) => [...{start}])"))
            for kind in ("svg", "png", "csv")
        }
        assert b"<svg" in head["svg"][:500], key
        assert head["png"].startswith(b"\x89PNG"), key
        assert head["csv"].count(b"\n") > 2, key
        assert b"nan" not in head["csv"], key


def test_numbers_of_the_first_picture_are_the_histories(open_page: Any) -> None:
    """Exact to five digits: the largest normal force of the reference in the saved CSV is the history's peak."""
    text = open_page.js("TV.figures.made('overview', 'csv').then(([b, name]) => b.text())")
    rows = list(csv.DictReader(io.StringIO(text)))
    series = {row["series"] for row in rows}
    assert {"Built-in explicit FE", "Springs of the paper"} <= series
    normal = [float(row["y"]) for row in rows if row["series"] == "Built-in explicit FE" and "normal" in row["panel"]]
    assert max(normal) == pytest.approx(1e6 * 1e-4 * (1.0 + 0.03 * 150.0 * 2.0 * np.pi / 60.0 * 0.1), rel=1e-4)


def test_browser_process_keeps_less_than_120_MB_for_the_page(tab: Any, page: Path) -> None:
    """Private memory of the largest page process: both charts drawn, the page scrolled through, garbage collected.

    The made-up study has 18 cases; that of the paper is measured by `benchmarks/page_memory.py`.
    """
    tab.open(page.as_uri(), *DESK)
    _charts(tab)
    for down in range(0, tab.js("document.documentElement.scrollHeight"), 800):
        tab.js(f"scrollTo(0, {down})")
    tab.send("HeapProfiler.collectGarbage")
    assert tab.send("Runtime.getHeapUsage")["usedSize"] < 30e6
    assert 10e6 < tab.private_memory() < 120e6


def test_drawn_peak_is_the_histories_peak(read_page: Any) -> None:
    """Exact to the packing: half a 20,000th of the peak; the extremes are never thinned out."""
    drawn = read_page.js("Math.max(...document.getElementById('case-plot').data[0].y)")
    reference = 1e6 * 1e-4 * (1.0 + 0.03 * 150.0 * 2.0 * np.pi / 60.0 * 0.1)
    assert drawn == pytest.approx(reference, rel=1e-4)


def test_heat_map_cell_opens_its_case(open_page: Any) -> None:
    """Exact: a real click on a cell changes the address and the case."""
    open_page.click(f"a.heat-cell[data-case='{OTHER}']")
    open_page.until(f"TV.browser.current() === '{OTHER}'")


def test_heat_map_says_where_there_is_no_value(read_page: Any) -> None:
    """Exact: an error of -10 % is written in its cell; a missing reference is `n/a`, never a zero."""
    cell = "document.querySelector(\"a.heat-cell[data-case='{}']\").textContent"
    assert read_page.js(cell.format(FIRST)) == "\u221210.0\u00a0%"
    assert read_page.js(cell.format("rig-parallelogram-45c-0p2mm-300rpm")) == "n/a"


def test_table_sorts_by_value_both_ways(open_page: Any) -> None:
    """Exact: computed values 203, 260 and none; what has no value stays last whichever way it is sorted."""
    column = 5
    rows = "document.querySelectorAll('#table-claims tbody tr:not(.group)')"
    cells = f"[...{rows}].map(row => row.cells[{column - 1}].firstChild.textContent)"
    open_page.click(f"#table-claims th:nth-child({column}) button")
    assert open_page.js(cells) == ["203", "260", "–"]
    open_page.click(f"#table-claims th:nth-child({column}) button")
    assert open_page.js(cells) == ["260", "203", "–"]
    assert open_page.js(f"document.querySelector('#table-claims th:nth-child({column})').ariaSort") == "descending"


def test_scatter_holds_one_point_a_compared_case(read_page: Any) -> None:
    """Exact: 18 cases less one stale and one missing reference."""
    points = "document.getElementById('scatter-plot').data.filter(t => t.symbol)[0].x.length"
    assert read_page.js(points) == 16


def test_chosen_quantity_is_drawn(open_page: Any) -> None:
    """Exact: the third quantity of the list is negative in the tables; its size is drawn."""
    choose = "s.value = '2'; s.dispatchEvent(new Event('change'))"
    open_page.js(f"(() => {{ const s = document.getElementById('scatter-quantity'); {choose}; }})()")
    assert open_page.js("Math.min(...document.getElementById('scatter-plot').data.slice(-1)[0].y) > 0") is True


@pytest.mark.parametrize(("size", "mobile"), [(DESK, False), (PHONE, True)])
def test_page_fits_its_window_and_is_not_blank(tab: Any, page: Path, size: tuple[int, int], mobile: bool) -> None:
    """Exact: no sideways scrolling; the screenshot has the window's width and more than one colour in every fifth."""
    tab.open(page.as_uri(), *size, mobile=mobile)
    assert tab.js("document.documentElement.scrollWidth <= window.innerWidth") is True
    picture = tab.screenshot()
    assert struct.unpack(">II", picture[16:24]) == size
    pixels = np.asarray(Image.open(io.BytesIO(picture)).convert("L"))
    assert all(band.std() > 2.0 for band in np.array_split(pixels, 5))


def test_every_number_that_rests_on_a_made_up_input_has_a_tag(read_page: Any) -> None:
    """Exact: every tag leads to a row of the list of assumptions, and every figure of a made-up case has one."""
    dangling = "[...document.querySelectorAll('.mark a')].filter(a => !document.querySelector(a.hash)).length"
    assert read_page.js(dangling) == 0
    figures = "[...document.querySelectorAll('#forces figure, #material figure')]"
    assert read_page.js(f"{figures}.length") > 0
    assert read_page.js(f"{figures}.filter(f => !f.querySelector('.mark')).length") == 0


def test_every_form_control_and_picture_has_a_name(read_page: Any) -> None:
    """Exact: inputs and selects have labels, images and charts have words that stand for them."""
    bare = "[...document.querySelectorAll('input, select')].filter(e => !e.labels.length).length"
    assert read_page.js(bare) == 0
    assert read_page.js("[...document.images].filter(i => !i.alt).length") == 0
    drawings = "[...document.querySelectorAll('.drawing')]"
    assert read_page.js(f"{drawings}.filter(d => d.getAttribute('role') !== 'img' || !d.ariaLabel).length") == 0
    assert (
        read_page.js("[...document.querySelectorAll('.plot')].filter(p => !p.getAttribute('aria-label')).length") == 0
    )
