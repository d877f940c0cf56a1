"""Thick and thin spheres, tubes: closed forms, limit points, the softest and stiffest rows of the library."""

from collections.abc import Callable
from typing import Any

import numpy as np

import turgor as tg
from benchmarks.robustness.robustness_cases import checks
from benchmarks.robustness.robustness_cases.case import KPA, MM, RUBBER, Case, Check, Found, one

import exact  # isort: skip  (found where robustness_cases.case says)
import meshes  # isort: skip
import problems  # isort: skip
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.solvers.pressures import pressures_of

INNER, OUTER = 10 * MM, 15 * MM
NEO, OGDEN = problems.NEO_HOOKE, problems.OGDEN
#: Limit pressures of the spheres of V04 [Pa].
NEO_LIMIT, OGDEN_LIMIT = 0.11844454e6, 0.012944853e6
LEAP = tg.Static(first_step=1.0, max_step=1.0)


def sphere(law: Any, pressure: float = 0.0, *, outer: float = OUTER, kind=TETRAHEDRON, around: int = 2,
           through: int = 2, history: Any = None, bulk_modulus: float = np.inf) -> Callable[[], tg.Model]:  # fmt: skip
    """An octant of a sphere under pressure."""

    def model() -> tg.Model:
        mesh = meshes.sphere_octant(INNER, outer, around, through, kind=kind)
        if outer > 3 * INNER:
            mesh = meshes.with_points(mesh, graded(mesh.points, outer))
        load = tg.Pressure("cavity", pressure, history) if history else tg.Pressure("cavity", pressure)
        return one(mesh, law, [load] if pressure else [], bulk_modulus=bulk_modulus)

    return model


def graded(points: np.ndarray, outer: float) -> np.ndarray:
    """Spread layers of equal thickness so that each is a constant factor thicker than the one inside it."""
    radius = np.linalg.norm(points, axis=1)[:, None]
    return points / radius * INNER * (outer / INNER) ** ((radius - INNER) / (outer - INNER))


def on_curve(law: Any, outer: float = OUTER, tolerance: float = 2e-3) -> Check:
    """Pressures of all states against the exact ones at their inner stretches."""

    def check(solution: tg.Solution) -> Found:
        worst, last = 0.0, 1.0
        for state in solution.states[1:]:
            got = pressures_of(state)["cavity"]
            last = problems.mean_radius(state, "cavity", (0, 1, 2)) / INNER
            worst = max(worst, abs(got / exact.sphere_pressure(law, last, INNER, outer) - 1))
        return Found(worst <= tolerance, f"pressures {worst:.1e} off the exact curve up to a stretch of {last:.4g}")

    return check


def stretch_at(law: Any, stretch: float, name: str, hard: str, **more: Any) -> Case:
    """A sphere asked, in one step, for the exact pressure of a stretch that it must come to."""
    pressure = exact.sphere_pressure(law, stretch, INNER, more.get("outer", OUTER))

    def got(state: tg.solutions.State) -> float:
        return problems.mean_radius(state, "cavity", (0, 1, 2)) / INNER

    check = checks.at_end("inner stretch", got, stretch, 3e-3)
    return Case(name=name, hard=hard, model=sphere(law, pressure, **more), procedure=LEAP, check=check)


def jump_said(law: Any, limit: float) -> Check:
    """Stopped at the limit point; or the end lies on the far branch of the exact curve, and the message says so."""

    def check(solution: tg.Solution) -> Found:
        if not solution.complete:
            return checks.limit_at(limit)(solution)
        result = on_curve(law)(solution)
        said = "jumped past a limit point" in solution.message
        return Found(result.agrees and said, f"{result.text}; the jump is {'' if said else 'not '}said")

    return check


def library(name: str, record: str) -> Any:
    """The law of a row of the library."""
    return tg.from_library(name, record=record).law


def injected(stretch: float) -> tg.VolumeControl:
    """The volume that brings a sphere to a stretch."""
    return tg.VolumeControl(volume=4 / 3 * np.pi * INNER**3 * (stretch**3 - 1))


def gas_pressure(ratio: float) -> Check:
    """The gas in the sphere obeys its law, and the sphere its own."""

    def check(solution: tg.Solution) -> Found:
        state, air = solution.states[-1], 101_325.0
        stretch = problems.mean_radius(state, "cavity", (0, 1, 2)) / INNER
        expected = air * ratio / stretch**3 - air
        return checks.value("gauge pressure", pressures_of(state)["cavity"] / KPA, expected / KPA, 2e-3, " kPa")

    return check


def tube(law: Any, stretch: float, outer: float, name: str, hard: str) -> Case:
    """A tube in plane strain asked, in one step, for the pressure of a stretch."""
    pressure = exact.tube_pressure(law, stretch, 5 * MM, outer)

    def model() -> tg.Model:
        mesh = meshes.tube_sector(5 * MM, outer, 1 * MM, (2, 4, 1), kind=HEXAHEDRON)
        return one(mesh, law, [tg.Pressure("cavity", pressure)], problems.PLANE_STRAIN)

    def got(state: tg.solutions.State) -> float:
        return problems.mean_radius(state, "cavity", (0, 1)) / (5 * MM)

    check = checks.at_end("inner stretch", got, stretch, 5e-3)
    return Case(name=name, hard=hard, model=model, procedure=LEAP, check=check)


