"""Magnitudes of shapes: size, walls, sheets, threads, turns, and how far off obstacles stay."""

from collections.abc import Iterator

import numpy as np

from turgor.core.engine.faces.surfaces import area
from turgor.core.engine.mass import cell_volumes
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.solvers.checks.plausibility.question import Magnitude, Question, shown


def longest_side(question: Question) -> Iterator[Magnitude]:
    """Longest side of the box around the mesh [m]."""
    yield Magnitude("The actuator", size_of(question.model.mesh))


def mean_wall(question: Question) -> Iterator[Magnitude]:
    """Thickness of a plate of the same volume and surface [m]."""
    mesh = question.model.mesh
    surface = outer_triangles(mesh)
    mirrored = [corner_keys(mesh.faces[name], len(mesh.points)) for name in mesh.cut_faces]
    if mirrored:
        surface = surface[~np.isin(corner_keys(surface, len(mesh.points)), np.concatenate(mirrored))]
    if len(surface) and len(mesh.cells):
        whole = float(area(mesh.points, surface)) * mesh.symmetry_factor
        yield Magnitude("The actuator", 2 * region_volume(mesh) / whole)


def sheet_thickness(question: Question) -> Iterator[Magnitude]:
    """Thickness of every sheet [m]."""
    return (Magnitude(f"Sheet on '{face}'", sheet.thickness) for face, sheet in question.model.membranes.items())


def thread_diameter(question: Question) -> Iterator[Magnitude]:
    """Diameter of the threads of every winding [m]."""
    return (Magnitude(f"Winding on {each.place}", each.diameter) for each in question.model.reinforcements)


def turns(question: Question) -> Iterator[Magnitude]:
    """Turns of a thread, where they are stated [-]."""
    for each in question.model.reinforcements:
        if not each.embedded and each.wound.turns is not None:
            yield Magnitude(f"Winding on {each.place}", each.wound.turns)


def obstacle_distance(question: Question) -> Iterator[Magnitude]:
    """Shortest distance of every obstacle along its path from the actuator at rest, over the size of that [-]."""
    mesh, obstacles = question.model.mesh, question.model.contact.obstacles
    if not obstacles:
        return
    points = mesh.points[np.unique(outer_triangles(mesh))]
    for each in obstacles:
        factors = each.stops or (0.0,)
        nearest = min(each.shape.clearance(each.pose(factor).at_first(points)) for factor in factors)
        yield Magnitude(f"Obstacle '{each.name}', {shown(max(nearest, 0.0), 'm')} away", nearest / size_of(mesh))


def iterations(question: Question) -> Iterator[Magnitude]:
    """Newton iterations that a step may take [-]."""
    yield Magnitude("procedure.max_iterations", question.procedure.max_iterations)


def tolerance(question: Question) -> Iterator[Magnitude]:
    """Relative residual at which a step has converged [-]."""
    yield Magnitude("procedure.tolerance", question.procedure.tolerance)


def size_of(mesh: Mesh) -> float:
    """Longest side of the box around a mesh [m]."""
    return float(np.ptp(mesh.points, axis=0).max())


def region_volume(mesh: Mesh, name: str | None = None) -> float:
    """Volume of a region at rest, or of all, of the whole actuator [m³]."""
    volumes = cell_volumes(mesh)
    chosen = volumes if name is None else volumes[mesh.regions[name]]
    return float(chosen.sum()) * mesh.symmetry_factor
