"""Reading of STL files, which hold triangles without names, as CAD bodies."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.facets import find_facets, flux
from turgor.core.geometry.cad.surface.crossing import winding
from turgor.core.geometry.cad.surface.orientation import shells_of
from turgor.core.geometry.cad.surface.part import is_flat, surface_items
from turgor.core.geometry.cad.surface.repair import repaired
from turgor.core.geometry.cad.surface.settings import SURFACE
from turgor.core.geometry.cad.surface.shape import SurfaceShape, surface_shape
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StlBodies:
    """Bodies of an STL file.

    Parameters
    ----------
    bodies : list
        CAD solids where all walls are plane; one `SurfaceShape` where some are curved or rough.
    findings : tuple of Finding
        What was repaired.
    """

    bodies: list[Any]
    findings: tuple[Finding, ...]


def stl_bodies(path: Path) -> StlBodies:
    """Read an STL file as bodies. Its surface is repaired; walls that are plane become one CAD face each.

    Parameters
    ----------
    path : Path
        Text or binary.

    Raises
    ------
    TurgorError
        If it is damaged, open in a way that cannot be repaired, flat, crosses itself, or has too many triangles.
    """
    corners = read_stl(path)
    if len(corners) > SURFACE.most_triangles:
        raise TurgorError(
            f"'{path}' has {len(corners)} triangles; at most {SURFACE.most_triangles} can be read. Export STEP, which "
            "keeps curved walls, or a coarser STL."
        )
    fixed = repaired(corners, path.name)
    shape = surface_shape(fixed.points, fixed.triangles)
    bodies = _sewn(fixed.points, fixed.triangles) if _is_plane(shape) and not fixed.crossing else []
    if not bodies:
        _check_single(path, shape)
    return StlBodies(bodies=bodies or [shape], findings=fixed.findings)


def _is_plane(shape: SurfaceShape) -> bool:
    """Whether a surface consists of few plane walls."""
    if len(shape.faces) > SURFACE.sewn_faces or len(shape.triangles) > SURFACE.sewn_triangles:
        return False
    plane = sum(face.mass for face, item in zip(shape.faces, surface_items(shape), strict=True) if is_flat(item))
    return plane >= SURFACE.sewn_share * sum(face.mass for face in shape.faces)


def _check_single(path: Path, shape: SurfaceShape) -> None:
    """Refuse bodies apart from each other."""
    shell = shells_of(shape.triangles)
    origin = shape.points.mean(axis=0)
    volumes = [flux(shape.points, shape.triangles[shell == i], origin) for i in range(int(shell.max()) + 1)]
    solids = [number for number, volume in enumerate(volumes) if volume > 0]
    if len(solids) > 1:
        places = [shape.corners[shell == number].mean(axis=(0, 1)) for number in solids[:3]]
        listed = ", ".join(f"({x:.4g}, {y:.4g}, {z:.4g})" for x, y, z in places)
        raise TurgorError(
            f"'{path}' has {len(solids)} bodies that are not joined to each other, around {listed} in units of the "
            "file: nothing would hold them; move them together in the CAD program, or export one body."
        )


def _sewn(points: Array, triangles: Ints) -> list[Any]:
    """CAD solids of plane triangles; none where the CAD kernel cannot sew them."""
    shells = list(occ.Sew([_face(points[triangle]) for triangle in triangles]).shells)
    return _nested(sorted((_positive(shell) for shell in shells), key=lambda solid: -solid.mass)) if shells else []


def read_stl(path: Path) -> Array:
    """Read the triangles of an STL file, text or binary, (t, 3, 3)."""
    content = path.read_bytes()
    count = int.from_bytes(content[80:84], "little") if len(content) >= 84 else -1
    if len(content) == 84 + 50 * count and count > 0:
        kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        with np.errstate(invalid="ignore"):  # damaged numbers are refused below
            corners = np.frombuffer(content, dtype=kind, offset=84)["corners"].astype(np.float64)
    else:
        number = rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
        vertices = re.findall(rb"vertex\s+(%b)\s+(%b)\s+(%b)" % (number, number, number), content)
        if not content.lstrip().startswith(b"solid") or not vertices or len(vertices) % 3:
            raise TurgorError(
                f"'{path}' is no whole STL file: neither text that begins with 'solid' and has three vertices a "
                "triangle nor binary of the length that it states; export it again."
            )
        if len(vertices) < len(re.findall(rb"^\s*vertex\b", content, re.MULTILINE)):
            raise TurgorError(f"'{path}' has corners that are not finite numbers; export it again.")
        corners = np.array(vertices, dtype=np.float64).reshape(-1, 3, 3)
    if not np.isfinite(corners).all():
        raise TurgorError(f"'{path}' has corners that are not finite numbers; export it again.")
    return corners


def _face(corners: Array) -> Any:
    a, b, c = (occ.Pnt(*map(float, corner)) for corner in corners)
    return occ.Face(occ.Wire([occ.Segment(a, b), occ.Segment(b, c), occ.Segment(c, a)]))


def _positive(shell: Any) -> Any:
    """Body within a shell, for either orientation of its triangles, with one face for each plane wall."""
    solid = occ.Solid(shell)
    if solid.mass < 0:
        solid = occ.Solid(shell.Reversed())
    return solid.UnifySameDomain()


def _nested(solids: list[Any]) -> list[Any]:
    """Subtract each shell that lies in an odd number of others from the smallest of them, the largest first."""
    triangles = [_triangles(solid) for solid in solids]
    bodies: dict[int, Any] = {}
    for i, solid in enumerate(solids):
        around = [j for j in range(i) if winding(triangles[i][0].mean(axis=0), triangles[j]) > 0.5]
        if len(around) % 2 == 0:
            bodies[i] = solid
        else:
            bodies[around[-1]] = bodies[around[-1]] - solid
    return [solid for body in bodies.values() for solid in body.solids]


def _triangles(solid: Any) -> Array:
    return find_facets(solid, list(dict.fromkeys(solid.faces))).corners()
