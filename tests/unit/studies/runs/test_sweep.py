"""tg.sweep: functions of a dataclass and of plain numbers at many designs, kept, and failed runs as rows."""

from dataclasses import dataclass, field

import numpy as np
import pytest
from study_cases import Beam, deflection, line, slow

import turgor as tg
from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import mm

AT = ("force", 0.01)


def branch(end: float, sign: float) -> Response:
    """A path that turns at its end."""
    columns = Column("pressure", "kPa", sign * np.array([0.0, end, end / 2])), Column("angle", "", [0.0, 2.0, 3.0])
    return Response(columns=columns, source=Source(text="a path"))


@dataclass(frozen=True, kw_only=True)
class Pair:
    """A dataclass that holds another one."""

    beam: Beam = field(default_factory=Beam)
    share: float = 1.0


def within(pair: Pair) -> Response:
    return deflection(pair.beam)


def test_a_closed_formula_at_all_levels():
    """w = F L³ / (3 E I): with the third power of the length and the inverse third one of the height."""
    study = tg.sweep(deflection, Beam(), length=[0.1, 0.2], height=[1 * mm, 2 * mm, 4 * mm])
    assert len(study) == 6
    assert [row.values["height"] for row in study.rows[:3]] == [1 * mm, 2 * mm, 4 * mm]
    length, height = study.inputs.T
    known = 0.01 * length**3 / (3 * 1e6 * 0.01 * height**3 / 12)
    np.testing.assert_allclose(study.column("deflection", AT), known, rtol=1e-12)
    assert {row.status for row in study.rows} == {"converged"}


def test_a_design_goes_to_other_processes_and_is_found_again(tmp_path):
    with tg.studies.saved_in(tmp_path, processes=2) as runs:
        study = tg.sweep(deflection, Beam(length=0.2), evaluations=runs, parts=[1, 2, 4])
    values = study.column("deflection", AT)
    np.testing.assert_allclose(values, values[0] / np.array([1, 2, 4]), rtol=1e-12)
    again = tg.sweep(deflection, Beam(length=0.2), evaluations=tg.studies.saved_in(tmp_path), parts=[1, 2, 4])
    assert all(row.ended.again for row in again.rows)
    other = tg.sweep(deflection, Beam(length=0.3), evaluations=tg.studies.saved_in(tmp_path), parts=[1, 2, 4])
    assert not any(row.ended.again for row in other.rows)
    assert study.factor("parts").whole


def test_a_design_that_the_class_refuses_is_a_row():
    study = tg.sweep(deflection, Beam(), height=[-1 * mm, 2 * mm])
    assert [row.status for row in study.rows] == ["failed", "converged"]
    assert study.problems == ("The run with height -0.001 failed: height is -1 mm; allowed is above 0 mm.",)
    assert np.isnan(study.column("deflection", AT)[0])


def test_plain_numbers_and_further_arguments(tmp_path):
    study = tg.sweep(line, {"log": str(tmp_path / "log")}, slope=[1e-5, 2e-5])
    assert study.column("bending_angle") == pytest.approx([0.1, 0.2])
    assert len((tmp_path / "log").read_text(encoding="utf-8").splitlines()) == 2
    whole = tg.sweep(slow, {"log": str(tmp_path / "log"), "seconds": 0.0}, number=[1, 2])
    assert whole.column("pressure").tolist() == [1.0, 2.0]


def test_fields_of_a_dataclass_within():
    study = tg.sweep(within, Pair(), **{"beam.length": [0.1, 0.2]})
    short, long = study.column("deflection", AT)
    assert long == pytest.approx(8 * short)


def test_units_of_an_actuator_are_those_of_its_fields():
    from turgor.studies.runs.sweep import factor_of

    finger = tg.FastPneuNet()
    assert factor_of("wall", np.array([1.0, 2.0]) * mm, finger).shown(1.5 * mm) == "1.5 mm"
    assert factor_of("chambers", [3, 5], finger).whole


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_values_at_a_point_of_a_path(sign):
    """Up to the end of the path, whatever its last digits, and on its first branch; a vacuum is a path too."""
    study = tg.sweep(branch, {"sign": sign}, end=[10e3 * (1 - 1e-13)])
    assert study.column("angle", ("pressure", sign * 5e3)) == pytest.approx([1.0])
    assert study.column("angle", ("pressure", sign * 10e3)) == pytest.approx([2.0])
    assert np.isnan(study.column("angle", ("pressure", sign * 10.1e3))).all()


def test_tables_have_units_and_failed_rows(tmp_path):
    study = tg.sweep(deflection, Beam(), height=[-1 * mm, 2 * mm], parts=[1, 2])
    study.to_csv(tmp_path / "study.csv", at=("force", 0.005))
    lines = (tmp_path / "study.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "height,parts,status,problem,cpu_seconds,force (N),deflection (mm)"
    assert lines[1] == "-0.001,1,failed,height is -1 mm; allowed is above 0 mm.,0,,"
    assert lines[4].split(",")[-2:] == ["0.005", "125"]
    frame = study.to_dataframe(["deflection"])
    assert frame["deflection (mm)"].tolist()[2:] == pytest.approx([500.0, 250.0])
    study.to_parquet(tmp_path / "study.parquet", ["deflection"])
    pandas = pytest.importorskip("pandas")
    assert pandas.read_parquet(tmp_path / "study.parquet").equals(frame)


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ({"heigth": [1 * mm]}, ["Beam", "'heigth'", "'height'"]),
        ({"height": 1 * mm}, ["'height'", 0.001, "list"]),
        ({"height": []}, ["'height'", "empty", "list"]),
        ({}, ["levels", "designs"]),
    ],
)
def test_mistakes_are_answered(given, facts):
    with refused(*facts):
        tg.sweep(deflection, Beam(), **given)


def test_functions_that_no_process_could_import_are_refused():
    with refused("'height 0.001'", "<lambda>", "module"):
        tg.sweep(lambda beam: deflection(beam), Beam(), height=[1 * mm])
