"""Mass on faces: sheets, and liquids that move with the walls of their cavity."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import liquid_tables
from turgor.core.engine.system import System

Array = NDArray[np.float64]


def face_mass(system: System, sides: NDArray[np.int64], per_area: float) -> Array:
    """Lower triangle (nnz,) of the consistent mass of an even layer, on the pattern of a system's tangent.

    Parameters
    ----------
    system : System
    sides : (f, n) int array
        Sides of cells or films, by the nodes that carry their displacement.
    per_area : float
        Scaled mass per scaled area at rest.
    """
    tables = liquid_tables(sides.shape[1])  # exact for products of two shape functions on flat sides
    edges = np.einsum("qad,fai->fqdi", tables.dN, system.points[sides])
    areas = tables.weights * np.linalg.norm(np.cross(edges[:, :, 0], edges[:, :, 1]), axis=2)
    local = np.einsum("fq,qa,qb,ij->faibj", per_area * areas, tables.N, tables.N, np.eye(3), optimize=True)
    return system.scattered_sides(sides, local)
