"""Places of supports and forces in job files: read, written back, solved, and refused with the key that is wrong."""

from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.model.supports import Displacement, Fixed, NodesAt, Shift, Slide
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


def test_rollers_and_tractions_are_read_and_written_back(tmp_path: Path) -> None:
    file = with_load(tmp_path, 'tip = { traction = ["1 kPa", 0, 0] }')
    slopes = 'outside = { directions = [1, 0, 1] }\nrim = { edge = ["tip", "outside"], directions = [0, 1, 1] }'
    file.write_text(file.read_text(encoding="utf-8").replace('fixed = "x"', f'fixed = "normal"\n{slopes}'))
    job = read_job(file)
    assert job.supports == (
        tg.supports.Roller("fixed"),
        tg.supports.Roller("outside", (1.0, 0.0, 1.0)),
        tg.supports.Roller(NodesAt("rim", edge=("tip", "outside")), (0.0, 1.0, 1.0)),
    )
    assert job.loads[1] == tg.Traction("tip", (1e3, 0.0, 0.0))
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}), encoding="utf-8")
    assert (read_job(again).supports, read_job(again).loads) == (job.supports, job.loads)


def test_a_run_with_a_box_that_moves_says_so(tmp_path: Path) -> None:
    text = 'end = { box = [["17 mm", "-20 mm", "-20 mm"], ["20 mm", "20 mm", "20 mm"]], displacement = ["2 mm", 0, 0] }'
    changes = {"output.mesh_error": False, "output.measures": ["tip_displacement_x"]}
    outcome = tg.jobs.run_job(read_job(written(tmp_path, text), changes), tmp_path / "out")
    assert outcome.response.column("tip_displacement_x")[-1] == pytest.approx(2e-3, rel=1e-9)
    assert "end (the box from (17, -20, -20) to (20, 20, 20) mm)" in (tmp_path / "out/report.html").read_text()


def with_load(folder: Path, load: str) -> Path:
    file = written(folder, "")
    file.write_text(file.read_text(encoding="utf-8").replace("[supports]", f"{load}\n\n[supports]"), encoding="utf-8")
    return file


def test_forces_on_places_are_read_and_written_back(tmp_path: Path) -> None:
    text = """
    pull = { near = ["20 mm", 0, "10 mm"], force = ["-0.1 N", 0, 0], history = [[0, 0], [0.5, 1], [1, 1]] }
    ring = { edge = ["tip", "outside"], force = ["10 mN", 0, 0] }
    """
    job = read_job(with_load(tmp_path, text))
    pull, ring = (load for load in job.loads if isinstance(load, tg.loads.Force))
    assert pull.face == NodesAt("pull", near=(20e-3, 0.0, 10e-3))
    assert (pull.vector, pull.share(0.5)) == ((-0.1, 0.0, 0.0), 1.0)
    assert (ring.face, ring.vector) == (NodesAt("ring", edge=("tip", "outside")), (0.01, 0.0, 0.0))
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(again).loads == job.loads


@pytest.mark.parametrize(
    ("load", "facts"),
    [
        ('pull = { edge = ["tip", "outsid"], force = [0, 0, "1 N"] }', ("loads.pull.edge", "outsid", "'outside'")),
        ('pull = { naer = [0, 0, 0], force = [0, 0, "1 N"] }', ("loads.pull", "naer", "'near'")),
        ('pull = { near = [0, 0, 0], box = [[0, 0, 0], [0, 0, 0]], force = [0, 0, "1 N"] }', ("near", "box", "one")),
        ('pull = { near = [0, 0, 0], force = [0, 0, "1 kPa"] }', ("loads.pull.force", "kPa")),
        ('tip = { traction = [0, 0, "1 N"] }', ("loads.tip.traction", "N")),
        ('tip = { tracton = [0, 0, "1 kPa"], force = [0, 0, "1 N"] }', ("loads.tip", "tracton", "'traction'")),
        ('tip = { traction = ["1 kPa", 0, 0], force = [0, 0, "1 N"] }', ("loads.tip", "one of", "traction")),
        ('pull = { near = [0, 0, 0], traction = [0, 0, "1 kPa"] }', ("loads.pull.traction", "force")),
        ('tipp = { force = [0, 0, "1 N"] }', ("loads.tipp", "'tip'")),
    ],
)
def test_forces_on_places_that_cannot_be(tmp_path: Path, load: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        read_job(with_load(tmp_path, load))


@pytest.mark.parametrize(
    ("support", "facts"),
    [
        ('rim = { edge = ["fixed", "outsid"] }', ("supports.rim.edge", "outsid", "'outside'")),
        ('rim = { edge = ["fixed"] }', ("supports.rim.edge", "('fixed',)")),
        ('rim = { edge = ["fixed", "tip"], near = [0, 0, 0] }', ("supports.rim", "edge", "near")),
        ('rim = { near = [0, 0, "5 kPa"] }', ("supports.rim.near", "kPa")),
        ("rim = { box = [[0, 0, 0]] }", ("supports.rim.box",)),
        ("tip = { directions = [1, 0] }", ("supports.tip.directions", "[1.0, 0.0]")),
        ('tip = { directions = [1, 0, 1], displacement = [0, 0, "1 mm"] }', ("supports.tip.displacement", "0.5 mm")),
        ('tip = "normall"', ("supports.tip", "'normal'")),
        ('tip = { directions = "x" }', ("supports.tip", "displacement")),
    ],
)
def test_places_that_cannot_be(tmp_path: Path, support: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        read_job(written(tmp_path, support))


def test_a_move_along_any_direction_is_read_written_back_and_solved(tmp_path: Path) -> None:
    job = read_job(written(tmp_path, 'tip = { directions = [3, 0, 4], displacement = ["0.3 mm", 0, "0.4 mm"] }'))
    (slide,) = (each for each in job.supports if isinstance(each, Slide))
    assert slide.along == (3, 0, 4) and slide.distance == pytest.approx(0.5e-3)
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}), encoding="utf-8")
    (back,) = (each for each in read_job(again).supports if isinstance(each, Slide))
    assert back.along == slide.along and back.distance == pytest.approx(slide.distance, rel=1e-12)
    later = slide.continued(0.5, None)
    for factor in (0.0, 1.0):
        assert later.displacement(np.zeros((1, 3)), factor) == pytest.approx(np.array([[0.15e-3, 0, 0.2e-3]]))


def test_a_move_across_its_direction_is_refused(tmp_path: Path) -> None:
    with refused("supports.tip.displacement", "directions", "0.09 mm"):
        read_job(written(tmp_path, 'tip = { directions = [1, 0, 3], displacement = [0, 0, "0.1 mm"] }'))
