"""A small model for tests of the solvers: two tetrahedra under a traction."""

import numpy as np

from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.model.loads import Traction
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed

RUBBER = Material(name="rubber", law=NeoHooke(C10=0.1e6))


def bar() -> Mesh:
    """Two tetrahedra of 1 cm with one free vertex each: faces ``fixed`` and ``top``."""
    vertices = 0.01 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    corners = [(0, 1, 2, 3), (0, 2, 1, 4)]
    points, middle = list(vertices), {}
    cells = []
    for cell in corners:
        nodes = list(cell)
        for a, b in TETRAHEDRON_EDGES:
            edge = frozenset((cell[a], cell[b]))
            if edge not in middle:
                middle[edge] = len(points)
                points.append((vertices[cell[a]] + vertices[cell[b]]) / 2)
            nodes.append(middle[edge])
        cells.append(nodes)
    table = np.array(cells)
    sides = [table[:, list(side)] for side in TETRAHEDRON.sides]
    return Mesh(
        points=np.array(points), cells=table, regions={"body": np.arange(2)},
        faces={"fixed": sides[0][1:], "top": sides[1][:1]},
    )  # fmt: skip


def model(pressure: float = 1e3) -> Model:
    return Model(bar(), {"body": RUBBER}, [Fixed("fixed")], [Traction("top", (0.0, 0.0, pressure))])
