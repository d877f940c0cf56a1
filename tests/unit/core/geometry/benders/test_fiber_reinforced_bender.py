"""The CAD shape of a fiber-reinforced bender has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_cavity_between, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(
    ("radius", "wall", "base", "skin", "length", "end_wall"),
    [(8, 2, 2, 0, 160, 5), (8, 2, 2, 1, 160, 5), (3, 0.5, 1, 0.2, 20, 1), (15, 4, 0.5, 3, 200, 20)],
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(radius, wall, base, skin, length, end_wall, symmetric):
    bender = FiberReinforcedBender(
        radius=radius * mm, wall=wall * mm, base=base * mm, skin=skin * mm, length=length * mm,
        end_wall=end_wall * mm, symmetric=symmetric,
    )  # fmt: skip
    share, outer = (2 if symmetric else 1), radius + wall + skin
    void = pi * radius**2 / 2 * (length - 2 * end_wall)
    whole = (pi * outer**2 / 2 + 2 * outer * (base + skin)) * length
    assert_shape(
        bender,
        solid=(whole - void) / share,
        cavities={"cavity": void / share},
        regions={"body", "skin"} if skin else {"body"},
        faces=FACES | ({"winding"} if skin else set()) | ({"symmetry_y"} if symmetric else set()),
    )


def test_the_flat_side_and_the_winding_are_faces_of_their_own():
    bare = areas(FiberReinforcedBender(skin=0.0, length=50 * mm, clamp_length=10 * mm).build())
    assert bare["strain_limiting_layer"] == pytest.approx(10 * 50)
    assert bare["outside"] == pytest.approx((pi * 10 / 2 + 2) * 50)
    covered = areas(FiberReinforcedBender(length=50 * mm, clamp_length=10 * mm).build())
    assert covered["strain_limiting_layer"] == pytest.approx(10 * 60)
    assert covered["winding"] == pytest.approx((pi * 10 / 2 + 2) * 60)
    assert covered["outside"] == pytest.approx((pi * 11 / 2 + 3 + 11) * 50)


def test_the_cavity_is_where_the_walls_leave_it():
    assert_cavity_between(FiberReinforcedBender(base=3 * mm).build(), "cavity", (5, 0, 3), (155, 8, 11))


def test_it_meshes_coarsely():
    assert_meshes(FiberReinforcedBender(length=40 * mm), size=4 * mm)
    assert_meshes(FiberReinforcedBender(length=40 * mm, skin=0.0), size=4 * mm)


def test_what_cannot_be_is_said():
    with refused("base", "0 mm", "0.01 mm to 500 mm"):
        FiberReinforcedBender(base=0.0)
    with refused("skin", "-1 mm", "0 (none) or 0.01 mm to 500 mm"):
        FiberReinforcedBender(skin=-1 * mm)
