"""mesh_surfaces: tetrahedra between closed surfaces, an outer one and those of cavities."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from turgor.core.geometry.cad.surface.part import surface_facets
from turgor.core.geometry.cad.surface.repair import repaired
from turgor.core.geometry.cad.surface.shape import surface_shape
from turgor.core.geometry.cad.walls import smallest_wall
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.child_process import in_child
from turgor.core.geometry.directions import FileAxes
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing import netgen
from turgor.core.meshing.child_meshing import meshing
from turgor.core.meshing.exchange.formats.raw import KINDS, Block, RawMesh
from turgor.core.meshing.exchange.formats.stl import Triangles, read_stl
from turgor.core.meshing.exchange.frame import Frame
from turgor.core.meshing.exchange.names import Wishes
from turgor.core.meshing.exchange.read import DEFAULT_UNIT, named_mesh, with_unit_checked
from turgor.core.meshing.exchange.selectors import Choice
from turgor.core.meshing.exchange.settings import MESH_FILE
from turgor.core.meshing.exchange.solids import place_of
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.silenced_output import captured_output
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity

_CROSSING = re.compile(r"Intersecting elements (\d+) and (\d+)")


def mesh_surfaces(
    path: str | Path,
    *,
    unit: str | float | None = None,
    regions: Mapping[str, Choice] | None = None,
    faces: Mapping[str, Choice] | None = None,
    cavities: Mapping[str, str | Path] | None = None,
    axes: FileAxes = ("x", "y", "z"),
) -> Mesh:
    """Fill the space between closed STL surfaces with tetrahedra, keeping their triangles as they are.

    The mesh generator runs in a child process, because surfaces may crash it. Where it cannot fill them, the part is
    meshed within an envelope of its surface, as `read_cad` and `mesh` do with it at their default size, and a finding
    (G27) says so.

    Parameters
    ----------
    path : str or Path
        STL file of the outer surface; it may hold the cavities as further shells.
    unit : str or float, optional
        Unit of length of all files, by name or in meters; ``"mm"`` by default.
    regions, faces : mappings, optional
        As for `read_mesh`, by selectors.
    cavities : mapping of str to str or Path, optional
        Names of cavities with STL files of their surfaces, where these are files of their own.
    axes : tuple of three str or (3,) floats
        Directions in the file of our x, y and z, as for `read_mesh`.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If a file has no surface or an open one, surfaces cross themselves or each other, or no way to mesh them works.
    """
    file = Path(path)
    outer = read_stl(file).shells()
    shells_of_cavities = [shell for cavity in (cavities or {}).values() for shell in read_stl(cavity).shells()]
    inner = [shell for shell in shells_of_cavities if not any(_same(shell, other) for other in outer)]
    for shell, where in ((shell, file) for shell in (*outer, *inner)):
        if shell.open_edges:
            raise TurgorError(f"a surface of '{where}' is open: {shell.open_edges} edges have not two triangles.")
    if not outer:
        raise TurgorError(f"'{file}' has no surface: all of its triangles are flat; export it again.")
    shells = [_wound(shell, outward=i == 0) for i, shell in enumerate((*outer, *inner))]
    frame = Frame(unit=unit or DEFAULT_UNIT, axes=axes)
    wishes = Wishes(regions=regions or {}, faces=faces or {}, cavities=cavities or {}, frame=frame)
    stated = unit is not None
    try:
        raw = in_child(meshing(str(file)), _filled, file, shells, frame)
    except TurgorError as error:
        if inner and "cross themselves" in str(error):
            raise  # to unite a cavity with the part that it leaves would hide the mistake
        try:
            raw = in_child(meshing(str(file)), _enveloped, file, (*outer, *inner), frame)
        except TurgorError:
            raise error from None
        mesh = named_mesh(raw, wishes)
        mesh = replace(mesh, findings=(*mesh.findings, _not_followed(file, error)))
    else:
        mesh = named_mesh(raw, wishes)
    return with_unit_checked(mesh, file, stated=stated)


def _enveloped(file: Path, shells: Sequence[Triangles], frame: Frame) -> RawMesh:
    """Tetrahedra whose boundary lies on the surfaces, but has triangles of its own."""
    scale = frame.scale / METERS_PER_CAD_UNIT
    corners = np.concatenate([shell.points[shell.triangles] for shell in shells]) * scale
    fixed = repaired(corners, file.name)
    shape = surface_shape(fixed.points, fixed.triangles)
    shape = shape.named(("outside",) * len(shape.faces))
    geometry = Geometry(
        name=file.stem,
        smallest_wall=smallest_wall(surface_facets(shape)) * METERS_PER_CAD_UNIT,
        cavity_volumes={},
        solid_volume=shape.mass * METERS_PER_CAD_UNIT**3,
        regions=("body",),
        faces=("outside",),
        shape=shape,
    )
    mesh = mesh_with(geometry, MeshSettings())
    block = Block(kind=KINDS["tetrahedron10"], nodes=mesh.cells)
    return RawMesh(path=file, points=mesh.points / frame.scale, blocks=(block,), named=False)


def _not_followed(file: Path, error: TurgorError) -> Finding:
    return Finding(
        code="G27",
        severity=Severity.NOTE,
        message=f"The triangles of '{file.name}' could not be kept: {_reason(error)}. The "
        "part was meshed within an envelope of its surface instead.",
        advice='[actuator] with type = "cad_file" meshes it so too, with a size of your choice, and finds its faces.',
    )


def _same(a: Triangles, b: Triangles) -> bool:
    """Whether two shells are the same surface, one perhaps wound the other way."""
    boxes = [np.stack([shell.points.min(axis=0), shell.points.max(axis=0)]) for shell in (a, b)]
    near = 1e-5 * float(np.ptp(boxes[0], axis=0).max())
    volumes = abs(a.volume), abs(b.volume)
    return bool(np.abs(boxes[0] - boxes[1]).max() <= near and abs(volumes[0] - volumes[1]) <= 1e-4 * volumes[0])


def _wound(shell: Triangles, outward: bool) -> Triangles:
    """Turn a shell so that its normals point out of the solid: outwards on the largest one, inwards on cavities."""
    if (shell.volume > 0) == outward:
        return shell
    return Triangles(points=shell.points, triangles=shell.triangles[:, ::-1])


def _filled(file: Path, shells: Sequence[Triangles], frame: Frame) -> RawMesh:
    before = netgen.SetMessageImportance(0)
    with captured_output() as text:
        mesh = netgen.Mesh(dim=3)
        mesh.Add(netgen.FaceDescriptor(surfnr=1, domin=1, domout=0, bc=1))
        for shell in shells:
            numbers = [mesh.Add(netgen.MeshPoint(netgen.Pnt(*position))) for position in shell.points.tolist()]
            for triangle in shell.triangles.tolist():
                mesh.Add(netgen.Element2D(1, [numbers[i] for i in triangle]))
        try:
            mesh.GenerateVolumeMesh()
        except netgen.NgException:
            pass  # no cells were made, which is reported below with the places
        finally:
            netgen.SetMessageImportance(before)
        output = text()
    cells = mesh.Elements3D().NumPy()["nodes"]
    if not len(cells):
        raise _not_filled(file, shells, output, frame)
    block = Block(kind=KINDS["tetrahedron4"], nodes=cells[:, :4].astype(np.int64) - 1)
    points = np.array(mesh.Coordinates(), dtype=np.float64)
    a, b, c, d = (points[block.nodes[:, i]] for i in range(4))
    filled = float(np.abs(np.einsum("ci,ci->c", b - a, np.cross(c - a, d - a))).sum()) / 6
    inside = sum(shell.volume for shell in shells)
    if abs(filled - inside) > MESH_FILE.volume * abs(inside):
        raise TurgorError(f"the cells between the surfaces of '{file}' fill {filled / inside:.1%} of the space there.")
    return RawMesh(path=file, points=points, blocks=(block,), named=False)


def _not_filled(file: Path, shells: Sequence[Triangles], text: str, frame: Frame) -> TurgorError:
    corners = np.concatenate([shell.points[shell.triangles] for shell in shells])
    pairs = {tuple(sorted((int(a) - 1, int(b) - 1))) for a, b in _CROSSING.findall(text)}
    if not pairs:
        return TurgorError(f"the space between the surfaces of '{file}' could not be filled with cells.")
    places = ", ".join(place_of(frame.meters(corners[list(pair)].reshape(-1, 3))) for pair in sorted(pairs)[:3])
    return TurgorError(
        f"the surfaces of '{file}' and its cavities cross themselves or each other in {len(pairs)} places, around "
        f"{places}; repair them where they were made."
    )


def _reason(error: TurgorError) -> str:
    """First clause of an error, without the output of the generator."""
    return str(error).split("(")[0].split(";")[0].strip().rstrip(".")
