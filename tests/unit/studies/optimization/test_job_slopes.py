"""Slopes of jobs in an optimization: their values, what they spare, what is left out, and what is kept."""

import numpy as np
import pytest

import turgor as tg
from calibration_cases import JOB
from turgor.studies.optimization.job_optimization import job_optimization, readings_of
from turgor.studies.optimization.slopes import slopes_of
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.studies.runs.jobs.job_slopes import refused_at_once
from turgor.studies.runs.jobs.solid_volume import SOLID_VOLUME
from turgor.studies.runs.run import Run
from turgor.studies.runs.study import Row
from turgor.units import MPa, kPa, mm

studies = tg.studies

LEAN = """
job = "part.toml"

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

FINGER = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "20 mm"
wall = "2 mm"

[mesh]
size = "8 mm"
cells = "hexahedra"

[materials.body]
law = "neo_hooke"
C10 = "0.11 MPa"

[materials.base]
law = "neo_hooke"
C10 = "0.15 MPa"

[loads]
pressure = "1 kPa"
"""

BEND = """
job = "part.toml"

[factors]
"actuator.chambers" = { low = 1, high = 2 }
"materials.body.C10" = { low = "0.08 MPa", high = "0.2 MPa" }

[optimize]
most_solves = 2

[[optimize.targets]]
measure = "bending_angle"
value = "40 deg"
"""


def searched(folder, job, study, runs=None, **search):
    (folder / "part.toml").write_text(job, encoding="utf-8")
    more = "".join(f"{key} = {value}\n" for key, value in search.items())
    (folder / "study.toml").write_text(study.replace("[optimize]\n", f"[optimize]\n{more}"), encoding="utf-8")
    asked = studies.read_study_file(folder / "study.toml")
    wanted = job_optimization(asked.optimize, asked.job, folder / f"results{len(more)}", mesh_error=False)
    return wanted.search(runs or Evaluations())


@pytest.fixture
def drawn_nothing(monkeypatch):
    """Runs in this process without the pictures, which take half of the time."""

    class Nothing:
        png = b""

    monkeypatch.setattr("turgor.studies.runs.jobs.job_runs.picture", lambda *_, **__: Nothing())


@pytest.mark.usefixtures("drawn_nothing")
def test_slopes_spare_runs_of_a_job(tmp_path):
    with_them = searched(tmp_path, JOB, LEAN)
    without = searched(tmp_path, JOB, LEAN, slopes="false")
    assert with_them.converged and without.converged
    assert with_them.solves <= 0.7 * without.solves, (with_them.solves, without.solves)
    for name, value in without.values.items():
        assert with_them.values[name] == pytest.approx(value, rel=2e-3), "the same optimum"
    assert with_them.notes == without.notes == ()
    assert not any("_slope_" in name for name in without.best_row.response)


