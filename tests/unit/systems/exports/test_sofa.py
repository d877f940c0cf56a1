"""A scene for SOFA, built with a stub of SOFA's nodes: volumes, normals, constants, supports and loads."""

import runpy
from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.faces.surfaces import area
from turgor.core.meshing.exchange.formats.stl import read_stl
from turgor.systems.exports.linear_body import linear_body
from turgor.systems.exports.sofa_law import sofa_law
from turgor.units import kPa, mm

YEOH = tg.Material(name="rubber", law=tg.Yeoh(C10=20e3, C20=2e3), density=1070.0)
FAMILY = tg.FastPneuNet(chambers=1, length=12 * mm)


class Node:
    """What SOFA's nodes take: objects by type with their data, and children by name."""

    def __init__(self, name):
        self.name, self.objects, self.children = name, [], {}

    def addObject(self, kind, **data):
        self.objects.append((kind, data))
        return self

    def addChild(self, name):
        assert name not in self.children
        self.children[name] = Node(name)
        return self.children[name]

    def data(self, kind):
        (data,) = (data for each, data in self.objects if each == kind)
        return data


@pytest.fixture(scope="module")
def model():
    paper = tg.Shell(replace(tg.from_library("paper", record="hooke-yang-2020"), density=800.0), thickness=0.1 * mm)
    return tg.Model(
        tg.mesh(FAMILY.build(), size=6 * mm),
        materials={"body": YEOH, "base": YEOH, "strain_limiting_layer": paper},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", 3 * kPa), tg.Gravity()],
    )


@pytest.fixture(scope="module")
def written(model, tmp_path_factory):
    return tg.files.write_sofa(model, tmp_path_factory.mktemp("sofa") / "finger")


@pytest.fixture(scope="module")
def scene(written):
    root = Node("root")
    runpy.run_path(str(written.folder / "scene.py"))["createScene"](root)
    return root


def directed_edges(triangles):
    return triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)


def test_cavities_are_closed_with_the_volume_of_the_actuator(written, scene):
    file = scene.children["actuator"].children["cavity"].data("MeshSTLLoader")["filename"]
    surface = read_stl(file)  # in mm
    expected = 2 * FAMILY.build().cavity_volumes["cavity"]  # of both halves
    assert surface.volume * mm**3 == pytest.approx(expected, rel=1e-6)
    assert written.volumes["cavity"] == pytest.approx(expected, rel=1e-6)
    assert surface.open_edges == 0
    edges = directed_edges(surface.triangles)
    assert len(np.unique(edges, axis=0)) == len(edges)  # neighbors are wound alike
    assert {tuple(edge) for edge in edges.tolist()} == {tuple(edge[::-1]) for edge in edges.tolist()}


def test_the_mesh_is_the_whole_body_and_has_the_corners_of_the_cavity(model, written, scene):
    lines = (written.folder / "body.vtk").read_text("ascii").splitlines()
    count = int(lines[4].split()[1])
    points = np.array([line.split() for line in lines[5 : 5 + count]], dtype=float)
    cells = np.array([line.split()[1:] for line in lines[6 + count :] if line.startswith("4 ")], dtype=int)
    a, b, c, d = (points[cells[:, k]] for k in range(4))
    volumes = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
    assert volumes.min() > 0
    mass = tg.measures.total_mass(model)
    (paper,) = model.sheet_masses.values()
    sheet = 2 * paper * area(model.mesh.points, model.mesh.face("strain_limiting_layer"))
    assert volumes.sum() * 1e-9 * 1070.0 + sheet == pytest.approx(mass, rel=1e-6)
    assert scene.children["actuator"].data("UniformMass")["totalMass"] == pytest.approx(mass, rel=1e-6)
    corners = read_stl(written.folder / "cavity.stl").points
    distance = np.linalg.norm(corners[:, None] - points[None], axis=2).min(axis=1)
    assert distance.max() < 1e-5  # mm; STL has single precision
    assert sorted(np.unique(cells).tolist()) == list(range(count))


