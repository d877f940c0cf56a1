"""Requests to a studio as its page sends them, and jobs that are solved in seconds."""

import json
import time
from http.cookiejar import CookieJar
from pathlib import Path
from urllib.error import HTTPError
from urllib.parse import quote
from urllib.request import HTTPCookieProcessor, Request, build_opener

from served import PATIENCE, Studio

#: A tube of revolution: 50 steps in a few seconds.
TUBE = """\
[actuator]
type = "extending_cylinder"
length = "20 mm"
cap = "3 mm"
wall = "2 mm"

[mesh]
size = "3 mm"
cells = "axisymmetric"

[materials.body]
law = "neo_hooke"
C10 = "0.1 MPa"

[loads.cavity]
pressure = "20 kPa"

[procedure]
type = "static"
max_step = 0.02
first_step = 0.02

[output]
measures = ["tip_displacement_x", "cavity_volume"]
pictures = false
report = false
fields = false
mesh_error = false
"""


def workspace(folder: Path, *, steps: float = 0.02, name: str = "tube.toml") -> Path:
    """Write the job of the tube into a folder; smaller steps make a longer run."""
    text = TUBE.replace("max_step = 0.02", f"max_step = {steps}").replace("first_step = 0.02", f"first_step = {steps}")
    (folder / name).write_text(text, encoding="utf-8")
    return folder


class Talk:
    """Requests to a studio with its cookie."""

    def __init__(self, studio: Studio):
        self.origin = studio.origin
        self.opener = build_opener(HTTPCookieProcessor(CookieJar()))
        self.opener.open(studio.url, timeout=PATIENCE)

    def raw(self, path: str, value: object = None) -> tuple[int, dict, bytes]:
        """Status, headers and body of an answer."""
        body = None if value is None else json.dumps(value).encode()
        request = Request(self.origin + path, data=body, headers={"Origin": self.origin})
        try:
            answer = self.opener.open(request, timeout=5 * PATIENCE)
        except HTTPError as error:
            answer = error
        return answer.status, dict(answer.headers), answer.read()

    def get(self, path: str, value: object = None) -> object:
        """Value of an answer that succeeds."""
        status, _, body = self.raw(path, value)
        assert status < 300, body
        return json.loads(body) if body else None

    def refusal(self, path: str, value: object = None) -> str:
        """Sentence of an answer that fails."""
        status, _, body = self.raw(path, value)
        assert status == 400, body
        return json.loads(body)["error"]

    def run(self, name: str) -> dict:
        """State of a run."""
        return self.get(f"/api/runs/status?run={quote(name)}")

    def wait(self, name: str, until, seconds: float = 2 * PATIENCE) -> dict:
        """Wait until the state of a run satisfies a condition."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            status, _, body = self.raw(f"/api/runs/status?run={quote(name)}")
            state = json.loads(body)
            if status == 200 and until(state):
                return state
            time.sleep(0.1)
        raise AssertionError(state)
