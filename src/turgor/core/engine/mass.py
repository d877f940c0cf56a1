"""Mass: the consistent mass matrix of rubber and sheets, the masses of reference points and of the liquid in cavities.

Fibers are weightless, and so are sheets on a body whose material has no density, as they are for gravity.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.cells.reference import CELL_QUADRATURE_DEGREE, reference_cell
from turgor.core.engine.faces import surfaces
from turgor.core.engine.liquids.content_mass import content_mass, face_mass
from turgor.core.engine.points.point_mass import add_point_masses
from turgor.core.engine.system import System
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def densities(model: Model) -> Array:
    """Return the density of every cell [kg/m³], (c,); that of films without a solid is part of `sheet_masses`.

    Raises
    ------
    TurgorError
        If a material has none; sheets that lie on a body may lack it.
    """
    out, alone = np.empty(len(model.mesh.cells)), not len(model.mesh.cells)
    films = {name: sheet.material for name, sheet in model.membranes.items()} if alone else {}
    for name, material in (model.region_materials | films).items():
        if material.density is None:
            raise TurgorError(
                f"materials.{name}: '{material.name}' has no density, and motion needs it; give one in kg/m³."
            )
        if not alone:
            out[model.mesh.regions[name]] = material.density
    return out


def total_mass(model: Model) -> float:
    """Return the mass of rubber and sheets of the whole actuator, mirror images together [kg].

    Raises
    ------
    TurgorError
        If a material has no density; sheets that lie on a body may lack it.
    """
    mesh = model.mesh
    sheets = (mass * surfaces.area(mesh.points, mesh.face(name)) for name, mass in model.sheet_masses.items())
    return float(densities(model) @ cell_volumes(mesh) + sum(sheets)) * mesh.symmetry_factor


@lru_cache(maxsize=4)  # several checks ask
def cell_volumes(mesh: Mesh) -> Array:
    """Return the volume of every cell at rest, (c,) [m³]; read-only."""
    r = reference_cell(mesh.cell_type.nodes, CELL_QUADRATURE_DEGREE)
    # no compiled loop: `turgor check` shall not wait for it
    J = np.tensordot(mesh.points[mesh.cells], r.dN, axes=(1, 1)).transpose(0, 2, 1, 3)
    volumes = np.asarray(np.linalg.det(J) @ r.weights)
    volumes.flags.writeable = False
    return volumes


def mass_data(system: System) -> Array:
    """Lower triangle (nnz,) of the consistent mass matrix on the pattern of a system's tangent, points included.

    Scaled so that its product with a scaled acceleration, in units of length per s², is a scaled force. It is
    integrated exactly on straight cells in every formulation: four points would leave a tetrahedron motions without
    mass.

    Parameters
    ----------
    system : System
    """
    model, mesh = system.model, system.model.mesh
    data = _cell_mass(system, densities(model) * (system.length**2 / system.stress_scale))
    for name, mass in model.sheet_masses.items():
        data += face_mass(system, mesh.carrying_sides(name), mass * system.length / system.stress_scale)
    scale = 1 / (system.length * system.stress_scale)
    add_point_masses(data, system.layout.base, model, system.carriers, scale)
    content = content_mass(system)
    return data if content is None else data + content


def refuse_turning(model: Model) -> None:
    """Refuse motion and vibration of a part that turns, whose Coriolis force is not modeled.

    Parameters
    ----------
    model : Model

    Raises
    ------
    TurgorError
        If it has a centrifugal force.
    """
    if any(load.spinning is not None for load in model.loads):
        raise TurgorError(
            "centrifugal force: what moves or vibrates in a frame that turns has a Coriolis force, too, which is not "
            "modeled; leave the force out, or take an equilibrium (procedure static)."
        )


def even_mass(system: System) -> Array:
    """Lower triangle (nnz,) of a mass of 1 for a volume of 1, both scaled; reference points and sheets have none.

    Films without a solid count as layers of an edge.

    Parameters
    ----------
    system : System
    """
    if not len(system.cells):
        return face_mass(system, system.model.mesh.film_sides, 1.0)
    return _cell_mass(system, np.ones(len(system.cells)))


def _cell_mass(system: System, density: Array) -> Array:
    """Mass of the cells of a scaled density (c,); zeros where there are none."""
    mesh = system.model.mesh
    if not len(mesh.cells):
        return np.zeros(len(system.layout.base.indices))
    nodes = mesh.carrying_cells.shape[1]
    N = reference_cell(nodes, CELL_QUADRATURE_DEGREE).N
    weights = density[:, None] * _volumes(mesh, system.points)
    rows, columns = np.tril_indices(system.cell_size)
    same = (rows % 3 == columns % 3) & (rows < 3 * nodes)
    a, b = rows[same] // 3, columns[same] // 3
    return system.scattered(np.flatnonzero(same), weights @ (N[:, a] * N[:, b]))


def _volumes(mesh: Mesh, points: Array) -> Array:
    """Volume (c, q) that belongs to each integration point of the mass."""
    cells = mesh.carrying_cells
    r = reference_cell(cells.shape[1], CELL_QUADRATURE_DEGREE)
    return np.asarray(kernels_geometry.reference_geometry((0,) * cells.shape[1], points, cells, r.dN, r.weights)[1])
