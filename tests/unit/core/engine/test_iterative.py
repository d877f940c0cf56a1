"""GMRES for large tangents: its parts against their algebra, its answers against factors, and when it gives up."""

import sys
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp

import turgor as tg
from turgor.core.engine.algebra import linear
from turgor.core.engine.algebra.iterative import solver as module
from turgor.core.engine.algebra.iterative.krylov import gmres
from turgor.core.engine.algebra.iterative.levels import levels_of
from turgor.core.engine.algebra.iterative.node_blocks import block_structure, node_blocks
from turgor.core.engine.algebra.iterative.solver import IterativeSolver
from turgor.core.engine.algebra.iterative.two_level import TwoLevels
from turgor.core.engine.algebra.linear import available_solvers, linear_solver
from turgor.core.engine.algebra.settings import ITERATIVE_SOLVER, LINEAR_SOLVER
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.units import kPa, mm


@pytest.fixture(scope="module")
def model() -> tg.Model:
    """One chamber with a paper membrane, coarse."""
    mesh = tg.mesh(tg.FastPneuNet(chambers=1, length=14 * mm).build(), size=4 * mm)
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    paper = tg.Membrane(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
    materials = {"body": rubber, "base": rubber, "strain_limiting_layer": paper}
    return tg.Model(mesh, materials=materials, supports=[tg.Fixed("fixed")], loads=[tg.Pressure("cavity", 10 * kPa)])


@pytest.fixture(scope="module")
def tangent(model: tg.Model) -> tuple[System, np.ndarray, np.ndarray]:
    """The system, its tangent and its residual under half of the pressure, before anything has moved."""
    system = System(model)
    at = system.evaluate(np.zeros(system.size), 0.5)
    assert at is not None
    data = system.tangent_data(at)
    system.apply_supports(data)
    return system, data, np.where(system.prescribed, 0.0, at.residual)


def made(system: System) -> IterativeSolver:
    """The iterative solver of a system."""
    levels = levels_of(system)
    assert levels is not None
    return IterativeSolver(levels, system.pattern, 1, lambda: linear_solver("rslab", system.pattern, 1))


def stiffness(system: System, data: np.ndarray) -> sp.csc_matrix:
    """The displacement part of the tangent."""
    nodes = 3 * system.node_count
    return system.pattern.full(data)[:nodes, :nodes]


def test_blocks_hold_the_matrix_and_a_sweep_leaves_its_residual(tangent) -> None:
    system, data, _ = tangent
    whole, nodes = stiffness(system, data), system.node_count
    blocks = node_blocks(system.pattern, data, block_structure(system.pattern, nodes))
    again = sp.bsr_matrix((blocks.values, blocks.indices, blocks.indptr), shape=whole.shape)
    assert abs(again - whole).max() <= 1e-6 * abs(whole).max()
    right = np.random.default_rng(2).standard_normal(3 * nodes).astype(np.float32)
    solution, left = blocks.presmooth(right)
    np.testing.assert_allclose(left, right - whole @ solution, atol=1e-4 * np.abs(right).max())
    blocks.postsmooth(right, solution)
    first = right[:3] - (whole @ solution)[:3]  # the last node of a sweep back is in balance
    np.testing.assert_allclose(first, 0, atol=1e-4 * np.abs(right).max())


def test_a_cycle_solves_between_linear_displacements(tangent) -> None:
    system, data, _ = tangent
    levels = levels_of(system)
    assert levels is not None
    inverse = TwoLevels(levels, system.pattern, 1)
    inverse.factor(data)
    free, vertices = levels.free, levels.vertices
    rows = np.repeat(np.arange(levels.nodes), 2)
    down = sp.csr_matrix((np.full(len(rows), 0.5), (rows, levels.parents.ravel())))
    down = sp.diags(free.ravel() * 1.0) @ sp.kron(down, sp.identity(3)) @ sp.diags(free[vertices].ravel() * 1.0)
    coarse = (down.T @ stiffness(system, data) @ down + sp.diags(1.0 - free[vertices].ravel())).tocsc()
    right = np.random.default_rng(3).standard_normal(coarse.shape[0])
    assert inverse._coarse is not None
    exact = sp.linalg.spsolve(coarse, right)
    np.testing.assert_allclose(inverse._coarse.solve(right), exact, atol=2e-3 * np.abs(exact).max())
    forces = np.random.default_rng(4).standard_normal(3 * levels.nodes).astype(np.float32)
    blocks = node_blocks(system.pattern, data, block_structure(system.pattern, levels.nodes))
    solution, left = blocks.presmooth(forces)
    solution += (down @ sp.linalg.spsolve(coarse, down.T @ left)).astype(np.float32)
    blocks.postsmooth(forces, solution)
    np.testing.assert_allclose(inverse.solve(forces), solution, atol=2e-3 * np.abs(solution).max())


def test_solutions_reach_the_residual_that_is_asked_for(tangent) -> None:
    system, data, right = tangent
    solver = made(system)
    solver.factor(data)
    used = {}
    for left in (1e-3, 1e-5):
        before = solver.iterations
        solution = solver.solve(right, left)
        assert np.linalg.norm(system.pattern.product(data, solution) - right) <= left * np.linalg.norm(right)
        used[left] = solver.iterations - before
    assert used[1e-3] < used[1e-5] < 150
    assert solver.iterative


def test_factors_take_over_where_it_does_not_converge(tangent, monkeypatch: pytest.MonkeyPatch) -> None:
    system, data, right = tangent
    monkeypatch.setattr(module, "ITERATIVE_SOLVER", replace(ITERATIVE_SOLVER, iterations=3))
    solver = made(system)
    solver.factor(data)
    solution = solver.solve(right)
    assert np.linalg.norm(system.pattern.product(data, solution) - right) <= 1e-5 * np.linalg.norm(right)
    assert not solver.iterative
    assert solver.name == "rslab"
    assert solver.negative_pivots(system.constraint_count) == system.constraint_count


def test_it_counts_no_unstable_modes(tangent) -> None:
    system, data, _ = tangent
    solver = made(system)
    solver.factor(data)
    assert solver.negative_pivots(system.constraint_count) is None


def test_the_path_is_that_of_factors(model: tg.Model) -> None:
    asked = tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-7)
    states = {}
    for name in ("iterative", "rslab"):
        solution = tg.solve(model, asked, options=EngineOptions(linear_solver=name, threads=1))
        assert solution.timing.linear_solver == {"iterative": "gmres, two levels", "rslab": "rslab"}[name]
        states[name] = solution.states[-1]
    there, exact = states["iterative"].displacement, states["rslab"].displacement
    assert np.abs(there - exact).max() <= 1e-5 * np.abs(exact).max()
    assert states["iterative"].unstable_modes is None


