"""Several cavities with pressures and histories of their own.

Problem: a bar clamped at one end, with one void above the other. What must hold without any solution by formula: equal
pressures are one pressure; the way to a load does not matter for an elastic body on a stable path; and without load it
is undeformed again.
Exact: equality. Source: elasticity. Tolerances: round-off where the equations are the same ones, a hundred times
the solver's tolerance where they are solved along different ways, since a residual is not a displacement.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.system import System
from turgor.units import kPa

UP_AND_DOWN = ((0, 0), (0.5, 1), (1, 0))
FIRST, THEN = ((0, 0), (0.5, 1), (1, 1)), ((0, 0), (0.5, 0), (1, 1))
PRECISE = tg.Static(tolerance=1e-9)


def _bar(*loads):
    return problems.one_material(meshes.two_cavities(), problems.YEOH, supports=[tg.Fixed("x0")], loads=loads)


def _end(*loads):
    return problems.solve(_bar(*loads), PRECISE).states[-1].displacement


def _apart(one, other):
    return float(np.abs(one - other).max() / np.abs(other).max())


def test_equal_pressures_are_one_pressure(record_verification):
    """Two loads of one value join into one group, two histories of one course do not: all three are one problem."""
    mesh = meshes.two_cavities()
    mesh = meshes.with_faces(mesh, walls=np.concatenate([mesh.face("cavity_1"), mesh.face("cavity_2")]))
    ramp = ((0, 0), (0.5, 0.5), (1, 1))
    asked = {
        "one load on both": [tg.Pressure("walls", 40 * kPa)],
        "two loads": [tg.Pressure("cavity_1", 40 * kPa), tg.Pressure("cavity_2", 40 * kPa)],
        "two histories": [tg.Pressure("cavity_1", 40 * kPa, history=ramp), tg.Pressure("cavity_2", 40 * kPa)],
    }
    ends = []
    for loads in asked.values():
        model = problems.one_material(mesh, problems.YEOH, supports=[tg.Fixed("x0")], loads=loads)
        system = System(model)
        assert system.terms.symmetric
        at = np.random.default_rng(5).normal(0, 1e-2, system.size)
        ends.append(system.residual(at, 0.7))
    for name, end in list(zip(asked, ends, strict=True))[1:]:
        error = _apart(end, ends[0])
        record_verification(
            claim=f"equal pressures in two cavities, {name} against one load on both: residual, relative",
            source="the same equations",
            expected=0.0,
            got=error,
            tolerance="1e-13",
        )
        assert error < 1e-13
    assert _apart(_end(*asked["two histories"]), _end(*asked["two loads"])) < 1e-7


def test_equal_pressures_of_unlike_histories_act_apart(record_verification):
    at = np.random.default_rng(6).normal(0, 1e-2, System(_bar()).size)
    both = [tg.Pressure("cavity_1", 40 * kPa, history=FIRST), tg.Pressure("cavity_2", 40 * kPa, history=THEN)]
    error = _apart(
        System(_bar(*both)).residual(at, 0.5), System(_bar(tg.Pressure("cavity_1", 40 * kPa))).residual(at, 1.0)
    )
    record_verification(
        claim="40 kPa in cavity_1 at first, in cavity_2 later: residual half way, against cavity_1 alone, relative",
        source="the same equations",
        expected=0.0,
        got=error,
        tolerance="1e-13",
    )
    assert error < 1e-13


def test_up_and_down_returns_to_the_start(record_verification):
    loads = [tg.Pressure("cavity_1", 40 * kPa, history=UP_AND_DOWN)]
    solution = problems.solve(_bar(*loads))
    top = problems.state_at(solution, 0.5)
    same = _end(tg.Pressure("cavity_1", 40 * kPa))
    assert _apart(top.displacement, same) < 1e-4  # the kink is a state, at the whole pressure
    left = float(np.abs(solution.states[-1].displacement).max() / np.abs(same).max())
    record_verification(
        claim="pressure up to 40 kPa and back to zero: displacement left, over the largest on the way",
        source="an elastic body without load is undeformed",
        expected=0.0,
        got=left,
        tolerance="1e-8",
    )
    assert left < 1e-8
    assert problems.state_at(solution, 1.0).unstable_modes == 0


def test_the_order_of_the_pressures_does_not_matter(record_verification):
    ways = {
        "together": [tg.Pressure("cavity_1", 40 * kPa), tg.Pressure("cavity_2", 20 * kPa)],
        "cavity_1 first": [tg.Pressure("cavity_1", 40 * kPa, FIRST), tg.Pressure("cavity_2", 20 * kPa, THEN)],
        "cavity_2 first": [tg.Pressure("cavity_1", 40 * kPa, THEN), tg.Pressure("cavity_2", 20 * kPa, FIRST)],
    }
    together, *others = (_end(*loads) for loads in ways.values())
    for name, end in zip(list(ways)[1:], others, strict=True):
        error = _apart(end, together)
        record_verification(
            claim=f"40 and 20 kPa in two cavities, {name}, against both together: displacement, relative",
            source="the end of an elastic body does not depend on the way",
            expected=0.0,
            got=error,
            tolerance="1e-7",
        )
        assert error < 1e-7


@pytest.mark.parametrize("load_factor", [0.3, 0.8], ids=["before the kink", "after the kink"])
def test_tangent_of_two_histories_is_the_derivative_of_the_residual(load_factor, record_verification):
    """Cavities of unlike pressures, the faces of one left open: the skew part must follow its history too."""
    mesh = meshes.two_cavities()
    mesh = meshes.with_faces(mesh, part=mesh.face("cavity_2")[:-2])
    loads = [tg.Pressure("cavity_1", 50 * kPa, history=UP_AND_DOWN), tg.Pressure("part", -20 * kPa, history=THEN)]
    system = System(problems.one_material(mesh, problems.YEOH, supports=[tg.Fixed("x0")], loads=loads))
    assert not system.terms.symmetric
    rng = np.random.default_rng(11)
    gradient = 0.2 * rng.uniform(-1, 1, (3, 3))
    unknowns = np.concatenate([(mesh.points @ gradient).ravel() / system.length, rng.uniform(-1, 1, mesh.vertex_count)])
    free, worst, largest = np.flatnonzero(~system.prescribed), 0.0, 0.0
    tangent = system.tangent(unknowns, load_factor)
    for _ in range(12):
        along = np.zeros(system.size)
        along[free] = rng.normal(0, 1, len(free))
        h = 1e-5
        ends = [system.residual(unknowns + s * h * along, load_factor) for s in (1, -1)]
        exact = ((ends[0] - ends[1]) / (2 * h))[free]
        worst = max(worst, float(np.abs((tangent @ along)[free] - exact).max()))
        largest = max(largest, float(np.abs(exact).max()))
    record_verification(
        claim=f"tangent along 12 random directions against differences, two histories at load factor {load_factor}",
        source="V24",
        expected=0.0,
        got=worst / largest,
        tolerance="1e-6",
    )
    assert worst < 1e-6 * largest
