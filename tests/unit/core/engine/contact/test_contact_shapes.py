"""Signed distances of rigid shapes: exact values, and derivatives against finite differences."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from turgor.core.model.obstacles import Box, Cylinder, Plane, Sphere

SHAPES = {
    "plane": Plane(point=(0.1, -0.2, 0.3), normal=(1, 2, -2)),
    "sphere": Sphere(center=(0.1, 0.2, -0.3), radius=0.8),
    "endless cylinder": Cylinder(center=(0.1, 0.2, -0.3), axis=(1, -2, 0.5), radius=0.6),
    "cylinder": Cylinder(center=(0.1, 0.2, -0.3), axis=(1, -2, 0.5), radius=0.6, length=1.3),
    "sharp box": Box(center=(0.1, 0.2, -0.3), size=(1.0, 1.4, 0.8)),
    "box": Box(center=(0.1, 0.2, -0.3), size=(1.0, 1.4, 0.8), rounding=0.15),
    "round box": Box(center=(0.1, 0.2, -0.3), size=(1.0, 1.4, 0.8), rounding=0.4),
}

places = st.tuples(*[st.floats(-1.6, 1.6)] * 3).map(np.array)
any_shape = pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)


def at(shape, *place):
    distance, gradient, _ = shape.signed_distance(np.array([place], dtype=float))
    return float(distance[0]), gradient[0].tolist()


def test_plane():
    table = Plane(point=(5, 5, 2), normal=(0, 0, 3))
    assert at(table, 1, 1, 6) == (4.0, [0, 0, 1])
    assert at(table, 1, 1, 1.5) == (-0.5, [0, 0, 1])


def test_sphere():
    ball = Sphere(center=(1, 0, 0), radius=2)
    assert at(ball, 1, 5, 0) == (3.0, [0, 1, 0])
    assert at(ball, 1, 0, -1.5) == (-0.5, [0, 0, -1])


def test_endless_cylinder():
    bar = Cylinder(center=(0, 0, 7), axis=(0, 0, 2), radius=2)
    assert at(bar, 0, -5, 100) == (3.0, [0, -1, 0])
    assert at(bar, 1.5, 0, -100) == (-0.5, [1, 0, 0])


def test_cylinder_with_ends():
    bar = Cylinder(center=(0, 0, 1), axis=(0, 0, 1), radius=2, length=6)  # from z = -2 to 4
    assert at(bar, 0, -5, 3.9) == (3.0, [0, -1, 0])
    assert at(bar, 1, 0, 5) == (1.0, [0, 0, 1])
    assert at(bar, 5, 0, 8) == (5.0, [pytest.approx(0.6), 0, pytest.approx(0.8)])  # beside the rim: 3, 4, 5
    assert at(bar, 5, 0, -6) == (5.0, [pytest.approx(0.6), 0, pytest.approx(-0.8)])
    assert at(bar, 1.5, 0, 1) == (-0.5, [1, 0, 0])
    assert at(bar, 1.5, 0, -1.75) == (-0.25, [0, 0, -1])


def test_sharp_box():
    block = Box(center=(0, 0, 1), size=(4, 6, 8))
    assert at(block, 3, 1, 1) == (1.0, [1, 0, 0])
    assert at(block, -5, 7, 1) == (5.0, [pytest.approx(-0.6), pytest.approx(0.8), 0])
    assert at(block, 4, 4, -5) == (3.0, [pytest.approx(2 / 3), pytest.approx(1 / 3), pytest.approx(-2 / 3)])
    assert at(block, 1.75, 1, 1) == (-0.25, [1, 0, 0])
    assert at(block, 1, 1, -2.5) == (-0.5, [0, 0, -1])


def test_rounded_box_is_a_smaller_one_blown_up():
    block = Box(center=(0, 0, 0), size=(6, 8, 10), rounding=1.5)  # the inner box ends at 1.5, 2.5 and 3.5
    assert at(block, 3.5, 0, 0) == (0.5, [1, 0, 0])
    assert at(block, 4.5, 6.5, 0) == (3.5, [pytest.approx(0.6), pytest.approx(0.8), 0])
    distance, normal = at(block, 1.5 + 0.6, 2.5 + 0.8, 0)  # inside the round edge: radial all the same
    assert distance == pytest.approx(-0.5)
    assert normal == pytest.approx([0.6, 0.8, 0])
    assert at(block, 0, 2.0, 0) == (-2.0, [0, 1, 0])


@any_shape
@settings(max_examples=60, deadline=None)
@given(place=places)
def test_derivatives_are_those_of_the_distance(shape, place):
    step = 1e-5
    steps = np.concatenate([np.eye(3), -np.eye(3)]) * step
    around = [place + move for move in steps]
    distance, gradient, hessian = shape.signed_distance(np.array([*around, place]))
    # beside a kink, such as the middle of a body, the differences mean nothing
    assume(np.abs(hessian - hessian[-1]).max() < 0.01 and np.abs(gradient - gradient[-1]).max() < 100 * step)
    by_distance = (distance[:3] - distance[3:6]) / (2 * step)
    by_gradient = (gradient[:3] - gradient[3:6]) / (2 * step)
    assert gradient[-1] == pytest.approx(by_distance, abs=1e-7)
    assert hessian[-1] == pytest.approx(by_gradient, abs=1e-5)
    assert np.array_equal(hessian[-1], hessian[-1].T)
    assert np.linalg.norm(gradient[-1]) == pytest.approx(1, abs=1e-12)


@any_shape
@settings(max_examples=30, deadline=None)
@given(place=places)
def test_nearest_point_lies_on_the_surface(shape, place):
    distance, gradient, _ = shape.signed_distance(np.array([place]))
    nearest = place - distance[0] * gradient[0]
    assert shape.signed_distance(nearest[None])[0][0] == pytest.approx(0, abs=1e-12)


@any_shape
def test_there_is_a_direction_everywhere(shape):
    shape = replace(shape, **{"point" if isinstance(shape, Plane) else "center": (0, 0, 0)})
    axis = np.array(getattr(shape, "axis", (0.0, 0, 1)))
    corner = np.array(getattr(shape, "size", (1.0, 1, 1))) / 2
    tiny = [np.array([t, 0, -t]) for t in (0.0, 5e-324, 1e-310, 1e-200, 1e-30, 1e-14)]
    points = np.array([place + move for place in (0 * axis, 0.3 * axis, 5 * axis, corner) for move in tiny])
    distance, gradient, hessian = shape.signed_distance(points)
    assert np.isfinite(distance).all()
    assert np.isfinite(hessian).all()
    assert np.linalg.norm(gradient, axis=1) == pytest.approx(np.ones(len(points)), abs=1e-12)


def test_no_points():
    for shape in SHAPES.values():
        assert [part.shape for part in shape.signed_distance(np.zeros((0, 3)))] == [(0,), (0, 3), (0, 3, 3)]


@any_shape
@given(place=places, length=st.sampled_from([2.0**-10, 0.25, 8.0]))  # powers of two divide without rounding
def test_scaled_shape_measures_in_the_new_unit(shape, place, length):
    distance, gradient, hessian = shape.signed_distance(place[None])
    measured, direction, bend = shape.scaled(length).signed_distance(place[None] / length)
    assert measured * length == pytest.approx(distance, abs=1e-14)
    assert direction == pytest.approx(gradient, abs=1e-14)
    assert bend / length == pytest.approx(hessian, rel=1e-12)
