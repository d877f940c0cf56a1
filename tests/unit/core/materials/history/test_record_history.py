"""Viscoelasticity and softening in files: records, jobs, lock files, exports and words; times of a testing machine."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.inp.materials import material_lines
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test, read_tests
from turgor.core.materials.experiments.test_edits import crop, thin
from turgor.core.materials.fitting.save import save_material
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.laws import ArrudaBoyce, GeneralizedRivlin, Gent, Ogden, YeohN
from turgor.core.materials.library.record_text import describe_material
from turgor.core.materials.library.records import from_library
from turgor.core.materials.material import Material
from turgor.core.solvers.procedures.static import Static
from turgor.foundation.source import Source
from turgor.job.output.lock import lock_text

SERIES = Prony(g=(0.2, 0.1), tau=(1.5, 1 / 3), moduli="long_term")
MULLINS = Mullins(r=1.4, m=23456.7, beta=0.1)

RECORD = """\
name = "Our silicone"

[records.may]
law = "yeoh"
convention = "two_index"
parameters = { C10 = "80 kPa", C20 = "1.5 kPa", C30 = "0 kPa" }
source = "our tests of May"

[records.may.viscoelasticity]
g = [0.2, 0.1]
tau = ["1.5 s", "2 min"]
moduli = "instantaneous"

[records.may.stress_softening]
r = 1.4
m = "20 kPa"
"""


@pytest.fixture
def write(tmp_path):
    def write(text, name="ours.toml"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        return tmp_path / name

    return write


def test_a_record_has_both(write):
    file = str(write(RECORD))
    rubber = from_library(file)
    assert rubber.viscoelasticity == Prony(g=(0.2, 0.1), tau=(1.5, 120.0), moduli="instantaneous")
    assert rubber.stress_softening == Mullins(r=1.4, m=20e3)
    text = describe_material(file)
    assert "viscoelasticity: g = 0.2 at tau = 1.5 s, g = 0.1 at tau = 120 s; moduli instantaneous" in text
    assert "stress softening: r = 1.4, m = 20 kPa, beta = 0" in text


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ("moduli =", "modulus =", ("records.may.viscoelasticity", "modulus", "moduli")),
        ('moduli = "instantaneous"\n', "", ("records.may.viscoelasticity", "'moduli'", "missing")),
        ('"instantaneous"', '"longterm"', ("records.may.viscoelasticity", "longterm", "long_term")),
        ("g = [0.2, 0.1]", "g = [0.2, 0.9]", ("records.may.viscoelasticity", "sum of g", 1.1, "below 1")),
        ("g = [0.2, 0.1]", "g = 0.2", ("records.may.viscoelasticity.g", 0.2)),
        ('"2 min"', "120", ("records.may.viscoelasticity.tau", 120, "'2 s'")),
        ('m = "20 kPa"', "m = 20", ("records.may.stress_softening.m", 20, "'60 kPa'")),
        ("r = 1.4", "r = 0.4", ("records.may.stress_softening", "r is 0.4", "more than 1")),
        ("r = 1.4", 'r = "1.4"', ("records.may.stress_softening.r", "'1.4'", "unit")),
    ],
)
def test_mistakes_in_a_record_are_named(write, old, new, facts):
    assert old in RECORD
    with refused(*facts):
        from_library(str(write(RECORD.replace(old, new))))


@pytest.mark.parametrize(
    "law",
    [
        tg.laws.NeoHooke(C10=1.2e5),
        tg.laws.MooneyRivlin(C10=1e4, C01=2e3 / 3),
        Ogden(mu=(2e4, -1e3), alpha=(1.5, -4.0)),
        GeneralizedRivlin.from_names({"C10": 2e4, "C01": 1e3, "C11": -7.0}),
        Gent(mu=4e4, Jm=20.0),
        ArrudaBoyce(mu=4e4, locking_stretch=3.0),
    ],
    ids=lambda law: type(law).__name__,
)
def test_a_material_is_saved_and_read_back(tmp_path, law):
    rubber = Material(
        name="ours",
        law=law,
        bulk_modulus=3.3e6,
        density=1070.0,
        stretch_range=(1.0, 2.0),
        source=Source(text="our tests"),
        viscoelasticity=SERIES,
        stress_softening=MULLINS,
    )
    save_material(tmp_path / "ours.toml", rubber, "may")
    again = from_library(str(tmp_path / "ours.toml"), record="may")
    for name in ("name", "law", "bulk_modulus", "density", "stretch_range", "viscoelasticity", "stress_softening"):
        assert getattr(again, name) == getattr(rubber, name), name
    assert again.source.text == "our tests"


def test_what_has_no_form_is_not_saved(tmp_path):
    with refused("law YeohN"):
        save_material(tmp_path / "a.toml", Material(name="a", law=YeohN(coefficients=(1e4, 10.0))))
    with refused(tmp_path / "a.csv", ".toml"):
        save_material(tmp_path / "a.csv", Material(name="a", law=tg.laws.NeoHooke(C10=1e5)))


JOB = """\
name = "finger"

[actuator]
type = "fast_pneunet"
chambers = 2

[materials.body]
law = "neo_hooke"
C10 = "0.1 MPa"
viscoelasticity = { g = [0.2, 0.1], tau = ["1.5 s", "20 s"], moduli = "long_term" }
stress_softening = { r = 1.4, m = "20 kPa", beta = 0.1 }

