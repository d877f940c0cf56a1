"""A woven sheet pulled off its axes: modulus, contraction and shear; a woven shell bent along warp, weft and bias.

Off-axis pull: a square of fabric whose warp is at θ from the pull. Its ends move apart and are free across the pull, so
that the stress is uniaxial. Exact (Jones 1999, Mechanics of Composite Materials, Eq. 2.97): the modulus E(θ), the
contraction and the shear per strain. The square lies on rubber that bears 1e-6 of the force. Tolerance: 0.2 %, of the
strain of 0.05 %.

Bending: a strip of woven shell is clamped at one end, its long edges slide in mirror planes, and a dead load per area
deflects it by 0.1 % of its length. Exact: f l⁴ / (8 D), with D that of the strip's direction without contraction. On
the bias, D is Q₁₁ of the turned plane-stress moduli, because the mirror planes suppress the twist. Tolerance: 1 %.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.units import MPa, Pa, mm

E1, E2, G, NU = 400 * MPa, 150 * MPa, 12 * MPa, 0.25
FABRIC = tg.Material(name="fabric", law=tg.laws.Woven(E=E1, E_weft=E2, G=G, nu=NU))
THICKNESS, SIDE, THIN = 0.3 * mm, 10 * mm, 0.05 * mm
SOFT = problems.rubber(tg.laws.NeoHooke(C10=1 * Pa))
STRAIN = 5e-5

KINDS = pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
ANGLES = pytest.mark.parametrize("angle", [0, 20, 45, 90])


def _pulled(angle, kind):
    """Modulus [Pa], and contraction and shear per strain, of a square pulled along x."""
    mesh = meshes.box((SIDE, SIDE, THIN), (3, 3, 1), kind=kind)
    corner = meshes.single_node(meshes.node_at(mesh, (0, 0, 0)), mesh.faces["x0"].shape[1])
    mesh = meshes.with_faces(mesh, corner=corner)
    sheet = tg.Membrane(
        FABRIC, THICKNESS, warp=(np.cos(angle), np.sin(angle), 0.5)
    )  # what is across the face is nothing
    supports = [
        tg.Fixed("z0", "z"), tg.Fixed("corner", "y"), tg.Fixed("x0", "x"),
        tg.Displacement("x1", (STRAIN * SIDE, 0, 0), "x"),
    ]  # fmt: skip
    model = tg.Model(mesh, {"body": SOFT, "z0": sheet}, supports, [])
    state = problems.solve(model, tg.Static(first_step=1.0)).states[-1]
    force = float(problems.reaction(state, "x1")[0])
    move = {at: state.displacement[meshes.node_at(mesh, (*at, 0))] for at in ((0, SIDE), (SIDE, 0))}
    young = force / (SIDE * THICKNESS * STRAIN)
    return young, -move[0, SIDE][1] / (SIDE * STRAIN), move[SIDE, 0][1] / (SIDE * STRAIN)


@KINDS
@ANGLES
def test_off_axis_pull(angle, kind, record_verification):
    c, s = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    young = 1 / (c**4 / E1 + s**4 / E2 + c**2 * s**2 * (1 / G - 2 * NU / E1))
    contraction = young * (NU / E1 * (c**4 + s**4) - c**2 * s**2 * (1 / E1 + 1 / E2 - 1 / G))
    shear = young * (c**3 * s * (2 / E1 + 2 * NU / E1 - 1 / G) - c * s**3 * (2 / E2 + 2 * NU / E1 - 1 / G))
    got = _pulled(np.deg2rad(angle), kind)
    record_verification(
        claim=f"fabric pulled at {angle}° from its warp, {kind.name}: modulus [MPa], contraction and shear per strain",
        source="Jones 1999, exact",
        expected=[young / MPa, contraction, shear],
        got=[got[0] / MPa, *got[1:]],
        tolerance="0.2 %",
    )
    assert got == pytest.approx([young, contraction, shear], rel=2e-3, abs=1e-3)
    assert FABRIC.law.modulus_along(np.deg2rad(angle)) == pytest.approx(young)


LENGTH, WIDTH, SLAB = 40 * mm, 5 * mm, 1 * mm


def _sunk(angle, kind):
    """How far the end of a clamped strip sinks, over f l⁴ / 8 [1 / (N m)]."""
    mesh = meshes.box((LENGTH, WIDTH, SLAB), (12, 2, 1), kind=kind)
    sheet = tg.Shell(FABRIC, THICKNESS, warp=(np.cos(angle), np.sin(angle), 0))
    load = 1e-3 * LENGTH * 8 * _stiffness(angle) / LENGTH**4
    supports = [tg.Fixed("x0"), tg.supports.Symmetry("y0"), tg.Fixed("y1", "y")]
    model = tg.Model(mesh, {"body": SOFT, "z0": sheet}, supports, [tg.Traction("z0", (0.0, 0.0, load))])
    state = problems.solve(model, tg.Static(first_step=1.0)).states[-1]
    return float(state.displacement[meshes.node_at(mesh, (LENGTH, 0, 0)), 2]) / (load * LENGTH**4 / 8)


def _stiffness(angle):
    """Bending stiffness [N m] along x of a strip that neither contracts nor twists."""
    c, s = np.cos(angle), np.sin(angle)
    whole = 1 - NU**2 * E2 / E1
    Q = c**4 * E1 + s**4 * E2 + 2 * c**2 * s**2 * (NU * E2 + 2 * G * whole)
    return Q / whole * THICKNESS**3 / 12


@KINDS
@ANGLES
def test_bending(angle, kind, record_verification):
    expected, got = 1 / _stiffness(np.deg2rad(angle)), _sunk(np.deg2rad(angle), kind)
    record_verification(
        claim=f"strip of woven shell, {angle}° from its warp, {kind.name}: deflection over f l⁴ / 8 [1 / (N m)]",
        source="Kirchhoff",
        expected=expected,
        got=got,
        tolerance="1 %",
    )
    assert got == pytest.approx(expected, rel=0.01)
