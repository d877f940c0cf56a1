"""Linear equations in .inp files: those of a model, and one for each node that a support holds along a direction."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.model import Model

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
    equations, rows = _stated_lines(model, fixed), list[str]()
    for node in sorted(set(directions) & set(mesh.cells[:, :20].ravel().tolist())):  # no middles of sides in files
        for terms in _reduced(np.array(directions[node])):
            if len(terms) == 1:
                rows.append(f"{node + 1}, {terms[0][0] + 1}")
            else:
                said = ", ".join(f"{node + 1}, {axis + 1}, {value:.12g}" for axis, value in terms)
                equations += ["*EQUATION", str(len(terms)), said]
    return equations, rows


def _stated_lines(model: Model, fixed: NDArray[np.bool_]) -> list[str]:
    """Keywords and data of the `Equation` supports; what is fixed is zero and no term."""
    written = np.zeros(len(fixed), dtype=bool)
    written[model.mesh.cells[:, :20]] = True
    lines, dependent = list[str](), set[tuple[int, int]]()
    for nodes, vectors in (each for support in model.supports if (each := support.equations(model.mesh)) is not None):
        for row, parts in zip(nodes, vectors, strict=True):
            terms: dict[tuple[int, int], float] = {}
            for node, vector in zip(row.tolist(), parts, strict=True):
                for axis in np.flatnonzero(np.abs(vector) > NO_TERM).tolist():
                    terms[node, axis] = terms.get((node, axis), 0.0) + float(vector[axis])
            terms = {place: value for place, value in terms.items() if value and not fixed[place]}
            first = next((place for place in terms if place not in dependent), None)
            if not written[row].all() or first is None:  # middles of sides, and what follows from others
                continue
            dependent.add(first)
            ordered = [first, *(place for place in terms if place != first)]
            lines += ["*EQUATION", str(len(ordered))]
            lines += [f"{node + 1}, {axis + 1}, {terms[node, axis]:.12g}" for node, axis in ordered]
    return lines


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