[materials.base]
library = "elastosil-m4601"
record = "yeoh-mosadegh-2014"
stress_softening = { r = 2.0, m = "5 kPa" }

[materials.strain_limiting_layer]
library = "paper"
record = "hooke-yang-2020"
thickness = "0.1 mm"

[mesh]
size = "4 mm"

[loads]
pressure = "3 kPa"
"""


def test_a_job_states_both_and_its_lock_file_repeats_them(write):
    job = tg.jobs.read_job(write(JOB, "job.toml"))
    body, base = job.materials["body"], job.materials["base"]
    assert body.viscoelasticity == Prony(g=(0.2, 0.1), tau=(1.5, 20.0), moduli="long_term")
    assert body.stress_softening == Mullins(r=1.4, m=20e3, beta=0.1)
    assert (base.viscoelasticity, base.stress_softening) == (None, Mullins(r=2.0, m=5e3))
    again = tg.jobs.read_job(write(lock_text(job, {"turgor": "0.0"}), "lock.toml"))
    assert again.materials == job.materials


def test_mistakes_in_a_job_are_named_with_their_line(write):
    with refused("job.toml:10", "viscoelasticity", "'longterm'", "'long_term'"):
        tg.jobs.read_job(write(JOB.replace('"long_term"', '"longterm"'), "job.toml"))
    extra = 'thickness = "0.1 mm"\nstress_softening = { r = 2.0, m = "5 kPa" }'
    stiff = write(JOB.replace('thickness = "0.1 mm"', extra), "job.toml")
    with refused("job.toml:18", "materials.strain_limiting_layer", "'Paper'", "viscoelasticity", "stress_softening"):
        tg.jobs.read_job(stiff)


def test_abaqus_gets_either_and_calculix_refuses_it():
    relaxing = Material(name="a", law=tg.laws.NeoHooke(C10=1e5), bulk_modulus=2e6, viscoelasticity=SERIES)
    assert material_lines("body", relaxing, "abaqus")[1:] == [
        "*HYPERELASTIC, NEO HOOKE, MODULI=LONG TERM",
        "0.1, 1",
        "*VISCOELASTIC, TIME=PRONY",
        "0.2, 0, 1.5",
        "0.1, 0, 0.333333333333333",
    ]
    softening = replace(relaxing, viscoelasticity=None, stress_softening=MULLINS)
    assert material_lines("body", softening, "abaqus")[1:] == [
        "*HYPERELASTIC, NEO HOOKE",
        "0.1, 1",
        "*MULLINS EFFECT",
        "1.4, 0.0234567, 0.1",
    ]
    assert [Static().deck_step("abaqus", relaxes).keyword for relaxes in (True, False)] == [
        "*STATIC, LONG TERM",
        "*STATIC",
    ]
    with refused("materials.body", "'a'", "Abaqus", "turgor"):
        material_lines("body", replace(relaxing, stress_softening=MULLINS), "abaqus")
    with refused("materials.body", "CalculiX", "viscoelasticity"):
        material_lines("body", softening, "calculix")


TABLE = "Time (min),stretch,nominal stress (kPa)\n0.5,1.0,0\n1,1.5,80\n1.5,1.5,70\n"


@pytest.mark.parametrize(
    ("text", "time", "said"),
    [
        (TABLE, [0, 30, 60], "time from 'Time (min)'"),
        (TABLE.replace("Time (min)", "time_s"), [0, 0.5, 1.0], "time from 'time_s'"),
        (TABLE.replace("Time (min)", "Time"), None, ""),
        (TABLE.replace("\n1.5,1.5", "\n0.2,1.5"), None, "'Time (min)' left out, because it runs backwards at line 4"),
        (TABLE.replace("\n1,", "\n10:30,"), None, "left out, because it does not hold times only"),
    ],
)
def test_time_is_read_where_it_is_one(write, text, time, said):
    test = read_test(write(text, "uniaxial.csv"))
    assert (None if test.time is None else test.time.tolist()) == time
    assert said in test.edits[0].text


def test_specimens_side_by_side_share_a_clock_or_have_their_own(write):
    one = "time_s,stretch,nominal_stress_kPa,stretch,nominal_stress_kPa\n0,1,0,1,0\n2,1.5,80,1.4,70\n"
    two = "time_s,stretch,nominal_stress_kPa,time_s,stretch,nominal_stress_kPa\n0,1,0,0,1,0\n2,1.5,80,3,1.4,70\n"
    for text, times in ((one, [[0, 2], [0, 2]]), (two, [[0, 2], [0, 3]])):
        tests = read_tests(write(text, "uniaxial.csv"))
        assert [test.time.tolist() for test in tests] == times


def test_time_stays_with_its_points_until_they_are_averaged():
    stretch = np.linspace(1, 2, 11)
    test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stretch, time=np.arange(11.0), name="a")
    assert crop(test, 1.45, 2.0).time.tolist() == [5, 6, 7, 8, 9, 10]
    assert thin(test, points=5).time is None
    with refused("'a'", "time", "point 2", "1 s"):
        MaterialTest(mode="uniaxial", stretch=[1, 2, 3], nominal_stress=[1, 2, 3], time=[0, 1, 0.5], name="a")
