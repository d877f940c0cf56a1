"""Buckling loads by the rate of the tangent, branches beyond them, imperfections.

Problem: (a) a cantilever column, 100 × 1 × 2 mm, under a dead axial force; (b) a quarter of a thin ring in plane strain
under vacuum inside, mean radius 10 mm, wall 0.4 mm; (c) column (a) with 1.518 times Euler's load, at which the tip of
the elastica has turned by 100°, along the branch and with an imperfection.
Reference: (a) Euler, (2k − 1)² π²EI/4L²; (b) p = 3 E'I/R³ with E' = E/(1 − ν²) (Timoshenko and Gere, article 7.3), with
the wall's mean radius; (c) inextensible elastica, elliptic integrals.
Tolerance: (a) 1 % of the first load across the thin side, and its changes halve at least with the cells: the clamped
end carries them; (b) 1.5 %: walls of 1/25 of the radius are not thin to a percent; (c) 1 % of the deflection.
"""

from functools import lru_cache

import numpy as np
import pytest
from scipy.special import ellipk

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON

MM = problems.MM
LENGTH, SIDE, WIDTH = 100 * MM, 1 * MM, 2 * MM
YOUNG = 6 * 0.12 * problems.MPA
EULER = np.pi**2 * YOUNG * WIDTH * SIDE**3 / 12 / (4 * LENGTH**2)
M = np.sin(np.deg2rad(50)) ** 2
RATIO, DEFLECTION = (2 * ellipk(M) / np.pi) ** 2, 2 * np.sqrt(M) / ellipk(M)


def column(force, cells=16):
    """A cantilever along x under an axial force [N] at its tip; its thin side is along y."""
    mesh = meshes.box((LENGTH, SIDE, WIDTH), (cells, 1, 1), kind=HEXAHEDRON)
    loads = [tg.Traction("x1", (-force / (SIDE * WIDTH), 0.0, 0.0))]
    return problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x0")], loads=loads)


@lru_cache
def loads_of_column(cells):
    """Lowest loads across the thin side, over Euler's."""
    modes = tg.solutions.buckling_modes(column(EULER, cells), count=4)
    across = np.abs(modes.shapes[:, :, 1]).max(axis=1) > 0.5
    return modes.load_factors[across]


def tip(solution):
    last = solution.states[-1]
    return float(last.displacement[last.model.mesh.face_nodes("x1"), 1].mean()) / LENGTH


def test_a_column_buckles_at_eulers_loads(record_verification):
    got = loads_of_column(16)[:2]
    record_verification(
        claim="cantilever column: first two buckling loads over Euler's first",
        source="Euler", expected=(1.0, 9.0), got=got, tolerance="1 %, 1.5 %",
    )  # fmt: skip
    assert got[0] == pytest.approx(1, rel=0.01)
    assert got[1] == pytest.approx(9, rel=0.015)


def test_the_change_of_eulers_load_halves_with_the_cells():
    coarse, middle, fine = (loads_of_column(cells)[0] for cells in (8, 16, 32))
    assert 1.8 < (coarse - middle) / (middle - fine) < 5
    assert fine == pytest.approx(1, rel=0.006)


def test_a_load_that_pulls_buckles_nothing():
    modes = tg.solutions.buckling_modes(column(-EULER, 8), count=1)
    assert not len(modes.load_factors)
    assert "stiffens" in modes.message


def test_modes_from_a_state_close_by_are_those_from_rest():
    model = column(1.5 * EULER)
    solution = tg.solve(
        model, tg.Static(at=(0.6,)), stop=lambda state: "close" if state.load_factor >= 0.6 else None, throw=False
    )
    near = tg.solutions.buckling_modes(model, solution.states[-1], count=1)
    assert near.load_factor == pytest.approx(0.6)
    assert 1.5 * near.load_factors[0] == pytest.approx(loads_of_column(16)[0], rel=1e-3)


def test_a_thin_ring_buckles_under_vacuum(record_verification):
    wall, radius = 0.4 * MM, 10 * MM
    mesh = meshes.tube_sector(radius - wall / 2, radius + wall / 2, 1 * MM, (1, 12, 1), kind=HEXAHEDRON)
    supports = [tg.Fixed("z0", "z"), tg.Fixed("z1", "z")]
    expected = 3 * (YOUNG / (1 - 0.25)) * wall**3 / 12 / radius**3
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=supports, loads=[tg.Pressure("cavity", -expected)])
    (got,) = tg.solutions.buckling_modes(model, count=1).load_factors * expected
    record_verification(
        claim="thin ring in plane strain: vacuum at which it buckles [Pa]",
        source="Timoshenko and Gere", expected=expected, got=got, tolerance="1.5 %",
    )  # fmt: skip
    assert got == pytest.approx(expected, rel=0.015)


