"""read_mesh: a volume mesh from a file of gmsh, Abaqus, CalculiX or VTK."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from turgor.core.geometry.cad_unit import LARGEST_EXTENT, SMALLEST_EXTENT, unit_in_doubt
from turgor.core.geometry.directions import FileAxes
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.exchange.boundary import Sides, sides_of
from turgor.core.meshing.exchange.file_sets import sets_of_file, whole_faces
from turgor.core.meshing.exchange.formats.abaqus import read_abaqus
from turgor.core.meshing.exchange.formats.gmsh import read_gmsh
from turgor.core.meshing.exchange.formats.raw import Array, Ints, RawMesh
from turgor.core.meshing.exchange.formats.vtk_legacy import read_vtk
from turgor.core.meshing.exchange.formats.vtu import read_vtu
from turgor.core.meshing.exchange.frame import Frame
from turgor.core.meshing.exchange.names import Wishes, name_faces, name_regions
from turgor.core.meshing.exchange.selectors import Choice
from turgor.core.meshing.exchange.settings import MESH_FILE
from turgor.core.meshing.exchange.solids import Solids, place_of, read_solids
from turgor.core.meshing.exchange.splitting import as_tetrahedra, needs_tetrahedra
from turgor.core.meshing.mesh import PINHOLE, Mesh
from turgor.core.meshing.quality.cell_quality import refuse_inverted
from turgor.foundation.errors import TurgorError, near_file, near_match
from turgor.foundation.finding import Finding, Severity
from turgor.units import UNITS, deg, mm

READERS: Mapping[str, Callable[[Path], RawMesh]] = {
    ".msh": read_gmsh,
    ".inp": read_abaqus,
    ".vtk": read_vtk,
    ".vtu": read_vtu,
}

#: Unit of length of files that state none.
DEFAULT_UNIT = "mm"


def read_mesh(
    path: str | Path,
    *,
    unit: str | float | None = None,
    regions: Mapping[str, Choice] | None = None,
    faces: Mapping[str, Choice] | None = None,
    cavities: Mapping[str, str | Path] | None = None,
    axes: FileAxes = ("x", "y", "z"),
    merge: bool = True,
) -> Mesh:
    """Read a volume mesh: gmsh ``.msh`` (2.2, 4.1), Abaqus or CalculiX ``.inp``, VTK ``.vtk`` or ``.vtu``.

    Physical groups, sets and surfaces of the file become regions and faces; edges and points with a name become node
    sets, which supports and forces may name. What has no name is named by its shape:
    closed inner surfaces are cavities, the rest is ``outside``. Cells of first order become quadratic with straight
    edges. The ``findings`` of the mesh say what was repaired or guessed.

    Parameters
    ----------
    path : str or Path
        The file; its ending says what it is.
    unit : str or float, optional
        Unit of length of the file, ``"mm"``, ``"cm"``, ``"m"``, ``"um"`` or ``"in"``, or its length in meters. Only
        VTU files of turgor state it; others are in mm where it is not given.
    regions : mapping of str to str or selector, optional
        Region names with what they mean: a group of the file, or a box (`InBox`) that holds the centers of its
        cells. Other cells keep their group, or are ``body``.
    faces : mapping of str to str or selector, optional
        Face names with what they mean: a group, surface or set of the file, or selectors (`InBox`, `WithNormal`,
        `NearestTo`, `ByNodes`, `BySides`; several in a list must all hold). Names that begin with ``symmetry_`` are
        mirror planes.
    cavities : mapping of str to str or Path, optional
        Cavity names with STL files of their surfaces, in the unit of the mesh.
    axes : tuple of three str or (3,) floats
        Directions in the file of our x (from the fixed end to the tip), y (across) and z (up), such as
        ``("-x", "z", "y")``; boxes, planes and directions above are in our axes.
    merge : bool
        Whether nodes at the same place become one. Without that bodies that touch stay apart, with contact between
        them.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If the file cannot be read, has no cells that can be solved on, cells turned inside out, or an unlikely size.
    """
    file = Path(path)
    raw, frame = read_in(file, unit, axes)
    named = Wishes(regions=regions or {}, faces=faces or {}, cavities=cavities or {}, frame=frame, merge=merge)
    mesh = named_mesh(raw, named)
    return with_unit_checked(mesh, file, stated=bool(unit or raw.unit))


def read_in(file: Path, unit: str | float | None, axes: FileAxes) -> tuple[RawMesh, Frame]:
    """Read the content of a file of any format, and its unit and axes."""
    if unit is not None:
        Frame(unit=unit, axes=axes)  # what is wrong with these is reported before the file is read
    raw = _read(file)
    return raw, Frame(unit=unit or raw.unit or DEFAULT_UNIT, axes=axes)


def with_unit_checked(mesh: Mesh, file: Path, stated: bool) -> Mesh:
    """The mesh with a finding where its file states no unit and it is tiny in the usual one (P09)."""
    doubt = () if stated else unit_in_doubt(file.name, float(np.ptp(mesh.points, axis=0).max()))
    return replace(mesh, findings=(*mesh.findings, *doubt)) if doubt else mesh


def named_mesh(raw: RawMesh, wishes: Wishes) -> Mesh:
    """Check, repair and name the content of a file.

    Parameters
    ----------
    raw : RawMesh
    wishes : Wishes
        Unit, axes and names that were requested.

    Returns
    -------
    Mesh
    """
    _check_extent(raw, wishes.frame)
    done = []
    if needs_tetrahedra(raw):
        raw, what = as_tetrahedra(raw, wishes.merge)
        done = [what]
    solids = read_solids(raw, wishes.frame, wishes.merge)
    solids.done[:0] = done
    sides = sides_of(solids)
    if raw.revolved:
        sides = _without_pinhole(sides, raw.revolved)
    region_cells, notes = name_regions(raw, solids, wishes)
    face_sides, more = name_faces(raw, solids, sides, wishes)
    more += _put_on_planes(raw.path, solids.points, sides, face_sides)
    mesh = Mesh(
        points=solids.points,
        cells=solids.cells,
        regions=region_cells,
        faces={face: sides.nodes[rows] for face, rows in face_sides.items()},
        name=raw.path.stem,
        node_sets=sets_of_file(raw, solids, whole_faces(raw, solids, sides, face_sides)),
        revolved=raw.revolved,
    )
    if solids.kind is TETRAHEDRON:
        refuse_inverted(mesh, f"repair '{raw.path.name}' where it was made, or export cells of first order")
    findings = (*_mended(raw.path, solids), *_overlapping(raw.path, solids), *_straight(raw, sides), *notes, *more)
    return replace(mesh, findings=findings)


def _without_pinhole(sides: Sides, axis: str) -> Sides:
    """The sides of a revolved mesh about an axis through the origin; those around its pinhole bound nothing."""
    radius = np.hypot(*np.delete(sides.points, "xyz".index(axis), axis=1).T)
    near = radius <= 2 * PINHOLE * radius.max()
    return replace(sides, outer=sides.outer & ~near[sides.nodes].all(axis=1), on_axis=np.flatnonzero(near))


def _read(file: Path) -> RawMesh:
    reader = READERS.get(file.suffix.lower())
    if reader is None:
        known = ", ".join(READERS)
        what = near_match(file.suffix, READERS) or "."
        raise TurgorError(f"'{file}' has the ending '{file.suffix}', which is no mesh file{what} Known: {known}.")
    if not file.is_file():
        there = sorted(entry.name for entry in file.parent.glob(f"*{file.suffix}")) if file.parent.is_dir() else []
        raise TurgorError(f"there is no mesh file '{file}'{near_file(file, there)}")
    try:
        return reader(file)
    except TurgorError:
        raise
    except (ArithmeticError, LookupError, MemoryError, TypeError, ValueError) as error:  # what a parser stumbles over
        raise TurgorError(f"'{file}' cannot be read, the file seems damaged ({error}); export it again.") from error


def _check_extent(raw: RawMesh, frame: Frame) -> None:
    used = [np.unique(block.nodes) for block in raw.solids()]
    if not used:
        return  # the next step says so
    extent = float(np.ptp(raw.points[np.concatenate(used)], axis=0).max())
    if SMALLEST_EXTENT <= extent * frame.scale <= LARGEST_EXTENT:
        return
    likely = [other for other, length in UNITS["length"].items() if 5e-3 <= extent * length <= 0.5]
    hint = f"; was '{likely[0]}' meant?" if likely else "."
    raise TurgorError(
        f"'{raw.path}' is {extent * frame.scale / mm:.6g} mm long when its unit is {frame.unit}; "
        f"allowed is {SMALLEST_EXTENT / mm:g} mm to {LARGEST_EXTENT / mm:g} mm{hint}"
    )


def _put_on_planes(file: Path, points: Array, sides: Sides, faces: Mapping[str, Ints]) -> list[Finding]:
    """G27: put nodes of mirror planes that lie a little off, such as mid-side nodes, on their planes."""
    findings = []
    for name, rows in faces.items():
        if not name.startswith("symmetry_"):
            continue
        nodes = np.unique(sides.nodes[rows])
        extent = np.ptp(points[nodes], axis=0)
        axis = int(extent.argmin())
        level = float(np.median(points[nodes, axis]))
        off = np.abs(points[nodes, axis] - level)
        if off.max() > MESH_FILE.mirror_off * extent.max():
            x, y, z = points[nodes[off.argmax()]] / mm
            raise TurgorError(
                f"face '{name}' is no plane across x, y or z, as a mirror plane must be: its node at ({x:.4g}, "
                f"{y:.4g}, {z:.4g}) mm lies {off.max() / mm:.3g} mm off the plane {'xyz'[axis]} = {level / mm:.4g} mm."
            )
        points[nodes, axis] = level
        moved = int((off > TOLERANCE.round_off * extent.max()).sum())
        if moved:
            findings.append(
                Finding(
                    code="G27",
                    severity=Severity.NOTE,
                    message=f"{moved} nodes of '{name}' of '{file.name}' lay up to {off.max() / mm:.2g} mm off its "
                    "plane and were put on it.",
                    advice="Nothing is to be done where this is what the part looks like.",
                )
            )
    return findings


def _mended(file: Path, solids: Solids) -> tuple[Finding, ...]:
    if not solids.done:
        return ()
    return (
        Finding(
            code="G20",
            severity=Severity.NOTE,
            message=f"'{file.name}' was mended while it was read: {'; '.join(solids.done)}.",
            advice="Nothing is to be done where this is what you expect; merged nodes join parts that touch.",
        ),
    )


def _overlapping(file: Path, solids: Solids) -> tuple[Finding, ...]:
    if not len(solids.overlapping):
        return ()
    count, total = len(solids.overlapping), len(solids.cells)
    return (
        Finding(
            code="G24",
            severity=Severity.WARNING,
            message=f"{count} of {total} cells of '{file.name}' lie partly in their neighbors, around "
            f"{place_of(solids.points[solids.cells[solids.overlapping[0]]])} first.",
            advice="Material is counted twice there, and sides of folded cells were made to face like their neighbors; "
            "mesh the part again before trusting more than the trend.",
        ),
    )


def _straight(raw: RawMesh, sides: Sides) -> tuple[Finding, ...]:
    """G21: cells of first order on a curved surface."""
    if any(block.kind.nodes > block.kind.corners for block in raw.solids()):
        return ()
    angles = _edge_angles(sides)
    curved = (angles > MESH_FILE.least_turn) & (angles < MESH_FILE.most_turn)
    if curved.mean() < MESH_FILE.curved_share:
        return ()
    return (
        Finding(
            code="G21",
            severity=Severity.WARNING,
            message=f"The cells of '{raw.path.name}' have straight edges, but its surface is curved: "
            f"{100 * curved.mean():.0f} % of the boundary edges are bends of {np.median(angles[curved]) / deg:.0f}° "
            "in the middle.",
            advice="Export second-order cells whose mid-side nodes lie on the true surface, or mesh finer; a coarse "
            "straight-edged mesh can be 10 % too stiff or too soft in bending.",
        ),
    )


def _edge_angles(sides: Sides) -> Array:
    """Angles between the normals of boundary sides that share an edge [rad]."""
    outer = np.flatnonzero(sides.outer)
    pairs = np.array(sides.kind.side.edges)
    edges = np.sort(sides.nodes[outer][:, pairs], axis=2).reshape(-1, 2)
    owner = np.repeat(outer, len(pairs))
    order = np.lexsort(edges.T)
    same = np.flatnonzero((edges[order][1:] == edges[order][:-1]).all(axis=1))
    normals = sides.normals
    cosine = np.einsum("ei,ei->e", normals[owner[order[same]]], normals[owner[order[same + 1]]])
    return np.asarray(np.arccos(np.clip(cosine, -1, 1)))
