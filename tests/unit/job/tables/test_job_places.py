"""Places of supports in job files: read, written back, solved, and refused with the key that is wrong."""

from pathlib import Path

import pytest

import turgor as tg
from refused import refused
from turgor.core.model.supports import Displacement, Fixed, NodesAt, Shift
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job

JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"
cap = "3 mm"

[mesh]
size = "5 mm"

[materials]
body = {{ law = "neo_hooke", C10 = "0.12 MPa" }}

[loads]
pressure = "5 kPa"

[supports]
fixed = "x"
{support}
"""


def written(folder: Path, support: str) -> Path:
    file = folder / "places.toml"
    file.write_text(JOB.format(support=support), encoding="utf-8")
    return file


def test_places_are_read_and_written_back(tmp_path: Path) -> None:
    text = """
    rim = { edge = ["fixed", "outside"], directions = "z" }
    corner = { near = [0, "10 mm", 0], directions = "y" }
    [supports.end]
    box = [["17 mm", "-20 mm", "-20 mm"], ["20 mm", "20 mm", "20 mm"]]
    displacement = ["2 mm", 0, 0]
    directions = "x"
    """
    job = read_job(written(tmp_path, text))
    assert job.supports == (
        Fixed("fixed", "x"),
        Fixed(NodesAt("rim", edge=("fixed", "outside")), "z"),
        Fixed(NodesAt("corner", near=(0.0, 10e-3, 0.0)), "y"),
        Displacement(
            NodesAt("end", box=((17e-3, -20e-3, -20e-3), (20e-3, 20e-3, 20e-3))), Shift((2e-3, 0.0, 0.0)), "x"
        ),
    )
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(again).supports == job.supports


def test_a_run_with_a_box_that_moves_says_so(tmp_path: Path) -> None:
    text = 'end = { box = [["17 mm", "-20 mm", "-20 mm"], ["20 mm", "20 mm", "20 mm"]], displacement = ["2 mm", 0, 0] }'
    changes = {"output.mesh_error": False, "output.measures": ["tip_displacement_x"]}
    outcome = tg.jobs.run_job(read_job(written(tmp_path, text), changes), tmp_path / "out")
    assert outcome.response.column("tip_displacement_x")[-1] == pytest.approx(2e-3, rel=1e-9)
    assert "end (the box from (17, -20, -20) to (20, 20, 20) mm)" in (tmp_path / "out/report.html").read_text()


@pytest.mark.parametrize(
    ("support", "facts"),
    [
        ('rim = { edge = ["fixed", "outsid"] }', ("supports.rim.edge", "outsid", "'outside'")),
        ('rim = { edge = ["fixed"] }', ("supports.rim.edge", "('fixed',)")),
        ('rim = { edge = ["fixed", "tip"], near = [0, 0, 0] }', ("supports.rim", "edge", "near")),
        ('rim = { near = [0, 0, "5 kPa"] }', ("supports.rim.near", "kPa")),
        ("rim = { box = [[0, 0, 0]] }", ("supports.rim.box",)),
        ('tip = { directions = "x" }', ("supports.tip", "displacement")),
    ],
)
def test_places_that_cannot_be(tmp_path: Path, support: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        read_job(written(tmp_path, support))
