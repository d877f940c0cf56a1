"""A belt slides around a drum in long steps: it does not lift off along its tangent.

Problem: a belt of 22 cells lies on a quarter of a fixed drum, µ = 0.3, is pulled tight by 0.1 N at one end, and slides
as its other end is moved. Exact: the ratio of the tensions is exp(µ π/2) once all of it slides (Euler, Eytelwein).
Tolerance: 2 % at the beginning of sliding; later the belt, curved at rest, is bent straight, which takes a force too.

The belt is pressed in by 4 nm. A step along the tangent of the path lifts it off by more than that once it is longer
than 13 µm, a quarter of a percent of the load; the parabola of the last two tangents follows the drum (predictor).
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Cylinder, Obstacle
from turgor.units import MPa, N, mm

DRUM, THICK, WIDE, FREE, SLIDES = 20 * mm, 1 * mm, 5 * mm, 20 * mm, 5 * mm
QUARTER, FRICTION, TIGHT = np.pi / 2, 0.3, 0.1 * N


def _around(at):
    """A strip that comes straight, lies on a quarter of the drum, and leaves straight."""
    length = DRUM * QUARTER
    along, radius = (length + 2 * FREE) * at[:, 0] - FREE, DRUM + THICK * at[:, 2] + 1e-3 * mm
    angle = np.clip(along / DRUM, 0, QUARTER)
    beyond = np.where(along < 0, along, np.where(along > length, along - length, 0))
    x, z = radius * np.sin(angle) + beyond * np.cos(angle), radius * np.cos(angle) - beyond * np.sin(angle)
    return np.column_stack([x, WIDE * at[:, 1], z])


def _moved(points, load_factor):
    return np.tile([-SLIDES * max(0.0, (load_factor - 0.2) / 0.8), 0.0, 0.0], (len(points), 1))


def test_belt_slides_in_long_steps(record_verification):
    mesh = meshes.box((1, 1, 1), (22, 1, 1), _around, kind=HEXAHEDRON)
    drum = Cylinder(center=(0, 0, 0), axis=(0, 1, 0), radius=DRUM)
    contact = Contact(obstacles=[Obstacle(name="drum", shape=drum, friction=FRICTION, face="z0")])
    supports = [tg.Displacement("x0", _moved), tg.Fixed("y0", "y"), tg.Fixed("y1", "y")]
    pull = tg.Traction("x1", (0, 0, -TIGHT / (WIDE * THICK)), history=[(0, 0), (0.2, 1), (1, 1)])
    material = problems.rubber(tg.laws.NeoHooke(C10=2 * MPa))
    model = tg.Model(mesh, {"body": material}, supports, [pull], contact=contact)
    solution = problems.solve(model, stop=lambda state: "far enough" if state.load_factor > 0.35 else None, throw=False)
    (sliding,) = [state for state in solution.states if state.load_factor > 0.25][:1]
    got = -float(problems.reaction(sliding, "x0")[0]) / TIGHT
    record_verification(
        claim="belt that slides around a quarter of a drum, µ = 0.3: ratio of the tensions",
        source="exp(µ π/2), exact",
        expected=float(np.exp(FRICTION * QUARTER)),
        got=got,
        tolerance="2 %",
    )
    assert got == pytest.approx(np.exp(FRICTION * QUARTER), rel=0.02)
    assert solution.states[-1].load_factor - solution.states[-2].load_factor > 0.01
    assert solution.iterations < 260
