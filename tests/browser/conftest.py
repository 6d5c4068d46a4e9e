"""Headless Chromium, driven over its DevTools protocol (one websocket, no other machinery)."""

from __future__ import annotations

import base64
import importlib.util
import itertools
import json
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
import websocket

from tread_validate.report import build_report

FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-extensions", "--disable-dev-shm-usage",
    "--remote-debugging-port=0",
)  # fmt: skip
PATIENCE = 180.0  # s: for a busy machine; a page takes about 1 s


@dataclass
class Tab:
    """One page under test: what it was asked, what it logged, what it wanted from the network."""

    socket: websocket.WebSocket
    ids: Iterator[int] = field(default_factory=lambda: itertools.count(1))
    complaints: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)
    browser: Tab | None = None

    def send(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Send one command and return its result; events that arrive meanwhile are kept."""
        number = next(self.ids)
        self.socket.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return dict(message["result"])
            self._note(message)

    def _note(self, message: dict[str, Any]) -> None:
        method, parameters = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.complaints.append(str(parameters["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.complaints.append(str(parameters["args"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            self.complaints.append(str(parameters["entry"]))
        elif method == "Network.requestWillBeSent":
            self.requests.append(str(parameters["request"]["url"]))

    def open(self, address: str, width: int, height: int, mobile: bool = False) -> None:
        """Load a page at a window size and wait until it says that it is ready."""
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(f"{domain}.enable")
        self.send("Page.navigate", url="about:blank")
        self.requests.clear()
        self.send("Page.navigate", url=address)
        self.until("document.documentElement?.dataset.ready === 'yes'")

    def js(self, expression: str) -> Any:
        """Return the value of a JavaScript expression; an exception in it is an error here."""
        result = self.send("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def until(self, expression: str) -> None:
        """Wait until an expression is true."""
        deadline = time.monotonic() + PATIENCE
        while not self.js(expression):
            if time.monotonic() > deadline:
                raise TimeoutError(expression)
            time.sleep(0.05)

    def click(self, selector: str) -> None:
        """Press and release the mouse in the middle of an element, as a reader does."""
        find = f"document.querySelector({json.dumps(selector)})"
        self.js(f"{find}.scrollIntoView({{block: 'center', behavior: 'instant'}})")
        box = self.js(
            f"(() => {{ const r = {find}.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; }})()"
        )
        for kind in ("mousePressed", "mouseReleased"):
            self.send("Input.dispatchMouseEvent", type=kind, x=box[0], y=box[1], button="left", clickCount=1)

    def key(self, name: str) -> None:
        """Press and release a key."""
        codes = {"Tab": 9, "Enter": 13, "ArrowRight": 39, "ArrowDown": 40}
        extra = {"text": "\r"} if name == "Enter" else {}
        for kind in ("keyDown", "keyUp"):
            self.send(
                "Input.dispatchKeyEvent", type=kind, key=name, code=name, windowsVirtualKeyCode=codes[name], **extra
            )

    def private_memory(self) -> int:
        """Return the bytes (`Private_Dirty`) that the largest page process of the browser keeps for itself alone."""
        found = []
        for process in (self.browser or self).send("SystemInfo.getProcessInfo")["processInfo"]:
            file = Path(f"/proc/{process['id']}/smaps_rollup")
            if process["type"] == "renderer" and file.is_file():
                lines = dict(line.split(":", 1) for line in file.read_text(encoding="utf-8").splitlines()[1:])
                found.append(1024 * int(lines["Private_Dirty"].split()[0]))
        return max(found)

    def screenshot(self, whole: bool = False) -> bytes:
        """Return a PNG of the window, or of the whole page."""
        return base64.b64decode(self.send("Page.captureScreenshot", format="png", captureBeyondViewport=whole)["data"])


def devtools_address(process: subprocess.Popen[bytes], profile: Path) -> str:
    """Wait until Chromium has written where it listens, and return the address."""
    port_file = profile / "DevToolsActivePort"
    deadline = time.monotonic() + PATIENCE
    while not (port_file.is_file() and port_file.read_text().count("\n") >= 1):
        assert process.poll() is None, f"Chromium ended with {process.returncode}"
        assert time.monotonic() < deadline, "Chromium did not start"
        time.sleep(0.05)
    port, path = port_file.read_text().split("\n")[:2]
    return f"ws://127.0.0.1:{port}{path}"


@pytest.fixture(scope="session")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Start one Chromium and return the address of its DevTools."""
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    assert program is not None, "the browser tests need Chromium: apt-get install chromium"
    profile = tmp_path_factory.mktemp("chromium")
    process = subprocess.Popen(
        [program, *FLAGS, f"--user-data-dir={profile}", "about:blank"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield devtools_address(process, profile)
    finally:
        process.terminate()
        process.wait(timeout=20)


@pytest.fixture(scope="session")
def new_tab(chromium: str) -> Callable[[], AbstractContextManager[Tab]]:
    """Return what opens a fresh tab and closes it again."""

    @contextmanager
    def opened() -> Iterator[Tab]:
        browser = Tab(websocket.create_connection(chromium, timeout=PATIENCE, suppress_origin=True))
        target = browser.send("Target.createTarget", url="about:blank")["targetId"]
        address = chromium.split("/devtools/")[0] + f"/devtools/page/{target}"
        page = Tab(websocket.create_connection(address, timeout=PATIENCE, suppress_origin=True), browser=browser)
        try:
            yield page
        finally:
            page.socket.close()
            browser.send("Target.closeTarget", targetId=target)
            browser.socket.close()

    return opened


@pytest.fixture
def tab(new_tab: Callable[[], AbstractContextManager[Tab]]) -> Iterator[Tab]:
    """Open a fresh tab."""
    with new_tab() as opened:
        yield opened


@pytest.fixture(scope="session")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the report of the made-up study once and return its page."""
    source = Path(__file__).parents[1] / "fabricated_report.py"
    spec = importlib.util.spec_from_file_location("fabricated_report", source)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    folder = tmp_path_factory.mktemp("report")
    made = module.fabricate(folder / "in")
    build_report(made.study, made.tables, made.spring, made.reference, made.decks, folder / "out")
    return folder / "out" / "index.html"
