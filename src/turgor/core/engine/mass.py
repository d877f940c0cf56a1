"""Mass: the consistent mass matrix of the rubber, the masses of reference points and of the liquid in cavities.

Membranes and fibers are weightless, as they are for gravity.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.cells.reference import CELL_QUADRATURE_DEGREE, reference_cell
from turgor.core.engine.liquids.content_mass import content_mass
from turgor.core.engine.points.point_mass import add_point_masses
from turgor.core.engine.system import System
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def densities(model: Model) -> Array:
    """Return the density of every cell [kg/m³], (c,).

    Raises
    ------
    TurgorError
        If a material has none.
    """
    if not len(model.mesh.cells):
        raise TurgorError(f"'{model.mesh.name}' consists of films, which have no mass here; solve it statically.")
    out = np.empty(len(model.mesh.cells))
    for name, material in model.region_materials.items():
        if material.density is None:
            raise TurgorError(
                f"materials.{name}: '{material.name}' has no density, and motion needs it; give one in kg/m³."
            )
        out[model.mesh.regions[name]] = material.density
    return out


def total_mass(model: Model) -> float:
    """Return the mass of the rubber of the whole actuator, mirror images together [kg].

    Raises
    ------
    TurgorError
        If a material has no density.
    """
    return float(densities(model) @ cell_volumes(model.mesh)) * model.mesh.symmetry_factor


@lru_cache(maxsize=4)  # several checks ask
def cell_volumes(mesh: Mesh) -> Array:
    """Return the volume of every cell at rest, (c,) [m³]; read-only."""
    r = reference_cell(mesh.cell_type.nodes, CELL_QUADRATURE_DEGREE)
    # no compiled loop: `turgor check` shall not wait for it
    J = np.tensordot(mesh.points[mesh.cells], r.dN, axes=(1, 1)).transpose(0, 2, 1, 3)
    volumes = np.asarray(np.linalg.det(J) @ r.weights)
    volumes.flags.writeable = False
    return volumes


def mass_data(system: System, density: Array | None = None) -> Array:
    """Lower triangle (nnz,) of the consistent mass matrix on the pattern of a system's tangent, points included.

    Scaled so that its product with a scaled acceleration, in units of length per s², is a scaled force. It is
    integrated exactly on straight cells in every formulation: four points would leave a tetrahedron motions without
    mass.

    Parameters
    ----------
    system : System
    density : (c,) array [kg/m³], optional
        Of every cell, with weightless reference points; that of the materials and points by default.
    """
    mesh, rubber_only = system.model.mesh, density is not None
    density = densities(system.model) if density is None else density
    nodes = mesh.carrying_cells.shape[1]
    N = reference_cell(nodes, CELL_QUADRATURE_DEGREE).N
    weights = density[:, None] * _volumes(mesh, system.points) * (system.length**2 / system.stress_scale)
    rows, columns = np.tril_indices(system.cell_size)
    same = (rows % 3 == columns % 3) & (rows < 3 * nodes)
    a, b = rows[same] // 3, columns[same] // 3
    values = weights @ (N[:, a] * N[:, b])
    data = system.scattered(np.flatnonzero(same), values)
    if not rubber_only:
        scale = 1 / (system.length * system.stress_scale)
        add_point_masses(data, system.layout.base, system.model, system.carriers, scale)
        content = content_mass(system)
        data += 0.0 if content is None else content
    return data


def _volumes(mesh: Mesh, points: Array) -> Array:
    """Volume (c, q) that belongs to each integration point of the mass."""
    cells = mesh.carrying_cells
    r = reference_cell(cells.shape[1], CELL_QUADRATURE_DEGREE)
    return np.asarray(kernels_geometry.reference_geometry((0,) * cells.shape[1], points, cells, r.dN, r.weights)[1])
