"""Networks that flow in whole models: halves, refinement, stages, energies; what a guide and a gradient refuse."""

from dataclasses import replace

import numpy as np
import pytest
from lattice_cases import refined

import meshes
import turgor as tg
from refused import refused
from turgor.accuracy.gradients.checks import depends_on_history
from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.engine.cells.states.flow_networks import flow_at_rest, flow_networks
from turgor.core.engine.system import System
from turgor.core.engine.transfer import Transfer
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.solvers.procedures.stabilized import Stabilized
from turgor.core.solvers.procedures.static import Static

OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
LAW = tg.laws.MooneyRivlin(C10=0.4e5, C01=0.1e5)
PLAIN = tg.Material(name="rubber", law=LAW, density=1e3)
BOTH = replace(
    PLAIN,
    viscoelasticity=tg.laws.BergstromBoyce(stiffness=1.0, rate=0.5, stress=1e4, exponent=2.0),
    permanent_set=tg.laws.PermanentSet(stress=3e5, exponent=1.5),
)
UP_AND_DOWN = ((0, 0), (0.5, 1), (1, 0))
CYCLE = Static(duration=4.0, first_step=0.125, max_step=0.125)


def bar(rubber, cells=(2, 1, 1), kind=HEXAHEDRON):
    """Half of a bar, cut at y = 0, that a traction bends and lets go."""
    mesh = meshes.box((0.02, 0.004, 0.005), cells, kind=kind)
    load = tg.Traction("x1", (0.0, 0.0, 300.0), history=UP_AND_DOWN)
    return tg.Model(mesh, {"body": rubber}, [tg.Fixed("x0"), tg.Fixed("y0", "y")], [load])


def whole_bar(rubber):
    half = bar(rubber)
    mesh = meshes.box((0.02, 0.008, 0.005), (2, 2, 1), kind=HEXAHEDRON)
    return tg.Model(mesh, {"body": rubber}, [tg.Fixed("x0")], half.loads)


def rises(solution, plane=0.0):
    """Displacement of the end at every state [m], in the mirror plane."""
    mesh = solution.model.mesh
    nodes = np.flatnonzero((mesh.points[:, 0] == 0.02) & (np.abs(mesh.points[:, 1] - plane) < 1e-9))
    return np.array([state.displacement[nodes, 2].mean() for state in solution.states])


@pytest.fixture(scope="module")
def cycled():
    return tg.solve(bar(BOTH), CYCLE, options=OPTIONS)


def test_a_half_is_the_whole(cycled):
    whole = tg.solve(whole_bar(BOTH), CYCLE, options=OPTIONS)
    half = rises(cycled)
    assert rises(whole, 0.004) == pytest.approx(half, abs=1e-5 * half.max())
    assert half[-1] > 0.02 * half.max()


def test_the_material_stays_where_the_next_stage_begins(cycled):
    """Unloaded for long, network B relaxes and the set stays."""
    stages = tg.Stages((tg.Stage("cycle", CYCLE), tg.Stage("rest", Static(duration=1e9, first_step=1.0, max_step=1.0))))
    rested = tg.solve(bar(BOTH), stages, options=OPTIONS)
    end, cycle = rises(rested), rises(cycled)
    assert end[len(cycle) - 1] == pytest.approx(cycle[-1], rel=1e-6)
    plain = replace(BOTH, permanent_set=None)
    forgets = rises(tg.solve(bar(plain), stages, options=OPTIONS))
    assert abs(forgets[-1]) < 0.1 * abs(end[-1])


def test_viscous_forces_do_not_take_what_the_set_takes():
    rubber = replace(BOTH, viscoelasticity=None)
    solution = tg.solve(bar(rubber), Stabilized(max_step=0.05), options=OPTIONS)
    energies = solution.states[-1].energies
    assert energies.lasting > 0.02 * max(state.energies.strain for state in solution.states)
    assert energies.dissipated == pytest.approx(energies.lasting, rel=0.05)
    assert max(abs(state.energies.missing) for state in solution.states) < 0.05 * energies.dissipated


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_a_finer_mesh_takes_the_networks_over(kind):
    solution = tg.solve(bar(BOTH, kind=kind), replace(CYCLE, first_step=0.5, max_step=0.5), options=OPTIONS)
    mesh, state = solution.model.mesh, solution.states[-1]
    fine = refined(mesh, 0.3)
    memory = Transfer(mesh, fine).memory(state.memory)
    for name, flow in memory.flow.items():
        assert flow.shape[:2] == (2, len(fine.mesh.regions[name])) and flow.shape[3] == 10
        volume = np.linalg.det(flow[..., :9].reshape(*flow.shape[:3], 3, 3))
        assert volume == pytest.approx(1.0, abs=1e-12)
        assert (flow[0, ..., 9] >= 0).all() and flow[0, ..., 9].max() > 0
    assert isinstance(memory, Memory)


def test_a_guide_and_a_gradient_refuse_it(cycled):
    plain = tg.solve(bar(PLAIN), Static(), options=OPTIONS)
    with refused("guide", "'body'"):
        tg.solve(bar(replace(BOTH, viscoelasticity=None)), Static(), guide=plain, options=OPTIONS)
    lasting = tg.solve(bar(replace(BOTH, viscoelasticity=None)), Static(), options=OPTIONS)
    assert "permanent_set" in depends_on_history(lasting, lasting.states[-1])
    assert "relaxes" in depends_on_history(cycled, cycled.states[-1])


def test_a_history_gives_back_the_memory_it_was_made_of(cycled):
    memory = cycled.states[-1].memory
    again = System(cycled.model).history(memory, 0.3).memory
    assert again is not None and set(again.flow) == {"body"}
    assert np.array_equal(again.flow["body"], memory.flow["body"])


def of_cauchy_green(C):
    """Gradient (1, 1, 3, 3) without rotation, of the six components of C."""
    values, vectors = np.linalg.eigh(C[np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])])
    return ((vectors * np.sqrt(values)) @ vectors.T)[None, None]


def test_softened_rubber_that_flows_has_an_exact_tangent():
    """Below the largest energy and beyond the yield stress at once, as where a load turns around."""
    plastic = tg.laws.PermanentSet(stress=1e5, exponent=2.0)
    material = replace(PLAIN, permanent_set=plastic, stress_softening=tg.laws.Mullins(r=1.5, m=1e4))
    flow = flow_at_rest(material, (1, 1))
    flow[..., 9] = 0.01
    (network,) = flow_networks(material, flow, np.full((1, 1), 1.5e4), 0.0)
    C, h = np.array([1.5, 0.9, 0.8, 0.1, -0.05, 0.07]), 1e-6
    assert network.end(of_cauchy_green(C))[0, 0, 9] > 0.02
    full, lower = np.empty((6, 6)), np.tril_indices(6)
    full[lower] = full.T[lower] = network.response(of_cauchy_green(C))[1][0, 0]
    for w, step in enumerate(h * np.eye(6)):
        ends = [network.response(of_cauchy_green(C + sign * step))[0][0, 0] for sign in (1, -1)]
        slope = (ends[0] - ends[1]) / (2 * h) * (2.0 if w < 3 else 1.0)
        assert slope == pytest.approx(full[:, w], abs=1e-6 * np.abs(full).max())
