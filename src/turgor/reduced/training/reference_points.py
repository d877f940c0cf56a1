"""Reference points in reduced coordinates: how they move with their faces, and what keeps rigid faces rigid.

A point follows its face linearly: it has the mean displacement of an averaged face; where the face is rigid, its
displacement and the directions of the face follow from those of the nodes. Modes are combinations of states in which
the face is rigid, and combined they need not be so: a stiff energy of the strains of the face keeps it rigid. These
strains are quadratic, so that this energy is one of `turgor.reduced.parts.polynomials.Sheets`.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier
from turgor.core.engine.system import System
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.reduced.settings import RIGIDITY
from turgor.reduced.training import forms

Array = NDArray[np.float64]


def with_points(system: System, vectors: Array) -> Array:
    """Modes (3 n, r) of the nodes of the mesh with those of reference points behind them, (3 (n + e), r)."""
    modes = vectors.reshape(-1, 3, vectors.shape[1])
    out = np.zeros((system.node_count, *modes.shape[1:]))
    out[: len(modes)] = modes
    for each in system.carriers:
        out[each.node] = np.einsum("k,kir->ir", _following(each)[0], modes[each.nodes])
        out[each.node, list(each.blocked)] = 0.0
    return out.reshape(-1, vectors.shape[1])


def rigid_faces(system: System, vectors: Array) -> Array | None:
    """Form (n, n) of the stiff energy of all rigid faces, for modes (3 (n + e), r); None without any."""
    every, total = forms.positions(system, vectors), None
    i, j = np.triu_indices(every.shape[2])
    for each in system.carriers:
        if not each.rigid:
            continue
        ways = np.einsum("dk,kiR->diR", _following(each)[1:] * system.length, every[each.nodes])
        stiff = RIGIDITY * (each.radius / system.length) ** 3 / system.model.mesh.symmetry_factor
        for a in range(len(ways)):
            for b in range(len(ways)):
                product = ways[a].T @ ways[b]
                strain = 0.5 * np.where(i == j, 1.0, 2.0) * 0.5 * (product + product.T)[i, j]
                strain[0] -= 0.5 * (a == b)
                part = stiff * np.outer(strain, strain)
                total = part if total is None else total + part
    return total


def check_points(system: System) -> None:
    """Refuse by name what reference points of a reduced model cannot be.

    Raises
    ------
    TurgorError
    """
    for each in system.carriers:
        name = f"reference point '{each.point.name}'"
        if each.point.center is not None:
            raise TurgorError(f"{name}: reduced models need the center of mass at the point; leave its center out.")
        if not each.rigid and np.linalg.norm(each.center) > ROUND_OFF.same * each.radius:
            raise TurgorError(
                f"{name}: reduced models need an averaging point at the center of its face; leave at out."
            )
        if each.rigid and not np.allclose(_following(each)[0] @ each.arms, 0.0, atol=ROUND_OFF.same * each.radius):
            raise TurgorError(f"{name}: reduced models need a point in the plane of its rigid face.")


def _following(carrier: Carrier) -> Array:
    """Weights (1 + d, k) of the nodes of a face: displacement of the point, then directions of a rigid face [1/m].

    The d directions are those in which the face extends: two of a flat one.
    """
    if not carrier.rigid:
        return carrier.weights[None]
    middle = carrier.arms.mean(axis=0)
    _, sizes, axes = np.linalg.svd(carrier.arms - middle, full_matrices=False)
    along = axes[sizes > ROUND_OFF.same * sizes[0]]
    columns = np.column_stack([np.ones(len(carrier.arms)), carrier.arms @ along.T])
    return np.asarray(np.linalg.pinv(columns))
