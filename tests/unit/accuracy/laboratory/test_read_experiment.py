"""Tables of a laboratory: how people and sensors write headers, units and missing numbers."""

import numpy as np
import pytest

from refused import refused
from turgor.accuracy.laboratory.chosen_rows import ChosenRows
from turgor.accuracy.laboratory.compare import compare
from turgor.accuracy.laboratory.headers import read_header
from turgor.accuracy.laboratory.read_experiment import read_experiment, read_experiments
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source


@pytest.mark.parametrize(
    ("text", "name", "unit", "factor"),
    [
        ("Bending Angle (°)", "bending_angle", "deg", np.pi / 180),
        ("Pressure [psi]", "pressure", "kPa", 6894.757293168361),
        ("Pressure (mbar)", "pressure", "kPa", 100.0),
        ("Force / N", "force", "N", 1.0),
        ("Force, gf", "force", "N", 9.80665e-3),
        ("tip_displacement_mm", "tip_displacement", "mm", 1e-3),
        ("Volume [cc]", "volume", "mL", 1e-6),
        ("Time sec", "time", "s", 1.0),
        ("Sweep", "sweep", "", 1.0),
        ("strain (-)", "strain", "", 1.0),
        ("P (KPA)", "pressure", "kPa", 1e3),
    ],
)
def test_header(text: str, name: str, unit: str, factor: float) -> None:
    header = read_header(text)
    assert (header.name, header.unit) == (name, unit)
    assert header.factor == pytest.approx(factor, rel=1e-12)


def test_header_with_unknown_unit_names_the_near_match() -> None:
    with refused("column 'Pressure (kpaa)'", "'kpaa'", "'kPa'"):
        read_header("Pressure (kpaa)")


def test_units_in_a_second_line(tmp_path) -> None:
    file = tmp_path / "finger.txt"
    file.write_text("Pressure\tBending Angle\n(kPa)\t(°)\n0\t0\n10\t45\n", encoding="utf-8")
    result = read_experiment(file)
    assert result.names == ("pressure", "bending_angle")
    np.testing.assert_allclose(result["bending_angle"], [0.0, np.pi / 4])


def test_units_that_are_given_and_decimal_commas(tmp_path) -> None:
    file = tmp_path / "finger.csv"
    file.write_text("Pressure;Angle\n0;0\n10,5;45,5\n", encoding="utf-8")
    with refused(file.name, "column 'Pressure'", "units={'pressure': 'kPa'}") as error:
        read_experiment(file)
    assert "--unit pressure=kPa" in error.value.on_command_line
    result = read_experiment(file, units={"pressure": "kPa", "angle": "deg"})
    np.testing.assert_allclose(result["pressure"], [0.0, 10500.0])
    with refused(file.name, "units", "'presure'", "'pressure'"):
        read_experiment(file, units={"presure": "kPa", "angle": "deg"})


def test_missing_numbers_and_words(tmp_path) -> None:
    file = tmp_path / "finger.csv"
    file.write_text("pressure_kPa,angle_deg,remark\n0,0,start\n10,,\n20,9,end\n", encoding="utf-8")
    result = read_experiment(file)
    assert result.names == ("pressure", "angle")
    assert np.isnan(result["angle"][1])
    file.write_text("pressure_kPa,angle_deg\n0,0\n10,oops\n20,9\n", encoding="utf-8")
    with refused(file.name, "line 3", "column 'angle_deg'", "'oops'"):
        read_experiment(file)


def test_renamed_columns(tmp_path) -> None:
    file = tmp_path / "finger.csv"
    file.write_text("Gauge (kPa),Angle of tip (°)\n0,0\n10,5\n", encoding="utf-8")
    result = read_experiment(file, columns={"Gauge (kPa)": "pressure", "Angle of tip (°)": "bending_angle"})
    assert result.names == ("pressure", "bending_angle")
    with refused(file.name, "'Gage (kPa)'", "'Gauge (kPa)'"):
        read_experiment(file, columns={"Gage (kPa)": "pressure"})


def test_file_without_header(tmp_path) -> None:
    file = tmp_path / "finger.txt"
    file.write_text("0 0\n10 5\n", encoding="utf-8")
    with refused(file.name, "header", "columns"):
        read_experiment(file)
    assert read_experiment(file, columns=("pressure_kPa", "angle_deg")).names == ("pressure", "angle")
    with refused(file.name, "2 columns", "1 names"):
        read_experiment(file, columns=("pressure_kPa",))


def test_runs_told_apart_by_columns(tmp_path) -> None:
    file = tmp_path / "membrane.csv"
    file.write_text("load_N,sweep,pressure_kPa\n1.5,1,0\n1.5,1,4\n1.5,2,0\n2.5,1,0\n2.5,1,9\n", encoding="utf-8")
    runs = read_experiments(file, ["load", "sweep"])
    assert list(runs) == ["1.5, 1", "1.5, 2", "2.5, 1"]
    np.testing.assert_allclose(runs["2.5, 1"]["pressure"], [0.0, 9e3])
    assert runs["1.5, 1"].names == ("pressure",)


def test_german_headers_and_the_names_of_the_file(tmp_path) -> None:
    """Druck, Zeit and Kraft drive as pressure, time and force do; a range names a column as the file does."""
    file = tmp_path / "finger.csv"
    file.write_text("Zeit (s);Druck (bar);Winkel (°)\n0;0;0\n0,1;0,1;5\n0,2;0,2;11\n", encoding="utf-8")
    result = read_experiment(file)
    assert result.names == ("time", "pressure", "winkel")
    rows = ChosenRows(ranges=["Druck (bar)=50..250 mbar"]).read(file, "Druck", None)[0]
    np.testing.assert_allclose(rows.column("pressure"), [10e3, 20e3])
    computed = Response(
        columns=(Column("pressure", "kPa", [0, 20e3]), Column("bending_angle", "deg", [0, 0.2])),
        source=Source(text="a run"),
    )
    comparison = compare(computed, result, y="bending_angle=Winkel", x="pressure=Druck (bar)")
    assert (comparison.measured_x, comparison.measured_y) == ("pressure", "winkel")