def test_it_is_the_choice_where_factors_do_not_fit_and_that_is_said(
    model: tg.Model, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = {}
    monkeypatch.setattr(linear, "LINEAR_SOLVER", replace(LINEAR_SOLVER, large=1))
    for memory in (10_000, 10**12, None):
        monkeypatch.setattr(linear, "memory_of_machine", lambda memory=memory: memory)
        result = tg.solve(model, options=EngineOptions(threads=1))
        told[memory] = result.timing.linear_solver, [each.code for each in result.findings if each.code == "L09"]
    factored = available_solvers()[0], []
    assert told == {10_000: ("gmres, two levels", ["L09"]), 10**12: factored, None: factored}


def test_the_memory_of_this_machine_is_known() -> None:
    memory = linear.memory_of_machine()
    assert memory is None if sys.platform == "win32" else memory is not None and 2**28 < memory < 2**50


def test_equations_of_another_kind_are_factored(model: tg.Model) -> None:
    assert levels_of(System(tg.Model(**_parts(model), formulation="displacement"))) is None


def _parts(model: tg.Model) -> dict:
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=50 * kPa), bulk_modulus=1e6)
    return {
        "mesh": model.mesh,
        "materials": {"body": rubber, "base": rubber},
        "supports": [tg.Fixed("fixed")],
        "loads": [tg.Pressure("cavity", 10 * kPa)],
    }


def test_gmres_tells_when_it_is_not_done() -> None:
    matrix = np.diag(np.geomspace(1, 1000, 200))
    right = np.ones(200)
    assert gmres(lambda x: matrix @ x, lambda x: x, right, 1e-8, 10) == (None, 10)
    products = []
    solution, used = gmres(lambda x: products.append(x) or matrix @ x, lambda x: x, right, 1e-8, 1000)
    assert solution is not None
    assert used < 1000
    assert len(products) - used > 1  # single precision makes more than one start necessary
    np.testing.assert_allclose(matrix @ solution, right, atol=1e-6)
