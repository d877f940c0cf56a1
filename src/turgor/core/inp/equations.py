"""Linear equations in .inp files: those of a model, and one for each node that a support holds along a direction."""

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.ties import Equations, eliminated
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.middles import middles_of
from turgor.core.model.model import Model
from turgor.core.model.points import RIGID
from turgor.foundation.errors import TurgorError

#: Below this share of a direction a component of it is no term.
NO_TERM = 1e-9


def equation_lines(model: Model) -> tuple[list[str], list[str]]:
    """Write the linear equations of a model, and the supports along normals, such as `Radial` and `Roller`.

    Returns
    -------
    equations : list of str
        Keywords and data of the equations; empty without any.
    rows : list of str
        Rows of ``*BOUNDARY`` where one component is left besides those that are fixed already.
    """
    mesh = model.mesh
    fixed = np.zeros(mesh.points.shape, dtype=bool)
    for support in model.supports:
        if support.place not in model.points and support.components(mesh):
            fixed[support.nodes(mesh)[:, None], support.components(mesh)] = True
    directions: dict[int, list[NDArray[np.float64]]] = {}
    for support in model.supports:
        nodes, normals = support.normals(mesh) or (np.zeros(0, dtype=np.int64), np.zeros((0, 3)))
        for node, normal in zip(nodes.tolist(), normals, strict=True):
            directions.setdefault(node, []).append(np.where(fixed[node], 0.0, normal))
    rigid = [mesh.face_nodes(each.face) for each in model.points.values() if each.coupling == RIGID]
    equations, rows = _stated_lines(model, fixed, np.concatenate([list(directions), *rigid]).astype(np.int64))
    for node in sorted(set(directions) & set(mesh.cells[:, :20].ravel().tolist())):  # no middles of sides in files
        for terms in _reduced(np.array(directions[node])):
            if len(terms) == 1:
                rows.append(f"{node + 1}, {terms[0][0] + 1}")
            else:
                said = ", ".join(f"{node + 1}, {axis + 1}, {value:.12g}" for axis, value in terms)
                equations += ["*EQUATION", str(len(terms)), said]
    return equations, rows


def _stated_lines(model: Model, fixed: NDArray[np.bool_], follow: NDArray[np.int64]) -> tuple[list[str], list[str]]:
    """Keywords and data of the `Equation` supports, each solved for a component that no other has; what they fix."""
    mesh = model.mesh
    named = [(each.place, stated) for each in model.supports if (stated := each.equations(mesh)) is not None]
    if not named:
        return [], []
    moved = np.zeros_like(fixed)
    for support in model.supports:
        if support.moves and support.place not in model.points and support.components(mesh):
            moved[support.nodes(mesh)[:, None], support.components(mesh)] = True
    moved &= fixed
    free = ~fixed
    free[follow] = False  # other equations, or rigid faces, have these first
    spread = _spread(model) @ sp.diags((~fixed | moved).ravel().astype(float))
    lines, rows = list[str](), list[str]()
    for first, row in _solved(named, spread.tocsr(), free.ravel(), (~free & (~fixed | moved)).ravel()).items():
        if not row:
            rows.append(f"{first // 3 + 1}, {first % 3 + 1}")
            continue
        lines += ["*EQUATION", str(1 + len(row))]
        terms = [(first, 1.0), *((place, -value) for place, value in row.items())]
        lines += [f"{place // 3 + 1}, {place % 3 + 1}, {value:.12g}" for place, value in terms]
    return lines, rows


def _solved(
    named: list[tuple[str, Equations]], spread: sp.csr_matrix, free: NDArray[np.bool_], bound: NDArray[np.bool_]
) -> dict[int, dict[int, float]]:
    try:
        return eliminated(named, spread, free, bound)
    except TurgorError as error:
        name = str(error).partition(":")[0]
        raise TurgorError(
            f"{name} has no form in .inp files: all its displacements are moved, or those of rigid faces and of "
            "supports along a direction; leave it out to compare the rest."
        ) from None


def _spread(model: Model) -> sp.csr_matrix:
    """Displacements of all nodes from those in the file, where middles of sides and cells follow their shape."""
    size, own = 3 * len(model.mesh.points), np.ones(len(model.mesh.points))
    if model.mesh.cell_type is TETRAHEDRON:
        return sp.identity(size, format="csr")
    middles = middles_of(model.mesh.cells)
    own[middles.followers] = 0.0
    follow = sp.csr_matrix((middles.weights, (middles.followers, middles.leaders)), shape=(len(own), len(own)))
    return sp.kron(follow + sp.diags(own), sp.identity(3), format="csr")


def _reduced(directions: NDArray[np.float64]) -> list[list[tuple[int, float]]]:
    """Terms of independent equations, each with a component first that no other has, which the program eliminates."""
    rows, pivots = directions.copy(), list[tuple[int, int]]()
    while True:
        free = np.abs(rows)
        free[[row for row, _ in pivots]] = 0.0
        row, axis = (int(each) for each in np.unravel_index(free.argmax(), free.shape))
        if free[row, axis] < NO_TERM:
            break
        rows[row] /= rows[row, axis]
        others = np.arange(len(rows)) != row
        rows[others] -= np.outer(rows[others, axis], rows[row])
        pivots.append((row, axis))
    return [
        [(axis, 1.0), *((k, float(rows[row, k])) for k in range(3) if k != axis and abs(rows[row, k]) > NO_TERM)]
        for row, axis in pivots
    ]
