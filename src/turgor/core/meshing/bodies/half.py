"""Half of a mesh: the cells on one side of a mirror plane, which becomes a face."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.bodies.cut_cells import cut_at_plane
from turgor.core.meshing.bodies.placing import refuse_wedge
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_shapes, cell_volumes, refuse_inverted
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

#: How much farther one side of a mirror plane may reach than the other, or how much more volume it may have, as a share
#: of the whole.
UNLIKE = 0.01

#: Changes of the volume below this share are below any mesh error, and are not mentioned.
LEAST_CHANGE = 5e-4


def half_of(mesh: Mesh, axis: str) -> Mesh:
    """Return the half of a mesh at positive x, y or z, with the face ``symmetry_x``, ``symmetry_y`` or ``symmetry_z``.

    Sides of cells lie on the mirror plane through the origin where a generator built the part of two halves, and the
    half has the cells of the mesh. Tetrahedra that reach across the plane are cut there, which a finding says (G27);
    hexahedra are not.

    Parameters
    ----------
    mesh : Mesh
    axis : str
        The normal of the mirror plane: ``"x"``, ``"y"`` or ``"z"``.

    Returns
    -------
    Mesh
        Faces, regions and node sets without a part in this half are gone.

    Raises
    ------
    TurgorError
        If hexahedra reach across the plane, or the part is not alike on both sides: it reaches farther on one, or has
        more volume there.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> half_of(mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3), "x")
    Traceback (most recent call last):
    turgor.TurgorError: 'fast PneuNet, 1 chamber, half' has no mirror plane x = 0: it reaches from 0 to 10 mm along \
