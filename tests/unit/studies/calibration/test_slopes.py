"""Derivatives in a calibration: their values, what they spare, what happens without them, and what is kept."""

import numpy as np
import pytest

import calibration_cases as cases
import turgor as tg
from calibration_cases import free_parameters
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.calibration.calibrate import calibrate
from turgor.studies.calibration.curve import PathCurve
from turgor.studies.calibration.job_calibration import job_trial
from turgor.studies.calibration.objective import Objective, rig_parameter
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.trial import Trial, data_of
from turgor.studies.runs.evaluations import Evaluations, saved_in
from turgor.studies.runs.jobs import job_slopes
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.studies.runs.slopes import slope_name
from turgor.units import kPa, mm

#: Between 1.6 and 1.97 mm the mesh keeps its layers; at others there are no differences to compare with.
FREE = ["materials.body.C10=0.12 MPa", "actuator.wall=1.8 mm:1.6 mm:1.97 mm"]
TRUE = {"materials.body.C10": 0.11e6, "actuator.wall": 1.85 * mm}
PRIOR = ["actuator.wall=1.85 mm +- 1 %"]


def base_of(folder, text=cases.JOB):
    folder.mkdir(exist_ok=True)
    (folder / "tube.toml").write_text(text, encoding="utf-8")
    return job_function(tg.jobs.read_job(folder / "tube.toml"), folder / "results")


def curve_of(base, name="tip_displacement_x", noise=2e-6, **more):
    """What a rig would measure of the true tube."""
    true = solved_job(**base.values, numbers={**TRUE, **more}).response
    at = np.linspace(1.1 * kPa, 18.9 * kPa, 15)  # not at states, where the second derivative of the curve jumps
    values = np.interp(at, true["pressure"], true[name]) + noise * np.random.default_rng(1).standard_normal(15)
    columns = Column("pressure", "kPa", at), Column(name, "mm", values)
    return Response(columns=columns, source=Source(text="rig"))


@pytest.fixture(scope="module")
def base(tmp_path_factory):
    return base_of(tmp_path_factory.mktemp("slopes"))


@pytest.fixture(scope="module")
def measured(base):
    return curve_of(base)


def without(trial):
    return Trial(
        measured=trial.measured, function=trial.function, spread=trial.spread, values=trial.values, gather="numbers"
    )


def test_the_interpolation_is_differentiated_exactly():
    """A curve of which all points move, in both directions; differences of the interpolation of moved points."""
    rng, at = np.random.default_rng(0), np.linspace(-0.2, 1.3, 40)
    x, y = np.linspace(0, 1, 8) ** 1.3, np.sin(np.linspace(0, 2.5, 8))
    moves, rates = 0.1 * rng.standard_normal(8), rng.standard_normal(8)

    def response(step):
        columns = [("pressure", x + step * moves), ("y", y + step * rates)]
        columns += [(slope_name("pressure", "p"), moves), (slope_name("y", "p"), rates)]
        return Response(columns=tuple(Column(n, "", v) for n, v in columns), source=Source(text="points"))

    ends = [PathCurve.of(response(step), "pressure", "y").at(at) for step in (1e-6, -1e-6)]
    curve = PathCurve.of(response(0.0), "pressure", "y")
    result = curve.slopes(at, response(0.0), ("pressure", "y"), ["p", "q"])
    assert result[:, 0] == pytest.approx((ends[0] - ends[1]) / 2e-6, rel=1e-5, abs=1e-6)
    assert np.isnan(result[:, 1]).all(), "by q there are none"
    assert curve.rise(at) == pytest.approx((curve.at(at + 1e-6) - curve.at(at - 1e-6)) / 2e-6, rel=1e-5, abs=1e-6)


def test_only_the_states_beside_the_measured_rows_need_slopes():
    columns = {"pressure": np.arange(8.0), "y": np.arange(8.0) ** 2, "y_slope_p": np.ones(8)}
    known = []
    for lost in range(8):
        slopes = columns["y_slope_p"].copy()
        slopes[lost] = np.nan
        made = {**columns, "y_slope_p": slopes}
        response = Response(columns=tuple(Column(n, "", v) for n, v in made.items()), source=Source(text="points"))
        result = PathCurve.of(response, "pressure", "y").slopes(np.array([3.5]), response, ("pressure", "y"), ["p"])
        known.append(bool(np.isfinite(result).all()))
    assert known == [True, True, False, False, False, False, True, True]