SOFTEST, STIFFEST = library("ecoflex-00-30", "yeoh-elsayed-2014"), library("fiberglass", "yeoh-polygerinos-2015")
LOCKING = tg.laws.Gent(mu=0.24e6, Jm=2.0)
UP_AND_DOWN = [(0, 0), (0.5, 1), (1, 0)]

CASES = (
    stretch_at(NEO, 1.3, "sphere, one step", "first_step = 1, 91 % of the limit pressure"),
    stretch_at(NEO, 1.3, "sphere of hexahedra, one step", "first_step = 1", kind=HEXAHEDRON, around=1),
    stretch_at(SOFTEST, 1.4, "softest row of the library", "shear modulus 10 kPa, one step"),
    stretch_at(STIFFEST, 1.3, "stiffest row of the library", "shear modulus 16 MPa, one step"),
    stretch_at(LOCKING, 1.35, "Gent, near locking", "Jm = 2, no energy beyond; one step", through=4),
    stretch_at(tg.laws.ArrudaBoyce(mu=0.24e6, locking_stretch=1.5), 1.6, "Arruda-Boyce, near locking",
               "locking stretch 1.5; one step",
               through=4),
    stretch_at(NEO, 0.8, "vacuum in a sphere", "inner stretch 0.8, one step"),
    Case(
        name="sphere close below its limit point", hard="99.9 % of the limit pressure",
        model=sphere(NEO, 0.999 * NEO_LIMIT, through=3), check=checks.both(on_curve(NEO), checks.stable),
    ),
    Case(
        name="sphere past its limit, load control", hard="120 % of the limit pressure",
        model=sphere(NEO, 1.2 * NEO_LIMIT, through=3), check=checks.limit_at(NEO_LIMIT), stops=True,
    ),
    Case(
        name="sphere at ten times its limit, one step", hard="first_step = 1, no equilibrium there",
        model=sphere(NEO, 10 * NEO_LIMIT, through=3), procedure=LEAP,
        check=checks.limit_at(NEO_LIMIT, below=0.005), stops=True,
    ),
    Case(
        name="Ogden sphere past its limit, load control", hard="no way there but a jump to a stretch of 2.4",
        model=sphere(OGDEN, 0.0136e6, through=3), check=jump_said(OGDEN, OGDEN_LIMIT), stops=None,
    ),
    Case(
        name="Ogden sphere, procedure auto", hard="limit point on the way",
        model=sphere(OGDEN, 0.0136e6, through=3), procedure=tg.Auto(), check=on_curve(OGDEN, tolerance=5e-3),
    ),
    Case(
        name="sphere by arc length", hard="120 % of the limit pressure", model=sphere(NEO, 1.2 * NEO_LIMIT, through=3),
        procedure=tg.ArcLength(max_stretch=3.0), check=on_curve(NEO, tolerance=5e-3),
    ),
    Case(
        name="thin balloon filled to five times its radius", hard="wall of 1 %, far past the limit point",
        model=sphere(NEO, outer=1.01 * INNER, around=3, through=1), procedure=injected(5.0),
        check=on_curve(NEO, 1.01 * INNER, 0.01),
    ),
    Case(
        name="very thick sphere filled", hard="outer radius 10 times the inner, stretch 2",
        model=sphere(NEO, outer=10 * INNER, through=6), procedure=injected(2.0), check=on_curve(NEO, 10 * INNER, 0.02),
    ),
    Case(
        name="sealed gas in a sphere", hard="eight times the air of rest, past the limit point",
        model=sphere(NEO), procedure=tg.GasMass(mass_ratio=8.0),
        check=checks.both(gas_pressure(8.0), on_curve(NEO, tolerance=5e-3)),
    ),
    Case(
        name="softest sphere up and down", hard="pressure to 95 % of the limit and back to nothing",
        model=sphere(OGDEN, 0.95 * OGDEN_LIMIT, history=UP_AND_DOWN), check=checks.back_to_rest,
    ),
    Case(
        name="compressible sphere", hard="Poisson's ratio 0.3, one step",
        model=sphere(NEO, 60 * KPA, bulk_modulus=0.52e6), procedure=LEAP, check=checks.small_steps(),
    ),
    Case(
        name="sphere of one tetrahedron through the wall", hard="coarsest mesh, first_step = 1",
        model=sphere(RUBBER, 90 * KPA, around=1, through=1), procedure=LEAP, check=checks.small_steps(),
    ),
    tube(NEO, 1.5, 10 * MM, "thick tube, one step", "inner stretch 1.5, wall as thick as the bore"),
    tube(problems.YEOH, 2.0, 5.05 * MM, "thin tube, one step", "wall of 1 % of the radius, stretch 2"),
    tube(LOCKING, 1.6, 7 * MM, "locking tube, one step", "Gent, Jm = 2"),
)  # fmt: skip
