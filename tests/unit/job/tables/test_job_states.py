"""States of bodies in a job file: read, refused with a sentence, written into the lock file, and solved in stages."""

import numpy as np
import pytest

from refused import refused
from turgor.core.model.loads import Hardening, PreStretch, Shrinkage, Stiffness, Swelling, Temperature
from turgor.core.results.measures.measures import find_measure, measure
from turgor.core.solvers.solve import solve
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job

HEAD = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa" }
base = { law = "neo_hooke", C10 = "50 kPa" }

"""

STATES = """\
[loads]
pressure = "1 kPa"
shrinkage = [{ body = "body", linear = "0.5 %" }]
swelling = [{ body = "base", volume_ratio = 1.1 }]
pre_stretch = [{ body = "base", stretch = 1.2, direction = [0, 0, 1], form = "across" }]
stiffness = [{ body = "base", factor = 0.1, history = [[0, 0], [0.5, 1], [1, 1]] }]

[[loads.temperature]]
body = "body"
temperature = "60 °C"
expansion = "300 ppm/K"
modulus = [["20 °C", 1.0], ["80 °C", 0.7]]

[[loads.temperature]]
body = "base"
temperature = "313.15 K"
rest = "25 °C"
modulus = "rubber"
"""

WOUND = """\
[actuator]
type = "fiber_reinforced_cylinder"
length = "30 mm"

[mesh]
size = "8 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }

[fibers.hoops]
face = "outside"
E = "50 MPa"
diameter = "0.2 mm"
angle_from_circumference = "0 deg"
spacing = "2 mm"

[fibers.rods]
face = "outside"
E = "50 MPa"
diameter = "0.2 mm"
angle_from_axis = "0 deg"
spacing = "2 mm"

"""

THREADS = """\
[loads]
pressure = "5 kPa"
pre_stretch = [{ body = "hoops", stretch = 1.05 }]
shrinkage = [{ body = "rods", linear = "2 %" }]
swelling = [{ body = "rods", volume_ratio = 1.01 }]
stiffness = [{ body = "hoops", factor = 0.5 }]
temperature = [{ body = "hoops", temperature = "60 °C", expansion = "-4 ppm/K", modulus = "rubber" }]
"""

WOUND_STAGES = """\
[[stages]]
name = "wind"
loads = { pre_stretch = [{ body = "hoops", stretch = 1.1 }] }

[[stages]]
name = "inflate"
loads = { pressure = "10 kPa" }

[output]
measures = ["tip_displacement_x", "maximum_fiber_tension"]
"""

STAGES = """\
[[stages]]
name = "cure"
loads = { shrinkage = [{ body = "body", linear = "0.2 %" }] }

[[stages]]
name = "inflate"
loads = { pressure = "3 kPa" }

[[stages]]
name = "freeze"
loads = { hardening = [{ body = "base", factor = 100.0 }, { body = "body", factor = 100.0 }] }

[[stages]]
name = "open"
loads = { pressure = "0 kPa" }

