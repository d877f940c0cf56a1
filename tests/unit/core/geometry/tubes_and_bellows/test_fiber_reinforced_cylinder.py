"""The CAD shape of a fiber-reinforced cylinder has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "tip"}


@pytest.mark.parametrize(
    ("inner", "wall", "skin", "length", "cap"),
    [(6.35, 2, 0, 160, 5), (6.35, 2, 1, 160, 5), (2, 0.3, 0.1, 15, 3), (20, 3, 8, 200, 1)],
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(inner, wall, skin, length, cap, symmetric):
    tube = FiberReinforcedCylinder(
        inner_radius=inner * mm, wall=wall * mm, skin=skin * mm, length=length * mm, cap=cap * mm, symmetric=symmetric
    )
    share = 4 if symmetric else 1
    void = pi * inner**2 * (length - 2 * cap)
    assert_shape(
        tube,
        solid=(pi * (inner + wall + skin) ** 2 * length - void) / share,
        cavities={"cavity": void / share},
        regions={"body", "skin"} if skin else {"body"},
        faces=FACES | ({"winding"} if skin else set()) | ({"symmetry_y", "symmetry_z"} if symmetric else set()),
    )
    assert tube.smallest_wall == pytest.approx(min(wall, cap, skin or wall) * mm)


def test_areas_with_a_skin_and_a_block():
    tube = FiberReinforcedCylinder(skin=1 * mm, clamp_length=10 * mm, length=50 * mm, symmetric=False)
    assert areas(tube.build()) == pytest.approx(
        {
            "cavity": 2 * pi * 6.35 * 40 + 2 * pi * 6.35**2,
            "fixed": pi * 9.35**2 + 2 * pi * 9.35 * 10,
            "tip": pi * 9.35**2,
            "outside": 2 * pi * 9.35 * 50,
            "winding": 2 * pi * 8.35 * 60,
        }
    )


def test_it_meshes_coarsely():
    assert_meshes(FiberReinforcedCylinder(length=40 * mm), size=4 * mm)
    assert_meshes(FiberReinforcedCylinder(length=40 * mm, skin=1 * mm), size=4 * mm)


def test_what_cannot_be_is_said():
    with refused("skin", "0.001 mm", "0 (none) or 0.01 mm to 500 mm"):
        FiberReinforcedCylinder(skin=0.001 * mm)
