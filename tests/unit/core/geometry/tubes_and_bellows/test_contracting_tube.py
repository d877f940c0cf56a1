"""The CAD shape of a contracting tube has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.contracting_tube import ContractingTube
from turgor.units import mm

FACES = {"cavity", "fixed", "interface", "outside", "tip"}


@pytest.mark.parametrize(("inner", "wall", "length", "cap"), [(5, 1, 100, 6), (2, 0.3, 15, 3), (20, 3, 200, 1)])
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(inner, wall, length, cap, symmetric):
    tube = ContractingTube(
        inner_radius=inner * mm, wall=wall * mm, length=length * mm, cap=cap * mm, symmetric=symmetric
    )
    share = 4 if symmetric else 1
    void = pi * inner**2 * (length - 2 * cap)
    faces = FACES | ({"symmetry_y", "symmetry_z"} if symmetric else set())
    solid = (pi * (inner + wall) ** 2 * length - void) / share
    assert_shape(tube, solid=solid, cavities={"cavity": void / share}, regions={"body", "cap"}, faces=faces)
    ends = [solid.mass for solid in tube.build().shape.solids if solid.name == "cap"]
    assert ends == pytest.approx([pi * (inner + wall) ** 2 * cap / share] * 2)


def test_areas_of_the_default_whole():
    ring = pi * (6**2 - 5**2)
    assert areas(ContractingTube(symmetric=False, clamp_length=4 * mm).build()) == pytest.approx(
        {
            "cavity": 2 * pi * 5 * 88 + 2 * pi * 5**2,
            "interface": 2 * ring,
            "fixed": pi * 36 + 2 * pi * 6 * 4,
            "tip": pi * 36,
            "outside": 2 * pi * 6 * 100,
        }
    )


def test_the_cavity_is_where_the_walls_leave_it():
    assert_cavity_between(ContractingTube().build(), "cavity", (6, 0, 0), (94, 5, 5))


def test_it_meshes_coarsely():
    assert_meshes(ContractingTube(length=40 * mm), size=3 * mm)


def test_what_cannot_be_is_said():
    with refused("cap", "0 mm", "0.01 mm to 49.995 mm", "100 mm"):
        ContractingTube(cap=0.0)
