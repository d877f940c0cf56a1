"""The command ``turgor optimize``: what it prints, writes, goes on with and refuses."""

import csv
import json

import pytest
from PIL import Image
from turgor.jobs import read_job

from calibration_cases import JOB
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED
from turgor.studies.study_file.study_file import read_study_file
from turgor.views.pictures.state_picture import state_figure

STUDY = """
job = "tube.toml"

[factors]
"actuator.wall" = { low = "1 mm", high = "4 mm" }
"actuator.inner_radius" = { low = "4 mm", high = "10 mm", start = "7 mm" }

[optimize]
precision = 0.02

[[optimize.targets]]
measure = "tip_displacement_x"
value = "0.8 mm"
at = { pressure = "15 kPa" }

[[optimize.objectives]]
minimize = "solid_volume"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("optimization")
    (folder / "tube.toml").write_text(JOB, encoding="utf-8")
    (folder / "lean.toml").write_text(STUDY, encoding="utf-8")
    return folder


@pytest.fixture
def call(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)

    def run(*arguments):
        code = main(["optimize", *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_a_lean_tube_is_found_written_and_read_again(call, folder):
    code, said, told = call("lean.toml", "--most-solves", "4", "--no-mesh-error")
    assert code == NOT_CONVERGED
    assert "The budget of 4 runs ended before the search." in said
    assert told.count(" done, ") == 4
    code, said, told = call("lean.toml")
    assert code == DONE
    assert told.count(": read") == 4, "the runs of the first call"
    assert "mm (mesh) (wanted 0.8 mm), at the start 0.355" in said
    results = folder / "lean-optimization"
    assert f"Written in {results.name}: optimization.csv, optimization.txt, optimization.png, best.toml" in said
    table = list(csv.DictReader((results / "optimization.csv").open(encoding="utf-8")))
    kept = [row for row in table if row["kept"] == "1"]
    best = min(kept, key=lambda row: float(row["solid volume (mL)"]))
    assert float(best["tip displacement x at pressure 15 kPa (mm)"]) == pytest.approx(0.8, rel=0.011)
    wall, radius = (float(best[f"actuator.{name} (mm)"]) for name in ("wall", "inner_radius"))
    job = read_job(results / "best.toml")
    assert job.actuator.wall == pytest.approx(wall / 1e3, rel=0.05)
    assert (wall, radius) == (pytest.approx(1.0, abs=0.1), pytest.approx(7.92, abs=0.2))
    assert job.procedure.at == (0.75,), "a state at 15 kPa"
    for name in ("optimization.png", "before-and-after.png"):
        assert Image.open(results / name).size[0] > 400


def test_before_and_after_have_one_scale_and_runs_are_whole_numbers(call, folder, monkeypatch):
    drawn = []

    def noted(state, view=None, **how):
        drawn.append(view)
        return state_figure(state, view, **how)

    monkeypatch.setattr("turgor.studies.optimization.figure.state_figure", noted)
    assert call("lean.toml")[0] == DONE
    assert len(drawn) == 2 and drawn[0] is drawn[1]


def test_factors_may_be_tables_within_tables(folder):
    text = STUDY.replace('"actuator.wall"', "actuator.wall").replace('"actuator.inner_radius"', "actuator.inner_radius")
    (folder / "plain.toml").write_text(text, encoding="utf-8")
    plain, lean = (read_study_file(folder / f"{name}.toml").optimize for name in ("plain", "lean"))
    assert (plain.factors, plain.start) == (lean.factors, lean.start)


def test_the_answer_for_programs(call):
    code, said, _ = call("lean.toml", "--json")  # everything is read
    results = json.loads(said)
    assert code == results["exit_code"] == DONE
    result = results["result"]
    assert result["status"] == "converged" and result["solves"] == len(result["rows"])
    assert result["factors"][0] | {"value": 0} == {
        "name": "actuator.wall", "unit": "mm", "low": 1e-3, "high": 4e-3, "start": 2e-3, "value": 0
    }  # fmt: skip
    best = result["rows"][result["best"]]
    assert best["goals"][0] == pytest.approx(8e-4, rel=0.011)
    assert result["goals"][0]["mesh_error"] > 0


def test_what_cannot_be_cast_is_not_computed(call, folder):
    text = (
        STUDY.replace('"1 mm", high', '"0.2 mm", high')
        + '\n[optimize.casting]\nmold = false\nsmallest_wall = "1.5 mm"\n'
    )
    (folder / "cast.toml").write_text(text, encoding="utf-8")
    code, _, _ = call("cast.toml", "--no-mesh-error")
    assert code == DONE
    table = list(csv.DictReader((folder / "cast-optimization" / "optimization.csv").open(encoding="utf-8")))
    assert min(float(row["actuator.wall (mm)"]) for row in table) >= 1.5 - 1e-6


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('job = "tube.toml"', "", "'job' is missing; name a job file"),
        ("tube.toml", "tub.toml", "tub.toml"),
        (
            'job = "tube.toml"',
            'job = "tube.toml"\nfactor = 1',
            "wrong.toml:3: factor: unknown key 'factor'; did you mean 'factors'?",
        ),
        ("actuator.wall", "actuator.wal", "unknown number of the job 'actuator.wal'; did you mean 'actuator.wall'?"),
        ('low = "1 mm"', "low = 1", "wrong.toml:5: factors.actuator.wall: 1 needs a unit, such as '1 mm'"),
        ('low = "1 mm"', 'low = "1 kPa"', "'1 kPa' is a pressure"),
        ('low = "1 mm", ', "", "factors.actuator.wall: 'low' is missing"),
        ('low = "1 mm"', 'low = "5 mm"', "'actuator.wall' goes from 0.005 to 0.004; low must be below high"),
        ('start = "7 mm"', 'begin = "7 mm"', "factors.actuator.inner_radius: unknown key of a factor 'begin'"),
        ('"tip_displacement_x"', '"tip_displacment_x"', "did you mean 'tip_displacement_x'?"),
        ('measure = "tip_displacement_x"', "", "wrong.toml:11: optimize.targets.1: 'measure' is missing"),
        ('value = "0.8 mm"', "", "optimize.targets.1: 'value' is missing"),
        ('value = "0.8 mm"', 'value = "0.8 furlongs"', "'0.8 furlongs' is no number with a known unit"),
        ('at = { pressure = "15 kPa" }', "at = 15", "at is 15; write one column and its value"),
        ("at = { pressure", "at = { presure", "at of a goal: unknown column 'presure'; did you mean 'pressure'?"),
        ("minimize", "minimise", "unknown key in objectives 'minimise'"),
        ('minimize = "solid_volume"', "scale = 1", "needs either minimize or maximize"),
        ("precision = 0.02", "precision = 2", "precision is 2; allowed is between 0 and 0.1"),
        ("precision = 0.02", 'method = "newton"', "unknown method 'newton'"),
        ("precision = 0.02", "starts = 20", "starts is 20; allowed is 1 to 12, half of most_solves, 25"),
        ("precision = 0.02", 'slopes = "no"', "slopes is 'no'; allowed is true or false"),
        ("[[optimize.targets]]", "[optimize.targets]", "is not a list of tables, [[optimize.targets]]"),
        ("precision = 0.02", "[optimize.casting]", "there is no mold with webs and pins for ExtendingCylinder"),
    ],
)
def test_mistakes_are_answered(call, folder, old, new, sentence):
    assert old in STUDY
    (folder / "wrong.toml").write_text(STUDY.replace(old, new, 1), encoding="utf-8")
    code, _, told = call("wrong.toml", "--output", "refused")
    assert code == BAD_INPUT
    assert sentence in told
    assert "Traceback" not in told


def test_paths_limits_and_shares_are_read(folder):
    from turgor.units import kPa, mm

    text = (
        STUDY.split("[[optimize.targets]]")[0]
        + """
[[optimize.paths]]
x = "0, -2, -8 mm"
z = "0, 10, 18 mm"
pressure = "0, 10, 20 kPa"
tolerance = "0.5 mm"

[[optimize.limits]]
measure = "maximum_von_mises"
most = "0.2 MPa"
tolerance = "1 %"
"""
    )
    (folder / "path.toml").write_text(text, encoding="utf-8")
    path, limit = read_study_file(folder / "path.toml").optimize.goals
    assert path.points == [(0, 0), (pytest.approx(-2 * mm), pytest.approx(10 * mm)), (pytest.approx(-8 * mm), 18 * mm)]
    assert path.at == ("pressure", [0, 10 * kPa, 20 * kPa])
    assert path.tolerance == pytest.approx(0.5 * mm)
    assert (limit.most, limit.tolerance, limit.unit) == (0.2e6, pytest.approx(0.01), "MPa")
