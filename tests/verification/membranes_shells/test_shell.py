"""A sheet in a rubber strip bends it like a plate where it is a shell, and not at all where it is a membrane.

Problem: strip of rubber 40 × 2 mm, one cell deep between two frictionless walls (plane strain), clamped at one end, a
small dead traction across at the other; a stiff sheet of 0.4 mm in its middle plane. Small deflections; hexahedra and
tetrahedra.
Exact: cantilever of bending stiffness D = ∫ E/(1 − ν²) z² dz: F L³/(3 D) + F L/(k G A) of Timoshenko for the rubber
alone (membrane); with the sheet's E h³/(12 (1 − ν²)) added, sections that hold a stiff sheet do not shear as rubber
does, so that F L³/(3 D) remains (shell). Sheets of 60 MPa and of 6.5 GPa, as stiff as paper.
Source: plate theory; Timoshenko's beam. Tolerance: 2 % of the deflection (the clamp restrains the end of a real strip,
and the shear of the rubber beside the sheet is not that of a homogeneous section).
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

L, H, T = 40e-3, 2e-3, 0.4e-3
RUBBER, SHEET = tg.laws.NeoHooke(C10=0.12e6), tg.laws.Hooke(E=60e6, nu=0.3)


def _tip(kind, sheet):
    mesh = meshes.box((L, H, 1e-3), (20 if kind is HEXAHEDRON else 40, 2, 1), kind=kind)
    middle = _plane(mesh, kind)
    mesh = meshes.with_faces(mesh, sheet=middle)
    materials = {"body": problems.rubber(RUBBER), "sheet": sheet}
    force = 1e-4 * RUBBER.shear_modulus
    supports = [tg.Fixed("x0"), *problems.PLANE_STRAIN]
    model = tg.Model(mesh, materials, supports, [tg.Traction("x1", (0.0, force, 0.0))])
    state = problems.solve(model, tg.Static(first_step=1.0)).states[-1]
    return float(state.displacement[mesh.face_nodes("x1"), 1].mean()) / (force * H)


def _plane(mesh, kind):
    sides = mesh.cells[:, np.array(kind.sides)].reshape(-1, kind.side.nodes)
    on = (np.abs(mesh.points[sides][:, :, 1] - H / 2) < 1e-9).all(axis=1)
    _, first = np.unique(np.sort(sides[on], axis=1), axis=0, return_index=True)
    return sides[on][first]


def _deflection(stiffness):
    shear = 5 / 6 * RUBBER.shear_modulus * H
    return L**3 / (3 * stiffness) + L / shear


@pytest.mark.parametrize("modulus", [60e6, 6.5e9], ids=["soft", "paper"])
@pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=["hexahedra", "tetrahedra"])
def test_bending_of_a_strip_with_a_sheet(modulus, kind, record_verification):
    material = tg.Material(name="sheet", law=tg.laws.Hooke(E=modulus, nu=SHEET.nu))
    rubber = 4 * RUBBER.shear_modulus * H**3 / 12  # E / (1 − ν²) is 4 µ where ν is ½
    plate = modulus / (1 - SHEET.nu**2) * T**3 / 12
    expected = [_deflection(rubber), L**3 / (3 * (rubber + plate))]
    got = [_tip(kind, tg.Membrane(material, T)), _tip(kind, tg.Shell(material, T))]
    record_verification(
        claim=f"strip with a sheet of {modulus / 1e6:g} MPa, {kind.name}: tip over force, membrane and shell [m/N m]",
        source="plate theory",
        expected=expected,
        got=got,
        tolerance="2 %",
    )
    assert got == pytest.approx(expected, rel=0.02)
