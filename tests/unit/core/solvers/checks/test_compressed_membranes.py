"""A membrane that is compressed on the path gets a finding that says what a shell would do (N05)."""

from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases

import meshes
from turgor.core.engine.faces.membrane_term import bending_energy
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.loads import Pressure, Traction
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane, Shell
from turgor.core.model.supports import Fixed
from turgor.core.solvers.checks.membranes import compressed_membranes
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solve import solve
from turgor.foundation.finding import Severity
from turgor.units import GPa, kPa, mm

FILM = Material(name="film", law=Hooke(E=1 * GPa, nu=0.3))


def findings(stretch, sheet):
    """Of a block with a sheet on its sides, in uniaxial tension by formula."""
    mesh = cases.body(hollow=False)
    materials = dict.fromkeys(mesh.regions, cases.RUBBER) | {"outside": sheet}
    model = Model(mesh, materials, [Fixed("fixed")], [Traction("tip", (1e3, 0.0, 0.0))])
    state = cases.state(model, lambda X: X * [stretch, stretch**-0.5, stretch**-0.5])
    return compressed_membranes(model, [state])


def test_a_compressed_membrane_is_found_and_a_shell_or_a_wrinkling_film_is_not():
    (finding,) = findings(0.97, Membrane(FILM, 0.1 * mm))
    assert finding.code == "N05" and finding.severity is Severity.WARNING
    assert "The membrane on 'outside' is compressed in 100 % of its area at load factor 1" in finding.message
    assert "store less than 1 % of the energy of the actuator" in finding.message and 'form = "shell"' in finding.advice
    assert findings(0.97, Shell(FILM, 0.1 * mm)) == ()
    assert findings(0.97, Membrane(FILM, 0.1 * mm, compression=0.0)) == ()


def test_little_compression_is_a_note():
    (finding,) = findings(0.99999, Membrane(FILM, 0.1 * mm))
    assert finding.severity is Severity.NOTE and "wrinkles on finer meshes" in finding.message


def test_a_solve_has_the_finding():
    mesh = meshes.box((20 * mm, 5 * mm, 2 * mm), (4, 1, 1))
    materials = {"body": cases.RUBBER, "z0": Membrane(FILM, 0.1 * mm)}
    model = Model(mesh, materials, [Fixed("x0")], [Pressure("z1", 0.1 * kPa)])
    results = {each.code: each for each in solve(model, Static()).findings}
    assert "(from " in results["N05"].message or " at 0.1 kPa, by" in results["N05"].message


@pytest.mark.parametrize("own", [None, 1e-5])
@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_energy_of_a_sheet_rolled_to_a_cylinder(kind, own):
    """½ D κ² per area, whatever the cells; D is that of a plate or that of the fabric."""
    length, width, kappa = 20 * mm, 5 * mm, 1 / (20 * mm)
    sheet = Membrane(replace(FILM, bending_stiffness=own), 0.1 * mm)
    mesh = meshes.box((length, width, 2 * mm), (12, 2, 1), kind=kind)
    x, _, z = mesh.points.T
    moved = np.column_stack([(1 / kappa - z) * np.sin(kappa * x), mesh.points[:, 1],
                             1 / kappa - (1 / kappa - z) * np.cos(kappa * x)])  # fmt: skip
    model = Model(mesh, {"body": cases.RUBBER, "z0": sheet}, [Fixed("x0")], [])
    D = own or 1 * GPa * (0.1 * mm) ** 3 / 12 / (1 - 0.3**2)
    assert Shell(sheet.material, 0.1 * mm).bending_stiffness == pytest.approx(D)
    assert bending_energy(model, "z0", moved - mesh.points) == pytest.approx(
        D * kappa**2 / 2 * length * width, rel=0.02
    )
