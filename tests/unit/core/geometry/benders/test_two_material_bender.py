"""The CAD shape of a two-material bender has the volumes, faces and names that its dimensions say."""

from math import acos, pi, sqrt

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.two_material_bender import TwoMaterialBender
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


def segment(radius: float, height: float) -> float:
    """Area of a disc below a line at a height above its lowest point."""
    return radius**2 * acos(1 - height / radius) - (radius - height) * sqrt(2 * radius * height - height**2)


@pytest.mark.parametrize(
    ("inner", "wall", "base_height", "length", "end_wall"),
    [(6.35, 2, 8.35, 100, 5), (3, 1, 0.6, 30, 1), (10, 5, 22, 200, 20), (10, 5, 28, 200, 20)],
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(inner, wall, base_height, length, end_wall, symmetric):
    bender = TwoMaterialBender(
        inner_radius=inner * mm, wall=wall * mm, base_height=base_height * mm, length=length * mm,
        end_wall=end_wall * mm, symmetric=symmetric,
    )  # fmt: skip
    share = 2 if symmetric else 1
    void = pi * inner**2 * (length - 2 * end_wall)
    faces = FACES | ({"symmetry_y"} if symmetric else set())
    assert_shape(
        bender, solid=(pi * (inner + wall) ** 2 * length - void) / share, cavities={"cavity": void / share},
        regions={"body", "base"}, faces=faces,
    )  # fmt: skip
    in_void = min(max(base_height - wall, 0.0), 2 * inner)
    base = segment(inner + wall, base_height) * length - segment(inner, in_void) * (length - 2 * end_wall)
    volumes = [solid.mass for solid in bender.build().shape.solids if solid.name == "base"]
    assert sum(volumes) == pytest.approx(base / share, rel=1e-9)


def test_areas_of_the_default_whole():
    assert areas(TwoMaterialBender(symmetric=False).build()) == pytest.approx(
        {
            "cavity": 2 * pi * 6.35 * 90 + 2 * pi * 6.35**2,
            "fixed": pi * 8.35**2,
            "tip": pi * 8.35**2,
            "strain_limiting_layer": 2 * 8.35 * 100 - 2 * 6.35 * 90,
            "outside": 2 * pi * 8.35 * 100,
        }
    )


def test_the_cavity_is_where_the_walls_leave_it():
    assert_cavity_between(TwoMaterialBender().build(), "cavity", (5, 0, -6.35), (95, 6.35, 6.35))


def test_it_meshes_coarsely():
    assert_meshes(TwoMaterialBender(length=40 * mm), size=4 * mm)
    assert_meshes(TwoMaterialBender(length=40 * mm, inlet_diameter=3 * mm, clamp_length=5 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("wall", 0.0, ("wall", "0 mm", "0.01 mm to 500 mm")),
        ("base_height", 17e-3, ("base_height", "17 mm", "0.01 mm to 16.69 mm", "16.7 mm")),
    ],
)  # fmt: skip
def test_what_cannot_be_is_said(field, value, facts):
    with refused(*facts):
        TwoMaterialBender(**{field: value})
