"""The CAD shape of a semicircular bender has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(
    ("radius", "wall", "floor", "base", "length", "end_wall"),
    [(8, 2, 1.5, 1.5, 100, 5), (3, 0.5, 2, 0.4, 20, 1), (15, 6, 0.7, 5, 300, 40)],
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(radius, wall, floor, base, length, end_wall, symmetric):
    bender = SemicircularBender(
        radius=radius * mm, wall=wall * mm, floor=floor * mm, base=base * mm, length=length * mm,
        end_wall=end_wall * mm, symmetric=symmetric,
    )  # fmt: skip
    share, width = (2 if symmetric else 1), 2 * (radius + wall)
    void = pi * radius**2 / 2 * (length - 2 * end_wall)
    whole = (pi * (radius + wall) ** 2 / 2 + width * (floor + base)) * length
    faces = FACES | ({"symmetry_y"} if symmetric else set())
    assert_shape(
        bender, solid=(whole - void) / share, cavities={"cavity": void / share}, regions={"body", "base"}, faces=faces
    )
    assert bender.smallest_wall == min(wall, floor, base, end_wall) * mm


def test_areas_of_the_default_half():
    result = areas(SemicircularBender().build())
    section = pi * 100 / 4 + 10 * 3
    assert result == pytest.approx(
        {
            "cavity": (pi * 8 / 2 + 8) * 90 + 2 * pi * 64 / 4,
            "fixed": section,
            "tip": section,
            "strain_limiting_layer": 1000,
            "outside": (pi * 10 / 2 + 3 + 10) * 100,
            "symmetry_y": 13 * 100 - 8 * 90,
        }
    )


def test_a_block_is_held_on_all_of_its_outside():
    without, with_block = SemicircularBender(), SemicircularBender(clamp_length=12 * mm)
    section = pi * 100 / 4 + 10 * 3
    assert with_block.solid_volume - without.solid_volume == pytest.approx(section * 12 * mm**3)
    geometry = with_block.build()
    assert geometry.bounds[0][0] == pytest.approx(-12 * mm, rel=1e-6)
    result, plain = areas(geometry), areas(without.build())
    assert result["fixed"] == pytest.approx(section + (pi * 10 / 2 + 3 + 10) * 12)
    assert result["outside"] == pytest.approx(plain["outside"])
    assert result["strain_limiting_layer"] == pytest.approx(plain["strain_limiting_layer"] + 120)


def test_an_inlet_opens_at_the_fixed_end():
    for block in (0, 12):
        bender = SemicircularBender(inlet_diameter=3 * mm, clamp_length=block * mm)
        duct = pi * 1.5**2 / 2 * (5 + block)
        added = bender.cavity_volumes["cavity"] - SemicircularBender().cavity_volumes["cavity"]
        assert added == pytest.approx(duct * mm**3)
        assert areas(bender.build())["cavity"] == pytest.approx(
            (pi * 8 / 2 + 8) * 90 + 2 * pi * 64 / 4 - pi * 1.5**2 / 2 + pi * 1.5 * (5 + block)
        )


def test_the_cavity_is_where_the_walls_leave_it():
    assert_cavity_between(
        SemicircularBender(floor=1 * mm, end_wall=4 * mm).build(), "cavity", (4, 0, 2.5), (96, 8, 10.5)
    )


def test_it_meshes_coarsely():
    assert_meshes(SemicircularBender(length=40 * mm), size=4 * mm)
    assert_meshes(SemicircularBender(length=40 * mm, inlet_diameter=3 * mm, clamp_length=8 * mm), size=4 * mm)


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("radius", 0.0, ("radius", "0 mm", "0.01 mm to 500 mm")),
        ("wall", 2.0, ("wall", "2000 mm", "0.01 mm to 500 mm", "unit")),
        ("end_wall", 0.05, ("end_wall", "50 mm", "0.01 mm to 49.995 mm", "100 mm")),
        ("clamp_length", -1e-3, ("clamp_length", "-1 mm", "0 (none) or 0.01 mm to 2000 mm")),
        ("inlet_diameter", 7e-3, ("inlet_diameter", "7 mm", "0 (none) or 0.01 mm to 6.79 mm")),
        ("length", "100 mm", ("length", "'100 mm'", "meters")),
        ("symmetric", 1, ("symmetric", 1, "True or False")),
    ],
)
def test_what_cannot_be_is_said(field, value, facts):
    with refused(*facts):
        SemicircularBender(**{field: value})


def test_a_layer_with_a_thickness_is_a_region():
    bender = SemicircularBender(layer=0.5 * mm)
    assert_shape(
        bender,
        solid=SemicircularBender().solid_volume * 1e9 + 0.5 * 10 * 100,
        cavities={"cavity": pi * 8**2 / 4 * 90},
        regions={"body", "base", "strain_limiting_layer"},
        faces={"cavity", "fixed", "interface", "outside", "tip", "symmetry_y"},
    )
    with refused("layer", "11 mm", "0 (none) or 0.01 mm to 10 mm"):
        SemicircularBender(layer=11 * mm)
