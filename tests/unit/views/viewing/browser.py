"""A real browser for tests of pages: headless Chromium, which draws WebGL in software."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

import pytest

#: The browser, where it is installed (Debian: chromium).
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

needs_browser = pytest.mark.skipif(
    CHROMIUM is None or find_spec("playwright") is None, reason="Chromium or playwright is not installed"
)

SOFTWARE_GL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")


class Opened:
    """A page in the browser, with what it asked for and complained about.

    ``page`` is the page of playwright, ``requests`` are addresses outside the file, ``complaints`` errors and warnings
    of the console.
    """

    def __init__(self, page):
        self.page, self.requests, self.complaints = page, [], []
        page.on("console", lambda told: told.type in ("error", "warning") and self.complaints.append(told.text))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("request", lambda asked: self._note(asked.url))

    def _note(self, url: str) -> None:
        if not url.startswith(("file:", "data:", "blob:", "about:")):
            self.requests.append(url)

    def change(self, name: str, value) -> None:
        """Set a control of the viewer by its name, as a user does: a text for lists and sliders, a bool for boxes."""
        self.page.evaluate(
            """([name, value]) => {
              const control = document.querySelector(`[data-v="${name}"]`);
              if (typeof value === "boolean") control.checked = value; else control.value = value;
              for (const kind of ["input", "change"]) control.dispatchEvent(new Event(kind, { bubbles: true }));
            }""",
            [name, value],
        )

    def pixels(self) -> bytes:
        """The picture of the viewer as a PNG file, drawn anew."""
        self.page.evaluate("document.querySelector('.viewer').viewer.stage.now()")
        return self.page.locator(".v-picture canvas").screenshot()


@contextmanager
def opened(driver, file: Path, *, webgl: bool = True, frame: bool = False) -> Iterator[Opened]:
    """Open a file in a browser that a driver of playwright starts, with or without WebGL; wait for the viewer in it.

    With ``frame`` the viewer is in the first frame of the page.
    """
    options = ["--no-sandbox", *(SOFTWARE_GL if webgl else ("--disable-3d-apis", "--disable-gpu"))]
    browser = driver.chromium.launch(executable_path=CHROMIUM, args=options)
    try:
        shown = Opened(browser.new_page(viewport={"width": 1100, "height": 800}))
        shown.page.goto(file.resolve().as_uri())
        inside = shown.page.frames[-1] if frame else shown.page
        inside.wait_for_function("(v => v?.viewer || v?.dataset.failed)(document.querySelector('.viewer'))")
        yield shown
    finally:
        browser.close()
