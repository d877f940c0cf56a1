"""Cells that fold about a corner get a finding (N06), and no integration point of a state is turned inside out."""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.fields import cell_fields
from turgor.core.engine.system import System
from turgor.core.materials.laws.laws import CompressibleNeoHooke
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.solvers.checks.distortion import turned_cells

MU = 0.24e6
RUBBER = problems.rubber(tg.laws.NeoHooke(C10=MU / 2), bulk_modulus=4.5 * MU)
FOAM = problems.rubber(CompressibleNeoHooke(mu=MU, nu=0.396))


def pressed(material, cells, kind, depth=0.8):
    """A cube between plates that it sticks to."""
    push = tg.Displacement("z1", lambda X, t: -depth * t * X * [0, 0, 1.0], "xyz")
    mesh = meshes.box((0.01, 0.01, 0.01), cells, kind=kind)
    return tg.Model(mesh, {"body": material}, [tg.Fixed("z0"), push], [])


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
@pytest.mark.parametrize("material", [RUBBER, FOAM], ids=["rubber", "foam"])
def test_a_cube_that_folds_over_its_plates_is_reported(kind, material):
    solution = problems.solve(pressed(material, (2, 2, 2), kind))
    (found,) = (each for each in solution.findings if each.code == "N06")
    count = 8 if kind is HEXAHEDRON else 4
    assert f"{count} cells are turned inside out" in found.message
    for state in solution.states:
        assert cell_fields(state.model, state.displacement, state.mean_stress).volume_ratio.min() > 0


def test_a_little_squeeze_turns_nothing():
    model = pressed(RUBBER, (2, 2, 2), HEXAHEDRON, depth=0.2)
    assert not turned_cells(model, problems.solve(model).states)


@pytest.mark.parametrize("material", [RUBBER, FOAM], ids=["rubber", "foam"])
def test_no_iterate_has_a_turned_integration_point(material):
    """The engine evaluates no residual where the volume ratio of any point is zero or less."""
    system = System(pressed(material, (1, 1, 1), HEXAHEDRON))
    for depth, allowed in ((0.9, True), (1.5, False)):
        unknowns = np.zeros(system.size)
        unknowns[2 : 3 * system.node_count : 3] = -depth * system.points[:, 2]
        assert (system.evaluate(unknowns, 1.0) is not None) == allowed