#: Load factors at which the path has its states, whatever the numbers are: differences of whole solves need them.
STEADY = cases.JOB + '\n[procedure]\ntype = "static"\nfirst_step = 0.25\nmax_step = 0.25\ntolerance = 1e-11\n'

#: Steps of the differences in the coordinates of the search: of whole solves, and by the rig, whose values are rounded.
STEP, RIG_STEP = 1e-4, 1e-3


def test_the_jacobian_is_that_of_differences(tmp_path):
    """By a constant, a dimension, the pressure itself, and the rig; differences of solves with a tolerance of 1e-11."""
    base = base_of(tmp_path, STEADY)
    free = free_parameters([*FREE, "loads.pressure=20 kPa:15 kPa:25 kPa"], PRIOR, base)
    trial = job_trial(base, curve_of(base), spread=0.002 * mm)
    values = {each.name: each.start for each in free}
    taken = trial.taken(free)
    data = data_of(trial, trial.run(values, taken).call().response, taken)
    names = ["pressure_offset", "pressure_scale", "tip_displacement_x_offset", "tip_displacement_x_scale"]
    rig = [rig_parameter(name, [data]) for name in names]
    problem = Objective(parameters=(*free, *rig), models=len(free), data=(data,), evaluations=Evaluations())
    at = np.array([each.coordinate(each.start) for each in problem.parameters])
    result = problem.known_jacobian(at)
    for k, name in enumerate(each.name for each in problem.parameters):
        size = STEP if k < len(free) else RIG_STEP
        step = size * np.eye(len(at))[k]
        ends = [problem._weighted(to, _plain(problem, to)) for to in (at + step, at - step)]
        differences = (ends[0] - ends[1]) / (2 * size)
        assert np.linalg.norm(result[:, k] - differences) <= 1e-5 * np.linalg.norm(differences), name
    assert problem.derivatives(at) == "The derivatives are exact, from each run itself."


def _plain(problem, at):
    """What the trials compute at a point, without slopes."""
    return [each.result.response for each in problem.ended([at], slopes=False)[0]]


@pytest.fixture(scope="module")
def found(base, measured, tmp_path_factory):
    """A calibration with slopes, whose runs are kept, and the folder."""
    folder = tmp_path_factory.mktemp("kept")
    trial = job_trial(base, measured, spread=0.002 * mm)
    return calibrate(trial, free_parameters(FREE, PRIOR, base), evaluations=saved_in(folder)), folder


def test_derivatives_spare_solves_and_find_the_same(base, measured, found):
    exact, _ = found
    plain = calibrate(without(job_trial(base, measured, spread=0.002 * mm)), free_parameters(FREE, PRIOR, base))
    assert exact.converged and plain.converged
    assert exact.solves <= 0.6 * plain.solves, (exact.solves, plain.solves)
    for name, error in plain.errors.items():
        assert abs(exact.values[name] - plain.values[name]) < 0.2 * error
        assert exact.errors[name] == pytest.approx(error, rel=0.1)
    assert len(exact.undetermined) == len(plain.undetermined)
    assert exact.derivatives == "The derivatives are exact, from each run itself." in exact.summary()
    assert plain.derivatives == "The derivatives are differences of runs."


def test_derivatives_are_kept(base, measured, found):
    first, folder = found
    tables = list(folder.glob("*.csv"))
    assert len(tables) == first.solves and all("_slope_" in each.read_text(encoding="utf-8") for each in tables)
    trial = job_trial(base, measured, spread=0.002 * mm)
    again = calibrate(trial, free_parameters(FREE, PRIOR, base), evaluations=saved_in(folder))
    assert (again.computed, again.solves) == (0, first.solves)
    assert again.derivatives == first.derivatives
    assert again.values == pytest.approx(first.values, rel=1e-8)


