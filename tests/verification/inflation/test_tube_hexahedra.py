"""V05 on hexahedra: the tube that `test_tube` inflates, on curved 27-node hexahedra.

Problem: thick incompressible neo-Hookean tube held at its length, inner radius 5 mm, outer 7 mm, inflated to λ = 1.5.
Exact: pressure 0.05805014 MPa, axial force 6.51663 N.
Source: Green and Zerna.
Tolerance: 0.1 % of the inner radius with a single cell through the wall and three around a quarter; halving the cells
must reduce the error at least eightfold (the radius converges like an energy, at order 4 in the limit).
"""

import pytest
from thick_tube import INNER, OUTER, inflate

import meshes
import problems
from turgor.core.meshing.cells import HEXAHEDRON

PRESSURE, FORCE = 0.05805014 * problems.MPA, 6.51663


def _inflated(through):
    mesh = meshes.tube_sector(INNER, OUTER, 1 * problems.MM, (through, 3 * through, 1), kind=HEXAHEDRON)
    state = inflate(problems.NEO_HOOKE, [0.5 * PRESSURE, PRESSURE], mesh)[-1]
    force = mesh.symmetry_factor * float(problems.reaction(state, "z1")[2])
    return problems.mean_radius(state, "cavity", (0, 1)) / INNER, force


def test_radius_force_and_rate(record_verification):
    coarse, force = _inflated(1)
    fine, _ = _inflated(2)
    gain = abs(coarse - 1.5) / abs(fine - 1.5)
    record_verification(
        claim="thick tube, one 27-node hexahedron through the wall: inner stretch, axial force [N]",
        source="V05, exact",
        expected=[1.5, FORCE],
        got=[coarse, force],
        tolerance="0.1 %, 0.2 %",
    )
    record_verification(
        claim="thick tube, 27-node hexahedra: error of the inner stretch, 1 cell through the wall over 2",
        source="V05, exact",
        expected=16,
        got=gain,
        tolerance="at least 8",
    )
    assert coarse == pytest.approx(1.5, rel=1e-3)
    assert force == pytest.approx(FORCE, rel=2e-3)
    assert gain > 8
