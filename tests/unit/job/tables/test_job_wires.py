"""Shape-memory wires in job files: read, written into the lock file, refused."""

from pathlib import Path

import pytest

from refused import any_states
from turgor.core.materials.alloys.alloy import ShapeMemoryAlloy
from turgor.core.model.loads import ShapeMemoryWire
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.text.problems import JobError

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa" }
base = { law = "neo_hooke", C10 = "50 kPa" }

[[loads.wires]]
name = "top"
through = [["0 mm", 0, "2 mm"], ["10 mm", 0, "2 mm"]]
diameter = "0.25 mm"
alloy = "nitinol-brinson-1993"
strain = "4 %"
temperature = "80 °C"
"""

OWN = """{ martensite_modulus = "28 GPa", austenite_modulus = "75 GPa", martensite_finish = "42 °C", \
martensite_start = "52 °C", austenite_start = "68 °C", austenite_finish = "78 °C", martensite_slope = "7 MPa/K", \
austenite_slope = "7 MPa/K", detwinning_start = "80 MPa", detwinning_finish = "150 MPa", \
transformation_strain = "5 %" }"""


def read(folder: Path, text: str):
    (folder / "job.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "job.toml")


@pytest.mark.parametrize("alloy", ['"nitinol-brinson-1993"', OWN])
def test_a_wire_is_read_and_written(tmp_path: Path, alloy: str) -> None:
    job = read(tmp_path, JOB.replace('"nitinol-brinson-1993"', alloy))
    (load,) = job.loads
    assert isinstance(load, ShapeMemoryWire)
    assert (load.name, load.strain, load.temperature) == ("top", 0.04, 353.15)
    assert (load.alloy == ShapeMemoryAlloy.named("nitinol-brinson-1993")) == (alloy != OWN)
    assert read(tmp_path, lock_text(job, {})).loads == job.loads
    assert load.text().startswith("Shape-memory wire through 2 points goes from 20 °C to 80 °C; it has a diameter of")


@pytest.mark.parametrize(
    ("before", "after", "facts"),
    [
        ('alloy = "nitinol-brinson-1993"', 'alloy = "nitinol-brinson-1994"', ["nitinol-brinson-1993"]),
        ('"nitinol-brinson-1993"', '{ martensite_modulus = "28 GPa" }', ["austenite_modulus", "missing"]),
        ('"nitinol-brinson-1993"', OWN.replace("nsite_slope", "nsite_slop"), ["martensite_slop", "did you mean"]),
        ('"nitinol-brinson-1993"', OWN.replace("52 °C", "40 °C"), ["martensite_finish", "must be less"]),
        ('"4 %"', '"8 %"', ["strain is 0.08", "0 to 0.067"]),
        ('temperature = "80 °C"', 'temperature = "80 °C"\nrest = "40 °C"', ["rest is 40 °C", "34.5 °C"]),
        ("diameter", "diametr", ["diametr", "diameter"]),
        ('"0.25 mm"', '"0 mm"', ["diameter is 0", "above 0"]),
        ("wires", "wire", ["wire", "wires"]),
    ],
)  # fmt: skip
def test_a_mistake_is_named(tmp_path: Path, before: str, after: str, facts: list[str]) -> None:
    with pytest.raises(JobError) as error:
        read(tmp_path, JOB.replace(before, after))
    assert any_states(error.value.problems, facts), error.value.problems
