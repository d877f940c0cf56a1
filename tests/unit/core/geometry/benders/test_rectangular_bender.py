"""The CAD shape of a rectangular bender has the volumes, faces and names that its dimensions say."""

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(
    ("width", "height", "side_wall", "top_wall", "floor", "base", "length", "end_wall"),
    [(14, 12.5, 2, 2, 1.5, 1.5, 110, 5), (30, 5, 4, 1, 0.5, 0.6, 40, 3), (6, 25, 1, 3, 2, 5, 200, 1)],
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(width, height, side_wall, top_wall, floor, base, length, end_wall, symmetric):
    bender = RectangularBender(
        width=width * mm, height=height * mm, side_wall=side_wall * mm, top_wall=top_wall * mm, floor=floor * mm,
        base=base * mm, length=length * mm, end_wall=end_wall * mm, symmetric=symmetric,
    )  # fmt: skip
    share = 2 if symmetric else 1
    void = (width - 2 * side_wall) * (height - top_wall - floor - base) * (length - 2 * end_wall)
    faces = FACES | ({"symmetry_y"} if symmetric else set())
    assert_shape(
        bender, solid=(width * height * length - void) / share, cavities={"cavity": void / share},
        regions={"body", "base"}, faces=faces,
    )  # fmt: skip


def test_areas_of_the_default_whole():
    result = areas(RectangularBender(symmetric=False).build())
    assert result == pytest.approx(
        {
            "cavity": 2 * (10 * 7.5 + (10 + 7.5) * 100),
            "fixed": 14 * 12.5,
            "tip": 14 * 12.5,
            "strain_limiting_layer": 14 * 110,
            "outside": 2 * (14 + 12.5) * 110,
        }
    )


def test_the_cavity_is_where_the_walls_leave_it():
    assert_cavity_between(RectangularBender(base=1 * mm, top_wall=3 * mm).build(), "cavity", (5, 0, 2.5), (105, 5, 9.5))


def test_it_meshes_coarsely():
    assert_meshes(RectangularBender(length=40 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("width", 0.0, ("width", "0 mm", "1 mm to 1000 mm")),
        ("side_wall", 7e-3, ("side_wall", "7 mm", "0.01 mm to 6.995 mm", "14 mm")),
        ("base", 13e-3, ("base", "13 mm", "0 (none) or 0.01 mm to 12.47 mm", "12.5 mm")),
        ("floor", 11e-3, ("floor", "11 mm", "0.01 mm to 10.98 mm", "12.5 mm")),
        ("top_wall", 10e-3, ("top_wall", "10 mm", "0.01 mm to 9.49 mm", "12.5 mm")),
        ("inlet_diameter", 8e-3, ("inlet_diameter", "8 mm", "0 (none) or 0.01 mm to 7.5 mm")),
    ],
)  # fmt: skip
def test_what_cannot_be_is_said(field, value, facts):
    with refused(*facts):
        RectangularBender(**{field: value})
