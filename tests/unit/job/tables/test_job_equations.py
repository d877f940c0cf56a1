"""Linear equations, ties and centrifugal forces in job files: read, written back, and refused with what is wrong."""

from pathlib import Path

import pytest

import turgor as tg
from refused import refused
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.units import mm

JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "5 mm"

[materials]
body = {{ law = "neo_hooke", C10 = "0.05 MPa", density = "1070 kg/m³" }}

[loads]
pressure = "5 kPa"

[[loads.centrifugal]]
speed = "600 rpm"
axis = [1, 0, 0]

[supports]
fixed = "xyz"
lever = {{ terms = [{terms}] }}
{more}
"""
TERMS = '{ place = "tip", direction = "y" }, { near = [0, 0, "8 mm"], direction = [0, 0, 2], factor = -0.5 }'


def _job(folder: Path, terms: str = TERMS, more: str = "") -> tg.jobs.Job:
    file = folder / "job.toml"
    file.write_text(JOB.format(terms=terms, more=more), encoding="utf-8")
    return read_job(file)


def test_they_are_read_and_written_back(tmp_path: Path) -> None:
    job = _job(tmp_path, more='outside = { tied_to = "tip" }')
    near = tg.supports.NodesAt("lever_2", near=(0, 0, 8 * mm))
    lever = tg.supports.Equation("lever", [("tip", "y", 1), (near, (0, 0, 2), -0.5)])
    spin = tg.loads.Centrifugal(speed="600 rpm", axis=(1, 0, 0))
    assert {lever, tg.supports.Tied("outside", "tip")} < set(job.supports)
    assert spin in job.loads
    lock = tmp_path / "again.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    assert (read_job(lock).supports, read_job(lock).loads) == (job.supports, job.loads)


@pytest.mark.parametrize(
    ("terms", "more", "facts"),
    [
        ('{ place = "tp", direction = "y" }, { place = "tip", direction = "x" }', "", ("supports.lever", "'tip'")),
        ('{ place = "tip", direction = "w" }, { place = "tip", direction = "x" }', "", ("'w'", "'z'")),
        ('{ place = "tip", direction = "y" }', "", ("'lever'", "('tip', 'y', 1.0)")),
        (
            '{ place = "tip", near = [0, 0, 0], direction = "y" }, { place = "tip", direction = "x" }',
            "",
            ("place, near",),
        ),
        ('{ plase = "tip", direction = "y" }', "", ("'plase'", "'place'")),
        (TERMS, 'outside = { tied_to = "tipp" }', ("supports.outside.tied_to", "'tip'")),
        (TERMS, 'outside = { tied_to = "tip", directions = "x" }', ("supports.outside", "directions")),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, terms: str, more: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        _job(tmp_path, terms, more)


def test_places_that_do_not_match_and_speeds_that_are_none_are_refused(tmp_path: Path) -> None:
    with refused("'lever'", "'outside'", "'tip'"):
        mesh = tg.mesh(_job(tmp_path).geometry(), size=5 * mm)
        rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=5e4))
        uneven = tg.supports.Equation("lever", [("tip", "x", 1), ("outside", "x", 1)])
        tg.Model(mesh, rubber, ["fixed", uneven], [tg.Pressure("cavity", 1e3)])
    for wrong in (-1.0, "3 Hz"):
        with refused("speed"):
            tg.loads.Centrifugal(speed=wrong, axis=(0, 0, 1))
