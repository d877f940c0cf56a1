"""The CAD shape of a bidirectional PneuNet has the volumes, faces and names that its dimensions say."""

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet
from turgor.units import mm

FACES = {"cavity_1", "cavity_2", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(
    ("chambers", "length", "height", "floor"), [(11, 110, 13.5, 1.5), (2, 30, 10, 1), (1, 20, 8, 2)]
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(chambers, length, height, floor, symmetric):
    actuator = BidirectionalPneuNet(
        chambers=chambers, length=length * mm, height=height * mm, floor=floor * mm, symmetric=symmetric
    )
    gaps, share = chambers - 1, 2 if symmetric else 1
    cavity = (length - 4 - 3 * gaps) * 16 * (height - floor - 2) + gaps * 3 * 3 * 2
    solid = length * 20 * floor + (length - gaps) * 20 * (height - floor) + gaps * 5 * 3 - cavity
    assert_shape(
        actuator, solid=2 * solid / share, cavities={"cavity_1": cavity / share, "cavity_2": cavity / share},
        regions={"body"}, faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )  # fmt: skip


def test_the_first_cavity_is_above_the_layer_and_the_second_below():
    faces = set(BidirectionalPneuNet(chambers=2, length=20 * mm).build().shape.faces)
    assert min(face.center[2] for face in faces if face.name == "cavity_1") == pytest.approx(1.5)
    assert max(face.center[2] for face in faces if face.name == "cavity_2") == pytest.approx(-1.5)
    assert [face.center[2] for face in faces if face.name == "strain_limiting_layer"] == pytest.approx([0.0])


def test_an_end_block_is_held_all_around():
    result = areas(BidirectionalPneuNet(chambers=2, length=20 * mm, clamp_length=5 * mm).build())
    assert result["fixed"] == pytest.approx(10 * 27 + 5 * (10 + 10 + 27))
    assert result["strain_limiting_layer"] == pytest.approx(10 * 25)


@pytest.mark.parametrize("options", [{}, {"clamp_length": 8 * mm, "inlet_diameter": 3 * mm}])
def test_it_meshes_coarsely(options):
    assert_meshes(BidirectionalPneuNet(chambers=2, length=20 * mm, **options), size=4 * mm)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"floor": 13.5 * mm}, ("floor", "13.5 mm", "0.01 mm to 13.48 mm")),
        ({"height": 0.5 * mm}, ("height", "0.5 mm", "1 mm to 2000 mm")),
        ({"gap": -1 * mm}, ("gap", "-1 mm", "0.01 mm to 10.967 mm", 11, "110 mm")),
        ({"inlet_diameter": 12 * mm}, ("inlet_diameter", "12 mm", "0 mm to 9.99 mm", "16 mm x 10 mm")),
    ],
)
def test_an_impossible_dimension_is_refused(wrong, facts):
    with refused(*facts):
        BidirectionalPneuNet(**wrong)
