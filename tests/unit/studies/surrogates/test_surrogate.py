"""Surrogates: what they are fitted to, their file, what they refuse, and that they need no training code."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import surrogate_cases as cases
import turgor as tg
from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.study import Study
from turgor.studies.surrogates.fit import surrogate
from turgor.studies.surrogates.held_out import parts_of
from turgor.studies.surrogates.surrogate import Surrogate
from turgor.studies.surrogates.training import training
from turgor.units import deg, kPa, mm

DESIGN = {"wall": 1.3 * mm, "C10": 70 * kPa}


@pytest.fixture(scope="module")
def study():
    return cases.study_of(cases.finger, [cases.WALL, cases.C10], 16)


@pytest.fixture(scope="module")
def fitted(study):
    return surrogate(study, at=("pressure", 40 * kPa))


@pytest.fixture(scope="module")
def curves(study):
    return surrogate(study, ["bending_angle"], along="pressure")


def test_it_predicts_what_a_run_gives(fitted):
    exact = cases.finger(**DESIGN)
    said = fitted.predict(DESIGN)
    assert said["bending_angle"] == pytest.approx(exact["bending_angle"][8], rel=2e-3)
    assert fitted.measures == ("bending_angle", "tip_displacement_z")  # not the pressure, not the load factor
    assert said.text("bending_angle").endswith(" deg")
    assert fitted.error("bending_angle").share < 0.01
    assert "bending angle: " in fitted.summary()
    assert "of the range" in repr(fitted)


def test_many_points_are_those_of_single_ones(fitted):
    points = np.array([[1.3 * mm, 70 * kPa], [1.7 * mm, 55 * kPa]])
    mean, deviation = fitted.spreads(points)
    assert mean == pytest.approx(fitted.means(points))
    said = fitted.predict(DESIGN)
    assert mean[0] == pytest.approx(list(said.values.values()))
    assert deviation[0] == pytest.approx(list(said.deviations.values()), rel=1e-4)  # a difference of large numbers


def test_slopes_are_differences(fitted):
    step = 1e-4
    for name in ("wall", "C10"):
        above, below = (fitted.predict(DESIGN | {name: DESIGN[name] * (1 + sign * step)}) for sign in (1, -1))
        for measure in fitted.measures:
            difference = (above[measure] - below[measure]) / (2 * step * DESIGN[name])
            assert fitted.slopes(DESIGN)[measure][name] == pytest.approx(difference, rel=1e-5)


def test_outside_it_refuses_or_says_so(fitted):
    with refused("wall", "2.1 mm", "1 mm to 2 mm"):
        fitted.predict(DESIGN | {"wall": 2.1 * mm})
    with refused("C10", "40 kPa", "50 kPa to 100 kPa"):
        fitted.means(np.array([[1.3 * mm, 70 * kPa], [1.3 * mm, 40 * kPa]]))
    (finding,) = fitted.predict(DESIGN | {"wall": 2.1 * mm}, extrapolate=True).findings
    assert (finding.code, "10 % of the range beyond" in finding.message) == ("U01", True)
    assert fitted.predict(DESIGN, extrapolate=True).findings == ()
    for value in (1 * mm, 2 * mm):  # the ends belong to it
        fitted.predict(DESIGN | {"wall": value})


def test_names_and_values_are_checked(fitted):
    with refused("'wal'", "'wall'"):
        fitted.predict({"wal": 1.3 * mm, "C10": 70 * kPa})
    with refused("surrogate", "C10"):
        fitted.predict({"wall": 1.3 * mm})
    with refused("'wall'", "nan", "finite"):
        fitted.predict(DESIGN | {"wall": float("nan")})
    with refused("1 columns", 2, "wall, C10"):
        fitted.means(np.array([[1.3 * mm]]))
    with refused("'bending_angel'", "'bending_angle'"):
        fitted.predict(DESIGN)["bending_angel"]


def test_whole_curves(curves):
    exact = cases.finger(**DESIGN)
    path = curves.response(DESIGN, points=11)
    assert path["pressure"] == pytest.approx(exact["pressure"])
    assert path["bending_angle"] == pytest.approx(exact["bending_angle"], abs=0.5 * deg)
    assert (path["bending_angle_deviation"] > 0).all()
    assert [each.name for each in curves.factors] == ["wall", "C10", "pressure"]
    with refused("pressure", "60 kPa", "0 kPa to 50 kPa"):
        curves.predict(DESIGN | {"pressure": 60 * kPa})
    beyond = curves.response(DESIGN | {"C10": 45 * kPa}, extrapolate=True)
    assert [each.code for each in beyond.findings] == ["U01"]


def test_rows_of_one_path_are_held_out_together(study):
    given = training(study, ["bending_angle"], along="pressure")
    parts = parts_of(given.row, 10)
    assert all(len(set(parts[given.row == number])) == 1 for number in set(given.row))
    assert len(set(parts)) == 10


def test_failed_rows_are_left_out_and_counted():
    thin = replace(cases.WALL, low=0.8 * mm)
    study = cases.study_of(cases.finger, [thin, cases.C10], 16)
    failed = sum(row.response is None for row in study.rows)
    result = surrogate(study, ["bending_angle"])
    assert 0 < failed == 16 - result.rows
    assert f"{failed} of 16 rows were left out" in result.notes[0]


def test_short_paths_are_told():
    top = Factor(name="top", low=30 * kPa, high=60 * kPa, unit="kPa")
    study = cases.study_of(cases.finger, [cases.WALL, cases.C10, top], 16)
    assert "paths end before the others" in training(study, ["bending_angle"], along="pressure").notes[-1]
    result = training(study, ["bending_angle"], at=("pressure", 50 * kPa))
    assert len(result.inputs) < 16
    with refused("0 of 16 rows", "bending_angle", "70 kPa", 5):
        training(study, ["bending_angle"], at=("pressure", 70 * kPa))


def test_mesh_errors_are_noise(study):
    def noisy(row):
        response = row.response
        error = Column("bending_angle_mesh_error", "deg", np.full(len(response), 3 * deg))
        response = Response(columns=(*response.columns, error), source=response.source)
        return replace(row, ended=replace(row.ended, result=replace(row.ended.result, response=response)))

    rough = Study(factors=study.factors, rows=tuple(noisy(row) for row in study.rows), source=study.source)
    assert training(rough, ["bending_angle"]).noise == pytest.approx(3 * deg)
    spread = [surrogate(each, ["bending_angle"]).model.spread(np.full((1, 2), 0.5))[1] for each in (rough, study)]
    assert float(spread[0][0, 0]) > 3 * float(spread[1][0, 0])


def test_long_choices_and_small_studies_are_refused(study):
    rubber = Factor(name="rubber", levels=tuple("abcdefghijk"))
    with refused("'rubber'", 11, 10):
        surrogate(Study(factors=(*study.factors, rubber), rows=study.rows, source=study.source))
    with refused("4 of 4 rows", 5):
        surrogate(Study(factors=study.factors, rows=study.rows[:4], source=study.source))
    fixed = tuple(Factor(name=name, levels=(1.0,)) for name in ("wall", "gap"))
    with refused("wall, gap", "factor"):
        surrogate(Study(factors=fixed, rows=study.rows, source=study.source))
    same = Study(factors=study.factors, rows=study.rows[:1] * 6, source=study.source)
    with refused("measure", "pressure, bending_angle"):
        surrogate(same)
    with refused("'bending_angel'", "'bending_angle'"):
        surrogate(study, ["bending_angel"])
    with refused("at", "('pressure', 10000.0)", "along", "'pressure'"):
        surrogate(study, at=("pressure", 1e4), along="pressure")


def test_it_is_loaded_without_what_trained_it(fitted, tmp_path):
    result = fitted
    file = result.save(tmp_path / "finger")
    assert isinstance(tg.load(file), Surrogate)
    said = result.predict(DESIGN)
    script = (
        "import sys\n"
        "sys.modules['sklearn'] = sys.modules['SALib'] = None\n"  # an import of either fails
        "from turgor.studies import Surrogate\n"
        f"found = Surrogate.load({str(file)!r})\n"
        f"said = found.predict({DESIGN!r})\n"
        "print(repr(said['bending_angle']), repr(said.deviations['bending_angle']))\n"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert ended.stderr == ""
    assert [float(each) for each in ended.stdout.split()] == [said["bending_angle"], said.deviations["bending_angle"]]


def test_training_without_scikit_learn_is_a_sentence(study, monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn.gaussian_process", None)
    with refused("surrogate", "scikit-learn", "turgor[studies]"):
        surrogate(study)


def test_a_measure_of_one_state_needs_no_drive():
    study = cases.study_of(cases.two_chambers, [cases.FIRST, cases.SECOND], 16)
    result = surrogate(study)
    assert result.response({"first": 1e4, "second": 2e4}).names[:2] == ("tip_y", "tip_z")
    assert result.source == Source(text="a test")