x; move the plane to 0.
    """
    if axis not in ("x", "y", "z"):
        raise unknown("normal of a mirror plane", axis, ("x", "y", "z"))
    refuse_wedge(mesh)
    number, name = "xyz".index(axis), f"symmetry_{axis}"
    whole = _cut(_on_plane(mesh, number), number)
    _check_alike(whole, number)
    half = _upper(whole, number, name)
    return replace(half, findings=(*half.findings, *_one_sided(whole, number)))


def reach_across(mesh: Mesh, axis: str) -> bool:
    """Return whether cells reach across the plane through the origin with a normal ``"x"``, ``"y"`` or ``"z"``.

    Parameters
    ----------
    mesh : Mesh
    axis : str

    Returns
    -------
    bool
    """
    number = "xyz".find(axis)
    return number >= 0 and bool(_reach_across(_on_plane(mesh, number), number).any())


def _on_plane(mesh: Mesh, number: int) -> Mesh:
    """The mesh with nodes that are on the plane up to round-off exactly on it."""
    slack = ROUND_OFF.mesh_digits * float(np.ptp(mesh.points, axis=0).max())
    points = mesh.points.copy()
    points[np.abs(points[:, number]) <= slack, number] = 0.0
    return replace(mesh, points=points)


def _cut(mesh: Mesh, number: int) -> Mesh:
    """The mesh without cells across the plane, with a finding where some were cut."""
    at = mesh.points[:, number]
    across = int(_reach_across(mesh, number).sum())
    if not across:
        return mesh
    axis, what = "xyz"[number], f"{across} of {len(mesh.cells)} cells reach across it"
    if mesh.cell_type is not TETRAHEDRON:
        raise TurgorError(
            f"'{mesh.name}' has no mirror plane {axis} = 0: {what}, and hexahedra are not cut; mesh the part with "
            "sides on the plane, or with tetrahedra."
        )
    cut = cut_at_plane(mesh, number)
    if _reach_across(cut, number).any():
        raise TurgorError(
            f"'{mesh.name}' has no mirror plane {axis} = 0: {what}, and their curved sides do too; mesh the part finer."
        )
    refuse_inverted(cut, "mesh the part finer at its mirror plane, or with sides of cells on it")
    moved = int((cut.points[: cut.vertex_count, number] == 0).sum() - (at[: mesh.vertex_count] == 0).sum())
    shape = cell_shapes(cut).min(), cell_shapes(mesh).min()
    change = float(cell_volumes(cut).sum() / cell_volumes(mesh).sum()) - 1
    volume = f" Its volume changed by {change:.1%}." if abs(change) > LEAST_CHANGE else ""
    finding = Finding(
        code="G27",
        severity=Severity.NOTE,
        message=f"'{mesh.name}' was cut at {axis} = 0: {across} of its {len(mesh.cells)} cells reached across, and "
        f"{moved} nodes are on the plane now. The flattest cell has a shape of {shape[0]:.2g}, before {shape[1]:.2g}."
        f"{volume}",
        advice="Nothing is to be done; a mesh with sides of cells on the plane has rounder cells there.",
    )
    return replace(cut, findings=(*mesh.findings, finding))


def _reach_across(mesh: Mesh, number: int) -> NDArray[np.bool_]:
    at = mesh.points[mesh.cells, number]
    return np.asarray((at.min(axis=1) < 0) & (at.max(axis=1) > 0))


def _check_alike(mesh: Mesh, number: int) -> None:
    """Raise an error for a part that reaches farther, or has more volume, on one side of the plane."""
    axis, at = "xyz"[number], mesh.points[:, number]
    what = ""
    if abs(at.max() + at.min()) > UNLIKE * np.ptp(at):
        what = f"it reaches from {at.min() / mm:.4g} to {at.max() / mm:.4g} mm along {axis}; move the plane to 0"
    else:
        volumes = cell_volumes(mesh)
        share = float(volumes[at[mesh.cells].max(axis=1) > 0].sum() / volumes.sum())
        if abs(share - 0.5) > UNLIKE / 2:
            what = f"{share:.1%} of its volume is on the positive side"
    if what:
        raise TurgorError(f"'{mesh.name}' has no mirror plane {axis} = 0: {what}.")


def _one_sided(mesh: Mesh, number: int) -> tuple[Finding, ...]:
    """Say which names of the positive side have no image on the other one: what acts there acts on both now."""
    slack = UNLIKE * float(np.ptp(mesh.points[:, number]))
    named = {**mesh.faces, **mesh.node_sets}
    reach = {name: mesh.points[np.unique(rows), number] for name, rows in named.items() if len(rows)}
    alone = [f"'{name}'" for name, at in reach.items() if at.max() > slack and abs(at.max() + at.min()) > slack]
    if not alone:
        return ()
    axis = "xyz"[number]
    return (
        Finding(
            code="G27",
            severity=Severity.NOTE,
            message=f"{', '.join(alone)} of '{mesh.name}' did not reach as far on the other side of {axis} = 0. In the "
            "half, what acts or holds there has an image that does the same.",
            advice=f"Nothing is to be done where that is meant; otherwise model the whole, without '{axis}' in mirror.",
        ),
    )


def _upper(mesh: Mesh, number: int, name: str) -> Mesh:
    """The cells on the positive side, with the plane as a face."""
    points, high = mesh.points, mesh.points[mesh.cells, number].max(axis=1)
    chosen = np.flatnonzero(high > 0)
    nodes = np.unique(mesh.cells[chosen])
    new = np.full(len(points), -1, dtype=np.int64)
    new[nodes] = np.arange(len(nodes))
    cells = np.full(len(mesh.cells), -1, dtype=np.int64)
    cells[chosen] = np.arange(len(chosen))
    faces = {face: new[sides[(new[sides] >= 0).all(axis=1)]] for face, sides in mesh.faces.items() if face != name}
    regions = {region: cells[rows[cells[rows] >= 0]] for region, rows in mesh.regions.items()}
    sets = {each: new[rows[new[rows] >= 0]] for each, rows in mesh.node_sets.items()}
    half = replace(
        mesh,
        points=points[nodes],
        cells=new[mesh.cells[chosen]],
        regions={region: rows for region, rows in regions.items() if len(rows)},
        faces={face: sides for face, sides in faces.items() if len(sides)},
        node_sets={each: rows for each, rows in sets.items() if len(rows)},
    )
    outer = outer_triangles(half)
    plane = outer[(half.points[outer, number] == 0).all(axis=1)]
    return replace(half, faces=dict(sorted({**half.faces, name: plane}.items())))
