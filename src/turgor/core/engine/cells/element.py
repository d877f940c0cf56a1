"""Element: how the cells of a mesh carry displacement and mean stress, and where they are integrated."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.mean_stress_jumps import mean_stress_numbers
from turgor.core.engine.cells.reference import CELL_QUADRATURE_DEGREE, ReferenceCell, reference_cell
from turgor.core.model.model import DISPLACEMENT, Model

Ints = NDArray[np.int64]

#: Points of cells without mean stress, by nodes: those of the usual displacement elements, 4 in a
#: tetrahedron, 8 (reduced) in a 20-node hexahedron, 27 in a 27-node one.
DISPLACEMENT_DEGREE = {10: 2, 20: 3, 27: 4}


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """The discretization of a model's cells.

    Parameters
    ----------
    cells : (c, n) int array
        Nodes of each cell that carry its displacement.
    tables : ReferenceCell
        Shape functions of these at the integration points.
    shape, modes : tuples of zeros
        As long as a cell has nodes and mean stresses; their types tell the compiler these numbers.
    mean : (c, m) int array
        Places of each cell's mean stresses among all.
    mean_count : int
        Mean stresses of the mesh.
    """

    cells: Ints
    tables: ReferenceCell
    shape: tuple[int, ...]
    modes: tuple[int, ...]
    mean: Ints
    mean_count: int


def tables_with(nodes: int, points: int) -> ReferenceCell:
    """Find the tables of a cell with that many nodes by the number of their integration points."""
    tables = reference_cell(nodes, CELL_QUADRATURE_DEGREE)
    return tables if len(tables.weights) == points else reference_cell(nodes, DISPLACEMENT_DEGREE[nodes])


def element_of(model: Model) -> Element:
    """Choose the discretization of a model.

    Cells share a continuous mean stress with one value at each vertex, linear in tetrahedra and trilinear in hexahedra
    (Taylor and Hood), which jumps where stiffness or traction jumps (`turgor.core.engine.cells.mean_stress_jumps`). A
    linear mean stress of each hexahedron's own, discontinuous between all of them, passes the same tests; but it lacks
    the products of coordinates that bending makes in a wall of one cell: the cavity of a fast PneuNet with such walls
    grew 13 % too much, 1 % with values at vertices. The formulation ``"displacement"`` has none.

    The trilinear mean stress leaves hexahedra volumetric modes that it does not see; the penalty of
    `turgor.core.engine.cells.stabilization` resists them. Tetrahedra have no such modes. Where the middles of a mesh
    follow, its cells have the shape functions of 20 nodes.
    """
    mesh = model.mesh
    cells = mesh.carrying_cells
    nodes = cells.shape[1]
    if model.formulation == DISPLACEMENT or not len(mesh.cells):
        none = np.zeros((len(mesh.cells), 0), dtype=np.int64)
        return Element(
            cells,
            reference_cell(nodes, CELL_QUADRATURE_DEGREE if mesh.serendipity else DISPLACEMENT_DEGREE[nodes]),
            (0,) * nodes,
            (),
            none,
            0,
        )
    mean, count = mean_stress_numbers(model)
    tables = reference_cell(nodes, CELL_QUADRATURE_DEGREE)
    return Element(cells, tables, (0,) * nodes, (0,) * mean.shape[1], mean, count)