@pytest.fixture(scope="module")
def base(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tube")
    (folder / "tube.toml").write_text(JOB, encoding="utf-8")
    return job_function(tg.jobs.read_job(folder / "tube.toml"), folder / "results")


#: The factors of which each is changed, away from where the mesh gets another layer; and what is read: at a pressure
#: between two states, at another column, at the end.
VALUES = {"actuator.wall": 1.8 * mm, "materials.body.C10": 0.12 * MPa, "loads.pressure": 20 * kPa}
READ = [
    ("tip_displacement_x", ("pressure", 13 * kPa)),
    ("cavity_volume", ("tip_displacement_x", 0.3 * mm)),
    ("tip_displacement_x", None),
    (SOLID_VOLUME, None),
]


def run_of(base, values, **more):
    result = solved_job(**base.values, numbers=values, as_design=True, **more)
    run = Run(name="tube", function=solved_job, values={**base.values, "numbers": values})
    return Row(values=values, ended=Ended(run=run, result=result))


@pytest.mark.usefixtures("drawn_nothing")
def test_slopes_are_those_of_what_the_goals_read(base):
    goals = [studies.Minimize(name, at=at) for name, at in READ]
    row = run_of(base, VALUES, slopes={"readings": readings_of(goals, VALUES)})
    assert row.ended.result.notes == ()
    result = np.array([slopes_of(row, name, at, list(VALUES)) for name, at in READ])
    for place, (key, value) in enumerate(VALUES.items()):
        step = 1e-3 * value
        ends = [run_of(base, {**VALUES, key: value + side * step}) for side in (1, -1)]
        high, low = (np.array([goal.read(each)[0] for goal in goals]) for each in ends)
        differences = (high - low) / (2 * step)
        size = np.abs([goal.read(row)[0] for goal in goals]) / value
        apart = np.abs(result[:, place] - differences)
        assert np.all(apart <= 5e-3 * np.abs(differences) + 1e-4 * size), (key, result[:, place], differences)


@pytest.mark.usefixtures("drawn_nothing")
def test_the_end_of_a_path_that_ended_early_has_no_slopes(base):
    numbers = {"actuator.wall": 1 * mm, "loads.pressure": 90 * kPa}
    asked = [["tip_displacement_x", None, 0.0], ["cavity_volume", "pressure", 10 * kPa]]
    row = run_of(base, numbers, slopes={"readings": asked})
    assert "limit point" in row.problem
    assert np.isnan(slopes_of(row, "tip_displacement_x", None, list(numbers))).all()
    before = slopes_of(row, "cavity_volume", ("pressure", 10 * kPa), list(numbers))
    assert np.isfinite(before).all() and before[0] < 0
    alone = run_of(base, numbers, slopes={"readings": asked[:1]})
    assert np.isnan(slopes_of(alone, "tip_displacement_x", None, list(numbers))).all()


@pytest.mark.usefixtures("drawn_nothing")
def test_what_has_no_slopes_is_said_once_and_left_to_the_surfaces(tmp_path):
    runs = studies.saved_in(tmp_path / "runs")
    result = searched(tmp_path, FINGER, BEND, runs)
    assert len(result.notes) == 1
    assert result.notes[0].startswith("There are no slopes by actuator.chambers: ")
    assert result.summary().count("There are no slopes") == 1
    names = list(result.study.rows[0].response)
    assert "bending_angle_slope_materials_body_C10" in names
    assert "bending_angle_slope_actuator_chambers" not in names
    before, beside = (row.values for row in result.study.rows)
    assert before["materials.body.C10"] == beside["materials.body.C10"], "a run beside the start for the chambers alone"
    again = searched(tmp_path, FINGER, BEND, studies.saved_in(tmp_path / "runs"))
    assert all(row.ended.again for row in again.study.rows)
    assert again.notes == result.notes
    for one, other in zip(again.study.rows, result.study.rows, strict=True):
        assert one.values == other.values
        slope = "bending_angle_slope_materials_body_C10"
        assert one.response[slope][-1] == pytest.approx(other.response[slope][-1], rel=1e-12)


def test_what_no_derivative_can_be_taken_of_is_not_asked_for():
    path = studies.TipPath([(0.0, 0.0), (1 * mm, 2 * mm)], at=("pressure", [0.0, 5 * kPa]))
    assert readings_of([path, studies.Limit("wall", most=1.0)], {"wall"})[-1] == [
        "tip_displacement_z",
        "pressure",
        5e3,
    ]
    assert len(readings_of([path], {})) == 4
    assert readings_of([path, studies.TipPath([(0.0, 0.0), (1.0, 2.0)])], {}) == []
    assert readings_of([path, studies.Minimize(len)], {}) == []


def test_what_is_known_to_have_no_derivative_is_not_tried():
    numbers = {"actuator.wall": 2e-3, "actuator.folds": 2, "materials.a.C10,materials.b.C10": 1e5}
    assert list(refused_at_once(numbers)) == ["actuator.folds"]
    assert "whole numbers" in refused_at_once(numbers)["actuator.folds"]


def tube(wall, stiffness):
    """A tube of finite elements with its slopes."""
    values = {"wall": wall, "stiffness": stiffness}
    solution = tg.solve(tube_model(values))
    gradient = tg.gradient(solution, "tip_displacement_x", studies.Variation(tube_model, values))
    slopes = {"tip_displacement_x": gradient.by("tip_displacement_x")}
    return studies.with_slopes(tg.measure(solution, "tip_displacement_x", mesh_error=False), slopes)


def tube_model(values):
    shape = tg.actuators.ExtendingCylinder(length=20 * mm, cap=3 * mm, wall=values["wall"])
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=values["stiffness"]))
    mesh = tg.mesh(shape.build(), size=3 * mm, cells="axisymmetric", wall_cells=1)
    return tg.Model(mesh, dict.fromkeys(mesh.regions, rubber), [tg.Fixed("fixed")], [tg.Pressure("cavity", 20 * kPa)])


def test_a_function_of_finite_elements_gives_its_gradient():
    factors = [
        studies.Factor(name="wall", low=1 * mm, high=4 * mm, unit="mm"),
        studies.Factor(name="stiffness", low=0.06 * MPa, high=0.3 * MPa, unit="MPa"),
    ]
    goals = [studies.Target("tip_displacement_x", 1.2 * mm)]
    start = {"wall": 2.5 * mm, "stiffness": 0.15 * MPa}
    solves = {}
    for slopes in (True, False):
        result = tg.optimize(tube, factors, goals, start=start, search=studies.Search(slopes=slopes))
        assert result.converged and result.reads()[0].value == pytest.approx(1.2 * mm, rel=0.011)
        solves[slopes] = result.solves
    assert solves[True] < solves[False], solves
