"""A studio as people use it: a real server process, and a page of it in headless Chromium."""

import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from http.cookiejar import CookieJar
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import HTTPCookieProcessor, build_opener

import pytest
from browser import CHROMIUM, SOFTWARE_GL, needs_browser

__all__ = ["Shown", "Studio", "needs_browser", "open_page", "served", "server"]

#: Time that a server has to print its address, and a page to do what it was waited for [s].
PATIENCE = 60


@dataclass
class Studio:
    """A server that runs: the printed address with the token, its process, and the folder that it shows."""

    url: str
    process: subprocess.Popen
    workspace: Path

    @property
    def origin(self) -> str:
        """Address of the server without the token."""
        parts = urlsplit(self.url)
        return f"{parts.scheme}://{parts.netloc}"

    @property
    def port(self) -> int:
        """Port of the server."""
        return urlsplit(self.url).port

    @property
    def token(self) -> str:
        """Secret of the first address."""
        return re.search(r"token=([^&#]+)", self.url)[1]

    def cookie(self) -> str:
        """Header that a browser sends after it has opened the printed address."""
        jar = CookieJar()
        build_opener(HTTPCookieProcessor(jar)).open(self.url).close()
        return "; ".join(f"{each.name}={each.value}" for each in jar)

    def kill(self) -> None:
        """End the process at once, as `kill -9` does."""
        self.process.kill()
        self.process.wait()


def server(folder: Path, *options: str, command: str = "studio") -> Studio:
    """Start ``turgor studio FOLDER --no-browser`` with options, and wait for its address."""
    arguments = [sys.executable, "-m", "turgor", command, str(folder), "--no-browser", *options]
    process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    lines = []
    for line in process.stdout:
        lines.append(line)
        if address := re.search(r"https?://\S+", line):
            return Studio(address[0], process, _home(folder))
    raise AssertionError(f"the studio has not started: {''.join(lines)}")


def _home(folder: Path) -> Path:
    return folder if folder.is_dir() else folder.parent


@contextmanager
def served(folder: Path, *options: str, command: str = "studio") -> Iterator[Studio]:
    """Serve a folder at a free port, and end the server afterwards."""
    studio = server(folder, "--port", "0", *options, command=command)
    try:
        yield studio
    finally:
        studio.kill()


class Shown:
    """A page in the browser: ``page`` of playwright, ``complaints`` of its console, ``requests`` to other hosts."""

    def __init__(self, page, origin: str):
        self.page, self.complaints, self.requests = page, [], []
        page.set_default_timeout(PATIENCE * 1000)
        page.on("console", lambda said: said.type in ("error", "warning") and self.complaints.append(said.text))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("request", lambda request: self._note(request.url, origin))
        page.on("websocket", lambda socket: self._note(socket.url, origin))

    def _note(self, url: str, origin: str) -> None:
        inside = url.replace("ws://", "http://").startswith(f"{origin}/")
        if not inside and not url.startswith(("data:", "blob:", "about:")):
            self.requests.append(url)

    def until(self, expression: str) -> None:
        """Wait until an expression is true in the page, whose policy forbids `wait_for_function` to evaluate it."""
        end = time.monotonic() + PATIENCE
        while not self.page.evaluate(expression):
            assert time.monotonic() < end, f"this was not so within {PATIENCE} s: {expression}"
            self.page.wait_for_timeout(30)

    def check(self) -> None:
        """The page complained about nothing (drawing in software is no complaint) and called no other host."""
        about = [each for each in self.complaints if "GPU stall" not in each and "swiftshader" not in each.lower()]
        assert about == []
        assert self.requests == []


@contextmanager
def open_page(studio: Studio, screen: str = "", size: tuple[int, int] = (1200, 850)) -> Iterator[Shown]:
    """Open the printed address in Chromium at a screen such as ``"#/shape/finger.toml"``."""
    sync = pytest.importorskip("playwright.sync_api")
    with sync.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", *SOFTWARE_GL])
        try:
            shown = Shown(browser.new_page(viewport={"width": size[0], "height": size[1]}), studio.origin)
            shown.page.goto(studio.url + screen)
            shown.page.wait_for_selector("main > *")
            yield shown
        finally:
            browser.close()
