"""Shells: the sides of cells they lie on and the edges of these at rest, from which the terms of bending are made."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_cell, reference_nodes, tables_at
from turgor.core.engine.faces.membranes import surface_frames
from turgor.core.engine.faces.plate_terms import HingeTerm, PlateTerm
from turgor.core.engine.faces.plates import (
    covariant,
    curvature_numbers,
    least_penalties,
    second_derivatives,
    surface_at,
)
from turgor.core.engine.faces.settings import PLATE
from turgor.core.engine.faces.sheet_moduli import sheet_moduli
from turgor.core.engine.term import Setting, Term
from turgor.core.meshing.cells import side_type
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.model.points import RIGID
from turgor.core.model.sheets import Shell
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Points of a side for its curvature, by corners: 3 of triangles, 3 × 3 of quadrilaterals. With 2 × 2, skew
#: quadrilaterals can bend for less than nothing.
PLATE_QUADRATURE_DEGREE = {3: 2, 4: 5}

#: Where on an edge its angle counts, and for which share of its length, by corners of the sides. See `HingeTerm`.
EDGE_POINTS = {3: ((0.5, 1.0),), 4: ((0.5 - 0.75**0.5 / 3, 0.5), (0.5 + 0.75**0.5 / 3, 0.5))}


def plate_terms(setting: Setting) -> Sequence[Term]:
    """Bending of the shells: sides and edges of each; faces with equal sheets are one sheet."""
    model, terms = setting.model, []
    bending = {name: sheet for name, sheet in model.membranes.items() if isinstance(sheet, Shell)}
    for first, sheet in bending.items():
        names = [name for name, other in bending.items() if other == sheet]
        if names[0] != first:
            continue
        triangles = np.concatenate([model.mesh.face(name) for name in names])
        terms += [_plate(setting, triangles, sheet), *_hinges(setting, triangles, sheet, names)]
    return terms


def _plate(setting: Setting, sides: Ints, sheet: Shell) -> PlateTerm:
    """The bending of sides."""
    kind = side_type(sides.shape[1])
    degree = PLATE_QUADRATURE_DEGREE[kind.corners]
    frames, rule = surface_frames(setting.points, sides, degree), reference_cell(kind.nodes, degree)
    tangents = np.einsum("qad,fai->fqdi", rule.dN, setting.points[sides])
    bends = second_derivatives(kind.nodes, rule.points)
    pairs = ((frames.e1, frames.e1, 1.0), (frames.e2, frames.e2, 1.0), (frames.e1, frames.e2, 2.0))
    seconds = np.stack([factor * curvature_numbers(tangents, bends, e, f) for e, f, factor in pairs], axis=2)
    rest = np.einsum("fqcm,fmi,fqi->fqc", seconds, setting.points[sides], frames.normal)
    slopes = np.broadcast_to(rule.dN, (len(sides), *rule.dN.shape))
    moduli = sheet_moduli(sheet, frames.e1, frames.e2) * _stiffness(setting, sheet)
    return PlateTerm(sides, slopes, seconds, rest, frames.areas, moduli)


def _stiffness(setting: Setting, sheet: Shell) -> float:
    """Scaled second moment of area per width, h³/12."""
    return sheet.second_moment / (setting.length**3 * setting.stress)


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    """Edges of sides of cells.

    Parameters
    ----------
    nodes : (e, n) int array
        Nodes of the side of each.
    place : (e,) int array
        Which of its edges it is.
    penalty : (e,) array
        Penalty η of its angle.
    """

    nodes: Ints
    place: Ints
    penalty: Array

    @property
    def ends(self) -> Ints:
        """Corners (e, 2) in the order of the side."""
        return np.take_along_axis(self.nodes, self.corners, axis=1)

    @property
    def corners(self) -> Ints:
        """Places (e, 2) of both corners among the nodes of the side."""
        return np.array(side_type(self.nodes.shape[1]).edges)[self.place]

    @property
    def keys(self) -> Ints:
        """One number (e,) for each edge, from whichever side."""
        ends = np.sort(self.ends, axis=1)
        return np.asarray(ends[:, 0] << 32 | ends[:, 1])

    def __getitem__(self, chosen: Ints | NDArray[np.bool_]) -> "Edges":
        return Edges(self.nodes[chosen], self.place[chosen], self.penalty[chosen])


def edges_of(sides: Ints) -> Edges:
    """All edges of sides (f, n), one after the other of each, with the penalty that suits all sheets on bodies."""
    corners = side_type(sides.shape[1]).corners
    place = np.tile(np.arange(corners), len(sides))
    eta = PLATE.penalty_triangles if corners == 3 else PLATE.penalty_quadrilaterals
    return Edges(np.repeat(sides, corners, axis=0), place, np.full(len(place), eta))


def _of_film(setting: Setting, sides: Ints, sheet: Shell) -> Edges:
    """All edges of the sides of a film without a solid, each with the penalty that its sides need."""
    edges, plate = edges_of(sides), _plate(setting, sides, sheet)
    curving = plate.curving(setting.points)[1]
    bending = (np.swapaxes(curving, -1, -2) @ (plate.areas[..., None, None] * plate.moduli) @ curving).sum(axis=1)
    moments = np.zeros((len(edges.place), sides.shape[1], sides.shape[1]))
    for place, share in EDGE_POINTS[4]:
        here, corners = _at_edges(setting.points, edges, np.full(len(edges.place), place)), setting.points[edges.nodes]
        D = sheet_moduli(sheet, here.nu, here.tau)[..., 0, :] * _stiffness(setting, sheet)
        surface = surface_at(corners, here.slopes)
        numbers = covariant(surface, here.slopes, here.seconds, here.seconds @ corners)
        moment = np.einsum("...c,...cn->...n", D, numbers)
        length = share * np.linalg.norm((here.tangent[:, None] @ corners)[:, 0], axis=1)
        moments += np.einsum("e,ei,ej->eij", length * here.height / D[..., 0], moment, moment)
    least = least_penalties(bending, moments.reshape(len(sides), 4, *bending.shape[1:]))
    eta = np.maximum(PLATE.margin * least, PLATE.least_penalty)
    return replace(edges, penalty=eta.ravel())


def _hinges(setting: Setting, triangles: Ints, sheet: Shell, names: Sequence[str]) -> list[HingeTerm]:
    """Edges between two sides, and rim edges that are fixed."""
    alone = not len(setting.model.mesh.cells)
    edges = _of_film(setting, triangles, sheet) if alone else edges_of(triangles)
    order = np.argsort(edges.keys, kind="stable")
    _, first, count = np.unique(edges.keys[order], return_index=True, return_counts=True)
    if (count > 2).any():
        several = int(np.argmax(count > 2))
        at = setting.model.mesh.points[edges[order].ends[first[several]]].mean(axis=0) / mm
        raise TurgorError(
            f"the sheet on {', '.join(repr(name) for name in names)} resists bending, and {count[several]} of its "
            f"sides meet at one edge, near ({at[0]:.3g}, {at[1]:.3g}, {at[2]:.3g}) mm; a sheet may bend and fold, "
            "not branch or lie on itself. Leave a face out, or make one a membrane."
        )
    inner, rim = first[count == 2], first[count == 1]
    free, sides = _fixed_sides(setting, triangles, edges[order[rim]])
    pairs = [(edges[order[inner]], edges[order[inner + 1]]), (free, sides)]
    return [_hinge(setting, pair, k == 0, sheet) for k, pair in enumerate(pairs) if len(pair[0].nodes)]


def _fixed_sides(setting: Setting, triangles: Ints, rim: Edges) -> tuple[Edges, Edges]:
    """Rim edges at sides that supports hold along their normal, and these sides."""
    mesh, points = setting.model.mesh, setting.points
    outer = outer_triangles(mesh)
    outer = outer[~np.isin(corner_keys(outer, len(mesh.points)), corner_keys(triangles, len(mesh.points)))]
    prescribed = setting.prescribed.copy()
    for point in setting.model.points.values():
        if point.coupling == RIGID:
            prescribed[mesh.face_nodes(point.face)] = True
    freedom = np.abs(_normals(points, outer))[:, None] * ~prescribed[outer]
    sides = edges_of(outer[(freedom < ROUND_OFF.mesh_digits).all(axis=(1, 2))])
    sides = sides[np.isin(sides.keys, rim.keys)]
    sorter = np.argsort(rim.keys)
    ending = rim[sorter[np.searchsorted(rim.keys, sides.keys, sorter=sorter)]] if len(sides.keys) else rim[sides.place]
    sine = np.linalg.norm(np.cross(_normals(points, ending.nodes), _normals(points, sides.nodes)), axis=1)
    across = np.flatnonzero(sine > PLATE.across)
    once = across[np.unique(sides.keys[across], return_index=True)[1]]
    return ending[once], sides[once]


def _normals(points: Array, triangles: Ints) -> Array:
    """Unit normals (f, 3) of the planes through the corners of triangles."""
    a, b, c = np.moveaxis(points[triangles[:, :3]], 1, 0)
    normal = np.cross(b - a, c - a)
    return np.asarray(normal / np.linalg.norm(normal, axis=1)[:, None])


def _hinge(setting: Setting, pair: tuple[Edges, Edges], whole: bool, sheet: Shell) -> HingeTerm:
    """Hinges between two sides of a sheet (``whole``), or one and a side of the body that is fixed."""
    corners = side_type(pair[0].nodes.shape[1]).corners
    at, shares = np.tile(EDGE_POINTS[corners], (len(pair[0].place), 1)).T
    first, second = (edges[np.repeat(np.arange(len(edges.place)), len(at) // len(edges.place))] for edges in pair)
    alike = (first.ends == second.ends).all(axis=1)
    nodes, places = _patches(first, second)
    slopes, moments = np.zeros((len(nodes), 2, nodes.shape[1], 2)), np.zeros((len(nodes), 2, nodes.shape[1]))
    along, penalty, rows = np.zeros(nodes.shape), np.zeros(len(nodes)), np.arange(len(nodes))[:, None]
    for k, (edges, share) in enumerate(((first, at), (second, np.where(alike, at, 1 - at)))):
        here = _at_edges(setting.points, edges, share)
        slopes[rows, k, places[k]] = here.slopes
        if k == 0:
            along[rows, places[k]] = here.tangent
        if whole or k == 0:
            D = sheet_moduli(sheet, here.nu, here.tau) * _stiffness(setting, sheet)
            moment = np.einsum("...c,...cn->...n", D[..., 0, :], here.seconds)
            moments[rows, k, places[k]] = (0.5 if whole else 1.0) * moment
            penalty += edges.penalty * D[..., 0, 0] * (0.5 if whole else 2.0) / here.height
    slopes[alike, 1] = slopes[alike, 1, :, ::-1]  # turns the normal of a side that is wound the other way
    lengths = shares * np.linalg.norm(np.einsum("em,emi->ei", along, setting.points[nodes]), axis=1)
    hinge = HingeTerm(nodes, slopes, moments, along, np.zeros((len(nodes), 2)), lengths, penalty)
    return replace(hinge, rest=hinge.stresses(setting.points, np.zeros_like(setting.points)))


def _patches(first: Edges, second: Edges) -> tuple[Ints, tuple[Ints, Ints]]:
    """Nodes (e, 2 n - 3) of two sides with a common edge, and where the n nodes of each are among them, (e, n)."""
    same = second.nodes[:, :, None] == first.nodes[:, None, :]
    shared = same.any(axis=2)
    size = shared.shape[1]
    place = np.where(shared, same.argmax(axis=2), size - 1 + np.cumsum(~shared, axis=1))
    nodes = np.empty((len(place), 2 * size - 3), dtype=np.int64)
    nodes[:, :size] = first.nodes
    np.put_along_axis(nodes, place, second.nodes, axis=1)
    return nodes, (np.broadcast_to(np.arange(size), place.shape), place)


@dataclass(frozen=True, slots=True, eq=False)
class AtEdges:
    """Sides at points of their edges, at rest.

    Parameters
    ----------
    slopes : (e, n, 2) array
        Derivatives of the shape functions along the parameters.
    tangent : (e, n) array
        Derivatives along the edge, whose parameter runs from 0 to 1.
    nu, tau : (e, 3) arrays
        Unit vectors in the side, across the edge and along it.
    seconds : (e, 3, n) array
        Numbers of the second derivatives of the position across the edge, along it, and twice the mixed one.
    height : (e,) array
        Height of the side over the edge.
    """

    slopes: Array
    tangent: Array
    nu: Array
    tau: Array
    seconds: Array
    height: Array


def _at_edges(points: Array, edges: Edges, share: Array) -> AtEdges:
    """The sides of edges, each where a share (e,) of its edge is passed."""
    nodes = edges.nodes.shape[1]
    ends = reference_nodes(nodes)[edges.corners]
    way = ends[:, 1] - ends[:, 0]
    where = ends[:, 0] + share[:, None] * way
    slopes = tables_at(nodes, where, np.ones(len(where))).dN
    tangents = np.swapaxes(slopes, 1, 2) @ points[edges.nodes]
    arm = np.einsum("ea,eai->ei", way, tangents)
    length = np.linalg.norm(arm, axis=1)
    normal = np.cross(tangents[:, 0], tangents[:, 1])
    tau = arm / length[:, None]
    nu = np.cross(tau, normal)
    nu /= np.linalg.norm(nu, axis=1)[:, None]
    bends = second_derivatives(nodes, where)
    pairs = ((nu, nu, 1.0), (tau, tau, 1.0), (nu, tau, 2.0))
    seconds = np.stack([factor * curvature_numbers(tangents, bends, e, f) for e, f, factor in pairs], axis=1)
    tangent, height = np.einsum("ena,ea->en", slopes, way), np.linalg.norm(normal, axis=1) / length
    return AtEdges(slopes, tangent, nu, tau, seconds, height)
