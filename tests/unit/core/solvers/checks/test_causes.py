"""Every cause of an early end has its own sentence and advice, found in the last state of a tiny model."""

from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases
from solver_cases import bar

import meshes
from turgor.core.materials.laws.laws import Hooke, NeoHooke, Yeoh
from turgor.core.materials.material import Material
from turgor.core.model.loads import Pressure, Traction
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane, Shell
from turgor.core.model.supports import Fixed
from turgor.core.solvers.checks.causes import balloon, cause_in, overload, turned_law, wrinkled_film
from turgor.core.solvers.outcomes import stuck
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import Status, Step
from turgor.core.solvers.solve import solve
from turgor.core.solvers.step_reasons import Cause, Reason
from turgor.units import GPa, kPa, mm

TURNING = Material(name="turning", law=Yeoh(C10=0.1e6, C20=-0.02e6))
STIFFENING = Material(name="stiffening", law=Yeoh(C10=0.11e6, C20=0.02e6), stretch_range=(1.0, 2.0))
NEO_HOOKE = Material(name="rubber", law=NeoHooke(C10=0.12e6))


def block(rubber, load, **sheets):
    mesh = cases.body(hollow=False)
    return Model(mesh, {"body": rubber, "base": rubber, **sheets}, [Fixed("fixed")], [load])


def stretched(rubber, stretch, **sheets):
    """A block in uniaxial tension, made by formula."""
    model = block(rubber, Traction("tip", (1e3, 0.0, 0.0)), **sheets)
    return cases.state(model, lambda X: X * [stretch, stretch**-0.5, stretch**-0.5])


def film(kind=Membrane, **how):
    return kind(Material(name="film", law=Hooke(E=1 * GPa, nu=0.3)), 0.1 * mm, **how)


def test_a_law_that_turns_over():
    solution = solve(Model(bar(), {"body": TURNING}, [Fixed("fixed")], [Traction("top", (0, 0, 500e3))]), throw=False)
    assert not solution.complete
    assert "The law of 'turning' turns over at stretch 1.57 in uniaxial tension, and " in solution.message
    assert solution.advice.startswith("Stay below this stretch, or take a law that is stable there (M06)")


def test_the_stretch_decides_whether_a_law_turns_over():
    assert turned_law(stretched(TURNING, 1.3)) is None
    assert turned_law(stretched(TURNING, 1.55)) is not None  # just before the extreme, where Newton's method fails
    assert turned_law(stretched(STIFFENING, 3.0)) is None


def test_a_few_cells_are_enough_for_a_law_to_turn_over():
    model = block(TURNING, Traction("tip", (1e3, 0.0, 0.0)))
    long = 0.8 * cases.LENGTH
    few = cases.state(model, lambda X: X + np.outer(np.maximum(X[:, 0] - long, 0.0), [1.0, 0.0, 0.0]))
    assert "of 'body' is stretched as far" in turned_law(few).message


def test_a_balloon():
    mesh = meshes.sphere_octant(10 * mm, 15 * mm, 1, 2)
    solution = solve(Model(mesh, {"body": NEO_HOOKE}, [], [Pressure("cavity", 150 * kPa)]), throw=False)
    assert solution.status is Status.LIMIT_POINT
    assert "It is a balloon: 'cavity' has " in solution.message
    assert "points to a maximum of 118." in solution.message
    assert "VolumeControl" in solution.advice
    assert solution.advice.endswith("a rubber whose law stiffens earlier.")
    assert balloon(solution.states[:2]) is None  # hardly inflated


def test_a_limit_point_of_another_kind_keeps_its_sentence():
    """A shallow arch under its load snaps through: rubber is hardly stretched, and there is no cavity."""
    half, rise, thick = 20 * mm, 3 * mm, 1 * mm

    def arched(points):
        points[:, 2] += rise * (1 - (points[:, 0] / half) ** 2)
        return points

    mesh = meshes.box((half, 2 * mm, thick), (8, 1, 1), arched)
    supports = [Fixed("x0", "x"), Fixed("x1"), Fixed("y0", "y"), Fixed("y1", "y")]
    load = Traction("z1", (0.0, 0.0, -100.0))
    solution = solve(Model(mesh, {"body": NEO_HOOKE}, supports, [load]), Static(min_step=1e-3), throw=False)
    assert solution.status is Status.LIMIT_POINT
    assert "which is a limit point (ballooning, snap-through) or buckling. The path" in solution.message
    assert solution.advice.startswith("Ask for less than this load; the path up to it is complete.")
    assert "points to a maximum of load factor" in solution.message


def ended_in(*states):
    """How load control ends after these states, when no step from the last one succeeds."""
    failed = Step(
        load_factor=1.0, increment=1e-4, iterations=15, residual=1.0, accepted=False, seconds=0.0,
        why=Reason(Cause.TOO_MANY_ITERATIONS, 15),
    )  # fmt: skip
    return stuck(states[-1].model, states, [failed], lost_stability=False)


def test_a_film_that_wrinkles():
    ending = ended_in(stretched(cases.RUBBER, 0.97, outside=film()))
    assert ending.status is Status.STEP_TOO_SMALL
    assert "The film on 'outside' is compressed in 100 % of its area" in ending.message
    assert "make it a shell" in ending.advice
    unstable = replace(stretched(cases.RUBBER, 0.97, outside=film()), unstable_modes=3)
    assert ended_in(unstable).status is Status.LIMIT_POINT
    assert "it has no bending stiffness and wrinkles there" in ended_in(unstable).message


def test_a_film_in_tension_or_with_bending_stiffness_does_not_wrinkle():
    assert wrinkled_film(stretched(cases.RUBBER, 0.97, tip=film())) is None  # the tip grows in its plane
    assert wrinkled_film(stretched(cases.RUBBER, 0.97, outside=film(Shell))) is None
    assert wrinkled_film(stretched(cases.RUBBER, 0.97, outside=film(compression=0.0))) is None
    assert wrinkled_film(stretched(cases.RUBBER, 0.97, outside=film())) is not None


@pytest.mark.parametrize(("rubber", "stretch"), [(STIFFENING, 2.5), (NEO_HOOKE, 9.0)])
def test_a_load_that_no_rubber_bears(rubber, stretch):
    why = overload(stretched(rubber, stretch))
    assert f"is stretched to {stretch:.3g}; " in why.message
    assert why.advice.startswith("The load is more than the rubber bears: ask for less")
    assert cause_in(stretched(rubber, 1.5)) is None


def test_far_too_much_load_does_not_end_with_advice_about_the_mesh():
    ending = ended_in(stretched(STIFFENING, 2.5))
    assert "'body' is stretched to 2.5; its tests end at 2." in ending.message
    assert ending.advice.startswith("The load is more than the rubber bears: ask for less")
    assert "refine the mesh" in ended_in(stretched(STIFFENING, 1.2)).advice  # where nothing else is known
