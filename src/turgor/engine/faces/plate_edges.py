"""Sheets on tetrahedra: their triangles and edges at rest, from which the terms of bending are made."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells.reference import reference_cell, reference_nodes, tables_at
from turgor.engine.faces.membranes import MEMBRANE_QUADRATURE_DEGREE, plane_stress_moduli, surface_frames
from turgor.engine.faces.plate_terms import HingeTerm, PlateTerm
from turgor.engine.faces.plates import curvature_numbers
from turgor.engine.term import Setting, Term
from turgor.errors import TurgorError
from turgor.materials.laws.laws import Hooke
from turgor.meshing.cells import TETRAHEDRON, TRIANGLE
from turgor.meshing.surface import corner_keys, outer_triangles
from turgor.model.points import RIGID
from turgor.model.sheets import Shell
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Penalty η of the angles at edges. On flat triangles the energy is positive above 3. Above 6 the deflection of a flat
#: plate hardly depends on it. Too little of it makes a curved shell too soft, too much makes it too stiff: the pinched
#: cylinder of 16 × 16 cells is 9 % too soft with 4, 2 % with 10, and 3.5 % too stiff with 50.
PENALTY = 10.0

#: A side of the body that is held keeps the slope of a sheet that ends at it, if it goes on across the sheet: the
#: smallest sine of the angle between both.
ACROSS = 0.5

#: Share of a normal that may be free where a side is held along it.
ROUND_OFF = 1e-6


def plate_terms(setting: Setting) -> Sequence[Term]:
    """Bending of the sheets on tetrahedra: triangles and edges of each; faces with equal sheets are one sheet."""
    model, found = setting.model, []
    bending = {name: sheet for name, sheet in model.membranes.items() if isinstance(sheet, Shell)}
    if model.mesh.cell_type is not TETRAHEDRON:
        return []
    for first, sheet in bending.items():
        names = [name for name, other in bending.items() if other == sheet]
        if names[0] != first:
            continue
        triangles = np.concatenate([model.mesh.face(name) for name in names])
        found += [_plate(setting, triangles, sheet), *_hinges(setting, triangles, sheet, names)]
    return found


def _plate(setting: Setting, triangles: Ints, sheet: Shell) -> PlateTerm:
    """The bending of triangles."""
    frames = surface_frames(setting.points, triangles)
    slopes = reference_cell(TRIANGLE.nodes, MEMBRANE_QUADRATURE_DEGREE[3]).dN
    tangents = np.einsum("qad,fai->fqdi", slopes, setting.points[triangles])
    pairs = ((frames.e1, frames.e1, 1.0), (frames.e2, frames.e2, 1.0), (frames.e1, frames.e2, 2.0))
    seconds = np.stack([factor * curvature_numbers(tangents, e, f) for e, f, factor in pairs], axis=2)
    rest = np.einsum("fqcm,fmi,fqi->fqc", seconds, setting.points[triangles], frames.normal)
    spread = np.broadcast_to(slopes, (len(triangles), *slopes.shape))
    assert isinstance(sheet.material.law, Hooke)
    moduli = plane_stress_moduli(sheet.material.law) * _stiffness(setting, sheet)
    return PlateTerm(triangles, spread, seconds, rest, frames.areas, moduli)


def _stiffness(setting: Setting, sheet: Shell) -> float:
    """Scaled second moment of area per width, h³/12."""
    return sheet.second_moment / (setting.length**3 * setting.stress)


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    """Edges of triangles.

    Parameters
    ----------
    nodes : (e, 6) int array
        Nodes of the triangle of each.
    place : (e,) int array
        Which of its three edges it is.
    """

    nodes: Ints
    place: Ints

    @property
    def ends(self) -> Ints:
        """Corners (e, 2) in the order of the triangle."""
        corners = np.array(TRIANGLE.edges)[self.place]
        return np.take_along_axis(self.nodes, corners, axis=1)

    @property
    def keys(self) -> Ints:
        """One number (e,) for each edge, from whichever triangle."""
        ends = np.sort(self.ends, axis=1)
        return np.asarray(ends[:, 0] << 32 | ends[:, 1])

    def __getitem__(self, chosen: Ints | NDArray[np.bool_]) -> "Edges":
        return Edges(self.nodes[chosen], self.place[chosen])


def edges_of(triangles: Ints) -> Edges:
    """All edges of triangles (f, 6), three of each."""
    return Edges(np.repeat(triangles, 3, axis=0), np.tile(np.arange(3), len(triangles)))


def _hinges(setting: Setting, triangles: Ints, sheet: Shell, names: Sequence[str]) -> list[HingeTerm]:
    """Edges between two triangles, and rim edges that are held."""
    edges = edges_of(triangles)
    order = np.argsort(edges.keys, kind="stable")
    _, first, count = np.unique(edges.keys[order], return_index=True, return_counts=True)
    if (count > 2).any():
        several = int(np.argmax(count > 2))
        at = setting.model.mesh.points[edges[order].ends[first[several]]].mean(axis=0) / mm
        raise TurgorError(
            f"the sheet on {', '.join(repr(name) for name in names)} resists bending, and {count[several]} of its "
            f"triangles meet at one edge, near ({at[0]:.3g}, {at[1]:.3g}, {at[2]:.3g}) mm; a sheet may bend and fold, "
            "not branch or lie on itself. Leave a face out, or make one a membrane."
        )
    inner, rim = first[count == 2], first[count == 1]
    free, sides = _held_sides(setting, triangles, edges[order[rim]])
    pairs = [(edges[order[inner]], edges[order[inner + 1]], True), (free, sides, False)]
    return [_hinge(setting, *pair, sheet) for pair in pairs if len(pair[0].nodes)]


def _held_sides(setting: Setting, triangles: Ints, rim: Edges) -> tuple[Edges, Edges]:
    """Rim edges at sides that supports hold along their normal, and these sides."""
    mesh, points = setting.model.mesh, setting.points
    outer = outer_triangles(mesh)
    outer = outer[~np.isin(corner_keys(outer, len(mesh.points)), corner_keys(triangles, len(mesh.points)))]
    held = setting.held.copy()
    for point in setting.model.points.values():
        if point.coupling == RIGID:
            held[mesh.face_nodes(point.face)] = True
    freedom = np.abs(_normals(points, outer))[:, None] * ~held[outer]
    sides = edges_of(outer[(freedom < ROUND_OFF).all(axis=(1, 2))])
    sides = sides[np.isin(sides.keys, rim.keys)]
    sorter = np.argsort(rim.keys)
    ending = rim[sorter[np.searchsorted(rim.keys, sides.keys, sorter=sorter)]] if len(sides.keys) else rim[sides.place]
    sine = np.linalg.norm(np.cross(_normals(points, ending.nodes), _normals(points, sides.nodes)), axis=1)
    across = np.flatnonzero(sine > ACROSS)
    once = across[np.unique(sides.keys[across], return_index=True)[1]]
    return ending[once], sides[once]


def _normals(points: Array, triangles: Ints) -> Array:
    """Unit normals (f, 3) of the planes through the corners of triangles."""
    a, b, c = np.moveaxis(points[triangles[:, :3]], 1, 0)
    normal = np.cross(b - a, c - a)
    return np.asarray(normal / np.linalg.norm(normal, axis=1)[:, None])


def _hinge(setting: Setting, first: Edges, second: Edges, whole: bool, sheet: Shell) -> HingeTerm:
    """Hinges between two triangles of a sheet (``whole``), or one and a side that is held."""
    law = sheet.material.law
    assert isinstance(law, Hooke)
    D = plane_stress_moduli(law)[0, 0] * _stiffness(setting, sheet)
    alike = (first.ends == second.ends).all(axis=1)
    nodes, places = _patches(first, second)
    slopes, moments, along = np.zeros((len(nodes), 2, 9, 2)), np.zeros((len(nodes), 2, 9)), np.zeros((len(nodes), 9))
    penalty, rows = np.zeros(len(nodes)), np.arange(len(nodes))[:, None]
    for k, edges in enumerate((first, second)):
        middle = _middle(setting.points, edges)
        slopes[rows, k, places[k]] = middle.slopes
        if whole or k == 0:
            moments[rows, k, places[k]] = D * (0.5 if whole else 1.0) * (middle.across + law.nu * middle.along)
            penalty += PENALTY * D * (0.5 if whole else 2.0) / middle.height
    alike = (first.ends == second.ends).all(axis=1)
    slopes[alike, 1] = slopes[alike, 1, :, ::-1]  # turns the normal of a triangle that is wound the other way
    ends = first.ends
    np.put_along_axis(along, np.array(TRIANGLE.edges)[first.place], np.array([[-1.0, 1.0]]), axis=1)
    lengths = np.linalg.norm(setting.points[ends[:, 1]] - setting.points[ends[:, 0]], axis=1)
    hinge = HingeTerm(nodes, slopes, moments, along, np.zeros((len(nodes), 2)), lengths, penalty)
    return replace(hinge, rest=hinge.stresses(setting.points, np.zeros_like(setting.points)))


def _patches(first: Edges, second: Edges) -> tuple[Ints, tuple[Ints, Ints]]:
    """Nodes (e, 9) of two triangles with a common edge, and where the nodes of each are among them, (e, 6)."""
    same = second.nodes[:, :, None] == first.nodes[:, None, :]
    shared = same.any(axis=2)
    place = np.where(shared, same.argmax(axis=2), 5 + np.cumsum(~shared, axis=1))
    nodes = np.empty((len(place), 9), dtype=np.int64)
    nodes[:, :6] = first.nodes
    np.put_along_axis(nodes, place, second.nodes, axis=1)
    return nodes, (np.broadcast_to(np.arange(6), place.shape), place)


@dataclass(frozen=True, slots=True, eq=False)
class Middle:
    """Triangles in the middle of an edge, at rest.

    Parameters
    ----------
    slopes : (e, 6, 2) array
        Derivatives of the shape functions along the parameters.
    across, along : (e, 6) arrays
        Numbers of the second derivatives of the position across the edge and along it.
    height : (e,) array
        Height of the triangle over the edge.
    """

    slopes: Array
    across: Array
    along: Array
    height: Array


def _middle(points: Array, edges: Edges) -> Middle:
    """The triangles of edges in the middle of each."""
    places = reference_nodes(TRIANGLE.nodes)[TRIANGLE.corners :]
    slopes = tables_at(TRIANGLE.nodes, places, np.ones(3)).dN[edges.place]
    tangents = np.swapaxes(slopes, 1, 2) @ points[edges.nodes]
    arm = points[edges.ends[:, 1]] - points[edges.ends[:, 0]]  # the tangent of a quadratic edge in its middle
    length = np.linalg.norm(arm, axis=1)
    tau = arm / length[:, None]
    nu = np.cross(tau, np.cross(tangents[:, 0], tangents[:, 1]))
    nu /= np.linalg.norm(nu, axis=1)[:, None]
    a, b, c = np.moveaxis(points[edges.nodes[:, :3]], 1, 0)
    height = np.linalg.norm(np.cross(b - a, c - a), axis=1) / length
    return Middle(slopes, curvature_numbers(tangents, nu, nu), curvature_numbers(tangents, tau, tau), height)
