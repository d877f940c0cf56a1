"""Hexahedra: the tangent has the mean stress of the volume penalty that is linear in the last update."""

import numpy as np

import meshes
import problems
import turgor as tg
from turgor.core.engine.system import Stresses, System
from turgor.core.meshing.cells import HEXAHEDRON

SPIN = 0.2 * np.array([[0.0, -1.0, 0.4], [1.0, 0.0, -0.7], [-0.4, 0.7, 0.0]])


def _turned():
    """A block, the first order of a turn as an update, the equations after it, and the linearized stresses."""
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1), kind=HEXAHEDRON)
    system = System(tg.Model(mesh, {"body": problems.rubber(problems.YEOH)}, [tg.Fixed("x0")], []))
    update = system.unknowns(mesh.points @ SPIN.T, np.zeros(system.element.mean_count))
    rest = system.evaluate(np.zeros(system.size), 0.0)
    return system, system.evaluate(update, 0.0), system.stresses(rest, update)


def test_an_update_that_turns_a_cell_gives_the_penalty_no_stress():
    system, after, linearized = _turned()
    exact = system.stresses(after)
    assert np.abs(linearized.cells[..., 6]).max() < 1e-10
    assert np.abs(exact.cells[..., 6]).min() > 0.1  # the cell has grown by the second order of the turn


def test_the_tangent_takes_the_linearized_one():
    """The moduli of the penalty differ; with the exact stresses the tangent is that of the state itself."""
    system, after, linearized = _turned()
    exact = system.stresses(after)
    half = Stresses(np.concatenate([exact.cells[..., :6], linearized.cells[..., 6:]], axis=2), exact.terms)
    tangent = system.tangent_data(after)
    size = np.abs(tangent).max()
    assert np.abs(system.tangent_data(after, exact) - tangent).max() < 1e-12 * size
    assert np.abs(system.tangent_data(after, half) - tangent).max() > 1e-2 * size
