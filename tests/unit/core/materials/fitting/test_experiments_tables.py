"""Tables as machines and spreadsheets write them: quotes, encodings, units, surplus cells, missing numbers."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test, read_tests
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.laws.laws import MooneyRivlin, NeoHooke
from turgor.units import mm

PLAIN = "stretch,nominal_stress_MPa\n1,0\n1.5,0.1\n2,0.2\n"


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
        '"stretch","nominal stress (MPa)"\n"1,00000","0,000000"\n"1,5","0,1"\n"2,0","0,2"\n',
        '"stretch","nominal stress (MPa)"\n1,0\n"1,5","0,1"\n2,"0,2"\n',
        '"stretch, by video";"nominal stress (MPa)"\n"1,0";"0"\n"1,5";"0,1"\n"2";"0,2"\n',
        PLAIN.encode("utf-16"),
        PLAIN.encode("utf-16-le"),
        PLAIN.encode("utf-16-be"),
        b"\xfe\xff" + PLAIN.encode("utf-16-be"),
        PLAIN.encode("utf-32"),
        PLAIN.replace(",", "\t").replace("\n", "\r\n").encode("utf-16"),
        "stretch;nominal stress\n-;MPa\n1;0\n1.5;0.1\n2;0.2\n",
        "strain;nominal stress\n%;N/mm²\n0;0\n50;0,1\n100;0,2\n",
        "strain;nominal stress;temperature\n%;MPa;°C\n0;0;21\n50;0,1;21\n100;0,2;21\n",
        "stretch,nominal stress,,\n,(MPa),,\n1,0,,\n1.5,0.1,,\n2,0.2,,\n",
        "strain\tnominal stress\nmm/mm\tkPa\n0\t0\n0.5\t100\n1\t200\n",
        "strain nominal_stress\n% MPa\n0 0\n50 0.1\n100 0.2\n",
        "stretch,nominal_stress_MPa,,\n1,0\n1.5,0.1,,\n2,0.2,,,,\n",
        "stretch;nominal_stress_MPa\n\n1;0\n# a pause\n1.5;0.1\n\n\n2;0.2\n",
    ],
)
def test_the_same_numbers_from_what_machines_write(file, text):
    test = read_test(file(text))
    assert test.stretch == pytest.approx([1.0, 1.5, 2.0])
    assert test.nominal_stress == pytest.approx([0.0, 0.1e6, 0.2e6])


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("stretch;nominal_stress_MPa\n1;0\n1.5;7;0.1\n2;0.2\n", ("line 3", "3 cells", "2 columns")),
        ("stretch,nominal_stress_MPa\n1,0,0,0\n1,5,0,1\n2,0,0,2\n", ("line 2", "4 cells", "2 columns")),
        ("stretch;nominal_stress_MPa;K\n1;0;296\n1.5;296\n2;0.2;296\n", ("line 3", "2 cells", "3 columns")),
        ("stretch nominal_stress_MPa time_s\n1 0 0\n1.5 0.1\n2 0.2 2\n", ("line 3", "2 cells", "3 columns")),
        ("stretch;nominal_stress_MPa\n1,0;0\n1.5;0.1\n", ("'1,0'", "line 2", "'1.5'", "line 3")),
        ('stretch,nominal_stress_Pa\n1.0,0\n1.5,"1,000"\n', ("'1,000'", "line 3", "'1.0'", "line 2")),
        ("stretch,nominal_stress_MPa\n1,0\n1.5,nan\n", ("one point", "least two")),
        (b"PK\x03\x04 something", ("strip_uniaxial.csv", "spreadsheet", "CSV")),
        (b"\xff\xfes\x00t\x00r", ("strip_uniaxial.csv", "UTF-16", "byte 7")),
        (b"stretch,stress\n1,\x000\n", ("strip_uniaxial.csv", "byte 0", "CSV in UTF-8")),
    ],
)
def test_what_cannot_be_read_is_named_with_its_line(file, text, facts):
    with refused(*facts):
        read_test(file(text))


def test_names_for_a_file_without_a_header_must_fit_every_row(file):
    with refused("line 2", "3 cells", "have 2"):
        read_test(file("1,0\n1.5,7,0.1\n2,0.2\n3,0.3\n"), columns=("stretch", "nominal_stress_MPa"))


def test_the_name_of_a_specimen_is_no_number(file):
    tests = read_tests(file("specimen;stretch;nominal stress (MPa)\n1.1;1,0;0\n1.1;2,0;0,2\n1.2;1,0;0\n1.2;2,0;0,3\n"))
    assert [test.name for test in tests] == ["strip_uniaxial 1.1", "strip_uniaxial 1.2"]
    assert [test.nominal_stress[1] for test in tests] == pytest.approx([0.2e6, 0.3e6])


def test_batch_and_specimen_may_both_be_words(file):
    head = "Operator, Ann, Room, 3\nLength (mm), 33, Width (mm), 6\nbatch,specimen,stretch,nominal_stress_MPa\n"
    rows = ["May,A1,1,0", "May,A1,1.5,0.1", "May,A2,1,0", "May,A2,1.5,0.2", "June,B1,1,0", "June,B1,1.5,0.3"]
    path = file(head + "\n".join(rows) + "\n")
    tests = read_tests(path)
    assert [(test.name.split()[1:], test.batch) for test in tests] == [
        (["May", "A1"], "May"),
        (["May", "A2"], "May"),
        (["June", "B1"], "June"),
    ]
    by = read_tests(path, columns={"batch": "specimen"})
    assert [test.batch for test in by] == ["A1", "A2", "B1"]


def test_rows_without_a_number_are_left_out_and_counted(file):
    text = "stretch,nominal_stress_MPa,temperature\n1,0,nan\n1.2,nan,20\n1.5,0.1,20\n,,\n1.8,,\n2,0.2,x\n"
    test = read_test(file(text))
    assert list(test.stretch) == [1.0, 1.5, 2.0]
    assert "Read 3 rows" in test.edits[0].text
    assert "2 of 5 rows left out that lack a number (lines 3, 6)" in test.edits[0].text
    many = read_test(file("stretch,nominal_stress_MPa\n1,0\n" + "1.1,n/a\n" * 9 + "2,0.2\n"))
    assert "9 of 11 rows left out that lack a number (lines 3, 4, 5, 6, …, 11)" in many.edits[0].text


def test_a_column_that_is_not_used_may_lack_numbers(file):
    text = "strain,extension (mm),True Stress (MPa),Engineering Stress (MPa)\n0,,nan,0\n1,,nan,0.2\n"
    assert read_test(file(text)).nominal_stress[1] == pytest.approx(0.2e6)


@pytest.mark.parametrize(
    "header",
    [
        "# Length = 11mm\n# Cross-section = 30 mm²\n",
        "# Gauge length (mm): 11\n# width: 10 mm, thickness: 3 mm\n",
        "Specimen Length (mm);11,0;;\nSpecimen Width (mm);10;;\nSpecimen Thickness (mm);3\nCross-section (cm^2);0,3\n",
        "# initial length L0 = 1.1 cm\n# cross-sectional area = 30 mm2\n# Load cell 2; Strain rate = 5%/s\n",
    ],
)
def test_the_dimensions_of_the_specimen_may_stand_in_the_header(file, header):
    test = read_test(file(f"{header}length (mm);force (N)\n11;0\n22;3\n"))
    assert test.stretch == pytest.approx([1.0, 2.0])
    assert test.nominal_stress == pytest.approx([0.0, 0.1e6])
    assert "initial length of 11 mm (header: '" in test.edits[0].text


@pytest.mark.parametrize(
    ("header", "specimen", "facts"),
    [
        (
            "# Length = 11mm\n",
            None,
            ("forces", "'Length = 11mm'", "section", "'# Cross-section = 18 mm²'"),
        ),
        ("# Length = 11mm\n# Stroke length: 50 mm\n# L0: 12 mm\n", None, ("'Length = 11mm'", "'L0: 12 mm'")),
        ("# Length = 11\n# area 3 mm²\n", None, ("'Length = 11'", "unit", "'11 mm'")),
        ("# Length = 0 mm\n", None, ("'Length = 0 mm'", "more than 0")),
        ("# Length = 11mm\n", 12, ("'Length = 11mm'", "12 mm")),
        ("# Cross-section = 40 mm²\n", 11, ("'Cross-section = 40 mm²'", "30 mm²")),
        (
            "# Length = 11 mm; width = 5 mm\n# thickness = 3 mm\n# area = 3 mm²\n",
            None,
            ("width", "thickness", "15 mm²", "3 mm²"),
        ),
    ],
)
def test_dimensions_that_contradict_each_other_are_errors(file, header, specimen, facts):
    given = None if specimen is None else Specimen(length=specimen * mm, area=30 * mm**2)
    with refused(*facts):
        read_test(file(f"{header}length (mm);force (N)\n11;0\n22;3\n"), specimen=given)


def test_a_header_that_is_not_needed_is_not_judged(file):
    test = read_test(file("# Length = 11mm\n# Length = 12\nstretch;nominal stress (MPa)\n1;0\n2;0.2\n"))
    assert test.nominal_stress[1] == pytest.approx(0.2e6)
    strip = Specimen(length=11 * mm, area=30 * mm**2)
    assert read_test(file("# Length = 11\nlength (mm);force (N)\n11;0\n22;3\n"), specimen=strip).stretch[1] == 2.0


@pytest.mark.parametrize("names", [("nominal stress (kPa)", None), ("stress (kPa)", "nominal")])
def test_one_direction_of_a_biaxial_field_is_read_as_such(file, names):
    """The stress along the first axis was once taken for the difference of both, which gave 40.8 instead of 100 kPa."""
    name, measure = names
    first, second = np.meshgrid(np.linspace(1.1, 2.0, 6), np.linspace(1.0, 1.8, 5))
    field = MaterialTest(
        mode="biaxial", stretch=first.ravel(), stretch_2=second.ravel(), nominal_stress=first.ravel(), name="field"
    )
    stress = field.predicted(NeoHooke(C10=50e3)) / 1e3
    rows = "".join(f"{a},{b},{p}\n" for a, b, p in zip(field.stretch, field.stretch_2, stress, strict=True))
    test = read_test(file(f"stretch_1,stretch_2,{name}\n{rows}", "biaxial.csv"), stress_measure=measure)
    assert fit("neo-hooke", test).law.shear_modulus == pytest.approx(100e3)
    assert "along the first axis" in test.edits[0].text


def test_cauchy_stresses_of_both_axes(file):
    law = MooneyRivlin(C10=0.2e6, C01=0.02e6)
    points = MaterialTest(
        mode="biaxial",
        stretch=[1.5, 1.5],
        stretch_2=[1.0, 1.3],
        nominal_stress=[0, 0],
        nominal_stress_2=[0, 0],
        name="two",
    )
    first, second = np.split(points.predicted(law), 2)
    rows = "".join(
        f"{a};{b};{p * a};{q * b}\n" for a, b, p, q in zip(points.stretch, points.stretch_2, first, second, strict=True)
    )
    for names in ("lambda1;lambda2;cauchy stress 1 (Pa);cauchy stress 2 (Pa)", "λ 1;λ 2;sigma1 (Pa);sigma2 (Pa)"):
        test = read_test(file(f"{names}\n{rows}", "biaxial.csv"), stress_measure="cauchy")
        assert test.measured == pytest.approx([*first, *second])
    mixed = "stretch_1;stretch_2;nominal stress 1 (Pa);cauchy stress 2 (Pa)"
    with refused("biaxial.csv", "nominal stress 1 (Pa)", "cauchy stress 2 (Pa)"):
        read_test(file(f"{mixed}\n{rows}", "biaxial.csv"))
    with refused("biaxial.csv", "stress", "'stretch_1', 'stretch_2', 'nominal stress 2 (Pa)'"):
        read_test(file("stretch_1;stretch_2;nominal stress 2 (Pa)\n1.5;1;0\n1.5;1.2;1\n", "biaxial.csv"))


def test_a_difference_of_cauchy_stresses_says_so():
    with refused("strip", "Cauchy", "nominal_stress_2"):
        MaterialTest(
            mode="uniaxial", stretch=[1.0, 2.0], nominal_stress=[0.0, 1.0], name="strip", cauchy_difference=True
        )


def test_numbered_columns_of_other_modes_are_replicates(file):
    text = "stretch 1;nominal stress 1 (MPa);stretch 2;nominal stress 2 (MPa)\n1;0;1;0\n2;0,2;2;0,3\n"
    tests = read_tests(file(text))
    assert [test.nominal_stress[1] for test in tests] == pytest.approx([0.2e6, 0.3e6])


GERMAN = (
    '"Prüfer:";"M. Mustermann"\n"Einspannlänge";25,0;mm\n"Probenbreite b0";6,0;mm\n"Probendicke a0";2,0;mm\n'
    '"Prüfgeschwindigkeit";500;mm/min\n\n"Probe";"Prüfzeit";"Standardweg";"Standardkraft"\n"";"s";"mm";"kN"\n'
    "1;0,0;0,0;0,0\n1;0,1;12,5;0,0012\n1;0,2;25,0;0,0024\n\n2;0,0;0,0;0,0\n2;0,1;12,5;0,0013\n2;0,2;25,0;0,0026\n"
)


def test_a_german_file_of_force_and_way_in_kn_and_mm(file):
    """Sizes with their unit in a cell of its own, decimal commas, units in a line of their own, two specimens."""
    first, second = read_tests(file(GERMAN.encode("latin-1")))
    assert first.stretch == pytest.approx([1.0, 1.5, 2.0])
    assert first.nominal_stress == pytest.approx([0.0, 0.1e6, 0.2e6])
    assert second.nominal_stress[-1] == pytest.approx(2.6 / 12e-6)
    assert first.time == pytest.approx([0.0, 0.1, 0.2])
    assert first.specimen == Specimen(length=25 * mm, area=12e-6)
    with refused("2 specimens", "read_tests"):
        read_test(file(GERMAN))


@pytest.mark.parametrize(
    ("words", "measure"), [("Nennspannung", 1.0), ("technische Spannung", 1.0), ("wahre Spannung", 2.0)]
)
def test_german_stresses_say_what_they_are(file, words, measure):
    test = read_test(file(f"Dehnung (%);{words} (MPa);Breite (mm);Temperatur (°C)\n0;0;6;21\n100;0,2;6;21\n"))
    assert test.nominal_stress[-1] == pytest.approx(0.2e6 / measure)


def test_thousands_with_points_are_read(file):
    text = "Dehnung (%);Nennspannung (kPa)\n0;0\n50;650,5\n100;1.234,5\n"
    assert read_test(file(text)).nominal_stress == pytest.approx([0.0, 650.5e3, 1234.5e3])


def test_a_strain_that_must_be_percent_and_a_second_table_are_named(file):
    with refused("Strain", 200, "Strain (%)", "Strain (-)"):
        read_test(file("Strain,nominal stress (MPa)\n0,0\n100,0.1\n200,0.2\n"))
    block = '"Specimen","A"\n"Strain (-)","nominal stress (MPa)"\n0,0\n1,0.1\n'
    with refused("line 5", "'Specimen'", "'specimen'"):
        read_test(file(block + block.replace("A", "B")))
