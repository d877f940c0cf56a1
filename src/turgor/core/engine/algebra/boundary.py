"""Supports as prescribed displacement components."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.cyclic import CyclicPairs
from turgor.core.engine.algebra.multipoint import UNTIED, MultiPoint
from turgor.core.engine.algebra.node_frames import NodeFrames, across_fixed
from turgor.core.engine.algebra.rings import AXIAL, TANGENTIAL, rings_of
from turgor.core.engine.algebra.sections import Section, plane_sections
from turgor.core.engine.points.point_unknowns import Carrier, carriers_of, with_carrier_points
from turgor.core.engine.points.prescribed_motion import Turned, check_rigid, hold_points, rigid_ties
from turgor.core.model.model import Model
from turgor.core.model.supports import Support
from turgor.core.model.supports.radial import ROUND
from turgor.foundation.errors import TurgorError

AXES = "xyz"

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Nodes and normals of a support that fixes none.
NO_NORMALS = (np.zeros(0, dtype=np.int64), np.zeros((0, 3)))


@dataclass(frozen=True, slots=True, eq=False)
class PrescribedComponents:
    """Which displacement components are prescribed, and the functions that move some of them.

    Parameters
    ----------
    mask : (n + e, 3) bool array
        Prescribed components along the directions of the nodes: those of the mesh, then those of reference points.
    moving : tuple of (nodes, axes, Support or Turned)
    frames : NodeFrames
        Nodes whose components are not along x, y and z.
    along_axes : (n + e, 3) bool array
        Components along x, y and z that are prescribed, those of rigid faces left out.
    normals : (k, 3) array
        Of each node with a frame, the direction that is prescribed besides the axes; zero where there is none.
    ties : MultiPoint
        Components that follow others; followers count as prescribed.
    carriers : tuple of Carrier
        Reference points.
    """

    mask: NDArray[np.bool_]
    moving: tuple[tuple[Ints, list[int], Support | Turned], ...]
    frames: NodeFrames
    along_axes: NDArray[np.bool_]
    normals: Array
    ties: MultiPoint
    carriers: tuple[Carrier, ...] = ()

    def values(self, points: Array, load_factor: float) -> Array:
        """Prescribed components (n + e, 3) [m] of points at rest, at a load factor; zero where none is prescribed."""
        out, slides = np.zeros_like(points), np.zeros_like(points)
        for nodes, axes, support in self.moving:
            moved = np.broadcast_to(support.displacement(points[nodes], load_factor), (len(nodes), 3))
            if axes:
                out[nodes[:, None], axes] = moved[:, axes]
            else:
                slides[nodes] = moved
        if not len(self.frames.nodes):
            return out
        moved = np.einsum("ki,ki->k", self.normals, out[self.frames.nodes])
        out = self.frames.to_local(out)
        # the component along the normal is zero, or that of a slide: the first direction compensates the fixed axes
        moved = moved - np.einsum("ki,ki->k", self.normals, slides[self.frames.nodes])
        along = np.einsum("ki,ki->k", self.normals, self.frames.axes[:, 0])
        nodes = self.frames.nodes[along != 0]
        out[nodes, 0] = -moved[along != 0] / along[along != 0]
        return out

    def spread(self) -> sp.csr_matrix:
        """Displacements along x, y and z of all nodes, one row each, from the components that do not follow."""
        count, size = len(self.mask), self.mask.size
        axes = np.broadcast_to(np.eye(3), (count, 3, 3)).copy()
        axes[self.frames.nodes] = self.frames.axes
        turn = sp.bsr_matrix((axes.transpose(0, 2, 1), np.arange(count), np.arange(count + 1)), shape=(size, size))
        return (turn.tocsr() @ self.ties.spread(size)).tocsr()


def prescribed_components(model: Model) -> PrescribedComponents:
    """Collect what the supports of a model prescribe.

    Raises
    ------
    TurgorError
        If a support names directions or a face that it cannot hold.
    """
    carriers = carriers_of(model)
    mask = np.zeros((len(model.mesh.points) + sum(each.count for each in carriers), 3), dtype=bool)
    by_point = {each.point.name: each for each in carriers}
    moving: list[tuple[Ints, list[int], Support | Turned]] = []
    mirrored = np.zeros_like(mask)
    for support in model.supports:
        axes = support.components(model.mesh)
        if not axes:
            if support.moves and support.normals(model.mesh) is not None:  # along one direction of its own
                moving.append((support.nodes(model.mesh), axes, support))
            continue
        point = by_point.get(support.place)
        nodes = support.nodes(model.mesh) if point is None else np.array([point.node])
        (mirrored if support.mirror else mask)[nodes[:, None], axes] = True
        if support.moves:
            moving.append((nodes, axes, support))
    radial, sections = radial_normals(model), plane_sections(model)
    check_rigid(carriers, mask, np.concatenate([radial[0], *(section.nodes for section in sections)]))
    mask |= mirrored
    moving += [(nodes, [0, 1, 2], turned) for nodes, turned in hold_points(model, carriers, mask)]
    for section in sections:
        section.check(mask)
        mask[section.nodes, section.axis] = True
    if model.mesh.revolved:
        return _around_axis(model, mask, tuple(moving), sections, carriers)
    prescribed = _with_normals(mask, tuple(moving), radial, sections)
    if model.mesh.wedge is not None:
        prescribed = _with_cyclic(model, prescribed, mask, sections)
    return _with_rigid(prescribed, carriers)


def _with_rigid(prescribed: PrescribedComponents, carriers: tuple[Carrier, ...]) -> PrescribedComponents:
    """Let rigid faces follow their reference points."""
    followers, leaders, weights = rigid_ties(carriers)
    prescribed.mask.ravel()[followers] = True
    ties = MultiPoint(
        np.concatenate([prescribed.ties.followers, followers]),
        np.concatenate([prescribed.ties.leaders, leaders]),
        np.concatenate([prescribed.ties.weights, weights]),
    )
    return replace(prescribed, ties=ties, carriers=carriers)


def _with_cyclic(
    model: Model, prescribed: PrescribedComponents, mask: NDArray[np.bool_], sections: tuple[Section, ...]
) -> PrescribedComponents:
    """Let the higher cut face of a wedge follow the lower one; ``mask`` are components prescribed along the axes."""
    carriers = carriers_of(model)
    pairs = CyclicPairs.of(model.mesh, carriers)
    pairs.check_alike(mask)
    pairs.check_sections(sections)
    local, along = prescribed.mask.copy(), prescribed.along_axes.copy()
    local[pairs.low] |= local[pairs.high]
    for both in (local, along):
        both[pairs.on_axis[:, None], pairs.wedge.across] = True
    frames, normals = pairs.frames(prescribed.frames, prescribed.normals, len(mask))
    ties = pairs.ties(prescribed.ties, len(mask))
    prescribed = replace(prescribed, mask=local, frames=frames, along_axes=along, normals=normals, ties=ties)
    points = with_carrier_points(model.mesh.points, carriers)
    for nodes, _, support in prescribed.moving:
        if not isinstance(support, Turned):
            pairs.check_moved(np.where(local, prescribed.values(points, 1.0), 0.0), nodes, support.place)
    local.ravel()[ties.followers] = True
    return prescribed


def _around_axis(
    model: Model,
    mask: NDArray[np.bool_],
    moving: tuple[tuple[Ints, list[int], Support | Turned], ...],
    sections: tuple[Section, ...],
    carriers: tuple[Carrier, ...],
) -> PrescribedComponents:
    """Hold and tie the nodes of a body of revolution ring by ring; see `turgor.core.engine.algebra.rings`.

    Its mirror planes leave a reference point the way along the axis alone, which a rigid face follows; the radii of
    the face stay.
    """
    rings, count = rings_of(model.mesh), len(model.mesh.points)
    for section in sections:
        mask[section.nodes, section.axis] = False  # its leader is free, and the others follow it
        if section.axis != rings.axis:
            raise TurgorError(
                f"PlaneSection of '{section.face}': its normal must be the axis {AXES[rings.axis]} of the axisymmetric "
                "mesh."
            )
    rigid = [each for each in carriers if each.rigid]
    radial = np.concatenate([radial_normals(model)[0], *(each.nodes for each in rigid)])
    local = np.concatenate([rings.local_mask(mask[:count], radial), mask[count:]])
    together = [(section.nodes, 3 * section.leader + AXIAL) for section in sections]
    together += [(each.nodes, 3 * each.node + rings.axis) for each in rigid]
    ties = rings.ties(together, len(mask))
    along_axes = mask.copy()
    along_axes[:count] |= rings.on_axis[:, None] & (np.arange(3) != rings.axis)
    prescribed = PrescribedComponents(
        local, moving, rings.frames, along_axes, np.zeros_like(model.mesh.points), ties, carriers
    )
    for nodes, _, support in moving:
        swept = prescribed.values(with_carrier_points(model.mesh.points, carriers), 1.0)[nodes]
        across = np.abs(swept[:, TANGENTIAL]).max(initial=0.0)
        if not isinstance(support, Turned) and across > ROUND * np.abs(swept).max():
            raise TurgorError(
                f"{type(support).__name__} of '{support.place}': it moves the face around the axis or across it, "
                "which an axisymmetric mesh cannot follow; move it along the axis, or use another kind of cells."
            )
    local.ravel()[ties.followers] = True
    return prescribed


def _with_normals(
    mask: NDArray[np.bool_],
    moving: tuple[tuple[Ints, list[int], Support | Turned], ...],
    radial: tuple[Ints, Array],
    sections: tuple[Section, ...],
) -> PrescribedComponents:
    """Hold nodes along normals too: their first direction is the part of the normal across the fixed axes.

    The components along the normal of a plane section are prescribed in ``mask``, so that each is a direction of its
    node. Then they are tied to that of the first node.
    """
    for section in sections:
        section.check_across(*radial)
    rows, rest = across_fixed(*radial, mask)
    nodes, first, counts = np.unique(rows, return_index=True, return_counts=True)
    axes = np.empty((len(nodes), 3, 3))
    local, along = mask.copy(), mask.copy()
    for k, (node, start, count) in enumerate(zip(nodes, first, counts, strict=True)):
        own = np.concatenate([rest[start : start + count], np.eye(3)[mask[node]]])
        basis = np.linalg.qr(np.concatenate([own, np.eye(3)]).T)[0].T
        axes[k] = np.concatenate([own, basis[len(own) :]])[:3]
        local[node] = np.arange(3) < len(own)
        along[node] |= local[node].all()
    normals = _single_normals(nodes, radial, moving)
    ties = _ties(mask, dict(zip(nodes.tolist(), counts.tolist(), strict=True)), sections)
    local.ravel()[ties.leaders] = False
    return PrescribedComponents(local, moving, NodeFrames(nodes, axes), along, normals, ties)


def _single_normals(
    nodes: Ints, radial: tuple[Ints, Array], moving: tuple[tuple[Ints, list[int], Support | Turned], ...]
) -> Array:
    """The normal of each node (k, 3), zero where it has several; such a node may not be moved by another support."""
    every, first, counts = np.unique(radial[0], return_index=True, return_counts=True)
    if any(np.isin(every[counts > 1], moved).any() for moved, _, _ in moving):
        raise TurgorError(
            "a face is moved at nodes that two supports hold along their normals (Radial or Roller); end it before "
            "their common edge."
        )
    place = np.searchsorted(every, nodes)
    return np.where((counts[place] > 1)[:, None], 0.0, radial[1][first[place]])


def _ties(mask: NDArray[np.bool_], turned: Mapping[int, int], sections: tuple[Section, ...]) -> MultiPoint:
    """Tie the components along the normal of each section to that of its first node.

    ``turned`` are the nodes with a frame, and the number of their normals.
    """
    followers, leaders = [UNTIED.followers], [UNTIED.leaders]
    for section in sections:
        # of a node with a frame, the fixed axes come after the normals, in their order
        rank = mask[section.nodes, : section.axis].sum(axis=1)
        normals = np.array([turned.get(node, 0) for node in section.nodes.tolist()])
        tied = 3 * section.nodes + np.where(normals > 0, normals + rank, section.axis)
        followers.append(tied[1:])
        leaders.append(np.full(len(tied) - 1, tied[0]))
    tied = np.concatenate(followers)
    return MultiPoint(tied, np.concatenate(leaders), np.ones(len(tied)))


def radial_normals(model: Model, *, moved: bool = True) -> tuple[Ints, Array]:
    """Find the nodes (k,) that are fixed along normals, such as a fixed radius, and these normals (k, 3) at rest.

    A node stands there once for each of its normals.

    Parameters
    ----------
    model : Model
    moved : bool
        Whether those count along which a `Slide` moves them.

    Returns
    -------
    tuple of array
    """
    rows: list[tuple[int, Array]] = []
    normals_at: dict[int, list[Array]] = {}
    for support in (each for each in model.supports if moved or not each.moves):
        nodes, normals = support.normals(model.mesh) or NO_NORMALS
        for node, normal in zip(nodes.tolist(), normals, strict=True):
            known = normals_at.setdefault(node, [])
            if all(abs(float(each @ normal)) < 1 - 1e-6 for each in known):
                known.append(normal)
                rows.append((node, normal))
    return np.array([row[0] for row in rows], dtype=np.int64), np.array([row[1] for row in rows]).reshape(-1, 3)
