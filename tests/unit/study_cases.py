"""Functions that the tests of studies call in other processes."""

import os
from base64 import b64decode
from pathlib import Path

from turgor.errors import TurgorError
from turgor.response import Column, Response
from turgor.source import Source
from turgor.study.runs import Computed

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
