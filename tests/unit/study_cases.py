"""Functions that the tests of studies call in other processes."""

import os
import signal
import time
from base64 import b64decode
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from turgor.foundation.errors import NotHere, TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.run import Computed

#: The smallest picture: one gray pixel.
PICTURE = b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==")


def line(slope: float, log: str = "", seconds_each: float = 0.0) -> Computed:
    """A straight line; says in a file that it was computed."""
    if log:
        with Path(log).open("a", encoding="utf-8") as file:
            file.write(f"{slope} {os.environ.get('NUMBA_NUM_THREADS', '')}\n")
    columns = (
        Column("pressure", "kPa", [0.0, 5e3, 10e3]),
        Column("bending_angle", "deg", [0.0, 5e3 * slope, 10e3 * slope]),
        Column("bending_angle_mesh_error", "deg", [0.0, 1e-6, 2e-6]),
    )
    return Computed(response=Response(columns=columns, source=Source(text="a line"), message="ended"), picture=PICTURE)


def refuses(log: str = "") -> Computed:
    """Bad input."""
    raise TurgorError("wall is -1 mm; allowed is above 0 mm.")


def breaks(log: str = "") -> Computed:
    """A mistake in a study."""
    raise ZeroDivisionError("of the study")


def dies(log: str = "") -> Computed:
    """What a system without memory does."""
    os._exit(9)


def killed(log: str = "") -> Computed:
    """What the system does where memory ends."""
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError


def slow(number: int, log: str, seconds: float = 0.5) -> Response:
    """Says in a file which process began it, works, and says that it ended."""
    with Path(log).open("a", encoding="utf-8") as file:
        file.write(f"begun {number} {os.getpid()}\n")
    time.sleep(seconds)
    with Path(log).open("a", encoding="utf-8") as file:
        file.write(f"ended {number} {os.getpid()}\n")
    return Response(columns=(Column("pressure", "kPa", [0.0, float(number)]),), source=Source(text="a clock"))


def waits(number: int, log: str, gate: str) -> Response:
    """Says in a file when it began; the first one waits until a file is there."""
    with Path(log).open("a", encoding="utf-8") as file:
        file.write(f"begun {number} {os.getpid()}\n")
    while number == 0 and not Path(gate).exists():
        time.sleep(0.02)
    return Response(columns=(Column("pressure", "kPa", [0.0, float(number)]),), source=Source(text="a gate"))


def fails(log: str, how: str) -> Response:
    """Says in a file that it began, and ends in some way."""
    with Path(log).open("a", encoding="utf-8") as file:
        file.write(f"{how}\n")
    if how == "refused":
        raise TurgorError("wall is -1 mm; allowed is above 0 mm.")
    if how == "lacks":
        raise NotHere("a file is missing on this machine.")
    if how == "broken":
        raise ZeroDivisionError("of the study")
    if how == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    message = "the path ended at 3 kPa." if how == "early" else ""
    return Response(columns=(Column("a", "", [1.0]),), source=Source(text="an end"), message=message)


@dataclass(frozen=True, kw_only=True)
class Beam:
    """A cantilever, whose fields are dimensions."""

    length: float = 0.1
    height: float = 2e-3
    parts: int = 1

    def __post_init__(self) -> None:
        if self.height <= 0:
            raise TurgorError(f"height is {self.height / 1e-3:g} mm; allowed is above 0 mm.")


def deflection(beam: Beam) -> Response:
    """Deflection w = F L³ / (3 E I) of a strip 10 mm wide of 1 MPa under a force at its end, of each part."""
    force = np.linspace(0.0, 0.01, 5)
    bent = force * beam.length**3 / (3 * 1e6 * 0.01 * beam.height**3 / 12) / beam.parts
    columns = Column("force", "N", force), Column("deflection", "mm", bent)
    return Response(columns=columns, source=Source(text="a beam"), status="converged")
