"""Fields carried to a refined mesh are the same fields wherever the coarser mesh can represent them."""

import numpy as np
import pytest
from lattice_cases import KINDS, curved, lattice, refined

from turgor.core.engine.cells.element import element_of, tables_with
from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.engine.cells.reference import smooth_basis
from turgor.core.engine.transfer import Transfer
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed

Case = tuple[Mesh, Refinement]
MATERIALS = {name: Material(name=name, law=NeoHooke(C10=C10)) for name, C10 in (("left", 0.1e6), ("right", 1e6))}


@pytest.fixture(scope="module", params=KINDS)
def straight(request: pytest.FixtureRequest) -> Case:
    box = lattice((2, 2, 2), KINDS[request.param])
    return box, refined(box, 0.5)


@pytest.fixture(scope="module", params=KINDS)
def bent(request: pytest.FixtureRequest) -> Case:
    box = lattice((2, 2, 2), KINDS[request.param], curved)
    return box, refined(box, 0.5)


def model(mesh: Mesh, formulation: str = "mixed") -> Model:
    return Model(mesh, MATERIALS, [Fixed("x0")], [], formulation)


def quadratic(points: np.ndarray) -> np.ndarray:
    x, y, z = points.T
    return np.column_stack([1 + x * x - y * z, 2 * x * y - z * z + y, 0.3 * z + x * z - 4 * y * y])


def linear(points: np.ndarray) -> np.ndarray:
    return points @ np.array([1.0, -2.0, 0.7]) + 0.4


def test_a_quadratic_displacement_is_exact(straight: Case) -> None:
    box, fine = straight
    carried = Transfer(box, fine).nodal(quadratic(box.points))
    assert np.abs(carried - quadratic(fine.mesh.points)).max() < 1e-12


def test_positions_are_exact_in_curved_cells(bent: Case) -> None:
    box, fine = bent
    assert np.abs(Transfer(box, fine).nodal(box.points) - fine.mesh.points).max() < 1e-12


@pytest.mark.parametrize("formulation", ["mixed", "continuous"])
def test_a_linear_mean_stress_is_exact(straight: Case, formulation: str) -> None:
    """Mixed: with a jump of 5 at the border between the rubbers."""
    box, fine = straight
    jump = 5.0 if formulation == "mixed" else 0.0
    before, after = (_mean_stress(model(mesh, formulation), jump) for mesh in (box, fine.mesh))
    carried = Transfer(box, fine).mean_stress(model(box, formulation), model(fine.mesh, formulation), before)
    assert len(after) > len(before)
    assert np.abs(carried - after).max() < 1e-12


def _mean_stress(of: Model, jump: float) -> np.ndarray:
    element, mesh = element_of(of), of.mesh
    values = linear(mesh.points)[mesh.cells[:, : mesh.cell_type.corners]]
    values[mesh.regions["right"]] += jump
    out = np.full(element.mean_count, np.nan)
    out[element.mean] = values
    return out


def test_without_mean_stresses_there_is_nothing_to_carry(straight: Case) -> None:
    box, fine = straight
    rubbers = {name: Material(name=name, law=NeoHooke(C10=1e5), bulk_modulus=1e7) for name in MATERIALS}
    before, after = (Model(mesh, rubbers, [Fixed("x0")], [], "displacement") for mesh in (box, fine.mesh))
    assert len(Transfer(box, fine).mean_stress(before, after, np.zeros(0))) == 0


def test_the_memory_of_a_smooth_field_is_exact(straight: Case) -> None:
    """Linear in tetrahedra, trilinear in hexahedra; a second region remembers nothing."""
    box, fine = straight
    before, after = (_memory(mesh) for mesh in (box, fine.mesh))
    carried = Transfer(box, fine).memory(before)
    assert carried is not None
    assert set(carried.stress) == {"left"}
    assert np.abs(carried.stress["left"] - after.stress["left"]).max() < 1e-12
    assert np.abs(carried.largest["left"] - after.largest["left"]).max() < 1e-12
    assert Transfer(box, fine).memory(None) is None


def _memory(mesh: Mesh) -> Memory:
    cells, nodes = mesh.cells[mesh.regions["left"]], mesh.cell_type.nodes
    points = 27 if mesh.cell_type is HEXAHEDRON else 14
    X = np.einsum("qa,cai->cqi", tables_with(nodes, points).N, mesh.points[cells])
    basis = smooth_basis(nodes, X.reshape(-1, 3))
    values = 3 + basis @ np.linspace(-0.5, 0.6, basis.shape[1])
    field = values.reshape(X.shape[:2])
    stress = field[None, :, :, None] * np.arange(1.0, 13).reshape(2, 1, 1, 6)
    return Memory(stress={"left": stress}, largest={"left": field})


def test_no_energy_that_was_largest_becomes_negative(straight: Case) -> None:
    box, fine = straight
    largest = np.zeros((len(box.regions["left"]), 27 if box.cell_type is HEXAHEDRON else 14))
    largest[:, 0] = 1.0
    carried = Transfer(box, fine).memory(Memory(stress={}, largest={"left": largest}))
    assert carried is not None
    assert carried.largest["left"].min() >= 0
