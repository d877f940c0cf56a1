"""The CAD shape of a PneuNet with triangular bellows has the volumes, faces and names that its dimensions say."""

from math import atan2, pi, sin

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.triangular_pneunet import TriangularPneuNet
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(("chambers", "length", "wall", "gap"), [(10, 110, 1.5, 1), (3, 50, 1, 0.5), (1, 20, 2, 9)])
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(chambers, length, wall, gap, symmetric):
    actuator = TriangularPneuNet(
        chambers=chambers, length=length * mm, wall=wall * mm, gap=gap * mm, symmetric=symmetric
    )
    share = 2 if symmetric else 1
    foot = (length - 4 - (chambers - 1) * gap) / chambers
    rise = 15 - 5 - wall  # above the roof between the bellows
    outer = length * (5 + wall) + chambers * rise * foot / 2
    # the air's triangle is similar to the one outside, its point lower by wall / sin(half the angle at the top)
    height = 10 - wall / sin(atan2(foot / 2, rise))
    inner = (length - 4) * 2 + chambers * height**2 * (foot / 2) / rise
    assert_shape(
        actuator, solid=(outer * 20 - inner * 16) / share, cavities={"cavity": inner * 16 / share},
        regions={"body", "base"}, faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )  # fmt: skip


def test_areas_of_the_ends_with_an_end_block_and_an_inlet():
    actuator = TriangularPneuNet(
        chambers=2, length=30 * mm, clamp_length=10 * mm, inlet_diameter=1.5 * mm, symmetric=False
    )
    result = areas(actuator.build())
    assert result["fixed"] == pytest.approx(20 * 6.5 - pi / 4 * 1.5**2 + 10 * (20 + 20 + 13), rel=1e-6)
    assert result["tip"] == pytest.approx(20 * 6.5)
    assert result["strain_limiting_layer"] == pytest.approx(20 * 40)


def test_it_meshes_coarsely():
    assert_meshes(TriangularPneuNet(chambers=2, length=30 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"chambers": 40, "wall": 5 * mm}, ("wall", "5 mm", "0.01 mm to 0.93 mm", "1.675 mm")),
        ({"wall": 10 * mm}, ("wall", "10 mm", "0.01 mm to 9.97 mm", "15 mm")),
        ({"gap": 13 * mm}, ("gap", "13 mm", "0.01 mm to 12.086 mm", 10, "110 mm")),
        ({"side_wall": 11 * mm}, ("side_wall", "11 mm", "0.01 mm to 9.995 mm", "20 mm")),
    ],
)
def test_an_impossible_dimension_is_refused(wrong, facts):
    with refused(*facts):
        TriangularPneuNet(**wrong)
