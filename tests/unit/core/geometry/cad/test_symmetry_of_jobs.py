"""``symmetry = "automatic"`` of a CAD part in a job uses the planes that the loads allow."""

import pytest
from netgen.occ import Cylinder, Pnt, X

import wedge_cases
from refused import refused
from turgor.job.prepare import prepare
from turgor.job.read import read_job

pytestmark = pytest.mark.usefixtures("read_here")

JOB = """
[actuator]
type = "cad_file"
file = "tube.step"
symmetry = "automatic"

[actuator.faces]
fixed = {{ normal = "-x" }}
tip = {{ normal = "+x" }}

[materials]
body = {{ law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }}

[loads]
pressure = "5 kPa"
{more}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tube")
    tube = Cylinder(Pnt(0, 0, 0), X, r=8, h=30) - Cylinder(Pnt(3, 0, 0), X, r=6, h=24)
    tube.WriteStep(str(folder / "tube.step"))
    return folder


@pytest.mark.parametrize(
    ("more", "planes", "reason"),
    [
        ("", "yz", ""),
        ('gravity = "-z"', "y", "gravity acts along z"),
        ('[loads.tip]\nforce = [0, "0.1 N", 0]', "z", "a force on 'tip' acts along y"),
        ('[loads.tip]\nhangs = "5 g"', "y", "a weight on 'tip' acts along z"),
        ('point_forces = [{ at = [0, "8 mm", 0], force = ["1 N", 0, 0] }]', "", "loads.point_forces is not known"),
        ('[points.plate]\nface = "tip"\nforce = ["1 N", 0, 0]', "", "point 'plate'"),
        ('[loads.tip]\ntraction = [0, "1 kPa", 0]', "z", "a traction on 'tip' acts along y"),
        ('[loads.top]\nnear = ["30 mm", 0, "8 mm"]\nforce = ["1 N", 0, 0]', "", "the load 'top' acts on nodes by near"),
        ('[supports]\nfixed = "xyz"\n[supports.pin]\nnear = ["30 mm", 0, "8 mm"]\ndirections = "z"', "", "'pin'"),
        ('[supports]\nfixed = "xyz"\n[supports.tip]\ndirections = [0, 1, 1]', "", "acts along (0, 1, 1)"),
        (
            '[supports]\nfixed = "xyz"\n[supports.lever]\nterms = [{ place = "tip", direction = "x" }, '
            '{ near = [0, 0, "8 mm"], direction = "x", factor = -0.5 }]',
            "",
            "the equation 'lever'",
        ),
        (
            '[[stages]]\nname = "pull"\ndisplacements = { fixed = [0, "1 mm", 0] }',
            "z",
            "the face 'fixed' is moved along y",
        ),
        (
            '[fibers.rod]\nthrough = [[[0, "3 mm", "6.5 mm"], ["28 mm", "3 mm", "6.5 mm"]]]\nE = "1 GPa"\n'
            'diameter = "0.2 mm"',
            "",
            "threads 'rod' run through points",
        ),
        (
            '[fibers.hoops]\nface = "outside"\nE = "1 GPa"\ndiameter = "0.2 mm"\nangle_from_axis = "90 deg"\n'
            'spacing = "3 mm"\nform = "smeared"\nwithin = { y_from = "-9 mm", y_to = "0 mm" }',
            "z",
            "the winding 'hoops' has limits along y",
        ),
        ('[obstacles.floor]\nshape = "plane"\npoint = [0, 0, "-9 mm"]\nnormal = "+z"', "", "obstacle 'floor'"),
    ],
)
def test_planes_are_those_that_the_loads_allow(folder, more, planes, reason):
    path = folder / "job.toml"
    path.write_text(JOB.format(more=more), encoding="utf-8")
    job = read_job(path)
    _, part = job.built
    assert [face for face in part.faces if face.startswith("symmetry_")] == [f"symmetry_{axis}" for axis in planes]
    told = part.findings[-1]
    assert told.code == "D07"
    assert reason in told.message


@pytest.mark.parametrize(
    ("more", "wedge", "reason"),
    [
        ("", True, "A wedge of 1/6 of the part about x is modeled"),
        ('gravity = "-x"', True, "A wedge of 1/6"),
        ('gravity = "-z"', False, "Half of the part is modeled, cut at the mirror plane y"),
        ('point_forces = [{ at = [0, "8 mm", 0], force = ["1 N", 0, 0] }]', False, "The whole part is modeled"),
    ],
)
def test_a_wedge_is_used_where_loads_allow_it(folder, more, wedge, reason):
    wedge_cases.lobed().WriteStep(str(folder / "lobed.step"))
    path = folder / "wedge.toml"
    path.write_text(JOB.format(more=more).replace("tube.step", "lobed.step"), encoding="utf-8")
    _, part = read_job(path).built
    assert (part.wedge is not None) == wedge
    assert reason in part.findings[-1].message


@pytest.mark.parametrize(
    ("more", "fact"),
    [
        ('gravity = "-z"', "loads.gravity"),
        ('[loads.tip]\nforce = [0, "0.1 N", 0]', "loads.tip"),
    ],
)
def test_loads_that_break_a_wedge_are_refused(folder, more, fact):
    path = folder / "broken.toml"
    path.write_text(JOB.format(more=more).replace('"automatic"', '"wedge 6"'), encoding="utf-8")
    with refused("broken.toml:16", "about x", "actuator.symmetry", fact):
        read_job(path)


FIXED = '[supports]\nfixed = "xy"'


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ("", True),
        (FIXED, False),
        ('[mesh]\ncells = "axisymmetric"', False),
    ],
)
def test_an_axisymmetric_mesh_is_recommended_where_all_is_the_same_around(folder, more, told):
    path = folder / "job.toml"
    path.write_text(JOB.format(more=more), encoding="utf-8")
    _, findings = prepare(read_job(path))
    results = [each for each in findings if each.code == "G13"]
    assert bool(results) == told
    if told:
        assert 'cells = "axisymmetric"' in results[0].advice
        assert "body of revolution about x" in results[0].message
