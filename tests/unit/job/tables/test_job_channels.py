"""Channels in job files: read, written into the lock file, refused."""

from pathlib import Path

import pytest

from refused import any_states
from turgor.core.model.loads import Channel
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.text.problems import JobError

JOB = """
[actuator]
type = "bidirectional_bender"

[mesh]
size = "6 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[loads.cavity_1]
pressure = "20 kPa"

[[loads.channels]]
between = ["cavity_1", "cavity_2"]
resistance = "2 kPa s/mL"

[procedure]
type = "static"
duration = "3 s"
"""


def read(folder: Path, text: str):
    (folder / "job.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "job.toml")


def test_a_channel_is_read_and_written(tmp_path: Path) -> None:
    job = read(tmp_path, JOB)
    assert job.loads[-1] == Channel(between=("cavity_1", "cavity_2"), resistance=2e9)
    assert job.loads[-1].share(0.0) == 1
    valve = read(tmp_path, JOB.replace('mL"\n', 'mL"\nhistory = [[0, 0], [1, 0.5]]\n'))
    assert valve.loads[-1].share(1.0) == 0.5
    assert valve.loads[-1].text() != job.loads[-1].text()
    for each in (job, valve):
        assert read(tmp_path, lock_text(each, {})).loads == each.loads


@pytest.mark.parametrize(
    ("before", "after", "facts"),
    [
        ("2 kPa s/mL", "2 kPa", ["loads.channels.resistance:", "'2 kPa'", "flow resistance"]),
        ("2 kPa s/mL", "0 Pa s/m³", ["loads.channels", "resistance is 0", "above 0"]),
        ('"cavity_2"]', '"cavty_2"]', ["cavty_2", "cavity_2"]),
        ('"cavity_2"]', '"cavity_1"]', ["loads.channels", "two cavities"]),
        ('["cavity_1", "cavity_2"]', '["cavity_1"]', ["loads.channels.between"]),
        ("resistance =", "resistence =", ["resistence", "resistance"]),
    ],
)
def test_a_mistake_in_a_channel_is_named(tmp_path: Path, before: str, after: str, facts: list[str]) -> None:
    with pytest.raises(JobError) as error:
        read(tmp_path, JOB.replace(before, after))
    assert any_states(error.value.problems, facts), error.value.problems
