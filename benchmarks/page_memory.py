"""Weight of report pages, and the private memory of the browser process that shows them.

    python benchmarks/page_memory.py [PAGE ...]

Headless Chromium, 1440 x 900: the page opened, a case drawn, every case stepped through, the page scrolled through, and
once more after the garbage of that is collected. Private memory is `Private_Dirty` of the renderer in /proc; its
largest value while stepping and scrolling counts. Targets: 4 MB and 120 MB for the paper's study.
"""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import websocket

PAUSE = 0.4  # s between two steps of a quick reader


def driver() -> Any:
    """Return the module of the browser tests that speaks to Chromium."""
    spec = importlib.util.spec_from_file_location("devtools", Path(__file__).parents[1] / "tests/browser/conftest.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def measure(tools: Any, page: Path, address: str) -> dict[str, float]:
    """Return private memory in MB by what the reader has done."""
    browser = tools.Tab(websocket.create_connection(address, timeout=tools.PATIENCE, suppress_origin=True))
    target = browser.send("Target.createTarget", url="about:blank")["targetId"]
    place = f"{address.split('/devtools/')[0]}/devtools/page/{target}"
    tab = tools.Tab(websocket.create_connection(place, timeout=tools.PATIENCE, suppress_origin=True))

    def held() -> float:
        return float(browser.private_memory()) / 1e6

    found = {}
    tab.open(page.resolve().as_uri(), 1440, 900)
    time.sleep(2.0)
    found["opened"] = held()
    tab.js("document.getElementById('browser').scrollIntoView()")
    tab.until("document.getElementById('case-plot').data !== undefined")
    time.sleep(2.0)
    found["a case drawn"] = held()
    found["stepping through cases"] = 0.0
    for _ in range(min(60, tab.js("TV.data.cases.length"))):
        tab.js("document.getElementById('case-next').click()")
        time.sleep(PAUSE)
        found["stepping through cases"] = max(found["stepping through cases"], held())
    tab.send("HeapProfiler.collectGarbage")
    found["scrolling"], place_down = 0.0, 0
    while place_down < tab.js("document.documentElement.scrollHeight"):
        tab.js(f"scrollTo(0, {place_down})")
        time.sleep(PAUSE)
        place_down += 800
        found["scrolling"] = max(found["scrolling"], held())
    tab.send("HeapProfiler.collectGarbage")
    time.sleep(1.0)
    found["garbage collected"] = held()
    browser.send("Target.closeTarget", targetId=target)
    return found


def main() -> int:
    pages = [Path(name) for name in sys.argv[1:]] or [Path("reports/liu2010/index.html")]
    program = shutil.which("chromium")
    if program is None or not all(page.is_file() for page in pages):
        print("page memory: needs chromium and a page; run `make report` first")
        return 0
    tools = driver()
    for page in pages:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            command = [program, *tools.FLAGS, f"--user-data-dir={profile}", "about:blank"]
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                found = measure(tools, page, tools.devtools_address(process, Path(profile)))
            finally:
                process.terminate()
                process.wait(timeout=20)
        print(f"{page}: {page.stat().st_size / 1e6:.2f} MB; MB of memory: ", end="")
        print(", ".join(f"{what} {value:.0f}" for what, value in found.items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
