"""Tendons in job files: read, written into the lock file, refused."""

from pathlib import Path

import pytest

from refused import any_states
from turgor.core.model.loads import Tendon
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

[[loads.tendons]]
through = [["0 mm", 0, "2 mm"], ["10 mm", 0, "2 mm"]]
pull = "3 mm"
cable_stiffness = "2 N/mm"
friction = 0.2
"""


def read(folder: Path, text: str):
    (folder / "job.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "job.toml")


def test_a_tendon_is_read_and_written(tmp_path: Path) -> None:
    job = read(tmp_path, JOB)
    (load,) = job.loads
    assert load == Tendon(through=((0, 0, 2e-3), (10e-3, 0, 2e-3)), pull=3e-3, cable_stiffness=2e3, friction=0.2)
    assert read(tmp_path, lock_text(job, {})).loads == job.loads
    assert load.text().startswith("Tendon through 2 points with 3 mm drawn in, friction 0.2")


@pytest.mark.parametrize(
    ("before", "after", "facts"),
    [
        ('pull = "3 mm"', 'tension = "3 mm"', ["loads.tendons.tension:", "3 mm"]),
        ('cable_stiffness = "2 N/mm"\n', "", ["pull needs the cable_stiffness"]),
        ('["10 mm", 0, "2 mm"]', '["10 mm", 0]', ["loads.tendons.through:", "at least 3"]),
        ("friction", "fricton", ["fricton", "friction"]),
        ("tendons", "tendon", ["tendon", "tendons"]),
    ],
)
def test_a_mistake_is_named(tmp_path: Path, before: str, after: str, facts: list[str]) -> None:
    with pytest.raises(JobError) as error:
        read(tmp_path, JOB.replace(before, after))
    assert any_states(error.value.problems, facts), error.value.problems
