"""Forms: coefficients of the polynomials of a reduced model, from the mesh and the modes."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.faces.membrane_term import MembraneTerm
from turgor.core.engine.system import System
from turgor.reduced.parts.kernels import constraint_forms
from turgor.reduced.parts.moments import Moments

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Cells whose gradients are in memory at once.
CHUNK = 500


def positions(system: System, vectors: Array) -> Array:
    """Scaled positions at rest and displacements of the modes, (n, 3, R)."""
    return np.concatenate([system.points[:, :, None], vectors.reshape(system.node_count, 3, -1)], axis=2)


def gradients(system: System, vectors: Array, cells: Ints) -> Array:
    """Displacement gradients (c q, 9, r) of the modes (3 n, r) at all Gauss points of some cells."""
    modes = vectors.reshape(system.node_count, 3, -1)
    dN, Jinv = system.element.tables.dN, system.Jinv[cells]
    slopes = np.einsum("qak,cqkJ->cqJa", dN, Jinv, optimize=True)
    c, q, _, nodes = slopes.shape
    by_cell = modes[system.cells[cells]].reshape(c, nodes, -1)
    out = (slopes.reshape(c, 3 * q, nodes) @ by_cell).reshape(c, q, 3, 3, -1)
    return np.ascontiguousarray(out.swapaxes(2, 3)).reshape(c * q, 9, -1)


def chunks(count: int) -> Iterator[Ints]:
    """Numbers of cells, some at a time."""
    for start in range(0, count, CHUNK):
        yield np.arange(start, min(start + CHUNK, count))


def constraint(system: System, vectors: Array, stresses: Array) -> tuple[Array, Array]:
    """Forms (m, triples) of ∫ ψ (J − 1) dV for the modes ψ (mean_count, m), and ∫ ψ ψ / κ dV (m, m)."""
    R, m = vectors.shape[1] + 1, stresses.shape[1]
    packed, compliance = np.zeros((R * (R + 1) * (R + 2) // 6, m)), np.zeros((m, m))
    tables = system.element.tables
    for cells in chunks(len(system.cells)):
        psi = np.einsum("qm,cmk->cqk", tables.M, stresses[system.element.mean[cells]])
        weighted = system.dV[cells][:, :, None] * psi
        moved = gradients(system, vectors, cells)
        F = np.zeros((len(moved), R, 9))
        F[:, 0] = np.eye(3).ravel()
        F[:, 1:] = moved.swapaxes(1, 2)
        constraint_forms(F, np.ascontiguousarray(weighted.reshape(-1, m)), packed)
        compliance += np.einsum("c,cqk,cql->kl", system.materials.compliance[cells], weighted, psi, optimize=True)
        packed[0] -= weighted.sum(axis=(0, 1))
    return packed.T, compliance


def volume(system: System, sides: Ints, shift: Array, vectors: Array) -> Array:
    """Form (R, R, R) of the volume that sides enclose, −⅓ ∮ x·n da with normals out of the solid; no caps.

    ``shift`` (3,) is the scaled point on all mirror planes, about which cuts add nothing.
    """
    moved = positions(system, vectors)[sides]
    moved[..., 0] -= shift
    tables = side_tables(sides.shape[1])
    x = np.einsum("qa,faiR->fqiR", tables.N, moved, optimize=True).reshape(-1, 3, moved.shape[-1])
    r, s = (np.einsum("qa,faiR->fqiR", tables.dN[..., k], moved, optimize=True).reshape(x.shape) for k in range(2))
    weights, R = np.tile(tables.weights, len(sides)), x.shape[-1]
    out = np.zeros((R, R * R))
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        normal = r[:, a, :, None] * s[:, b, None, :] - r[:, b, :, None] * s[:, a, None, :]
        out -= (weights[:, None] / 3 * x[:, i]).T @ normal.reshape(-1, R * R)
    form = out.reshape(R, R, R)
    turns = ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0))
    return np.asarray(sum(form.transpose(turn) for turn in turns) / 6)


def sheet(system: System, term: MembraneTerm, vectors: Array) -> Array:
    """Form (n, n) of the energy of a sheet of Hooke's material; see `turgor.reduced.parts.polynomials.Sheets`."""
    moved = positions(system, vectors)[term.nodes]
    t = np.einsum("fqak,faiR->fqkiR", term.gradients, moved, optimize=True).reshape(-1, 2, 3, moved.shape[-1])
    i, j = np.triu_indices(moved.shape[-1])
    double = np.where(i == j, 1.0, 2.0)

    def product(a: int, b: int) -> Array:
        full = np.einsum("piR,piS->pRS", t[:, a], t[:, b], optimize=True)
        return 0.5 * double * (full[:, i, j] + full[:, j, i])

    strains = np.stack([0.5 * product(0, 0), 0.5 * product(1, 1), product(0, 1)], axis=1)
    strains[:, :2, 0] -= 0.5
    areas = term.areas.ravel()
    moduli = np.broadcast_to(term.moduli, (*term.areas.shape, 3, 3)).reshape(-1, 3, 3)
    stresses = areas[:, None, None] * (moduli @ strains)
    n = len(i)
    return np.asarray(strains.reshape(-1, n).T @ stresses.reshape(-1, n))


def moments(system: System, vectors: Array, stresses: Array) -> Moments | None:
    """Moments of the lost volume of hexahedra, as many as there are coefficients; None where cells have none.

    The energy is half the sum of the squares of all moments of all cells, so an orthogonal turn of them changes
    nothing: QR factors of some cells at a time keep as many rows as there are columns.
    """
    penalty, tables, R = system.rubber.penalty, system.element.tables, vectors.shape[1] + 1
    if not penalty.shape[2]:
        return None
    count, m = R * (R + 1) * (R + 2) // 6, stresses.shape[1]
    triangle = np.zeros((0, count + m))
    for cells in chunks(len(system.cells)):
        psi = np.einsum("qm,cmk->cqk", tables.M, stresses[system.element.mean[cells]])
        weighted = system.dV[cells][:, :, None] * penalty[cells]
        slopes = -np.einsum("c,cqk,cqm->ckm", system.materials.compliance[cells], weighted, psi, optimize=True)
        moved = gradients(system, vectors, cells).reshape(len(cells), -1, 9, R - 1)
        rows = np.zeros((len(cells), penalty.shape[2], count + m))
        rows[..., count:] = slopes
        for c in range(len(cells)):
            F = np.concatenate([np.broadcast_to(np.eye(3).ravel(), (len(moved[c]), 1, 9)), moved[c].swapaxes(1, 2)], 1)
            packed = np.zeros((count, penalty.shape[2]))
            constraint_forms(np.ascontiguousarray(F), np.ascontiguousarray(weighted[c]), packed)
            packed[0] -= weighted[c].sum(axis=0)
            rows[c, :, :count] = packed.T
        triangle = np.asarray(np.linalg.qr(np.vstack([triangle, rows.reshape(-1, count + m)]), mode="r"))
    return Moments(triangle[:, :count], triangle[:, count:])
