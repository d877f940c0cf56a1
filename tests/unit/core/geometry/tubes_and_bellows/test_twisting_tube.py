"""The CAD shape of a twisting tube has the volumes, faces and names that its dimensions say, and no mirror plane."""

from math import pi

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.twisting_tube import TwistingTube
from turgor.units import mm


@pytest.mark.parametrize(("inner", "wall", "length", "cap"), [(6.35, 2, 160, 5), (2, 0.3, 15, 3), (20, 3, 200, 1)])
def test_volumes_computed_by_hand(inner, wall, length, cap):
    tube = TwistingTube(inner_radius=inner * mm, wall=wall * mm, length=length * mm, cap=cap * mm)
    void = pi * inner**2 * (length - 2 * cap)
    assert_shape(
        tube, solid=pi * (inner + wall) ** 2 * length - void, cavities={"cavity": void}, regions={"body"},
        faces={"cavity", "fixed", "outside", "tip"},
    )  # fmt: skip
    assert areas(tube.build())["outside"] == pytest.approx(2 * pi * (inner + wall) * length)


def test_it_meshes_coarsely():
    assert_meshes(TwistingTube(length=40 * mm), size=4 * mm)


def test_what_cannot_be_is_said():
    with refused("wall", "0 mm", "0.01 mm to 500 mm"):
        TwistingTube(wall=0.0)
