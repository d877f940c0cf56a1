"""An obstacle that a mirror plane cuts turns about the normal of this plane, or it is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from refused import refused
from turgor.core.model.checks.symmetry import check_turning
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Box, Cylinder, Obstacle, Plane, Sphere
from turgor.units import deg, mm

#: A half model, cut by y = 0.
HALF = SimpleNamespace(points=np.array([[0, 0, 0], [40, 8, 10]]) * mm, mirror_planes=((1, 0.0),))
ROLLER = Cylinder(center=(24 * mm, 0, -8.5 * mm), axis=(0, 1, 0), radius=8 * mm)
AWAY = Sphere(center=(0, 5 * mm, 0), radius=2 * mm)


def turned(shape, axis, **more):
    return Contact(obstacles=[Obstacle(name="knob", shape=shape, rotation=[(0, (0, 0, 0)), (1, axis)], **more)])


@pytest.mark.parametrize(
    ("shape", "more"),
    [
        (ROLLER, {}),
        (Plane(point=(0, 0, 0), normal=(0, 0, 1)), {}),
        (AWAY, {"path": [(0, (0, 0, 0)), (0.5, (0, -4 * mm, 0)), (1, (0, 0, 0))]}),
        (AWAY, {"about": (0, 0, 0)}),
    ],
)
def test_a_cut_obstacle_that_turns_about_another_axis_is_refused(shape, more) -> None:
    with refused("'knob'", "about x", "y = 0 mm", "none"):
        check_turning(HALF, turned(shape, (180 * deg, 0, 0), **more))


@pytest.mark.parametrize(
    ("shape", "axis"),
    [
        (ROLLER, (0, 90 * deg, 0)),
        (AWAY, (90 * deg, 0, 90 * deg)),  # it has an image of its own
        (Box(center=(0, 2 * mm, 0), size=(1 * mm, 4 * mm, 1 * mm)), (0, 30 * deg, 0)),
    ],
)
def test_what_stays_its_own_image_or_has_one_may_turn(shape, axis) -> None:
    check_turning(HALF, turned(shape, axis))


def test_load_factors_that_do_not_rise_are_named_without_the_angles() -> None:
    with refused("rotation", "0, 0.7, 0.5", "rise"):
        Obstacle(name="knob", shape=AWAY, rotation=[(at, (0, 1, 0)) for at in (0, 0.7, 0.5)])
