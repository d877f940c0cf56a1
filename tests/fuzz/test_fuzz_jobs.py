"""Mutants of job files are read, or refused with sentences: no traceback, no hang.

``TURGOR_FUZZ=5000 python -m pytest tests/fuzz`` tries thousands.
"""

import random
import tomllib
from copy import deepcopy
from pathlib import Path

import pytest
import tomlkit
from mutants import changed_table, changed_text, check_sentence, limit, seeds

from turgor.foundation.errors import TurgorError
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job

#: A job with most of the tables that a job can have, whose actuator is built in milliseconds.
FULL = """\
name = "full"

[actuator]
type = "extending_cylinder"
length = "30 mm"
symmetric = false

[mesh]
size = "4 mm"
cells = "tetrahedra"
face_sizes = { cavity = "3 mm" }
wall_cells = 1

[materials.body]
law = "yeoh"
C10 = "0.11 MPa"
C20 = "0.02 MPa"
density = "1.07 g/cm³"
source = { text = "our own test" }

[fibers.hoops]
face = "outside"
library = "kevlar-fiber"
angle_from_circumference = "0 deg"
spacing = "2 mm"
within = { x_from = "1 mm" }

[supports]
fixed = "xyz"

[loads.cavity]
pressure = "20 kPa"
history = [[0, 0], [0.5, 1], [1, 0.5]]

[loads.gravity]
direction = "-z"

[obstacles.plate]
shape = "plane"
point = ["50 mm", 0, 0]
normal = "-x"
friction = 0.3

[procedure]
type = "static"
first_step = 0.25
max_step = 0.5

[output]
measures = ["tip_displacement_x", "cavity_volume"]
fields = false

[engine]
threads = 1
"""

STAGED = """\
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"

[mesh]
size = "4 mm"

[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[contact]
self_contact = true

[[stages]]
name = "fill"
loads = { cavity = { pressure = "2 kPa" } }
procedure = { type = "static" }

[[stages]]
name = "swing"
loads = { cavity = { pressure = "1 kPa", history_over_time = [[0, 0], [1, 1]] } }
procedure = { type = "dynamic", duration = "1 s" }
"""


def read(file: Path) -> Job | None:
    """Read a job; None where it was refused with sentences."""
    try:
        return read_job(file)
    except TurgorError as error:
        check_sentence(error)
        return None


@pytest.mark.parametrize("text", [FULL, STAGED], ids=["full", "staged"])
def test_the_jobs_to_be_changed_are_valid(text: str, tmp_path: Path) -> None:
    file = tmp_path / "job.toml"
    file.write_text(text, encoding="utf-8")
    read_job(file)


@pytest.mark.parametrize("seed", seeds(110))
def test_a_changed_job_is_read_or_refused(seed: int, tmp_path: Path) -> None:
    chance, file = random.Random(seed), tmp_path / "job.toml"
    table = tomllib.loads(chance.choice((FULL, FULL, STAGED)))
    for _ in range(chance.choice((1, 1, 2, 3))):
        changed_table(table, chance)
    file.write_text(tomlkit.dumps(deepcopy(table)), encoding="utf-8")
    with limit(60):
        job = read(file)
        if job is not None:  # what was read can be written and read again
            file.write_text(lock_text(job, {}), encoding="utf-8")
            assert read_job(file) == job


@pytest.mark.parametrize("seed", seeds(30))
def test_a_damaged_job_file_is_read_or_refused(seed: int, tmp_path: Path) -> None:
    chance, file = random.Random(seed), tmp_path / "job.toml"
    file.write_text(changed_text(chance.choice((FULL, STAGED)), chance), encoding="utf-8")
    with limit(60):
        read(file)
