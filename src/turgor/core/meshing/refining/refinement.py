"""Refinement: a finer mesh whose cells are exact pieces of the cells of a coarser one."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.foundation.display import brief


@dataclass(frozen=True, slots=True, eq=False)
class Refinement:
    """A finer mesh and how its cells lie in those of the coarser one.

    Every cell of the finer mesh is a piece of one cell of the coarser mesh, in the reference coordinates of that cell a
    straight tetrahedron or a box. A quadratic field of the coarser mesh is therefore one of the finer mesh, exactly.

    Parameters
    ----------
    mesh : Mesh
        The finer mesh.
    parent : (c,) int array
        Cell of the coarser mesh that each cell is a piece of.
    corners : (c, k, 3) float array
        Its corners in the reference coordinates of that cell, from 0 to 1.
    """

    mesh: Mesh
    parent: NDArray[np.int64]
    corners: NDArray[np.float64]

    __repr__ = brief
