"""Goals that take several runs or contact: the workspace of a design, and the force of a blocked tip."""

import csv

import pytest

import optimization_cases as cases
import turgor as tg
from calibration_cases import JOB
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.units import kPa, mL, mm

studies = tg.studies


def test_the_largest_workspace_under_limits_of_stress_and_rubber():
    """The stress gives the wall, 160 kPa mm / 80 kPa = 2 mm, the rubber the length, 8 mL / 50 mm / 2 mm = 80 mm."""
    ranges = [
        studies.Factor(name="length", low=40 * mm, high=120 * mm, unit="mm"),
        studies.Factor(name="wall", low=1 * mm, high=4 * mm, unit="mm"),
    ]
    goals = [
        studies.Maximize("workspace_area"), studies.Limit("stress", most=80 * kPa), studies.Limit("rubber", most=8 * mL)
    ]  # fmt: skip
    result = tg.optimize(cases.reach_of_two_cavities, ranges, goals, search=studies.Search(most_solves=40))
    assert result.converged, result.summary()
    assert result.values == pytest.approx({"length": 80 * mm, "wall": 2 * mm}, rel=0.01)
    corner = 20e3 * 1e-8 * result.values["length"] ** 2 / (60 * mm) / result.values["wall"]
    assert result.reads()[0].value == pytest.approx(2 * corner**2)  # a square with diagonals of twice the corner
    assert "workspace area: " in result.summary()
    assert "mm² (as large as possible)" in result.summary()


PUSHES = """
job = "blocked.toml"

[factors]
"actuator.inner_radius" = { low = "4 mm", high = "10 mm", start = "6 mm" }

[[optimize.targets]]
measure = "blocked_force"
value = "0.8 N"
at = { pressure = "8 kPa" }
"""


def test_a_tip_before_a_plate_is_to_push_with_a_force(tmp_path, monkeypatch, capsys):
    job = JOB.replace("20 kPa", "10 kPa") + '\n[procedure]\ntype = "blocked_force"\n'
    (tmp_path / "blocked.toml").write_text(job, encoding="utf-8")
    (tmp_path / "push.toml").write_text(PUSHES, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(["optimize", "push.toml", "--no-mesh-error"]) == DONE
    said, progress = capsys.readouterr()
    assert progress.lstrip().startswith("actuator.inner_radius 6 mm: done")
    assert "N (wanted 0.8 N), at the start 0.2" in said
    best = job_function(tg.jobs.read_job(tmp_path / "push-optimization" / "best.toml"), tmp_path / "again")
    result = solved_job(**best.values, numbers={}, measures=["blocked_force"]).response
    assert list(result["pressure"])[-2:] == pytest.approx([8 * kPa, 10 * kPa])  # a state where the goal reads
    assert result["blocked_force"][-2] == pytest.approx(0.8, rel=0.011)


BENDER = """
[actuator]
type = "bidirectional_bender"
length = "40 mm"

[mesh]
size = "12 mm"
wall_cells = 1

[materials]
body = { library = "elastosil-m4601", record = "neo-hooke-polygerinos-2020" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[loads]
pressure = "10 kPa"
"""

REACHES = """
job = "bender.toml"

[factors]
"actuator.outer_wall" = { low = "1.5 mm", high = "3 mm" }

[optimize]
most_solves = 2

[[optimize.objectives]]
maximize = "workspace_area"

[[optimize.limits]]
measure = "workspace_area"
least = "0.001 mm²"

[optimize.workspace]
cavity_1 = "0, 10 kPa"
cavity_2 = "0, 10 kPa"
"""


@pytest.fixture
def reaches(tmp_path, monkeypatch):
    (tmp_path / "bender.toml").write_text(BENDER, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "reach.toml"


def test_a_job_is_to_reach_far_with_all_combinations_of_its_pressures(reaches, capsys):
    """The area of the best job, computed on its own, is the one that the search has read; and a second call reads."""
    reaches.write_text(REACHES, encoding="utf-8")
    assert main(["optimize", "reach.toml", "--no-mesh-error"]) == NOT_CONVERGED  # after two runs
    assert "mm² (as large as possible), at the start 0.00" in capsys.readouterr().out
    folder = reaches.parent / "reach-optimization"
    table = list(csv.DictReader((folder / "optimization.csv").open(encoding="utf-8")))
    areas = [float(row["workspace area (mm2)"]) for row in table]
    assert len(areas) == 2
    assert areas[0] != pytest.approx(areas[1], rel=0.05)
    pressures = {"cavity_1": (0.0, 10 * kPa), "cavity_2": (0.0, 10 * kPa)}
    alone = tg.studies.workspace_of(tg.jobs.read_job(folder / "best.toml"), pressures)
    assert alone.reached.area == pytest.approx(max(areas) * mm**2, rel=1e-6)
    assert len(list((folder / "workspaces").glob("*.json"))) == 2 * 3  # rest takes no run


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("cavity_2 =", "cavty_2 =", "unknown cavity of the workspace 'cavty_2'; did you mean 'cavity_2'?"),
        ('"0, 10 kPa"', '"0, 10 mm"', "optimize.workspace: cavity_1: '0 mm' is a length"),
        ('"0, 10 kPa"', "10", 'cavity_1 is 10; write numbers and their unit, such as "0, 10, 20 kPa"'),
        ("optimize.workspace]", "optimize.workspaces]", "unknown key 'workspaces'; did you mean 'workspace'?"),
        (
            REACHES.partition("[optimize.workspace]")[2],
            "",
            "reads 'workspace_area', which needs the pressures of the cavities",
        ),
        ("workspace_area", "solid_volume", "no goal reads workspace_area or workspace_volume"),
        ('"workspace_area"', '"workspace_aera"', "did you mean 'workspace_area'?"),
    ],
)
def test_mistakes_in_a_workspace_are_answered(reaches, capsys, old, new, sentence):
    assert old in REACHES
    reaches.write_text(REACHES.replace(old, new, 2 if old == "workspace_area" else 1), encoding="utf-8")
    assert main(["optimize", "reach.toml"]) == BAD_INPUT
    assert sentence in capsys.readouterr().err
