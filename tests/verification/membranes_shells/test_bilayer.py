"""A stiff film on one side of a rubber strip: bending of the composite section, exactly, on any mesh of tetrahedra.

Problem: strip of 20 × 2 mm between two frictionless walls (plane strain) with a film of 0.4 mm and 60 MPa on its lower
side. One end is a mirror plane. The other end turns by a small angle about the neutral axis of the section: its
displacement along the strip is prescribed, linear over the height, and the slope of the film follows the turning side.
Exact: energy ½ D θ²/L with the bending stiffness of the composite, E h³/12 and E t³/12 and both layers about the common
neutral axis, where E stands for E/(1 − ν²). The displacement is quadratic, so that the mesh does not matter.
Source: beam of two layers (as Timoshenko 1925 on bimetals). Tolerance: 1e-5. The
energy of a turn this way and that is averaged; what the linear theory neglects is 1e-6 then.

And the same bilayer as a cantilever with a dead load, large deflection, against hexahedra: 1 % of the deflection.
"""

import numpy as np
import pytest
from turgor.supports import Displacement

import meshes
import problems
import turgor as tg
from sheets import sheet, stiffness
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

L, H, T, E, NU = 20e-3, 2e-3, 0.4e-3, 60e6, 0.3
RUBBER = tg.laws.NeoHooke(C10=0.12e6)
PLANE = 4 * RUBBER.shear_modulus  # E / (1 − ν²) at ν = ½
FILM = E / (1 - NU**2) * T
NEUTRAL = PLANE * H**2 / 2 / (FILM + PLANE * H)
COMPOSITE = PLANE * (H**3 / 12 + H * (H / 2 - NEUTRAL) ** 2) + FILM * NEUTRAL**2 + stiffness(E, T)
ANGLE = 1e-4


def _turning(angle):
    """Turn the end about the neutral axis: only the first component is prescribed."""
    return lambda points, load_factor: load_factor * angle * np.outer(NEUTRAL - points[:, 1], (1.0, 0.0, 0.0))


@pytest.mark.parametrize("counts", [(3, 1, 1), (7, 2, 1)])
def test_turned_end(counts, record_verification):
    width = 1e-3
    mesh = meshes.box((L, H, width), counts)
    mesh = meshes.with_faces(mesh, pin=meshes.single_node(meshes.node_at(mesh, (0, 0, 0))))
    held = [tg.Fixed("x0", "x"), tg.Fixed("pin", "y"), *problems.PLANE_STRAIN]
    materials, energy = {"body": problems.rubber(RUBBER), "y0": sheet(E, T, NU)}, 0.0
    for angle in (ANGLE, -ANGLE):
        model = tg.Model(mesh, materials, [*held, Displacement("x1", _turning(angle), "x")], [])
        energy += problems.energy(problems.solve(model, tg.Static(first_step=1.0, tolerance=1e-8)).states[-1]) / 2
    got = 2 * energy * L / ANGLE**2 / width
    record_verification(
        claim=f"film on a strip, {counts[0]} × {counts[1]} cells: bending stiffness over width [N m]",
        source="beam of two layers",
        expected=COMPOSITE,
        got=got,
        tolerance="1e-5",
    )
    assert got == pytest.approx(COMPOSITE, rel=1e-5)


def _cantilever(kind, cells):
    """Displacement of the tip (x, y) over the length under a dead load on the film."""
    mesh = meshes.box((4 * L, H, 2e-3), (cells, 1, 1), kind=kind)
    load = [tg.Traction("y0", (0.0, 6 * COMPOSITE / (4 * L) ** 3, 0.0))]
    materials = {"body": problems.rubber(RUBBER), "y0": sheet(E, T, NU)}
    model = tg.Model(mesh, materials, [tg.Fixed("x0"), *problems.PLANE_STRAIN], load)
    state = problems.solve(model).states[-1]
    return state.displacement[meshes.node_at(mesh, (4 * L, 0, 0)), :2] / (4 * L)


def test_cantilever_against_hexahedra(record_verification):
    expected, got = _cantilever(HEXAHEDRON, 40), _cantilever(TETRAHEDRON, 40)
    record_verification(
        claim="film on a cantilever strip, tetrahedra: tip (x, y) over the length",
        source="shell on hexahedra",
        expected=expected,
        got=got,
        tolerance="1 %",
    )
    assert np.linalg.norm(expected) > 0.4
    assert np.linalg.norm(got - expected) < 0.01 * np.linalg.norm(expected)
