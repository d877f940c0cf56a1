"""Rings of an axisymmetric mesh: one mean stress for each side of a border, and no cuts around the axis."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine.algebra.free_solver import solver_of
from turgor.core.engine.algebra.linear import linear_solver
from turgor.core.engine.algebra.rings import rings_of
from turgor.core.engine.algebra.settings import LINEAR_SOLVER
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.mean_stress_jumps import mean_stress_numbers
from turgor.core.engine.system import System
from turgor.core.meshing.refining.split_hexahedra import sheets
from turgor.core.solvers.remeshing.refine import refined, ring_sheets
from turgor.units import MPa, mm


@pytest.fixture(scope="module")
def bellows():
    return tg.mesh(tg.actuators.BellowsOfRevolution(folds=1).build(), size=6 * mm, cells="axisymmetric")


def of_two(mesh):
    """The mesh with two rubbers: one below half its length, one above."""
    x = mesh.points[mesh.cells, 0].mean(axis=1)
    low = np.flatnonzero(x < np.median(x))
    halves = replace(mesh, regions={"low": low, "high": np.setdiff1d(np.arange(len(x)), low)})
    rubbers = {
        name: tg.Material(law=tg.laws.NeoHooke(C10=C10 * MPa), name=name) for name, C10 in (("low", 0.1), ("high", 1))
    }
    return tg.Model(halves, rubbers, [tg.Fixed("fixed")], [])


def test_a_ring_has_one_mean_stress_on_each_side_of_a_border(bellows):
    model = of_two(bellows)
    numbers, _ = mean_stress_numbers(model)
    leader = rings_of(bellows).leader[bellows.cells[:, :8]]
    sides = {}
    for name, cells in model.mesh.regions.items():
        pairs = np.unique(np.stack([leader[cells].ravel(), numbers[cells].ravel()], axis=1), axis=0)
        assert len(pairs) == len(np.unique(pairs[:, 0]))  # one number for each ring
        sides[name] = dict(pairs.tolist())
    shared = set(sides["low"]) & set(sides["high"])
    assert shared
    assert all(sides["low"][ring] != sides["high"][ring] for ring in shared)


def test_pressure_in_a_bellows_has_a_potential(bellows):
    """The rim at the pinhole keeps its radius, so that the tangent is symmetric and its pivots are counted."""
    rubber = tg.Material(law=tg.laws.NeoHooke(C10=0.1 * MPa), name="rubber")
    model = tg.Model(bellows, {"body": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1e3)])
    system = System(model)
    assert system.terms.symmetric
    tangent = Tangent(system, "rslab", 1)
    tangent.factor(system.evaluate(np.zeros(system.size), 0.0))
    assert tangent.name == "rslab"
    assert tangent.unstable_modes() == 0


def test_held_unknowns_are_left_out_of_the_factorization(bellows):
    rubber = tg.Material(law=tg.laws.NeoHooke(C10=0.1 * MPa), name="rubber")
    system = System(tg.Model(bellows, {"body": rubber}, [tg.Fixed("fixed")], []))
    assert system.prescribed.mean() > LINEAR_SOLVER.many_prescribed
    data = system.tangent_data(system.evaluate(np.zeros(system.size), 0.0))
    system.apply_supports(data)
    make = partial(linear_solver, "rslab", threads=1)
    whole, free = make(system.pattern), solver_of(make, system.pattern, system.prescribed)
    right = np.random.default_rng(1).standard_normal(system.size)
    for solver in (whole, free):
        solver.factor(data)
    assert free.solve(right) == pytest.approx(whole.solve(right), rel=1e-9, abs=1e-9)
    assert free.negative_pivots(0) == whole.negative_pivots(0) == system.constraint_count
    free.double = True
    assert free.double


def test_a_refined_mesh_has_as_many_cells_around(bellows):
    around = ring_sheets(bellows, sheets(bellows))
    assert len(around) == 2
    fine = refined(bellows, np.full((len(bellows.cells), 3), 1.0), 8.0)
    assert fine.mesh.revolved == "x"
    assert len(fine.mesh.cells) == 4 * len(bellows.cells)
    assert len(ring_sheets(fine.mesh, sheets(fine.mesh))) == 2


def test_the_pinhole_on_the_axis_touches_nothing(bellows):
    model = of_two(bellows)
    contact = tg.Contact(self_contact=True)
    touching = tg.Model(model.mesh, model.materials, model.supports, [], contact=contact)
    sides = np.concatenate([part.surface.sides for part in System(touching).contact.parts])
    assert len(sides)
    assert bellows.on_axis.any()
    assert not bellows.on_axis[sides].all(axis=1).any()
