"""Beams, columns, arches, plates and blocks: large rotations, buckling, snapping, squeezing."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.special import ellipk

import turgor as tg
from benchmarks.robustness.robustness_cases import checks
from benchmarks.robustness.robustness_cases.case import MM, OPTIONS, RUBBER, Case, Check, Found, one
from turgor.core.materials.laws.homogeneous import nominal_stress, uniaxial

import meshes  # isort: skip  (found where robustness_cases.case says)
import problems  # isort: skip
from turgor.core.meshing.cells import HEXAHEDRON

YOUNG = 3 * RUBBER.law.shear_modulus
LENGTH, SIDE = 100 * MM, 1 * MM
#: Stiffness in bending of the beam, and its Euler load clamped at one end [N].
BENDING = YOUNG * SIDE**4 / 12
EULER = np.pi**2 * BENDING / (4 * LENGTH**2)
LEAP = tg.Static(first_step=1.0, max_step=1.0)

#: Elastica of a cantilever under a transverse force of 10 EI / L² (Mattiasson 1981): deflection over length.
DEFLECTION_AT_10 = 0.81061


def beam(force: tuple[float, float, float], bow: float = 0.0, cells: int = 30) -> Callable[[], tg.Model]:
    """A slender cantilever along x with a dead force [N] at its tip, bowed as it would buckle."""

    def place(points: np.ndarray) -> np.ndarray:
        return points + np.outer(bow * (1 - np.cos(np.pi * points[:, 0] / (2 * LENGTH))), [0, 0, 1])

    def model() -> tg.Model:
        mesh = meshes.box((LENGTH, SIDE, SIDE), (cells, 1, 1), place, kind=HEXAHEDRON)
        vector = tuple(np.array(force) / SIDE**2)
        return one(mesh, RUBBER, [tg.Traction("x1", vector)], [tg.Fixed("x0")])

    return model


def sag(state: tg.solutions.State) -> float:
    """Deflection of the tip over the length."""
    return float(abs(state.displacement[state.model.mesh.face_nodes("x1"), 2].mean()) / LENGTH)


def elastica(tip_angle: float) -> tuple[float, float]:
    """Force over Euler's and deflection over length of a buckled column, from the angle of its tip."""
    m = np.sin(tip_angle / 2) ** 2
    return float((2 * ellipk(m) / np.pi) ** 2), float(2 * np.sqrt(m) / ellipk(m))


RATIO, BUCKLED = elastica(np.deg2rad(100))


def loses_stability(solution: tg.Solution) -> Found:
    """Stable below Euler's load, unstable above, and said so."""
    force = 1.5 * EULER
    wrong = [
        s for s in solution.states[1:] if abs(p := s.load_factor * force / EULER - 1) > 0.03
        and bool(s.unstable_modes) != (p > 0)
    ]  # fmt: skip
    said = "unstable" in solution.message
    return Found(not wrong and said, f"{len(wrong)} states with the wrong stability, unstable said: {said}")


def rotated(angle: float) -> Callable[[np.ndarray, float], np.ndarray]:
    """Turn about the axis of a bar of section 10 × 10 mm along x."""

    def moved(points: np.ndarray, load_factor: float) -> np.ndarray:
        center = np.array([0, 5 * MM, 5 * MM])
        return (points - center) @ problems.rotation((1, 0, 0), angle * load_factor).T + center - points

    return moved


def bar(*supports: Any, counts=(4, 2, 2), size=(20, 10, 10), law: Any = RUBBER, loads=()) -> Callable[[], tg.Model]:
    """A block from the origin, held and moved by supports alone."""
    return lambda: one(meshes.box(tuple(np.array(size) * MM), counts), law, loads, supports)


def along(distance: float, axis: int) -> Callable[[np.ndarray, float], np.ndarray]:
    """Move along an axis [m]."""
    return lambda points, factor: np.tile(np.eye(3)[axis] * distance * factor, (len(points), 1))