def test_parts_of_the_scene_have_the_numbers_of_the_model_in_mm_kg_s(model, written, scene):
    actuator = scene.children["actuator"]
    assert scene.gravity == pytest.approx([0, 0, -9806.65])
    body = linear_body(model.mesh)
    fixed = actuator.data("FixedProjectiveConstraint")["indices"]
    assert body.points[fixed, 0] == pytest.approx(0.0, abs=1e-12)
    assert len(fixed) == (np.abs(body.points[:, 0]) < 1e-9).sum()
    regions = {name: node for name, node in actuator.children.items() if name.startswith("region_")}
    assert set(regions) == {"region_body", "region_base"}
    given, own = regions["region_body"].data("TetrahedronHyperelasticityFEMForceField"), written.materials["body"]
    assert (given["materialName"], own.name) == ("Ogden", "Ogden")
    modulus, exponent = own.constants
    assert given["ParameterSet"] == pytest.approx([modulus / 1e3, exponent, own.bulk_modulus / 1e3])
    sheet = actuator.children["sheet_strain_limiting_layer"].data("TriangleFEMForceField")
    assert (sheet["youngModulus"], sheet["thickness"]) == pytest.approx((1.2e6, 0.1))
    assert actuator.children["cavity"].data("SurfacePressureConstraint")["value"] == pytest.approx(3.0)
    head = (written.folder / "scene.py").read_text("utf-8").split('"""')[1]
    assert "mm, kg, s" in head and "kPa" in head and "not run in SOFA" in head


def test_constants_are_exact_where_they_can_be_and_state_their_error_elsewhere():
    fitted = sofa_law(tg.Material(name="m", law=tg.laws.MooneyRivlin(C10=30e3, C01=7e3)), 2.0, 0.49)
    assert fitted.name == "MooneyRivlin"
    assert fitted.constants == pytest.approx((30e3, 7e3))
    assert fitted.bulk_modulus == pytest.approx(74e3 * 2 * 1.49 / (3 * 0.02))
    ogden = tg.laws.Ogden(mu=[20e3], alpha=[5.0])
    fitted = sofa_law(tg.Material(name="m", law=ogden, bulk_modulus=1e6), 2.0, 0.49)
    assert (fitted.name, fitted.bulk_modulus) == ("Ogden", 1e6)
    assert fitted.constants == pytest.approx((2 * ogden.shear_modulus, 5.0), rel=1e-4)
    assert fitted.error < 1e-4
    assert fitted.parameters == pytest.approx([2 * ogden.shear_modulus / 1e3, 5.0, 1e3], rel=1e-4)


def test_the_error_of_the_constants_is_that_of_their_energy():
    fitted = sofa_law(YEOH, 1.5, 0.49)
    a, b = fitted.constants

    def energy(l1, l2, l3):
        return a / b**2 * (l1**b + l2**b + l3**b - 3)  # as SOFA has it

    stretch, step = np.linspace(1.0, 1.5, 41)[1:], 1e-6
    ends = [energy(each, each**-0.5, each**-0.5) for each in (stretch - step, stretch + step)]
    stress = tg.laws.curve(YEOH.law, "uniaxial", stretch).nominal_stress
    error = np.abs((ends[1] - ends[0]) / (2 * step) - stress).max() / stress.max()
    assert 0.2 * fitted.error < error <= fitted.error * (1 + 1e-5)
    assert 1e-3 < fitted.error < 0.05 < sofa_law(YEOH, 3.0, 0.49).error


@pytest.mark.parametrize(
    ("name", "record", "error"),
    [("ecoflex-00-30", "yeoh-steck-2019", 0.007), ("elastosil-m4601", "yeoh-mosadegh-2014", 0.075)],
)
def test_errors_of_two_silicones_are_those_of_the_guide(name, record, error):
    assert sofa_law(tg.from_library(name, record=record), 1.5, 0.49).error == pytest.approx(error, rel=0.02)


def test_what_a_scene_cannot_have_is_refused(model, tmp_path):
    with refused("poisson", 0.5):
        tg.files.write_sofa(model, tmp_path, poisson=0.5)
    with refused("stretch", 1):
        tg.files.write_sofa(model, tmp_path, stretch=1.0)
    with refused("SOFA", "tip"):
        tg.files.write_sofa(replace(model, loads=(tg.loads.Force("tip", (0, 0, 1.0)),)), tmp_path)
    with refused("SOFA", "fixed", "x"):
        tg.files.write_sofa(replace(model, supports=(tg.Fixed("fixed", "x"),)), tmp_path)
    assert not list(tmp_path.iterdir())
