"""Reading tests: what real tables look like, and how each mistake in one is answered."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test, read_tests
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.laws.laws import MooneyRivlin, NeoHooke
from turgor.units import mm

STRIP = Specimen(length=50 * mm, width=5 * mm, thickness=3 * mm)


@pytest.fixture
def file(tmp_path):
    def write(text, name="strip_uniaxial.csv"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


@pytest.mark.parametrize(
    "text",
    [
        "stretch_-,engineering_stress_MPa\n1,0\n1.5,0.1\n2,0.2\n",
        "Stretch;Nominal stress (kPa)\n1,0;0\n1,5;100\n2,0;200\n",
        "stretch\tnominal stress [N/mm²]\n1,0\t0\n1,5\t0,1\n2\t0,2\n",
        "# a machine\n# old\nTime (s);Engineering Strain;Engineering Stress (MPa);;\n0;0;0;;\n1;0.5;0.1;;\n2;1;0.2;;\n",
        "Strain;Nominal stress\n(%);(MPa)\n0;0\n50;0.1\n100;0.2\n",
        "True Strain,True Stress (MPa)\n0,0\n0.4054651081,0.15\n0.6931471806,0.4\n",
        "grip_length_mm,force_N\n50,0\n75,1.5\n100,3\n",
        "Extension (mm) ; Load (kN)\r\n0;0\r\n25;0.0015\r\n50;0.003\r\n",
        "# Time (s)  Length (mm)   Force (N)\n00:06:57.69\t5.0E+1\t0\n00:06:57.86\t7.5E+1\t1.5E+0\n00:06:58\t100\t3\n",
        "\ufeffstretch;nominal stress (Pa)\n1;0\n1.5;1e5\n2;2e5\n\n",
    ],
)
def test_the_same_strip_in_many_tables(file, text):
    test = read_test(file(text), specimen=STRIP)
    assert test.stretch == pytest.approx([1.0, 1.5, 2.0])
    assert test.nominal_stress == pytest.approx([0.0, 0.1e6, 0.2e6])
    assert "3 rows" in test.edits[0].text


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("", ("empty", "header")),
        ("\n\n \n", ("empty", "header")),
        ("stretch,nominal_stress_MPa\n", ("no rows", "least two")),
        ("stretch,nominal_stress_MPa\n1,0\n", ("strip_uniaxial", "one point", "least two")),
        ("stretch,nominal_stress_MPa\n1,0\n1.5,x\n2,0.2\n", ("line 3", "'x'", "nominal_stress_MPa")),
        ("stretch,nominal_stress_MPa\n1,0\n1.5,1e999\n2,0.2\n", ("line 3", "1e999", "nominal_stress_MPa")),
        ("stretch,nominal_stress_MPa\n1,0\n\n1.5,1_0\n2,0.2\n", ("line 4", "1_0", "nominal_stress_MPa")),
        (
            "stretch,nominal_stress_MPa\n1,0\n2,0.2\n1.5,0.1\n3,0.3\n",
            ("row 3", "2 to 1.5", "cyclic=True", "select_cycle"),
        ),
        ("stretch,nominal_stress_MPa\n1,0\n-1.5,0.1\n", ("stretch", "point 2", -1.5, "more than 0")),
        ("strain,nominal_stress_MPa\n0,0\n-1.5,0.1\n", ("stretch", "point 2", -0.5, "more than 0")),
        ("stretch,nominal stress\n1,0\n2,0.2\n", ("column 'nominal stress'", "unit", "'nominal stress (MPa)'")),
        ("stretch,nominal stress (MPA)\n1,0\n2,0.2\n", ("nominal stress (MPA)", "'MPA'", "'MPa'")),
        (
            "stretch,stress (MPa)\n1,0\n2,0.2\n",
            ("'stress (MPa)'", 'stress_measure="nominal"', 'stress_measure="cauchy"'),
        ),
        ("a,b\n1,0\n2,0.2\n", ("stretch, strain", "columns={'stretch': ...}")),
        ("stretch,temperature\n1,0\n2,0.2\n", ("stress", "force", "'stretch'")),
        ("1,0\n2,0.2\n", ("header line", "columns=('stretch', 'nominal_stress_MPa')")),
        ("stretch,nominal a (MPa),nominal b (MPa)\n1,0,0\n2,1,1\n", ("stress", "force", "'stretch'")),
        (
            "stretch,nominal stress a (MPa),nominal stress b (MPa)\n1,0,0\n2,1,1\n",
            ("nominal stress a (MPa)", "nominal stress b (MPa)", "columns={'nominal_stress': ...}"),
        ),
    ],
)
def test_bad_tables_are_answered_with_a_sentence(file, text, facts):
    with refused("'strip_uniaxial", *facts):
        read_test(file(text))


@pytest.mark.parametrize(
    ("header", "column", "example"),
    [
        ("Clock,stretch,nominal stress (MPa)", "Clock", "s"),
        ("Time (s),stretch,nominal stress", "nominal stress", "MPa"),
        ("Time (s),stretch,force", "force", "N"),
        ("Time (s),grip length,nominal stress (MPa)", "grip length", "mm"),
    ],
)
def test_the_example_of_a_missing_unit_is_a_unit_of_the_column(file, header, column, example):
    stated = {"time": "Clock"} if column == "Clock" else {}
    with refused("strip_uniaxial.csv", f"'{column} ({example})'"):
        read_test(file(f"{header}\n0,1,0\n1,2,0.2\n"), columns=stated, specimen=STRIP)


def test_forces_need_the_specimen(file):
    path = file("length_mm,force_N\n50,0\n100,3\n")
    with refused("strip_uniaxial.csv", "specimen=Specimen", "'# Length = 33 mm'"):
        read_test(path)


@pytest.mark.parametrize(
    ("sizes", "facts"),
    [
        ({"length": 0.05, "area": 0.0}, ("area", "0 m²", "more than 0")),
        ({"length": 0.0, "area": 1e-5}, ("length", "0 m", "more than 0")),
        ({"length": 0.05, "width": -1e-3, "thickness": 1e-3}, ("width", "-0.001 m", "more than 0")),
        ({"length": 0.05}, ("by nothing", "area", "width", "thickness")),
        ({"length": 0.05, "area": 1e-5, "width": 1e-3, "thickness": 1e-3}, ("by area", "width", "thickness")),
    ],
)
def test_specimens_without_a_section_are_refused(sizes, facts):
    with refused(*facts):
        Specimen(**sizes)


def test_a_missing_file_is_a_sentence(tmp_path):
    with refused(tmp_path / "nowhere_uniaxial.csv", "No such file"):
        read_test(tmp_path / "nowhere_uniaxial.csv")


def test_stress_measure_is_asked_for_and_cauchy_is_converted(file):
    path = file("stretch,stress (MPa)\n1,0\n2,0.2\n")
    assert read_test(path, stress_measure="nominal").nominal_stress[1] == pytest.approx(0.2e6)
    assert read_test(path, stress_measure="cauchy").nominal_stress[1] == pytest.approx(0.1e6)
    with refused("stress_measure", "true", "cauchy, nominal"):
        read_test(path, stress_measure="true")


def test_a_file_with_both_measures_gives_the_same_by_either(file):
    path = file("strain,True Stress (MPa),Engineering Stress (MPa)\n0,0,0\n1,0.4,0.2\n")
    nominal, cauchy = (read_test(path, stress_measure=measure).nominal_stress for measure in ("nominal", "cauchy"))
    assert nominal == pytest.approx(cauchy)


def test_mode_comes_from_the_name_or_is_asked_for(file):
    text = "stretch,nominal_stress_MPa\n1,0\n2,0.2\n"
    assert read_test(file(text, "pure_shear.csv")).mode == "planar"
    assert read_test(file(text, "Equibiaxial 3.csv")).mode == "equibiaxial"
    with refused("test7.csv", "mode", "uniaxial, equibiaxial", "simple_shear"):
        read_test(file(text, "test7.csv"))
    with refused("mode", "planr", "planar"):
        read_test(file(text), mode="planr")


def test_columns_can_be_named(file):
    path = file("0.2,2\n0.3,3\n")
    test = read_test(path, columns=("nominal_stress_MPa", "stretch"))
    assert (test.stretch[1], test.nominal_stress[1]) == (3.0, pytest.approx(0.3e6))
    with refused("strip_uniaxial.csv", "2 columns", "1 names"):
        read_test(path, columns=("stretch",))
    path = file("channel 1 (mm);channel 2 (N)\n50;0\n100;3\n")
    test = read_test(path, specimen=STRIP, columns={"length": "channel 1 (mm)", "force": "channel 2 (N)"})
    assert test.nominal_stress[1] == pytest.approx(0.2e6)
    with refused("strip_uniaxial.csv", "'channel 3 (mm)'", "'channel 1 (mm)'"):
        read_test(path, specimen=STRIP, columns={"length": "channel 3 (mm)"})
    with refused("lenght", "length"):
        read_test(path, specimen=STRIP, columns={"lenght": "channel 1 (mm)"})


def test_replicates_by_a_column_or_side_by_side(file):
    long = file("specimen,stretch,nominal_stress_MPa\nA,1,0\nA,2,0.2\nB,1,0\nB,1.5,0.1\nB,2,0.3\n")
    tests = read_tests(long)
    assert [test.name for test in tests] == ["strip_uniaxial A", "strip_uniaxial B"]
    assert [len(test.stretch) for test in tests] == [2, 3]
    wide = file(
        "Strain;Eng. stress (MPa);Strain;Eng. stress (MPa)\n0;0;0;0\n1;0,2;0,5;0,1\n;;1;0,3\n", "w_uniaxial.csv"
    )
    tests = read_tests(wide)
    assert [list(test.nominal_stress) for test in tests] == [
        [0, pytest.approx(2e5)],
        [0, pytest.approx(1e5), pytest.approx(3e5)],
    ]
    with refused("2 specimens", "strip_uniaxial A", "strip_uniaxial B", "read_tests"):
        read_test(long)


def test_biaxial_fields_and_differences(file):
    law = MooneyRivlin(C10=0.2e6, C01=0.02e6)
    path = file(
        "stretch_1_-,stretch_2_-,nominal_stress_1_MPa,nominal_stress_2_MPa\n1.5,1,0.3,0.1\n1.5,1.5,0.4,0.4\n",
        "biaxial.csv",
    )
    test = read_test(path)
    assert list(test.measured / 1e6) == pytest.approx([0.3, 0.4, 0.1, 0.4])
    both = test.predicted(law)
    assert both[1] == pytest.approx(both[3]), "equal stretches, equal stresses"
    path = file("stretch_1,stretch_2,cauchy_stress_difference_1_minus_2_MPa\n1.5,1,0.3\n1.5,1.5,0\n", "biaxial_d.csv")
    test = read_test(path)
    assert test.predicted(law)[0] * 1.5 == pytest.approx(both[0] * 1.5 - both[2] * 1.0)
    assert test.predicted(law)[1] == pytest.approx(0, abs=1e-6)


def test_simple_shear(file):
    test = read_test(file("shear strain,nominal stress (kPa)\n-0.5,-120\n0,0\n0.5,120\n", "simple_shear.csv"))
    assert test.predicted(NeoHooke(C10=0.12e6)) == pytest.approx(test.measured)


@pytest.mark.parametrize(
    ("values", "facts"),
    [
        ({"mode": "shear"}, ("mode", "'shear'", "simple_shear")),
        ({"stretch": [1.0, 2.0, 3.0]}, ("nominal_stress", "(2,)", "stretch (3,)")),
        ({"nominal_stress": [0.0, np.nan]}, ("nominal_stress", "point 2", "nan")),
        ({"stretch": [0.0, 1.0]}, ("stretch", "point 1", 0, "more than 0")),
        ({"stretch_2": [1.0, 1.0]}, ("'t'", "uniaxial", "stretch_2")),
        ({"mode": "biaxial"}, ("'t'", "biaxial", "stretch_2")),
    ],
)
def test_a_test_checks_itself(values, facts):
    with refused(*facts):
        MaterialTest(
            **({"mode": "uniaxial", "stretch": [1.0, 2.0], "nominal_stress": [0.0, 1.0], "name": "t"} | values)
        )


def test_numbers_of_a_test_cannot_be_changed():
    test = MaterialTest(mode="uniaxial", stretch=[1.0, 2.0], nominal_stress=[0.0, 1.0], name="t")
    with refused("read-only", error=ValueError):
        test.stretch[0] = 2.0
