"""Fields of a state: stresses and stretches at the quadrature points, averages at the nodes, energies."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.boundary import prescribed_components
from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.cells.cell_materials import CellMaterials
from turgor.core.engine.cells.cell_terms import CellTerms
from turgor.core.engine.cells.element import Element, element_of, tables_with
from turgor.core.engine.cells.internal_variables import Memory, bonds_of
from turgor.core.engine.cells.reference import reference_cell, reference_nodes, smooth_basis, tables_at
from turgor.core.engine.cells.stabilization import penalty_energy
from turgor.core.engine.cells.states.body_states import has_states, networks_of, rest_of, stiffness_of
from turgor.core.engine.faces.membranes import MEMBRANE_QUADRATURE_DEGREE, surface_frames
from turgor.core.engine.points.motion import PointMotion, carrier_displacement
from turgor.core.engine.points.point_unknowns import carriers_of, with_carrier_points
from turgor.core.engine.term import Setting
from turgor.core.engine.terms import Terms
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.region_nodes import RegionNodes
from turgor.core.model.model import Model
from turgor.foundation.display import brief

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CellFields:
    """Fields at the quadrature points of the cells.

    Parameters
    ----------
    cauchy : (c, q, 3, 3) array [Pa]
        Cauchy stress.
    mean_stress : (c, q) array [Pa]
        Mean stress, positive in tension.
    von_mises : (c, q) array [Pa]
        Von Mises stress.
    stretch : (c, q) array [-]
        Largest principal stretch, from the stress-free configuration of the point.
    volume_ratio : (c, q) array [-]
        J = det F, from the mesh at rest.
    weight : (c, q) array [m³]
        Reference volume of each point.
    """

    cauchy: Array
    mean_stress: Array
    von_mises: Array
    stretch: Array
    volume_ratio: Array
    weight: Array

    __repr__ = brief

    @property
    def principal_stress(self) -> Array:
        """Largest principal Cauchy stress, (c, q) [Pa]."""
        return _largest_eigenvalue(self.cauchy, _trace(self.cauchy))

    @property
    def nominal_stress(self) -> Array:
        """Nominal stress along the largest principal stretch, (c, q) [Pa]: force per initial area, J σ₁ / λ₁."""
        return self.volume_ratio * self.principal_stress / self.stretch


@lru_cache(maxsize=2)
def _geometry(mesh: Mesh, points: int) -> tuple[Array, Array]:
    """Inverse Jacobian and weight at that many integration points of each cell."""
    cells = mesh.carrying_cells
    r = tables_with(cells.shape[1], points)
    return kernels_geometry.reference_geometry((0,) * cells.shape[1], mesh.points, cells, r.dN, r.weights)


def _mean_stress(model: Model, element: Element, J: Array, mean_stress: Array, compliance: Array) -> Array:
    """Mean stress (c, q) at the integration points."""
    if not element.modes:
        return np.asarray((J - 1) / compliance[:, None])
    return np.einsum("qm,cm->cq", element.tables.M, mean_stress[element.mean])


def cell_fields(
    model: Model, displacement: Array, mean_stress: Array, memory: Memory | None = None, load_factor: float = 1.0
) -> CellFields:
    """Compute stresses and stretches at the quadrature points.

    Parameters
    ----------
    model : Model
    displacement : (n, 3) array [m]
    mean_stress : (m,) array [Pa]
        The mean stresses of a `State`.
    memory : Memory, optional
        What its rubber remembers, where any relaxes or softens; by default the deformation is a sudden one from rest.
    load_factor : float
        That of the state, where loads set states of bodies.
    """
    element = element_of(model)
    r = element.tables
    F, weight = deformation_gradients(model, displacement)
    materials = CellMaterials(model, 1.0, len(r.weights))
    J = ratio = _determinant(F)
    if has_states(model):
        rest = rest_of(model, _places(model), load_factor)
        F, J = F @ rest.inverse, ratio / rest.volume
        Jinv, _ = _geometry(model.mesh, len(r.weights))

        def shaped(cells: NDArray[np.int64], u: Array) -> Array:
            return kernels_geometry.deformation_gradients(element.shape, element.cells[cells], u, r.dN, Jinv[cells])

        networks = networks_of(model, materials.rows, rest, load_factor, shaped)
        materials = materials.with_states(stiffness_of(model, load_factor), networks)
    B = F @ F.swapaxes(-1, -2)
    I1 = _trace(B)
    I2 = 0.5 * (I1**2 - _squared(B))
    j = J ** (-2 / 3)
    chosen = F[materials.gradient_cells]
    laws = materials.isochoric(j * I1, j * j * I2, chosen, materials.history(memory))  # a sudden step: its own stress
    W1, W2 = laws.derivatives[:2]
    identity = np.eye(3)
    mean = _mean_stress(model, element, J, mean_stress, materials.compliance)
    # dev σ = 2/J dev [(j W₁ + j² I₁ W₂) B − j² W₂ B²]; to it comes the mean stress: the volumetric energy is p (J − 1)
    deviator = _deviator((2 / J * (j * W1 + j * j * I1 * W2))[..., None, None] * B)
    if W2.any():
        deviator -= _deviator((2 / J * j * j * W2)[..., None, None] * (B @ B))
    if len(chosen):
        second = laws.stress[..., [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
        pushed = chosen @ second @ chosen.swapaxes(-1, -2)
        deviator[materials.gradient_cells] += pushed / J[materials.gradient_cells, :, None, None]
    if any(material.is_foam for material in model.region_materials.values()):
        mean = mean + _trace(deviator) / 3  # the law of a foam has a mean stress of its own
        deviator = _deviator(deviator)
    von_mises = np.sqrt(1.5 * _squared(deviator))
    return CellFields(
        cauchy=deviator + mean[..., None, None] * identity,
        mean_stress=mean,
        von_mises=von_mises,
        stretch=np.sqrt(_largest_eigenvalue(B, I1)),
        volume_ratio=ratio,
        weight=weight,
    )


def deformation_gradients(model: Model, displacement: Array) -> tuple[Array, Array]:
    """Return the deformation gradients F (c, q, 3, 3) at the quadrature points, and their volumes (c, q) [m³]."""
    mesh, element = model.mesh, element_of(model)
    dN = element.tables.dN
    Jinv, weight = _geometry(mesh, len(element.tables.weights))
    return kernels_geometry.deformation_gradients(element.shape, element.cells, displacement, dN, Jinv), weight


def _places(model: Model) -> Array:
    """Integration points at rest (c, q, 3) [m]."""
    element = element_of(model)
    return np.einsum("qa,cai->cqi", element.tables.N, model.mesh.points[element.cells])


def elastic_gradients(model: Model, displacement: Array, load_factor: float) -> tuple[Array, Array]:
    """Return `deformation_gradients` from the stress-free configuration at a load factor."""
    F, weight = deformation_gradients(model, displacement)
    return (F @ rest_of(model, _places(model), load_factor).inverse if has_states(model) else F), weight


def _determinant(A: Array) -> Array:
    """Determinants of 3 × 3 arrays; several times faster than a factorization of each."""
    (a, b, c), (d, e, f), (g, h, i) = np.moveaxis(A, (-2, -1), (0, 1))
    return np.asarray(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))


def _trace(A: Array) -> Array:
    """Traces of 3 × 3 arrays; three times faster than `numpy.trace`, with the same digits."""
    return np.asarray(A[..., 0, 0] + A[..., 1, 1] + A[..., 2, 2])


def _deviator(A: Array) -> Array:
    """Return A − (tr A / 3) I, in place."""
    mean = _trace(A) / 3
    for i in range(3):
        A[..., i, i] -= mean
    return A


def _squared(A: Array) -> Array:
    """Sum of the squares of all components, A : A."""
    return np.einsum("...ij,...ij->...", A, A)


def _largest_eigenvalue(B: Array, trace: Array) -> Array:
    """Largest eigenvalue of symmetric 3 × 3 arrays by the trigonometric formula; exact for equal eigenvalues."""
    deviator = _deviator(B.copy())
    size = np.sqrt(_squared(deviator) / 6)
    safe = np.where(size > 0, size, 1.0)
    half_det = np.clip(_determinant(deviator) / (2 * safe**3), -1, 1)
    return np.asarray(trace / 3 + 2 * size * np.cos(np.arccos(half_det) / 3))


def nodal_average(mesh: Mesh, values: Array, nodes: RegionNodes) -> Array:
    """Carry values (c, q, ...) from quadrature points to the nodes of the regions (d, ...).

    In each cell a linear field (a trilinear one in hexahedra) is fitted to the points and evaluated at the nodes; at a
    node the values of the cells of one region are averaged, weighted by volume. Across a border between regions
    nothing is averaged: stresses jump there.
    """
    nodes_of_cell = mesh.cell_type.nodes
    r = tables_with(nodes_of_cell, values.shape[1])
    root = np.sqrt(r.weights)[:, None]
    fit = np.linalg.pinv(root * smooth_basis(nodes_of_cell, r.points)) * root.T
    at_nodes = smooth_basis(nodes_of_cell, reference_nodes(nodes_of_cell)) @ fit
    local = np.einsum("aq,cqk->cak", at_nodes, values.reshape(*values.shape[:2], -1))
    volume = _geometry(mesh, values.shape[1])[1].sum(axis=1)
    return _averaged(local, volume, nodes).reshape(len(nodes.node), *values.shape[2:])


def film_average(model: Model, values: Array) -> Array:
    """Carry values (f, 4, ...) from 2 × 2 points of the sides of films, in the order of the model, to the nodes.

    In each side a bilinear field goes through the points; at a node the values of its sides are averaged by area. The
    means of sides would cut off the peaks at corners of folds, by a tenth on default meshes.
    """
    nodes = np.concatenate([model.mesh.face(name) for name in model.membranes])
    frames, kind = surface_frames(model.mesh.points, nodes), nodes.shape[1]
    rule = reference_cell(kind, MEMBRANE_QUADRATURE_DEGREE[4])
    at_nodes = smooth_basis(kind, reference_nodes(kind)) @ np.linalg.inv(smooth_basis(kind, rule.points))
    local = np.einsum("aq,fqk->fak", at_nodes, values.reshape(*values.shape[:2], -1))
    area, count = frames.areas.sum(axis=1), len(model.mesh.points)
    weights = np.repeat(area, kind)
    sums = [np.bincount(nodes.ravel(), weights * each, count) for each in local.reshape(-1, local.shape[2]).T]
    mean = np.stack(sums, axis=1) / np.maximum(np.bincount(nodes.ravel(), weights, count), 1e-300)[:, None]
    return np.asarray(mean.reshape(count, *values.shape[2:]))


def nodal_mean_stress(model: Model, mean_stress: Array, nodes: RegionNodes) -> Array:
    """Mean stress (d,) at the nodes of the regions [Pa] from the mean stresses (m,) of a `State`.

    In each cell it is interpolated between the values of the cell; where cells of one region have different ones at a
    node, they are averaged.
    """
    mesh, element = model.mesh, element_of(model)
    at_nodes = tables_at(mesh.cell_type.nodes, reference_nodes(mesh.cell_type.nodes), np.ones(mesh.cell_type.nodes)).M
    local = np.einsum("am,cm->ca", at_nodes, mean_stress[element.mean])
    volume = _geometry(mesh, len(element.tables.weights))[1].sum(axis=1)
    return _averaged(local[..., None], volume, nodes)[:, 0]


def _averaged(local: Array, volume: Array, nodes: RegionNodes) -> Array:
    """Average (d, k) of what each cell has at its nodes (c, a, k), weighted by volume (c,)."""
    at, count = nodes.cells.ravel(), len(nodes.node)
    total = np.bincount(at, np.repeat(volume, nodes.cells.shape[1]), minlength=count)
    weighted = (local * volume[:, None, None]).reshape(len(at), -1)
    return np.stack([np.bincount(at, column, minlength=count) / total for column in weighted.T], axis=1)


def strain_energy(
    model: Model,
    displacement: Array,
    mean_stress: Array,
    memory: Memory | None = None,
    points: Mapping[str, PointMotion] | None = None,
    load_factor: float = 1.0,
) -> float:
    """Stored energy of cells, sheets, fibers and springs of the modeled part [J].

    Where a material is compressible its volumetric energy is p²/(2κ), with κ (J − 1) = p. Of a rubber that relaxes or
    softens it is what infinitely slow unloading gives back; ``memory`` is that of the state. Springs of reference
    points need their motions ``points``; a point without one moves with its face. The ``load_factor`` is that of the
    state, where loads set states of bodies and windings.
    """
    carriers = carriers_of(model)
    rest = with_carrier_points(model.mesh.points, carriers)
    whole, element = CellTerms(model, rest, 1.0, 1.0), element_of(model)
    cells = whole.at(load_factor)
    materials = cells.materials
    u = np.concatenate([displacement, carrier_displacement(carriers, (1.0, 1.0), displacement, points or {})])
    I1, I2, J = cells.kinematics(u)
    mean = _mean_stress(model, element, J, mean_stress, materials.compliance)
    F = cells.gradients_of_laws(u)
    density = materials.energy(I1, I2, F, materials.history(memory)) + 0.5 * mean**2 * materials.compliance[:, None]
    lost = penalty_energy(cells.penalty, cells.dV, J - 1 - mean * materials.compliance[:, None])
    terms = Terms(Setting(model, rest, prescribed_components(model).along_axes, whole.dV, 1.0, 1.0))
    stored = float((cells.dV * density).sum() + lost.sum())
    return stored + terms.energy(rest + u, load_factor, bonds_of(memory))
