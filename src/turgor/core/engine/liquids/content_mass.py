"""Mass on faces: of sheets, and of the liquid in cavities, which moves with the walls."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import liquid_tables
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.faces import surfaces
from turgor.core.engine.system import System

Array = NDArray[np.float64]


def content_mass(system: System) -> Array | None:
    """Lower triangle (nnz,) of the scaled mass of the liquid in all cavities; None without any.

    The mass that a cavity contains at rest is spread evenly over its walls: it is exact where the liquid moves with
    them as one piece, and keeps the center of a prismatic cavity. Faces around a body contain nothing.

    Parameters
    ----------
    system : System
    """
    mesh, parts = system.model.mesh, []
    for load in (each.liquid for each in system.model.loads):
        volume = 0.0 if load is None or load.free_surface else cavity_volume(mesh, load.face) / mesh.symmetry_factor
        if load is None or volume <= 0:
            continue
        sides = mesh.carrying_sides(load.face)
        mass = load.density * volume / (system.length * system.stress_scale)
        parts.append(face_mass(system, sides, mass / surfaces.area(system.points, sides)))
    return np.sum(parts, axis=0) if parts else None


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
