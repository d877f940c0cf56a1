"""Openings of a cavity: where its faces end, off the mirror planes and the cut faces of a wedge."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.wedge import HIGH, LOW
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.cells import side_type
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.finding import Finding, Severity

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: How far an opening may bulge, as a share of its width; a radial hole as wide as the radius of its tube does by 0.13.
FLAT = 0.2

#: An opening of more than this share of the box around a cavity is hardly an inlet.
WIDE = 0.15


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rim:
    """One connected part of the edges at which a surface ends.

    Parameters
    ----------
    center : (3,) array [m]
        Mean of its nodes.
    edges : int
        How many edges it has.
    area : float [m²]
        Area of the fan from its center; of half the opening where a mirror plane cuts it.
    simple : bool
        Whether it is one loop, or one line from mirror plane to mirror plane, or from cut to cut of a wedge.
    bulge : float
        Extent across its plane over its width.
    node : int
        One of its corners.
    """

    center: Array
    edges: int
    area: float
    simple: bool
    bulge: float
    node: int

    @property
    def is_opening(self) -> bool:
        """Whether it can be closed by a cap: one nearly plane loop, such as the mouth of an air inlet."""
        return self.simple and self.bulge <= FLAT


def find_rims(mesh: Mesh, rim: Ints) -> tuple[Rim, ...]:
    """Find where a surface ends away from the mirror planes.

    Parameters
    ----------
    mesh : Mesh
    rim : (e, 3) int array
        The edges at which it ends, from `turgor.core.meshing.surface.rim_edges`.

    Returns
    -------
    tuple of Rim
        Empty for a surface that is closed, or closed by mirror planes.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> from turgor.core.meshing.surface import rim_edges
    >>> finger = mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3)
    >>> find_rims(finger, rim_edges(finger.face("cavity")))
    ()
    >>> [rim.is_opening for rim in find_rims(finger, rim_edges(finger.face("tip")))]
    [True]
    """
    at_mirror, mirror = np.zeros(len(rim), dtype=bool), np.full(mesh.points.shape, np.nan)
    for name, (axis, position) in mirror_planes(mesh).items():
        nodes = mesh.face_nodes(name)
        at_mirror |= np.isin(rim, nodes).all(axis=1)
        mirror[nodes, axis] = position
    if mesh.wedge is not None:
        at_mirror |= _at_cuts(mesh, rim)
        for axis in mesh.wedge.across:  # what goes on all around has its middle on the axis
            for name in (LOW, HIGH):
                mirror[mesh.face_nodes(name), axis] = mesh.wedge.center[axis]
    rim = rim[~at_mirror]
    if mesh.revolved:  # around the pinhole on the axis
        rim = rim[~mesh.on_axis[rim].all(axis=1)]
    if not len(rim):
        return ()
    nodes, ends = np.unique(rim[:, :2], return_inverse=True)
    ends = ends.reshape(-1, 2)
    label = groups_of(len(nodes), ends[:, 0], ends[:, 1])
    degree = np.bincount(ends.ravel(), minlength=len(nodes))
    fine = (degree == 2) | ((degree == 1) & np.isfinite(mirror[nodes]).any(axis=1))
    return tuple(
        _rim(mesh.points, rim[label[ends[:, 0]] == i], mirror, bool(fine[label == i].all()))
        for i in range(int(label.max()) + 1)
    )


def _at_cuts(mesh: Mesh, rim: Ints) -> NDArray[np.bool_]:
    """Which edges (e, 3) lie in a cut face of a wedge."""
    return np.asarray(np.any([np.isin(rim, mesh.face_nodes(name)).all(axis=1) for name in (LOW, HIGH)], axis=0))


def torn_rims(mesh: Mesh, surface: Ints, edges: Ints) -> tuple[Rim, ...]:
    """Find the rims that are no openings: not plane, or in the wall of a closed void of which a part has no name.

    Parameters
    ----------
    mesh : Mesh
    surface : (f, k) int array
        The whole surface of the mesh.
    edges : (e, 3) int array
        The edges at which a cavity ends.

    Returns
    -------
    tuple of Rim
        Empty where the cavity encloses a volume.
    """
    return tuple(rim for rim in find_rims(mesh, edges) if not rim.is_opening or _in_void(mesh, surface, rim.node))


def check_openings(mesh: Mesh, surface: Ints, rims: Mapping[str, Ints]) -> tuple[Finding, ...]:
    """Check that every cavity is closed (G02), up to mirror planes and plane openings such as an air inlet (D01).

    Parameters
    ----------
    mesh : Mesh
    surface : (f, k) int array
        The whole surface of the mesh.
    rims : mapping of str to (e, 3) int array
        The edges at which each cavity ends.

    Returns
    -------
    tuple of Finding
    """
    findings = []
    for name, edges in rims.items():
        own_rims = find_rims(mesh, edges)
        torn = torn_rims(mesh, surface, edges)
        if torn:
            findings.append(_torn(name, torn))
        elif own_rims:
            findings.append(_open(name, own_rims, mesh))
    return tuple(findings)


def _torn(name: str, rims: tuple[Rim, ...]) -> Finding:
    x, y, z = rims[0].center * 1e3
    return Finding(
        code="G02",
        severity=Severity.ERROR,
        message=f"Face '{name}' is not closed: {sum(rim.edges for rim in rims)} of its edges end away from a "
        f"mirror plane and bound no plane opening, around ({x:.3g}, {y:.3g}, {z:.3g}) mm.",
        advice="Name all walls of the cavity, close its inlet, or name the mirror planes symmetry_*; "
        "such a cavity has no volume and its pressure no potential.",
    )


def _in_void(mesh: Mesh, surface: Ints, node: int) -> bool:
    """Whether a node lies on a part of the surface that is closed, up to mirror planes, and looks inward.

    A film without a solid looks into its cavity everywhere, and is open at its rims.
    """
    if not len(mesh.cells):
        return False
    corners = side_type(surface.shape[1]).corners
    on_mirror, origin = np.zeros(len(surface), dtype=bool), mesh.points[node].copy()
    for name, (axis, position) in mirror_planes(mesh).items():
        on_mirror |= np.isin(surface, mesh.face_nodes(name)).all(axis=1)
        origin[axis] = position  # so that the missing wall there adds nothing to the volume
    if mesh.wedge is not None:
        on_mirror |= np.any([np.isin(surface, mesh.face_nodes(name)).all(axis=1) for name in (LOW, HIGH)], axis=0)
        across = list(mesh.wedge.across)
        origin[across] = np.array(mesh.wedge.center)[across]
    walls = surface[~on_mirror, :corners]
    owner = np.repeat(np.arange(len(walls)), corners)
    label = groups_of(len(walls) + len(mesh.points), owner, len(walls) + walls.ravel())[: len(walls)]
    ours = walls[label == label[(walls == node).any(axis=1)][0]]
    a, b, c = (mesh.points[ours[:, i]] - origin for i in range(3))
    volume = np.einsum("fi,fi->", a, np.cross(b, c))
    if corners == 4:
        d = mesh.points[ours[:, 3]] - origin
        volume += np.einsum("fi,fi->", a, np.cross(c, d))
    return bool(volume < 0)


def _open(name: str, rims: tuple[Rim, ...], mesh: Mesh) -> Finding:
    places = " and ".join(
        f"{rim.area * 1e6:.3g} mm² at ({', '.join(f'{value * 1e3 + 0.0:.3g}' for value in rim.center)}) mm"
        for rim in rims
    )
    a, b, c = np.ptp(mesh.points[mesh.face_nodes(name)], axis=0)
    wide = len(mesh.cells) > 0 and sum(rim.area for rim in rims) > WIDE * 2 * (a * b + b * c + c * a)
    return Finding(
        code="D01",
        severity=Severity.WARNING if wide else Severity.NOTE,
        message=f"Face '{name}' is open to the outside: {places}. Its volume is measured up to a cap over the opening.",
        advice=("If this is a mirror plane, name it symmetry_*. " if wide else "")
        + "The pressure pushes on the walls only; what it would do to a plug or a tube in the opening is left "
        "out. Close the inlet in the CAD program if that matters.",
    )


def mirror_planes(mesh: Mesh) -> dict[str, tuple[int, float]]:
    """Axis and position of each mirror plane."""
    return dict(zip(mesh.symmetry_faces, mesh.mirror_planes, strict=True))


def _rim(points: Array, edges: Ints, mirror: Array, simple: bool) -> Rim:
    """Describe a rim; ``mirror`` holds for every node the coordinates that a mirror plane fixes, else nan."""
    nodes = np.unique(edges)
    around = points[nodes]
    center = around.mean(axis=0)
    for axis in range(3):  # half an opening has its middle in the mirror plane
        fixed = mirror[nodes, axis]
        if np.isfinite(fixed).any():
            center[axis] = np.nanmean(fixed)
    _, _, axes = np.linalg.svd(around - center)
    extent = np.ptp((around - center) @ axes.T, axis=0)
    start, end, middle = (points[edges[:, i]] - center for i in range(3))
    fan = (np.cross(start, middle) + np.cross(middle, end)).sum(axis=0) / 2
    # two edges of a straight rim have no width across: they are no opening
    bulge = float(extent[2] / extent[1]) if extent[1] > 0 else np.inf
    return Rim(
        center=center,
        edges=len(edges),
        area=float(np.linalg.norm(fan)),
        simple=simple,
        bulge=bulge,
        node=int(edges[0, 0]),
    )