def stretched(stretch: float, name: str, hard: str) -> Case:
    """A free block pulled or pushed between smooth plates, in one step, against the closed form."""
    held = (tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z"))
    expected = float(nominal_stress(RUBBER.law, uniaxial(stretch))[0, 0]) * 1e-4
    model = bar(*held, tg.Displacement("x1", along(20 * MM * (stretch - 1), 0), "x"))
    check = checks.at_end("force", lambda state: float(problems.reaction(state, "x1")[0]), expected, 1e-4, " N")
    return Case(name=name, hard=hard, model=model, procedure=LEAP, check=check)


def no_energy(solution: tg.Solution) -> Found:
    """A rigid rotation stores nothing."""
    stress = float(np.abs(problems.fields(solution.states[-1]).cauchy).max())
    return Found(stress < 1e-3 * YOUNG, f"largest stress {stress / YOUNG:.0e} of Young's modulus")


#: Span, rise and thickness of the arch, and the force per depth that it is asked to carry [mm, N].
SPAN, RISE, THICK, PUSH = 60.0, 6.0, 1.0, 0.0018
CROWN = (0, 0, (RISE + THICK / 2) * MM)


def arch(driven: bool = False) -> tg.Model:
    """Half of a shallow clamped arch: a dead force at its crown, or its crown moved down by twice its rise."""

    def place(points: np.ndarray) -> np.ndarray:
        return points + np.outer(RISE * MM * 0.5 * (1 + np.cos(2 * np.pi * points[:, 0] / (SPAN * MM))), [0, 0, 1])

    mesh = meshes.box((SPAN / 2 * MM, 2 * MM, THICK * MM), (12, 1, 1), place, kind=HEXAHEDRON)
    names = {"x0": "symmetry_x", "y0": "symmetry_y"}
    faces = {names.get(name, name): sides for name, sides in mesh.faces.items()}
    faces["crown"] = meshes.single_node(meshes.node_at(mesh, CROWN), 9)
    mesh = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    supports: list[Any] = [tg.Fixed("x1")]
    if driven:
        supports.append(tg.Displacement("crown", along(-2.4 * RISE * MM, 2), "z"))
        return one(mesh, RUBBER, [], supports)
    return one(mesh, RUBBER, [tg.Traction("symmetry_x", (0, 0, -PUSH / (2 * THICK * MM**2)))], supports)


def pushed_through() -> tuple[np.ndarray, np.ndarray]:
    """Displacement and force at the crown, as its displacement is prescribed in small steps."""
    slow = tg.Static(first_step=0.005, max_step=0.005)
    plain = replace(OPTIONS, iteration="plain")
    states = tg.solve(arch(driven=True), slow, options=plain).states
    down = np.array([2.4 * RISE * MM * state.load_factor for state in states])
    return down, np.array([-float(problems.reaction(state, "crown")[2]) for state in states])


def crown(state: tg.solutions.State) -> float:
    """How far the crown has moved down [m]."""
    return float(-state.displacement[meshes.node_at(state.model.mesh, CROWN), 2])


def as_driven(tolerance: float = 0.05) -> Check:
    """All states on the curve of the arch whose crown is moved; a jump, where steps go past its top, is said."""

    def check(solution: tg.Solution) -> Found:
        down, force = pushed_through()
        top = float(force[: len(force) // 2].max())
        there = [np.interp(crown(state), down, force) for state in solution.states]
        off = max(abs(f - PUSH * state.load_factor) / top for f, state in zip(there, solution.states, strict=True))
        said = not solution.converged or isinstance(solution.procedure, tg.ArcLength) or "jumped" in solution.message
        last = crown(solution.states[-1]) / MM
        text = f"forces {off:.1e} of the top, {top * 1e3:.4g} mN, off those of a driven crown; last {last:.3g} mm"
        return Found(off <= tolerance and said, text + ("" if said else "; the jump is not said"))

    return check


def plate(thickness: float, pressure: float, kind=HEXAHEDRON) -> Callable[[], tg.Model]:
    """A quarter of a clamped square plate of 40 mm under pressure from below."""

    def model() -> tg.Model:
        mesh = meshes.box((20 * MM, 20 * MM, thickness), (6, 6, 1), kind=kind)
        names = {"x0": "symmetry_x", "y0": "symmetry_y", "z0": "below"}
        faces = {names.get(name, name): sides for name, sides in mesh.faces.items()}
        mesh = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
        return one(mesh, RUBBER, [tg.Pressure("below", pressure)], [tg.Fixed("x1"), tg.Fixed("y1")])

    return model


CRUSHED = (tg.Fixed("x0"), tg.Displacement("x1", along(-10 * MM, 0)))

CASES = (
    Case(
        name="cantilever bent by 80 % of its length, one step",
        hard="slenderness 100, rotation of 82°, first_step = 1",
        model=beam((0, 0, -10 * BENDING / LENGTH**2)), procedure=LEAP,
        check=checks.at_end("deflection over length", sag, DEFLECTION_AT_10, 0.01),
    ),
    Case(
        name="cantilever bent by 80 %",
        hard="slenderness 100, as it comes", model=beam((0, 0, -10 * BENDING / LENGTH**2)),
        check=checks.at_end("deflection over length", sag, DEFLECTION_AT_10, 0.01),
    ),
    Case(
        name="column bowed by 0.1 % of its length", hard="1.5 times Euler's load, from its buckled shape",
        model=beam((-RATIO * EULER, 0, 0), bow=1e-3 * LENGTH),
        check=checks.at_end("deflection over length", sag, BUCKLED, 0.02),
    ),
    Case(
        name="column bowed by 0.001 % of its length", hard="almost a bifurcation",
        model=beam((-RATIO * EULER, 0, 0), bow=1e-5 * LENGTH),
        check=checks.at_end("deflection over length", sag, BUCKLED, 0.02),
    ),
    Case(
        name="column bowed by 1 %, one step", hard="first_step = 1 to 1.5 times Euler's load",
        model=beam((-RATIO * EULER, 0, 0), bow=1e-2 * LENGTH), procedure=LEAP,
        check=checks.at_end("deflection over length", sag, BUCKLED, 0.03),
    ),
    Case(
        name="perfect column", hard="straight at 1.5 times Euler's load: unstable, to be said",
        model=beam((-1.5 * EULER, 0, 0)), check=loses_stability,
    ),
    Case(
        name="arch, load control", hard="snaps through", model=arch, check=as_driven(), stops=None,
    ),
    Case(name="arch by arc length", hard="snaps through", model=arch, procedure=tg.ArcLength(), check=as_driven()),
    Case(name="arch, procedure auto", hard="snaps through; no cavity", model=arch, procedure=tg.Auto(),
         check=as_driven()),
    Case(
        name="bar twisted by 180°, one step", hard="first_step = 1",
        model=bar(tg.Fixed("x0"), tg.Displacement("x1", rotated(np.pi))), procedure=LEAP,
        check=checks.small_steps(40),
    ),
    Case(
        name="bar turned rigidly by 170°, one step", hard="first_step = 1",
        model=bar(*(tg.Displacement(face, rotated(np.deg2rad(170))) for face in ("x0", "x1"))), procedure=LEAP,
        check=no_energy,
    ),
    stretched(4.0, "block pulled to four times its length, one step", "first_step = 1"),
    stretched(0.3, "block squeezed to 30 %, one step", "first_step = 1"),
    Case(
        name="clamped block squeezed to half, one step", hard="bulging corners, first_step = 1", model=bar(*CRUSHED),
        procedure=LEAP, check=checks.small_steps(20),
    ),
    Case(
        name="clamped block squeezed to half", hard="bulging corners, as it comes", model=bar(*CRUSHED),
        check=checks.small_steps(20),
    ),
    Case(
        name="plate of 0.1 mm blown up, one step", hard="span 400 times the thickness: no stiffness at first",
        model=plate(0.1 * MM, 2e3), procedure=LEAP, check=checks.small_steps(20),
    ),
    Case(
        name="plate of 0.1 mm blown up", hard="span 400 times the thickness, as it comes", model=plate(0.1 * MM, 2e3),
        check=checks.small_steps(20),
    ),
    Case(
        name="plate of 10 µm blown up", hard="span 4000 times the thickness", model=plate(0.01 * MM, 200.0),
        check=checks.small_steps(20),
    ),
)  # fmt: skip
