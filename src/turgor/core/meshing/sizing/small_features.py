"""Small features: fillets and other rounds of small radius, along which cells need not be small.

The mesh generator makes cells small in all directions where a surface is curved. A bellows of six lobes with fillets
of 0.8 mm got 310,000 unknowns for a quarter so, and 22,000 without smaller cells along its fillets. Its extension at
0.2 kPa is 4.68 mm (axisymmetric meshes of 6,000 to 9,000 unknowns, within 0.05 %). Small cells along every fillet gave
4.620 mm, coarse ones of 2.5 mm 4.466 mm with one cell through the wall and 4.604 mm with two (74,000 unknowns).

Cells through the wall at the fillets decide. With a linear load, at 2.5 mm: 5.3 % too stiff with one cell, 0.5 % with
those edges through the wall cut whose ends both lie at fillets (52,000 unknowns). Cutting each arc of a fillet instead
made it stiffer (9.7 %, 35,000 unknowns), smaller cells of 1.6 mm too (8.3 %), and straight sides by far (24 %).
"""

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.geometry.cad.facets import RoundFacets, round_facets
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.sizing.settings import FEATURES, SIZING
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Advice for a body of revolution.
REVOLVED = (
    ' The part is a body of revolution: where its loads are the same all around, cells = "axisymmetric" follows the '
    "rounds with a fraction of the unknowns."
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SmallFeatures:
    """Faces that stay coarse, and the sizes of all other curved faces.

    Parameters
    ----------
    limit : float [m]
        Radii below it are left coarse.
    smallest : float [m]
        Smallest radius that is left coarse.
    faces : mapping of str to int
        How many CAD faces of each name are left coarse.
    unknowns : float
        About how many unknowns small cells along them would have added.
    lines : (k, 2, 3) array [m]
        Edges of the facets of curved faces that are followed.
    line_sizes : (k,) array [m]
        Sizes along these lines.
    """

    limit: float
    smallest: float
    faces: dict[str, int]
    unknowns: float
    lines: Array
    line_sizes: Array


def small_features(geometry: Geometry, size: float, limit: float | None) -> SmallFeatures | None:
    """Find rounds that are left coarse; None where nothing is.

    Parameters
    ----------
    geometry : Geometry
    size : float [m]
        Size of the mesh.
    limit : float or None [m]
        Radii below it are left coarse. None takes half the size in a part that comes from a CAD file, where cells along
        these radii would make more unknowns than all others.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
    >>> small_features(ExtendingCylinder().build(), 2e-3, None) is None
    True
    """
    if isinstance(geometry.shape, SurfaceShape) or (limit is None and not geometry.file) or limit == 0:
        return None
    geometry._cad.MakeTriangulation()
    facets, scale = round_facets(geometry._cad), geometry.length_scale
    radii, areas = facets.radii * scale, facets.areas * scale**2
    stated = limit is not None
    limit = FEATURES.coarse_radius * size if limit is None else limit
    small = radii < limit
    sizes = np.minimum(radii / SIZING.cells_per_radius, size)
    added = float(SIZING.unknowns_per_area * (areas * (sizes**-2 - size**-2))[small].sum())
    rest = SIZING.unknowns_per_volume * geometry.solid_volume / size**3
    if not small.any() or not (stated or added > max(FEATURES.unknowns, rest)):
        return None
    sizes[small] = size
    wide = _wide_rounds(facets, small, limit / scale)
    sizes[wide] = np.minimum(radii[wide], size)  # six cells around
    followed = sizes < size
    corners = facets.corners[followed] * scale
    return SmallFeatures(
        limit=limit,
        smallest=float(radii[small].min()),
        faces=dict(Counter(str(facets.faces[i].name) for i in np.unique(facets.face[small]))),
        unknowns=added,
        lines=np.stack([corners, np.roll(corners, 1, axis=1)], axis=2).reshape(-1, 2, 3),
        line_sizes=np.repeat(sizes[followed], 3),
    )


def _wide_rounds(facets: RoundFacets, small: NDArray[np.bool_], limit: float) -> NDArray[np.bool_]:
    """Small facets of faces that turn far within a distance of twice the radius, as holes do and fillets do not."""
    wide = np.zeros(len(small), dtype=bool)
    for number in np.unique(facets.face[small]):
        own = small & (facets.face == number)
        points, normals = facets.corners[own].reshape(-1, 3), facets.normals[own].reshape(-1, 3)
        reach = 2 * min(float(np.median(facets.radii[own])), limit)
        a, b = cKDTree(points).query_pairs(reach * (1 + 1e-4), output_type="ndarray").T
        if (np.einsum("pi,pi->p", normals[a], normals[b]) < FEATURES.turned).any():
            wide |= own
    return wide


def has_tiny_edges(geometry: Geometry, limit: float) -> bool:
    """Whether a CAD shape has edges shorter than half of a limit [m], such as those of engraved text."""
    return any(edge.mass * geometry.length_scale < FEATURES.coarse_radius * limit for edge in geometry._cad.edges)


def coarse_edges(limit: float, spared: float, filled: float) -> Finding:
    """Say that the mesh does not keep small edges.

    Parameters
    ----------
    limit : float [m]
    spared : float [-]
        Share of the unknowns that this spares.
    filled : float [-]
        Volume of the cells over the volume of the part.
    """
    return Finding(
        code="G11",
        severity=Severity.NOTE,
        message=f"The faces have edges shorter than {FEATURES.coarse_radius * limit / mm:.3g} mm, which cells need not "
        f"keep: the part was filled within an envelope of its facets, with {spared:.0%} fewer unknowns. The cells fill "
        f"{_off(filled)} than the part.",
        advice="Leave ignore_features_below out to keep all edges.",
    )


def coarse_features(features: SmallFeatures, stated: bool, filled: float, revolved: bool) -> Finding:
    """Say which faces were left coarse and by how much the volume differs.

    Parameters
    ----------
    features : SmallFeatures
    stated : bool
        Whether the limit was given.
    filled : float [-]
        Volume of the cells over the volume of the part.
    revolved : bool
        Whether the part is a body of revolution, so that its meridian can be meshed instead.
    """
    names = ", ".join(f"{count} of {name}" for name, count in features.faces.items())
    return Finding(
        code="G11",
        severity=Severity.NOTE,
        message=f"Cells are not smaller along rounds with a radius below {features.limit / mm:.3g} mm: {names} "
        f"(smallest radius {features.smallest / mm:.3g} mm). Smaller cells there would add about "
        f"{round(features.unknowns, -3):,.0f} unknowns. The cells fill {_off(filled)} than the part.",
        advice="Where walls bend at these rounds, compare with two cells through them (wall_cells = 2). "
        + ("A smaller ignore_features_below" if stated else "ignore_features_below = 0")
        + " follows them with small cells."
        + (REVOLVED if revolved else ""),
    )


def _off(filled: float) -> str:
    return f"{abs(filled - 1):.2%} {'more' if filled > 1 else 'less'}"