[output]
measures = ["bending_angle"]
"""


def read(tmp_path, text, head=HEAD):
    file = tmp_path / "finger.toml"
    file.write_text(head + text, encoding="utf-8")
    return read_job(file)


def test_states_are_read_and_come_back(tmp_path):
    job = read(tmp_path, STATES)
    loads = dict.fromkeys(job.loads)
    assert Shrinkage("body", 0.005) in loads
    assert Swelling("base", 1.1) in loads
    assert PreStretch("base", 1.2, (0, 0, 1), "across") in loads
    assert Stiffness("base", 0.1, [(0, 0), (0.5, 1), (1, 1)]) in loads
    assert Temperature("body", 333.15, expansion=3e-4, modulus=[(293.15, 1.0), (353.15, 0.7)]) in loads
    assert Temperature("base", 313.15, 298.15, modulus="rubber") in loads
    again = tmp_path / "again"
    again.mkdir()
    (again / "finger.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(again / "finger.toml").loads == job.loads


def test_states_of_windings_are_read_and_come_back(tmp_path):
    job = read(tmp_path, THREADS, WOUND)
    loads = dict.fromkeys(job.loads)
    assert PreStretch("hoops", 1.05, form="thread") in loads
    assert Shrinkage("rods", 0.02) in loads
    assert Swelling("rods", 1.01) in loads
    assert Stiffness("hoops", 0.5) in loads
    assert Temperature("hoops", 333.15, expansion=-4e-6, modulus="rubber") in loads
    assert "Threads of hoops were stretched to 1.05" in PreStretch("hoops", 1.05, form="thread").text()
    again = tmp_path / "again"
    again.mkdir()
    (again / "finger.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(again / "finger.toml").loads == job.loads


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ('shrinkage = [{ body = "hops", linear = "1 %" }]', ("loads.shrinkage", "'hops'", "'hoops'")),
        ('hardening = [{ body = "hoops", factor = 1.0 }]', ("hardening", "'hoops'", "winding")),
        ('temperature = [{ body = "hoops", temperature = "60 °C" }]', ("loads.temperature", "'hoops'", "expansion")),
        (
            'pre_stretch = [{ body = "hoops", stretch = 1.1, direction = [0, 0, 1] }]',
            ("loads.pre_stretch", "'hoops'", "direction"),
        ),
    ],
)
def test_wrong_states_of_windings_are_refused(tmp_path, text, facts):
    with refused(*facts):
        prepare(read(tmp_path, f"[loads]\n{text}\n", WOUND))


def test_a_job_winds_tight_and_inflates(tmp_path):
    job = read(tmp_path, WOUND_STAGES, WOUND)
    model, _ = prepare(job)
    response = measure(solve(model, job.procedure), find_measure("maximum_fiber_tension"))
    tension = response.column("maximum_fiber_tension")
    ends = {name: float(tension[k]) for k, name in enumerate(response.stages)}
    assert 0 < ends["wind"] < 0.1 * 50e6 * np.pi / 4 * 0.2e-3**2  # the wall gives way
    assert ends["inflate"] > ends["wind"]


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ('shrinkage = [{ body = "bdy", linear = "1 %" }]', ("loads.shrinkage", "'bdy'", "'body'")),
        ('shrinkage = [{ body = "body", linear = 0.01 }]', ("loads.shrinkage", "needs a unit", "'0.3 %'")),
        ('shrinkage = [{ body = "body", linaer = "1 %" }]', ("loads.shrinkage", "'linaer'", "'linear'")),
        ('temperature = [{ body = "body", temperature = "60 C" }]', ("loads.temperature", "'60 C'", "°C")),
        (
            'temperature = [{ body = "body", temperature = "60 °C", modulus = [["20 °C"]] }]',
            ("loads.temperature", "60 °C"),
        ),
        (
            'pre_stretch = [{ body = "body", stretch = 1.2, direction = [1, 1, 0] }]',
            ("loads.pre_stretch", "pre stretch", "actuator.symmetric"),
        ),
    ],
)
def test_wrong_states_are_refused_with_their_key(tmp_path, text, facts):
    with refused("finger.toml:", *facts):
        read(tmp_path, f"[loads]\n{text}\n")


def test_a_job_shrinks_inflates_and_freezes(tmp_path):
    job = read(tmp_path, STAGES)
    assert job.procedure.stages[2].loads == (Hardening("base", 100.0), Hardening("body", 100.0))
    model, _ = prepare(job)
    response = measure(solve(model, job.procedure), find_measure("bending_angle"))
    angle = np.rad2deg(response.column("bending_angle"))
    ends = {name: float(angle[k]) for k, name in enumerate(response.stages)}
    assert ends["cure"] < 0 < ends["inflate"]
    assert ends["freeze"] == pytest.approx(ends["inflate"], abs=1e-6)
    share = (ends["open"] - ends["cure"]) / (ends["inflate"] - ends["cure"])
    assert share == pytest.approx(100 / 101, abs=0.005)  # the springs of both networks in a row
