"""Commented jobs of `turgor init`: every family has one, and it says the same as the example job."""

import re
import tomllib
from dataclasses import fields

import pytest

from refused import refused
from turgor.core.meshing.default_settings import chosen_settings
from turgor.core.meshing.settings import MeshSettings
from turgor.job.job import ACTUATORS
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.reference.starters import example_job, starter


def written(name, folder):
    """The starter of a family, in a file."""
    file = folder / f"{name}.toml"
    file.write_text(starter(name), encoding="utf-8")
    return file


def told(job):
    """What a job states, without the name of its file."""
    return re.sub(r"stated in .*\.toml", "", lock_text(job, {}))


def told_besides_the_mesh(job):
    return re.sub(r"\[mesh\]\n(.+\n)*", "", told(job))


@pytest.mark.parametrize("name", ACTUATORS)
def test_starter_is_the_example_job_with_the_default_mesh(name, tmp_path):
    job, example = read_job(written(name, tmp_path)), read_job(example_job(name))
    assert told_besides_the_mesh(job) == told_besides_the_mesh(example)
    assert job.mesh == chosen_settings(job.geometry(), MeshSettings())


def test_starter_has_every_key_with_its_range_and_default():
    text = starter("fast_pneunet")
    for item in fields(ACTUATORS["fast_pneunet"]):
        assert re.search(rf"^#?{item.name} = ", text, re.MULTILINE)
    assert '#side_wall = "2 mm"' in text
    said = " ".join(text.replace("\n#  ", "").split())
    assert '[length; allowed: 0.01 mm to 9.995 mm, less than half the width of 20 mm; default "2 mm"]' in said
    for section in ("mesh", "materials.base", "supports", "loads", "contact", "procedure", "output", "engine"):
        assert f"\n[{section}]\n" in text


@pytest.mark.parametrize("name", ["fast_pneunet", "bellows_of_revolution"])
def test_keys_that_are_left_out_have_the_values_that_the_comments_show(name, tmp_path):
    file = written(name, tmp_path)
    before = told(read_job(file))
    text = file.read_text("utf-8")
    head, section, rest = re.split(r"(?m)^(\[mesh\])$", text)
    file.write_text(re.sub(r"(?m)^#(\w+ = )", r"\1", head) + section + rest, encoding="utf-8")
    assert len(tomllib.loads(file.read_text("utf-8"))["actuator"]) == len(fields(ACTUATORS[name])) + 1
    assert told(read_job(file)) == before


@pytest.mark.parametrize("name", ["slow_pneunet", "twisting_tube"])
def test_starter_passes_the_check(name, tmp_path):
    _, findings = prepare(read_job(written(name, tmp_path)))
    assert [finding for finding in findings if finding.severity == "error"] == []


def test_a_family_without_an_example_gets_a_plain_job(tmp_path, monkeypatch):
    monkeypatch.setattr("turgor.job.reference.starters.example_job", lambda name: tmp_path / f"{name}.nothing")
    job = read_job(written("slow_pneunet", tmp_path))
    assert set(job.materials) == {"body", "base"}
    assert job.loads


def test_an_unknown_family_is_answered_with_the_nearest_one():
    with refused("'slow_pneunt'", "'slow_pneunet'"):
        starter("slow_pneunt")
