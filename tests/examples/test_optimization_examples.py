"""The examples and the guide on optimization run, and say what they say."""

import re
import runpy
import shlex
import shutil
import tomllib
from pathlib import Path

import pytest

from turgor.cli import main
from turgor.cli.exits import DONE, NOT_CONVERGED
from turgor.cli.start.commands import COMMANDS
from turgor.studies.study_file.study_file import read_study_file

ROOT = Path(__file__).parents[2]


def test_bellows_from_the_strongest_to_the_softest():
    held = runpy.run_path(str(ROOT / "examples" / "optimized_bellows.py"))
    strong, soft = held["strong"], held["far"]
    assert strong[0].value == pytest.approx(1.06, abs=0.03)  # N
    assert soft[1].value == pytest.approx(20.6e-3, rel=0.02)  # m


def test_the_tip_passes_three_places():
    held = runpy.run_path(str(ROOT / "examples" / "tip_path.py"))
    assert held["found"].values["length"] == pytest.approx(0.15, rel=0.02)  # m


def test_the_code_of_the_guide():
    text = (ROOT / "docs" / "howto" / "optimize.md").read_text(encoding="utf-8")
    known = {"__name__": "guide"}
    exec("\n".join(re.findall(r"```python\n(.*?)```", text, re.DOTALL)), known)
    assert known["found"].reads()[0].value == pytest.approx(10e-6, rel=0.01)  # m³


def test_study_files_of_the_guides_are_those_of_the_example(tmp_path):
    """The finger itself takes minutes; its files are read."""
    example = read_study_file(ROOT / "examples" / "gripper_finger_study.toml")
    assert example.job.actuator.chambers == 3
    page = (ROOT / "docs" / "howto" / "optimize.md").read_text(encoding="utf-8")
    (tmp_path / "page.toml").write_text(re.findall(r"```toml\n(.*?)```", page, re.DOTALL)[0], encoding="utf-8")
    shutil.copy(ROOT / "examples" / "gripper_finger.toml", tmp_path)
    shown, example = read_study_file(tmp_path / "page.toml").optimize, example.optimize
    assert (shown.factors, shown.start, shown.casting) == (example.factors, example.start, example.casting)
    assert [goal.measure for goal in shown.goals] == [goal.measure for goal in example.goals]


def test_the_page_on_the_finger_shows_the_files_of_the_example():
    """Every command of the page was run; here its files are compared, and its commands with those that there are."""
    page = (ROOT / "docs" / "howto" / "gripper-finger.md").read_text(encoding="utf-8")
    tables = [tomllib.loads(text) for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL)]
    job, sweep, study = tables
    assert job == tomllib.loads((ROOT / "examples" / "gripper_finger.toml").read_text(encoding="utf-8"))
    example = tomllib.loads((ROOT / "examples" / "gripper_finger_study.toml").read_text(encoding="utf-8"))
    assert study | {"job": ""} == example | {"job": ""}
    assert set(sweep["factors"]) <= set(study["factors"])
    known = set(COMMANDS)
    asked = set(re.findall(r"^    turgor (\w+)", page, re.MULTILINE))
    assert {"init", "check", "run", "sweep", "optimize", "uncertainty", "export"} == asked <= known


@pytest.mark.slow
def test_every_command_of_the_page_on_the_finger_runs(tmp_path, monkeypatch):
    """The commands one after the other, on a shorter finger and with few runs; what they write is there."""
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs" / "howto" / "gripper-finger.md").read_text(encoding="utf-8")
    job, sweep, study = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    job = job.replace("chambers = 3", "chambers = 2").replace('"33 mm"', '"22 mm"').replace('"15 kPa"', '"4 kPa"')
    for name, text in (("finger", job), ("sweep", sweep), ("study", study.replace('"40 deg"', '"6 deg"'))):
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    for line in re.findall(r"^    turgor (.*)$", page, re.MULTILINE):
        asked = shlex.split(line) + (["--most-solves", "5"] if line.startswith("optimize") else [])
        assert main(asked) in (DONE, NOT_CONVERGED), line
    assert (tmp_path / "finger-mold" / "finger-mold-core.stl").stat().st_size > 10_000
    assert (tmp_path / "finger-uncertainty" / "uncertainty.csv").is_file()
    assert (tmp_path / "sweep-study" / "study.csv").is_file()
