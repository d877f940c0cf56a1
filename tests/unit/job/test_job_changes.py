"""Changes of a job: values by dotted keys, laid over the file before it is read."""

from pathlib import Path

import pytest

from refused import refused, states
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.text.overrides import parse_changes
from turgor.units import kPa, mm

EXAMPLES = Path(__file__).parents[3] / "examples"
FINGER = EXAMPLES / "actuators" / "slow_pneunet.toml"
STAGES = EXAMPLES / "hang_fill_press.toml"


def test_a_changed_value_replaces_that_of_the_file_and_the_rest_stays():
    job = read_job(FINGER, parse_changes(["loads.pressure=7 kPa", "mesh.size = '5 mm'"]))
    assert job.loads[0].pressure == 7 * kPa
    assert job.mesh.size == 5 * mm
    assert job.materials == read_job(FINGER).materials


def test_the_lock_file_holds_the_changed_values(tmp_path):
    job = read_job(FINGER, {"loads.pressure": "7 kPa", "procedure.max_step": 0.125, "output.report": False})
    lock = tmp_path / "job.lock.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    again = read_job(lock)
    assert again.loads == job.loads
    assert again.procedure.max_step == 0.125
    assert not again.output.report


def test_a_section_that_the_file_leaves_out_starts_from_its_default():
    job = read_job(FINGER, {"supports.tip": "z", "procedure.max_step": 0.1})
    assert [support.face for support in job.supports] == ["fixed", "tip"]
    assert job.procedure.max_step == 0.1


@pytest.mark.parametrize("stage", ["press", "3"])
def test_a_stage_is_named_by_its_name_or_number(stage):
    job = read_job(STAGES, {f"stages.{stage}.procedure.max_step": 0.07})
    steps = [each.procedure.max_step for each in job.procedure.stages]
    assert steps[2] == 0.07
    assert steps[:2] == [each.procedure.max_step for each in read_job(STAGES).procedure.stages[:2]]


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("loads.presure=30 kPa", ["changes: loads.presure:", "'presure'", "'pressure'"]),
        ("load.pressure=30 kPa", ["changes: load:", "'load'", "'loads'"]),
        ("loads.pressure=30", ["changes: loads.pressure:", "30", "'60 kPa'"]),
        ("loads.pressure.x=1", ["changes: loads.pressure.x:", "'15 kPa'", "'x'"]),
        ("mesh.size=[2", ["changes: mesh.size:", "[2", "TOML"]),
        ("procedure={type='statik'}", ["changes: procedure.type:", "'statik'", "'static'"]),
        ("loads..pressure=1", ["changes: 'loads..pressure'", "loads.pressure"]),
        ("loads.pressure", ["changes is 'loads.pressure'", "'30 kPa'"]),
        ("=3", ["changes is '=3'", "'30 kPa'"]),
        ("mesh.wall_cells=2\ngrading=1", ["changes: mesh.wall_cells:", "'2\\ngrading=1'", "whole number"]),
    ],
)
def test_a_mistake_is_a_sentence_that_names_the_argument_or_on_the_command_line_the_option(text, facts):
    with refused(*facts) as caught:
        read_job(FINGER, parse_changes([text]))
    assert all(states(caught.value.on_command_line, fact.replace("changes", "--set")) for fact in facts)
    assert "--set" not in str(caught.value)


def test_a_mistake_in_the_file_keeps_its_line_beside_one_of_a_change(tmp_path):
    file = tmp_path / "job.toml"
    file.write_text(FINGER.read_text("utf-8").replace("[output]", "[output]\npicture = true"), encoding="utf-8")
    with refused("job.toml:20", "output.picture", "changes", "mesh.siz", "'size'"):
        read_job(file, {"mesh.siz": "2 mm"})


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("stages.pres.procedure.max_step=0.1", ["stages.pres", "'pres'", "'press'", "fill, press"]),
        ("stages.name=x", ["stages.name", "list", "'name'"]),
        ("stages.press.procedure.max_stepp=0.1", ["stages.press.procedure.max_stepp", "'max_stepp'", "'max_step'"]),
    ],
)
def test_a_mistake_in_a_stage(text, facts):
    with refused("changes", *facts):
        read_job(STAGES, parse_changes([text]))
