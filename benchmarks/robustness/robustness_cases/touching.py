"""Contact: plates, balls, walls that bulge into each other, friction, a stopped tip."""

from collections.abc import Callable
from typing import Any

import numpy as np

import turgor as tg
from benchmarks.robustness.robustness_cases import checks
from benchmarks.robustness.robustness_cases.actuators import BENDER, ELASTOSIL, LEAP, PAPER
from benchmarks.robustness.robustness_cases.case import KPA, MM, RUBBER, Case, Found, one

import contact_meshes  # isort: skip  (found where robustness_cases.case says)
import meshes  # isort: skip
import problems  # isort: skip
from turgor.core.meshing.cells import HEXAHEDRON


def down(distance: float, across: float = 0.0) -> tuple[Any, ...]:
    """The path of an obstacle [mm]."""
    return ((0, (0, 0, 0)), (1, (across * MM, 0, -distance * MM)))


def carried(face: str) -> checks.Check:
    """What the obstacle pushes with, the support takes."""

    def check(solution: tg.Solution) -> Found:
        last = solution.states[-1]
        push = np.asarray(last.touches["plate"].force.sum(axis=0))
        held = problems.reaction(last, face)
        off = float(np.linalg.norm(push + held) / np.linalg.norm(push))
        return Found(off < 1e-4, f"plate pushes with {abs(push[2]):.4g} N, the support with {off:.0e} less")

    return check


def under(shape: Any, path: Any, friction: float = 0.0, size=(10, 10, 5), counts=(3, 3, 2)) -> Callable[[], tg.Model]:
    """A clamped block under an obstacle that is pressed into it."""

    def model() -> tg.Model:
        mesh = meshes.box(tuple(np.array(size) * MM), counts, kind=HEXAHEDRON)
        plate = tg.obstacles.Obstacle(name="plate", shape=shape, path=path, friction=friction)
        contact = tg.Contact(self_contact=False, obstacles=[plate])
        return one(mesh, RUBBER, [], [tg.Fixed("z0")], contact=contact)

    return model


def ball(depth: float) -> Callable[[], tg.Model]:
    """An eighth of a ball of 10 mm that a plate is pressed into."""

    def model() -> tg.Model:
        mesh = contact_meshes.ball(10 * MM, (3, 2, 2))
        shape = tg.obstacles.Plane(point=(0, 0, 10 * MM), normal=(0, 0, -1))
        contact = tg.Contact(
            self_contact=False, obstacles=[tg.obstacles.Obstacle(name="plate", shape=shape, path=down(depth))]
        )
        return one(mesh, RUBBER, [], [tg.supports.Symmetry("middle")], contact=contact)

    return model


def gap(first: float, second: float, along: int = 8) -> Callable[[], tg.Model]:
    """Two walls of 1.5 mm that bulge into the gap of 1 mm between them."""

    def model() -> tg.Model:
        mesh = contact_meshes.gap_cell(2, along=along)
        loads = [tg.Pressure(f"cavity_{k}", p * KPA) for k, p in ((1, first), (2, second)) if p]
        supports = [tg.Fixed("rim"), tg.Fixed("y0", "y"), tg.Fixed("y1", "y")]
        return one(mesh, RUBBER, loads, supports, contact=tg.Contact(self_contact=True))

    return model


def blocked() -> tg.Model:
    """Three chambers of the demo with paper, whose tip meets a plate 1 mm below it."""
    mesh = tg.mesh(tg.FastPneuNet(chambers=3, length=30 * MM, wall=1 * MM, gap=1 * MM).build(), size=2.4 * MM)
    materials = dict.fromkeys(mesh.regions, ELASTOSIL) | {"strain_limiting_layer": PAPER}
    free = tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 15 * KPA)])
    return tg.setups.blocked_force(free, distance=1 * MM)


def against(shape: Any, pressure: float) -> Callable[[], tg.Model]:
    """A bender with paper that bends onto an obstacle below it."""

    def model() -> tg.Model:
        mesh = tg.mesh(BENDER.build(), size=6 * MM)
        materials = dict.fromkeys(mesh.regions, ELASTOSIL) | {"strain_limiting_layer": PAPER}
        contact = tg.Contact(self_contact=False, obstacles=[tg.obstacles.Obstacle(name="plate", shape=shape)])
        loads = [tg.Pressure("cavity", pressure * KPA)]
        return tg.Model(mesh, materials, [tg.Fixed("fixed")], loads, contact=contact)

    return model


TOP = tg.obstacles.Plane(point=(0, 0, 5 * MM), normal=(0, 0, -1))
BALL = tg.obstacles.Sphere(center=(5 * MM, 5 * MM, 9 * MM), radius=4 * MM)
FLOOR = tg.obstacles.Plane(point=(0, 0, -3 * MM), normal=(0, 0, 1))
ROD = tg.obstacles.Cylinder(center=(35 * MM, 0, -8 * MM), axis=(0, 1, 0), radius=5 * MM)
HELD = checks.both(carried("z0"), checks.not_through)

CASES = (
    Case(name="plate pressed 40 % into a block, one step", hard="first_step = 1", procedure=LEAP,
         model=under(TOP, down(2)), check=checks.both(HELD, checks.small_steps(20))),
    Case(name="plate that sticks, 40 %",
         hard="friction 1, corners roll over", model=under(TOP, down(2), 1.0), check=HELD),
    Case(name="plate that drags", hard="friction 0.5, 1 mm down, 4 mm sideways", check=HELD,
         model=under(TOP, ((0, (0, 0, 0)), (0.3, (0, 0, -1 * MM)), (1, (4 * MM, 0, -1 * MM))), 0.5)),
    Case(name="ball pressed into a coarse block", hard="as deep as its radius, 9 cells below it",
         model=under(BALL, down(2.5)), check=HELD),
    Case(name="ball under a plate", hard="flattened by 40 % of its radius", model=ball(4.0), check=checks.not_through),
    Case(name="walls meet in a gap", hard="five times the pressure at which they meet", model=gap(100, 100),
         check=checks.both(checks.not_through, checks.small_steps(20))),
    Case(name="walls meet, one pressed", hard="one wall pushes the other", model=gap(120, 0),
         check=checks.both(checks.not_through, checks.small_steps(20))),
    Case(name="walls meet, one step", hard="first_step = 1", model=gap(100, 100), procedure=LEAP,
         check=checks.both(checks.not_through, checks.small_steps(20))),
    Case(name="bender on a floor",
         hard="lies down along its length", model=against(FLOOR, 60), check=checks.not_through),
    Case(name="bender round a rod", hard="slides around it", model=against(ROD, 80), check=checks.not_through),
    Case(name="bender held by a plate", hard="tip stopped from the start",
         model=lambda: tg.setups.blocked_force(
             tg.Model(mesh := tg.mesh(BENDER.build(), size=6 * MM),
                      dict.fromkeys(mesh.regions, ELASTOSIL) | {"strain_limiting_layer": PAPER},
                      [tg.Fixed("fixed")], [tg.Pressure("cavity", 50 * KPA)])),
         check=checks.not_through),
    Case(name="blocked finger with paper", hard="tip stopped while three walls meet", model=blocked,
         check=checks.not_through),
)  # fmt: skip
