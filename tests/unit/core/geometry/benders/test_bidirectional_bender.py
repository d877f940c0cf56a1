"""The CAD shape of a bidirectional bender has the volumes, faces and names that its dimensions say."""

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.bidirectional_bender import BidirectionalBender
from turgor.units import mm

FACES = {"cavity_1", "cavity_2", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(
    ("width", "height", "side_wall", "outer_wall", "middle_wall", "length", "end_wall"),
    [(14, 20, 2, 2, 3, 110, 5), (30, 9, 4, 1, 0.5, 40, 3), (6, 25, 1, 3, 6, 200, 1)],
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(width, height, side_wall, outer_wall, middle_wall, length, end_wall, symmetric):
    bender = BidirectionalBender(
        width=width * mm, height=height * mm, side_wall=side_wall * mm, outer_wall=outer_wall * mm,
        middle_wall=middle_wall * mm, length=length * mm, end_wall=end_wall * mm, symmetric=symmetric,
    )  # fmt: skip
    share = 2 if symmetric else 1
    void = (width - 2 * side_wall) * ((height - middle_wall) / 2 - outer_wall) * (length - 2 * end_wall) / share
    assert_shape(
        bender,
        solid=width * height * length / share - 2 * void,
        cavities={"cavity_1": void, "cavity_2": void},
        regions={"body"},
        faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )


def test_the_first_cavity_lies_above():
    built = BidirectionalBender(middle_wall=4 * mm).build()
    assert_cavity_between(built, "cavity_1", (5, 0, 2), (105, 5, 8))
    assert_cavity_between(built, "cavity_2", (5, 0, -8), (105, 5, -2))


def test_areas_of_the_default_whole():
    chamber = 2 * (10 * 6.5 + (10 + 6.5) * 100)
    assert areas(BidirectionalBender(symmetric=False).build()) == pytest.approx(
        {
            "cavity_1": chamber,
            "cavity_2": chamber,
            "fixed": 14 * 20,
            "tip": 14 * 20,
            "strain_limiting_layer": 14 * 110,
            "outside": 2 * (14 + 20) * 110,
        }
    )


def test_each_cavity_has_its_inlet():
    plain, bender = BidirectionalBender(), BidirectionalBender(inlet_diameter=3 * mm, clamp_length=10 * mm)
    for name in ("cavity_1", "cavity_2"):
        added = bender.cavity_volumes[name] - plain.cavity_volumes[name]
        assert added * 1e9 == pytest.approx(3.141592653589793 * 1.5**2 * 15 / 2)
    bender.build()


def test_it_meshes_coarsely():
    assert_meshes(BidirectionalBender(length=40 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("outer_wall", 10e-3, ("outer_wall", "10 mm", "0.01 mm to 9.98 mm", "20 mm")),
        ("middle_wall", 16e-3, ("middle_wall", "16 mm", "0.02 mm to 15.98 mm", "20 mm")),
        ("side_wall", 7e-3, ("side_wall", "7 mm", "0.01 mm to 6.995 mm", "14 mm")),
    ],
)  # fmt: skip
def test_what_cannot_be_is_said(field, value, facts):
    with refused(*facts):
        BidirectionalBender(**{field: value})
