"""The CAD shape of a helical PneuNet has the volumes, faces and names that its dimensions say."""

from math import cos, sin

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.helical_pneunet import HelicalPneuNet
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.units import deg, mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(("chambers", "length", "angle"), [(11, 110, 30), (3, 45, -20), (2, 60, 50), (1, 30, 10)])
def test_volumes_computed_by_hand(chambers, length, angle):
    actuator = HelicalPneuNet(chambers=chambers, length=length * mm, chamber_angle=angle * deg)
    gaps, along = chambers - 1, 1 / cos(angle * deg)  # 1 mm of wall or gap, along x
    cavity = (length - 3 * gaps * along - 4) * 16 * 10 + gaps * 3 * along * 3 * 2
    solid = length * 20 * 3 + (length - gaps * along) * 20 * 12 + gaps * along * 5 * 3 - cavity
    assert_shape(actuator, solid=solid, cavities={"cavity": cavity}, regions={"body", "base"}, faces=FACES)


def test_without_a_slant_it_is_the_whole_fast_pneunet():
    straight = HelicalPneuNet(chambers=3, length=30 * mm, chamber_angle=0.0).build()
    assert areas(straight) == pytest.approx(areas(FastPneuNet(chambers=3, length=30 * mm, symmetric=False).build()))


@pytest.mark.parametrize("angle", [30 * deg, -25 * deg])
def test_a_positive_angle_reaches_further_towards_the_tip_at_larger_y(angle):
    shape = HelicalPneuNet(chambers=2, length=40 * mm, chamber_angle=angle).build().shape
    # the sides of the gap: outside faces through the middle of the actuator, 12 mm high
    sides = [f for f in set(shape.faces) if f.name == "outside" and 18 < f.center[0] < 22 and f.mass > 200]
    sides = [f for f in sides if f.bounding_box[1][2] - f.bounding_box[0][2] > 11 and abs(f.center[1]) < 1]
    assert len(sides) == 2
    for face in sides:
        left = max(vertex.p[1] for vertex in face.vertices)
        at_left = [vertex.p[0] for vertex in face.vertices if vertex.p[1] == left]
        assert at_left[0] - face.center[0] == pytest.approx(10 * sin(angle) / cos(angle), rel=1e-6)


def test_its_ends_are_square():
    result = areas(HelicalPneuNet(clamp_length=5 * mm).build())
    assert result["fixed"] == pytest.approx(20 * 15 + 5 * 70)
    assert result["tip"] == pytest.approx(20 * 15)
    assert result["strain_limiting_layer"] == pytest.approx(20 * 115)


def test_it_meshes_coarsely():
    assert_meshes(HelicalPneuNet(chambers=2, length=30 * mm, inlet_diameter=3 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"chamber_angle": 45 * deg}, ("chamber_angle", "45 deg", "-35.243 deg to 35.243 deg")),
        ({"chamber_angle": -45 * deg}, ("chamber_angle", "-45 deg", "-35.243 deg to 35.243 deg")),
        ({"chambers": 1, "chamber_angle": 80 * deg}, ("chamber_angle", "80 deg", "-75 deg to 75 deg")),
        ({"chamber_angle": None}, ("chamber_angle", "None", "radians")),
        ({"symmetric": True}, ("symmetric", "True", "allowed is False")),
        ({"wall": 12 * mm}, ("wall", "12 mm", "0.01 mm to 4.54 mm", "9.091 mm")),
    ],
)
def test_an_impossible_dimension_is_refused(wrong, facts):
    with refused(*facts):
        HelicalPneuNet(**wrong)


@pytest.mark.parametrize(("chambers", "angle"), [(8, 45), (5, 60), (5, -60)])
def test_steep_chambers_mesh_where_there_are_few(chambers, angle):
    part = HelicalPneuNet(chambers=chambers, chamber_angle=angle * deg).build()
    made = mesh(part, size=4 * mm, cells="hexahedra")
    assert cell_volumes(made).sum() == pytest.approx(part.solid_volume)
    with refused("chamber_angle", f"{angle} deg", "end_extension", "length", "chambers"):
        HelicalPneuNet(chambers=chambers + 1, chamber_angle=angle * deg)


def test_the_largest_angle_is_built():
    geometry = HelicalPneuNet(chamber_angle=35.243 * deg).build()
    along = 1 / cos(35.243 * deg)
    cavity = (110 - 30 * along - 4) * 16 * 10 + 30 * along * 3 * 2
    assert geometry.cavity_volumes["cavity"] == pytest.approx(cavity * mm**3)


@pytest.mark.parametrize(("angle", "extension"), [(45, 4), (60, 12)])
def test_longer_ends_take_eleven_chambers_at_large_angles(angle, extension) -> None:
    sizes = {"chamber_angle": angle * deg, "end_extension": extension * mm}
    actuator = HelicalPneuNet(**sizes)
    geometry = actuator.build()  # checks both volumes against the dimensions
    bounds = geometry.shape.bounding_box
    assert (bounds[1][0] - bounds[0][0]) == pytest.approx(110)
    ranges = actuator._row.chamber_ranges()
    lengths = [(end - start) / mm for start, end in ranges]
    assert lengths[0] == pytest.approx(lengths[5] + extension)
    assert lengths[-1] == pytest.approx(lengths[5] + extension)
    with refused("chamber_angle", f"{angle} deg", "end_extension"):
        HelicalPneuNet(chamber_angle=angle * deg, end_extension=(extension - 2) * mm)


def test_hexahedra_fill_longer_ends() -> None:
    part = HelicalPneuNet(chambers=3, length=50 * mm, chamber_angle=45 * deg, end_extension=6 * mm).build()
    made = mesh(part, size=4 * mm, cells="hexahedra")
    assert cell_volumes(made).sum() == pytest.approx(part.solid_volume)
