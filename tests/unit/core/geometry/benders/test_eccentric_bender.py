"""The CAD shape of an eccentric bender has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.eccentric_bender import EccentricBender
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "tip"}


@pytest.mark.parametrize(
    ("outer", "inner", "offset", "length", "end_wall"),
    [(8, 4.5, 1.5, 100, 5), (4, 3, 0.2, 30, 1), (20, 5, 14, 200, 20)],
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(outer, inner, offset, length, end_wall, symmetric):
    bender = EccentricBender(
        outer_radius=outer * mm, inner_radius=inner * mm, offset=offset * mm, length=length * mm,
        end_wall=end_wall * mm, symmetric=symmetric,
    )  # fmt: skip
    share = 2 if symmetric else 1
    void = pi * inner**2 * (length - 2 * end_wall)
    faces = FACES | ({"symmetry_y"} if symmetric else set())
    solid = (pi * outer**2 * length - void) / share
    assert_shape(bender, solid=solid, cavities={"cavity": void / share}, regions={"body"}, faces=faces)
    assert bender.smallest_wall == pytest.approx(min(outer - inner - offset, end_wall) * mm)


def test_the_chamber_lies_above_the_axis():
    result = EccentricBender(offset=2 * mm, inlet_diameter=2 * mm, clamp_length=5 * mm).build()
    heights = [face.center[2] for face in result.shape.faces if face.name == "cavity"]
    assert sum(heights) / len(heights) == pytest.approx(2.0)  # mm


def test_areas_of_the_default_half():
    assert areas(EccentricBender().build()) == pytest.approx(
        {
            "cavity": pi * 4.5 * 90 + pi * 4.5**2,
            "fixed": pi * 32,
            "tip": pi * 32,
            "outside": pi * 8 * 100,
            "symmetry_y": 16 * 100 - 9 * 90,
        }
    )


def test_the_cavity_is_where_the_walls_leave_it():
    assert_cavity_between(EccentricBender(symmetric=False).build(), "cavity", (5, -4.5, -3), (95, 4.5, 6))


def test_it_meshes_coarsely():
    assert_meshes(EccentricBender(length=40 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("inner_radius", 8e-3, ("inner_radius", "8 mm", "0.01 mm to 7.98 mm")),
        ("offset", 4e-3, ("offset", "4 mm", "0.01 mm to 3.49 mm")),
        ("offset", 0.0, ("offset", "0 mm", "0.01 mm to 3.49 mm")),
    ],
)  # fmt: skip
def test_what_cannot_be_is_said(field, value, facts):
    with refused(*facts):
        EccentricBender(**{field: value})
