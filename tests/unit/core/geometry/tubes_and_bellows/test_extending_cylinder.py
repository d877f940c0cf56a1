"""The CAD shape of an extending cylinder has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "tip"}


@pytest.mark.parametrize(("inner", "wall", "length", "cap"), [(6.35, 2, 100, 5), (2, 0.3, 15, 3), (20, 30, 200, 1)])
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(inner, wall, length, cap, symmetric):
    tube = ExtendingCylinder(
        inner_radius=inner * mm, wall=wall * mm, length=length * mm, cap=cap * mm, symmetric=symmetric
    )
    share = 4 if symmetric else 1
    void = pi * inner**2 * (length - 2 * cap)
    faces = FACES | ({"symmetry_y", "symmetry_z"} if symmetric else set())
    solid = (pi * (inner + wall) ** 2 * length - void) / share
    assert_shape(tube, solid=solid, cavities={"cavity": void / share}, regions={"body"}, faces=faces)
    assert tube.smallest_wall == min(wall, cap) * mm


def test_areas_of_the_default_quarter():
    plane = 8.35 * 100 - 6.35 * 90
    assert areas(ExtendingCylinder().build()) == pytest.approx(
        {
            "cavity": (2 * pi * 6.35 * 90 + 2 * pi * 6.35**2) / 4,
            "fixed": pi * 8.35**2 / 4,
            "tip": pi * 8.35**2 / 4,
            "outside": pi * 8.35 / 2 * 100,
            "symmetry_y": plane,
            "symmetry_z": plane,
        }
    )


def test_block_and_inlet():
    tube = ExtendingCylinder(clamp_length=10 * mm, inlet_diameter=4 * mm, symmetric=False)
    duct = pi * 4 * 15
    assert tube.cavity_volumes["cavity"] * 1e9 == pytest.approx(pi * 6.35**2 * 90 + duct)
    assert tube.solid_volume * 1e9 == pytest.approx(pi * 8.35**2 * 110 - pi * 6.35**2 * 90 - duct)
    assert areas(tube.build())["fixed"] == pytest.approx(pi * 8.35**2 - pi * 4 + 2 * pi * 8.35 * 10)


def test_the_cavity_is_where_the_walls_leave_it():
    assert_cavity_between(ExtendingCylinder().build(), "cavity", (5, 0, 0), (95, 6.35, 6.35))


def test_it_meshes_coarsely():
    assert_meshes(ExtendingCylinder(length=40 * mm), size=4 * mm)
    assert_meshes(ExtendingCylinder(length=40 * mm, symmetric=False, inlet_diameter=4 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("inner_radius", -1e-3, ("inner_radius", "-1 mm", "0.01 mm to 500 mm")),
        ("cap", 50e-3, ("cap", "50 mm", "0.01 mm to 49.995 mm", "100 mm")),
        ("inlet_diameter", 13e-3, ("inlet_diameter", "13 mm", "0 (none) or 0.01 mm to 12.7 mm")),
        ("length", 100.0, ("length", "100000 mm", "1 mm to 2000 mm", "unit")),
    ],
)
def test_what_cannot_be_is_said(field, value, facts):
    with refused(*facts):
        ExtendingCylinder(**{field: value})