def test_a_derivative_that_fails_falls_back_to_differences(base, measured, found, monkeypatch):
    """That by the wall is refused from the second run on."""
    runs, asked = Evaluations(), []
    real = job_slopes.refused_at_once

    def failing(numbers):
        asked.append(numbers)
        known = {} if len(asked) == 1 else {"actuator.wall": "it is near a limit point."}
        return real(numbers) | known

    monkeypatch.setattr(job_slopes, "refused_at_once", failing)
    trial = job_trial(base, measured, spread=0.002 * mm)
    mixed = calibrate(trial, free_parameters(FREE, PRIOR, base), evaluations=runs)
    assert mixed.converged and mixed.solves > found[0].solves
    for name, error in found[0].errors.items():
        assert abs(mixed.values[name] - found[0].values[name]) < 0.2 * error
    assert mixed.derivatives == (
        "The derivatives by materials.body.C10 are exact, those by actuator.wall differences of runs. "
        "There are no slopes by actuator.wall: it is near a limit point."
    )
    assert next(iter(runs.ended.values())).result.notes == ()


def test_tetrahedra_have_slopes_by_a_dimension_too(tmp_path):
    base = base_of(
        tmp_path, cases.JOB.replace('"axisymmetric"', '"tetrahedra"').replace('"3 mm"\nwall', '"12 mm"\nwall')
    )
    result = solved_job(
        **base.values,
        numbers={key: TRUE[key] for key in TRUE},
        slopes={"drives": ["pressure"], "columns": ["cavity_volume"]},
    )
    assert result.notes == ()
    slopes = {name for name in result.response.names if "_slope_" in name}
    assert slopes == {slope_name(each, key) for each in ("pressure", "cavity_volume") for key in TRUE}
    assert np.isfinite(result.response[slope_name("cavity_volume", "actuator.wall")]).all()


def test_a_procedure_that_sets_the_drive_is_left_to_differences(tmp_path):
    free_of_loads = cases.JOB.replace('[loads]\npressure = "20 kPa"\n', "")
    base = base_of(tmp_path, free_of_loads + '\n[procedure]\ntype = "volume_control"\nvolume = "0.3 mL"\n')
    numbers = {"materials.body.C10": 0.12e6, "procedure.volume": 0.3e-6}
    result = solved_job(**base.values, numbers=numbers, slopes={"drives": ["injected_volume"], "columns": ["pressure"]})
    assert result.notes == ("There are no slopes by procedure.volume: they change the injected volume, too.",)
    assert np.isfinite(result.response["pressure_slope_materials_body_C10"][1:]).all()


def sloped(C10: float, wall: float = cases.WALL) -> Response:
    """A thin sphere that adds the derivative by its stiffness, at a given stretch, as the pressure moves."""
    result = cases.thin_sphere(C10=C10, wall=wall)
    return tg.studies.with_slopes(
        result, {"pressure": {"C10": result["pressure"] / C10}, "stretch": {"C10": 0 * result["stretch"]}}
    )


def broken(C10: float) -> Response:
    """A sphere with slopes that breaks when it is soft."""
    if C10 < 0.1e6:
        raise TurgorError("the path ended at its first step.")
    return sloped(C10)


def test_a_function_gives_its_own_derivatives():
    measured = cases.measured_sphere(C20=0.0, offset=0.3 * kPa, noise=1e-4)
    free = [Parameter(name="C10", start=0.2e6, unit="MPa")]
    exact = calibrate(Trial(measured=measured, function=sloped), free, rig=["pressure_offset"])
    plain = calibrate(Trial(measured=measured, function=cases.thin_sphere), free, rig=["pressure_offset"])
    assert exact.solves < plain.solves
    for name, error in plain.errors.items():
        assert abs(exact.values[name] - plain.values[name]) < 0.5 * error  # a search ends a little before
    wall = Parameter(name="wall", start=1.2 * mm, prior=(1 * mm, 0.02 * mm), unit="mm")
    mixed = calibrate(Trial(measured=measured, function=sloped), [*free, wall], rig=["pressure_offset"])
    assert mixed.derivatives == "The derivatives by C10 are exact, those by wall differences of runs."
    assert mixed.values["C10"] * mixed.values["wall"] == pytest.approx(exact.values["C10"] * cases.WALL, rel=2e-3)
    soft = Parameter(name="C10", start=0.12e6, lower=0.05e6)
    result = calibrate(Trial(measured=cases.measured_sphere(C10=0.09e6, C20=0.0), function=broken), [soft])
    assert result.failures and result.values["C10"] == pytest.approx(0.1e6, rel=0.05)