@pytest.mark.parametrize("side", [1, -1])
def test_a_branch_is_the_elastica(side, record_verification):
    solution = problems.solve(column(RATIO * EULER, 24), tg.ArcLength(branch=side))
    record_verification(
        claim=f"straight column, branch {side}: deflection of the tip over the length",
        source="elastica", expected=side * DEFLECTION, got=tip(solution), tolerance="1 %",
    )  # fmt: skip
    assert solution.converged
    assert tip(solution) == pytest.approx(side * DEFLECTION, rel=0.01)
    assert f"Took branch {side} at the bifurcation at load factor 0.66" in solution.message
    factors = [state.load_factor for state in solution.states]
    assert np.all(np.diff(factors) >= -1e-6)
    assert not solution.limit_points


def test_a_path_without_bifurcation_says_that_no_branch_was_taken():
    solution = problems.solve(column(0.5 * EULER, 8), tg.ArcLength(branch=1))
    assert "No bifurcation was met" in solution.message


def test_an_imperfect_column_bends_as_the_elastica(record_verification):
    model = tg.solutions.imperfect(column(RATIO * EULER, 24), SIDE / 50)
    solution = problems.solve(model, tg.ArcLength())
    record_verification(
        claim="imperfect column: deflection of the tip over the length",
        source="elastica", expected=DEFLECTION, got=abs(tip(solution)), tolerance="1 %",
    )  # fmt: skip
    assert abs(tip(solution)) == pytest.approx(DEFLECTION, rel=0.01)


def test_an_imperfection_is_as_large_as_stated_along_each_mode():
    model = column(EULER, 8)
    modes = tg.solutions.buckling_modes(model, count=2)
    moved = tg.solutions.imperfect(model, (0.2 * MM, -0.1 * MM), modes).mesh.points - model.mesh.points
    assert moved == pytest.approx(0.2 * MM * modes.shapes[0] - 0.1 * MM * modes.shapes[1], abs=1e-12)
    assert np.linalg.norm(0.2 * MM * modes.shapes[0], axis=1).max() == pytest.approx(0.2 * MM)


PRESENT = tg.Traction("x1", (-1.0, 0.0, 0.0), history="constant")
RUBBED = tg.loads.Tendon(
    through=((0, SIDE, 0), (LENGTH / 2, SIDE, 0), (LENGTH / 2, SIDE, WIDTH)), tension=1e-3, friction=0.3
)


def with_load(model, load):
    return tg.Model(model.mesh, model.materials, model.supports, (*model.loads, load))


def crumpled(model):
    """An imperfection that moves every node another way."""
    shapes = np.random.default_rng(1).uniform(-1, 1, (1, *model.mesh.points.shape))
    modes = tg.solutions.BucklingModes(
        model=model, load_factor=0.0, displacement=0 * shapes[0], load_factors=np.ones(1), shapes=shapes
    )
    return tg.solutions.imperfect(model, SIDE, modes)


@pytest.mark.parametrize(
    ("call", "facts"),
    [
        (lambda: tg.solutions.buckling_modes(column(EULER, 2), count=0), ["count is 0", "1 to 20"]),
        (lambda: tg.solutions.buckling_modes(column(0.0, 2)), ["nothing loads"]),
        (lambda: tg.solutions.imperfect(column(EULER, 8), 0.02), ["20 mm", "up to 10 mm"]),
        (lambda: tg.solutions.imperfect(column(-EULER, 8), 1e-4), ["1 size", "0 buckling modes", "stiffens"]),
        (lambda: tg.solutions.buckling_modes(with_load(column(EULER, 2), PRESENT)), ["from the start", "--at"]),
        (lambda: tg.solutions.buckling_modes(with_load(column(EULER, 2), RUBBED)), ["friction", "no potential"]),
        (lambda: crumpled(column(EULER, 8)), ["inside out", "smaller"]),
        (lambda: tg.ArcLength(branch=2), ["procedure.branch is 2", "-1, 0 or 1"]),
    ],
)
def test_what_cannot_be_computed_is_refused(call, facts):
    with pytest.raises(tg.TurgorError) as error:
        call()
    for fact in facts:
        assert fact in str(error.value)


def test_an_interrupted_branch_goes_on(tmp_path):
    model, procedure = column(RATIO * EULER, 8), tg.ArcLength(branch=1)
    whole = problems.solve(model, procedure)
    cut = 15

    def interrupt(iteration, state):
        if state is not None and iteration.step == cut:
            raise KeyboardInterrupt

    begun = problems.solve(model, procedure, folder=tmp_path / "run", progress=interrupt, throw=False)
    assert begun.status is tg.Status.INTERRUPTED
    gone_on = tg.resume(tmp_path / "run")
    assert len(gone_on.states) == len(whole.states)
    assert tip(gone_on) == pytest.approx(tip(whole), rel=1e-6)
    assert "Took branch 1" in gone_on.message
