"""V16: obstacles of different shapes with the same surface have the same effect; a spring carries the contact force.

Problem: a block of 10 × 10 × 5 mm under a plate, where the plate is a plane, the flat side of a box, the flat end of a
bar, or triangles; under the side of a bar, endless or with ends; under a ball, a box and triangles in a spring.
Exact: equality where the surface is the same one; the force of the spring is the force of the contact. Tolerance: 1e-6,
a thousand times that of Newton's method; 1e-4 with friction, whose limits are renewed until they change by no more than
that.
"""

import numpy as np
import pytest

import contact_cases
import problems
import turgor as tg
from problems import MM
from turgor.core.model.obstacles import Box, Cylinder, Plane, RigidSurface, Sphere

PRECISE = tg.Static(first_step=0.2, tolerance=1e-9)
DOWN = (0.0, 0.0, -0.8)
MIDDLE = (5 * MM, 5 * MM)


def _sheet(cells):
    """A square of triangles at z = 5 mm that looks down, 16 mm wide."""
    line = np.linspace(-3, 13, cells + 1) * MM
    x, y = np.meshgrid(line, line, indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 5 * MM)])
    number = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (n.ravel() for n in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    triangles = np.concatenate([np.column_stack([a, c, b]), np.column_stack([a, d, c])])
    return RigidSurface(points=points, triangles=triangles)


FLAT = {
    "box": Box(center=(*MIDDLE, 15 * MM), size=(30 * MM, 30 * MM, 20 * MM)),
    "round box": Box(center=(*MIDDLE, 15 * MM), size=(30 * MM, 30 * MM, 20 * MM), rounding=5 * MM),
    "end of a bar": Cylinder(center=(*MIDDLE, 15 * MM), axis=(0, 0, 1), radius=12 * MM, length=20 * MM),
    "two triangles": _sheet(1),
    "98 triangles": _sheet(7),
    "thin plate of triangles": contact_cases.slab(2),
    "thick plate of triangles": contact_cases.slab(40),
}


def _under(shape, counts=(3, 3, 2), **more):
    model = contact_cases.standing(contact_cases.block(counts), contact_cases.pushed(shape, DOWN, **more))
    return problems.solve(model, PRECISE).states[-1]


@pytest.fixture(scope="module")
def plane():
    return _under(Plane(point=(0, 0, 5 * MM), normal=(0, 0, -1)))


@pytest.mark.parametrize("name", FLAT)
def test_flat_side_is_a_plane(name, plane, record_verification):
    state = _under(FLAT[name])
    forces = [contact_cases.push(s.touches["plate"]) for s in (state, plane)]
    errors = [contact_cases.apart(state.displacement, plane.displacement), contact_cases.apart(*forces)]
    record_verification(
        claim=f"block under a flat side ({name}) against a plane: displacement and force, relative",
        source="V16, the same problem",
        expected=[0.0, 0.0],
        got=errors,
        tolerance="1e-6",
    )
    assert max(errors) < 1e-6
    assert forces[1][2] < -1


def test_bar_with_ends_far_away_is_endless(record_verification):
    ends = {"axis": (0, 1, 0), "center": (*MIDDLE, 9 * MM), "radius": 4 * MM}
    endless, long, short = (_under(Cylinder(**ends, length=length), (3, 6, 1)) for length in (None, 40 * MM, 4 * MM))
    error = contact_cases.apart(long.displacement, endless.displacement)
    record_verification(
        claim="block under a bar of 40 mm against an endless one: displacement, relative",
        source="V16, the same problem",
        expected=0.0,
        got=error,
        tolerance="1e-9",
    )
    assert error < 1e-9
    y = problems.current(short)[:, 1]
    pressed = np.linalg.norm(short.touches["plate"].force, axis=1) > 0
    push = [float(-contact_cases.push(s.touches["plate"])[2]) for s in (short, endless)]
    assert 0.2 < push[0] / push[1] < 0.8
    assert np.abs(y[pressed] - 5 * MM).max() < 4.5 * MM  # nothing touches far beyond its ends


SPRUNG = {
    "ball": Sphere(center=(4 * MM, 5.5 * MM, 12 * MM), radius=7 * MM),
    "box": Box(center=(4 * MM, 5 * MM, 15 * MM), size=(14 * MM, 14 * MM, 20 * MM), rounding=2 * MM),
    "triangles": contact_cases.slab(40),
}


@pytest.mark.parametrize("name", SPRUNG)
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_spring_carries_the_push(name, friction, record_verification):
    """What the spring is stretched by beyond its path, times its stiffness, is what the contact pushes with."""
    spring = 2e3
    state = _under(SPRUNG[name], spring=spring, friction=friction)
    touch = state.touches["plate"]
    pull = spring * (np.array(DOWN) * MM - touch.place)
    error = contact_cases.apart(pull, contact_cases.push(touch))
    record_verification(
        claim=f"block under a sprung obstacle ({name}), friction {friction:g}: spring against contact force, relative",
        source="V16, balance",
        expected=0.0,
        got=error,
        tolerance="1e-4" if friction else "1e-6",
    )
    tolerance = 1e-4 if friction else 1e-6
    assert error < tolerance
    assert -pull[2] > 0.1
    reaction = problems.reaction(state, "z0")
    assert contact_cases.apart(reaction, -contact_cases.push(touch)) < tolerance


def test_stiff_spring_is_no_spring(record_verification):
    held, sprung = _under(SPRUNG["ball"]), _under(SPRUNG["ball"], spring=1e9)
    error = contact_cases.apart(sprung.displacement, held.displacement)
    record_verification(
        claim="block under a ball in a spring of 1e9 N/m against a held ball: displacement, relative",
        source="V16, limit",
        expected=0.0,
        got=error,
        tolerance="1e-4",
    )
    assert error < 1e-4
