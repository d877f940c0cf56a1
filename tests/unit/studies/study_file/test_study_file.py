"""Study files: one format for all kinds, read as the options of the commands are, and listed in the reference."""

import json
import re
from dataclasses import fields
from pathlib import Path

import pytest

import turgor as tg
from calibration_cases import JOB
from refused import refused, states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.studies.optimization.manufacture import Casting
from turgor.studies.optimization.search import Search
from turgor.studies.study_file import analysis_tables, calibrate_table, goal_tables, sweep_table, uncertainty_table
from turgor.studies.study_file.job_base import KEYS
from turgor.studies.study_file.study_file import KINDS
from turgor.units import mm

PAGE = Path(__file__).parents[4] / "docs" / "reference" / "study-file.md"

#: One file with all kinds.
EVERY = """
job = "tube.toml"

[factors]
"actuator.wall" = { low = "1 mm", high = "4 mm", start = "2 mm", prior = "2.2 mm +- 1 %", spread = "0.1 mm" }
"materials.body.C10" = { low = "0.1 MPa", high = "0.14 MPa", spread = "5 %", label = "rubber" }

[sweep]
design = "sobol"
samples = 8
measures = ["tip_displacement_x"]

[optimize]
most_solves = 12
targets = [{ measure = "tip_displacement_x", value = "0.8 mm" }]

[calibrate]
experiments = ["rig.csv"]
spread = ["0.002 mm"]
rig = ["pressure_offset"]

[uncertainty]
at = "10 kPa"

[sensitivity]
method = "sobol"
samples = 64

[surrogate]
along = "pressure"
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    (tmp_path / "every.toml").write_text(EVERY, encoding="utf-8")
    (tmp_path / "rig.csv").write_text(
        "pressure (kPa),tip_displacement_x (mm)\n0,0\n5,0.12\n10,0.25\n15,0.38\n", encoding="utf-8"
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_one_file_states_all_kinds(folder):
    result = tg.studies.read_study_file("every.toml")
    assert (result.name, result.job.name) == ("every", "tube")
    assert len(result.sweep.designs) == 8
    assert result.optimize.start == {"actuator.wall": 2 * mm, "materials.body.C10": 0.12e6}
    assert result.optimize.search.most_solves == 12 and len(result.optimize.goals) == 1
    wall, stiffness = result.calibrate.free
    assert (wall.start, wall.bounds, wall.prior) == (2 * mm, (1 * mm, 4 * mm), (2.2 * mm, pytest.approx(0.022 * mm)))
    assert (stiffness.start, stiffness.prior) == (0.12e6, None)
    assert result.calibrate.spreads == (pytest.approx(0.002 * mm),)
    assert [(each.label, each.deviation) for each in result.uncertainty.inputs] == [
        ("actuator.wall", pytest.approx(0.1 * mm)), ("rubber", pytest.approx(0.006e6))
    ]  # fmt: skip
    assert result.uncertainty.at == 10e3
    assert (result.sensitivity.method, result.surrogate.along) == ("sobol", "pressure")


def test_only_the_table_that_is_needed_is_read(folder):
    (folder / "every.toml").write_text(EVERY.replace("rig.csv", "lost.csv"), encoding="utf-8")
    assert tg.studies.read_study_file("every.toml", kind="optimize").calibrate is None
    with refused("every.toml:18", "calibrate.experiments", "'lost.csv'"):
        tg.studies.read_study_file("every.toml")
    (folder / "ranges.toml").write_text(EVERY.partition("[sweep]")[0], encoding="utf-8")
    assert len(tg.studies.read_study_file("ranges.toml").sweep.designs) == 9
    with refused("ranges.toml", "[calibrate]"):
        tg.studies.read_study_file("ranges.toml", kind="calibrate")
    with refused("'every'", "[sweep]"):
        tg.studies.sweep_job(tg.studies.read_study_file("every.toml", kind="optimize"), "x", tg.studies.Evaluations())


FREE = ["--free", "actuator.wall=2 mm:1 mm:4 mm", "--prior", "actuator.wall=2.2 mm +- 1 %"]
SPREADS = ["--spread", "actuator.wall=0.1 mm", "--spread", "materials.body.C10=5 % as rubber", "--at", "10 kPa"]
CALLS = {
    "calibrate": ["rig.csv", *FREE, "--free", "materials.body.C10=0.12 MPa:0.1 MPa:0.14 MPa", "--spread", "0.002 mm",
                  "--rig", "pressure_offset"],
    "uncertainty": [*SPREADS],
}  # fmt: skip


@pytest.mark.parametrize("kind", list(CALLS))
def test_a_study_file_is_the_same_as_options(folder, capsys, kind):
    """The second call reads every run of the first one, and says the same."""
    assert main([kind, "tube.toml", *CALLS[kind], "--output", "found", "--json"]) == DONE
    stated = json.loads(capsys.readouterr().out)["result"]
    assert main([kind, "every.toml", "--output", "found", "--json"]) == DONE
    said = capsys.readouterr()
    assert ": done" not in said.err and said.err.count(": read") > 1
    read, says = json.loads(said.out)["result"], {"calibrate": "parameters", "uncertainty": "sentences"}[kind]
    assert read[says] == stated[says]
    assert main([kind, "every.toml", *CALLS[kind]]) == BAD_INPUT
    assert states(capsys.readouterr().err, "job file", "'every.toml'")


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ("prior =", "priors =", [5, "factors.actuator.wall", "'priors'", "'prior'"]),
        ("2.2 mm +- 1 %", "2.2 kPa +- 1 %", [5, "factors.actuator.wall: prior", "'2.2 kPa'"]),
        ('spread = "0.1 mm"', "spread = 1", [5, "factors.actuator.wall", "spread", 1, '"0.1 mm"']),
        ('low = "0.1 MPa", ', "", [6, "factors.materials.body.C10", "'low'"]),
        ('["rig.csv"]', "[]", [18, "calibrate.experiments"]),
        ('"0.002 mm"', '"3"', [19, "calibrate.spread", "'3'", "kPa, mm"]),
        ('at = "10 kPa"', 'att = "10 kPa"', ["uncertainty.att", "'att'", "'at'"]),
        ("samples = 64", 'samples = "64"', [27, "sensitivity.samples", "'64'"]),
        ("[surrogate]", "[surogate]", [29, "'surogate'", "'surrogate'"]),
    ],
)
def test_mistakes_are_answered(folder, old, new, facts):
    assert EVERY.replace(old, new, 1) != EVERY
    (folder / "every.toml").write_text(EVERY.replace(old, new, 1), encoding="utf-8")
    with refused("every.toml", *facts):
        tg.studies.read_study_file("every.toml")


def test_every_key_is_in_the_reference():
    words = set(re.findall(r"[\w.]+", " ".join(re.findall(r"`([^`\n]+)`", PAGE.read_text(encoding="utf-8")))))
    tables = (
        sweep_table.SweepTable, calibrate_table.CalibrateTable, uncertainty_table.UncertaintyTable,
        analysis_tables.SensitivityTable, analysis_tables.SurrogateTable,
    )  # fmt: skip
    keys = {name for table in tables for name in table.model_fields}
    keys |= {each.name for kind in (Search, Casting) for each in fields(kind)}
    keys |= {key for goal in goal_tables.GOAL_KEYS.values() for key in goal}
    keys |= {*KEYS, *KINDS, *(f"optimize.{kind}" for kind in goal_tables.GOAL_KEYS)}
    assert keys <= words, sorted(keys - words)
