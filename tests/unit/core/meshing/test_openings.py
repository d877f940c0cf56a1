"""A cavity that is open at an inlet has the volume up to a cap over it, also where a mirror plane cuts the inlet."""

import numpy as np
import pytest
from netgen.occ import Box, Cylinder, Pnt, X, Z

import turgor as tg
from turgor.core.engine.faces.openings import cap_volume
from turgor.core.engine.faces.surfaces import enclosed_volume
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.openings import find_rims
from turgor.core.meshing.surface import check_surface, rim_edges
from turgor.foundation.finding import Severity
from turgor.units import mm

#: A box of 20 x 16 x 10 mm with a room of 14 x 10 x 6 mm and an inlet of radius 1.5 along x, 3 mm long.
VOLUME = 14 * 10 * 6 + np.pi * 1.5**2 * 3


def room(low, shift=(0.0, 0.0, 0.0)):
    """The part with y >= low[0] and z >= low[1] of the box, meshed; the inlet lies around the x axis."""
    shape = Box(Pnt(0, -8, -5), Pnt(20, 8, 5)) - Box(Pnt(3, -5, -3), Pnt(17, 5, 3)) - Cylinder(Pnt(-1, 0, 0), X, 1.5, 6)
    shape = shape * Box(Pnt(-1, low[0], low[1]), Pnt(21, 9, 6))
    shape.mat("body")
    planes = [(i, name) for i, name, value in ((1, "symmetry_y", low[0]), (2, "symmetry_z", low[1])) if value == 0]
    for face in shape.faces:
        box, center = face.bounding_box, face.center
        face.name = "outside"
        inside = 2.9 < center.x < 17.1 and abs(center.y) < 5.1 and abs(center.z) < 3.1
        if inside or (0 < center.x < 3 and abs(center.y) < 1.6 and abs(center.z) < 1.6):
            face.name = "cavity"
        for axis, name in planes:
            if max(abs(box[0][axis]), abs(box[1][axis])) < 1e-5:
                face.name = name
    solid = sum(body.mass for body in shape.solids) * mm**3
    names = tuple(sorted({face.name for face in shape.faces}))
    geometry = Geometry(
        name="room",
        smallest_wall=2 * mm,
        cavity_volumes={},
        solid_volume=solid,
        regions=("body",),
        faces=names,
        shape=shape,
    )
    mesh = tg.mesh(geometry, size=3 * mm)
    return mesh, mesh.points + np.array(shift) * mm


@pytest.mark.parametrize(
    ("low", "share"), [((-9, -6), 1), ((0, -6), 2), ((-9, 0), 2), ((0, 0), 4)], ids=["whole", "y", "z", "y and z"]
)
def test_the_opening_is_capped(low, share):
    mesh, points = room(low)
    result = -share * enclosed_volume(points, mesh.face("cavity")) / mm**3
    assert result == pytest.approx(VOLUME, rel=2e-4)
    codes = [finding.code for finding in check_surface(mesh)]
    assert codes == ["D01"]
    (rim,) = find_rims(mesh, rim_edges(mesh.face("cavity")))
    assert rim.is_opening
    assert share * rim.area / mm**2 == pytest.approx(np.pi * 1.5**2, rel=0.03)


def test_the_volume_does_not_depend_on_the_place_nor_on_a_rotation():
    mesh, points = room((-9, -6), shift=(7, -3, 11))
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    here = enclosed_volume(points @ turn.T, mesh.face("cavity"))
    assert -here / mm**3 == pytest.approx(VOLUME, rel=2e-4)
    assert here == pytest.approx(enclosed_volume(mesh.points, mesh.face("cavity")), rel=1e-12)
    stretched = points * [1.0, 2.0, 1.5]
    assert enclosed_volume(stretched, mesh.face("cavity")) == pytest.approx(3 * here, rel=1e-12)


def test_a_wall_without_a_name_is_no_opening():
    mesh, _ = room((-9, -6))
    center = mesh.points[mesh.face("cavity")][:, :3].mean(axis=1)
    for missing in (center[:, 2] > 2.99 * mm, center[:, 2] > 0):
        faces = dict(mesh.faces) | {"cavity": mesh.face("cavity")[~missing]}
        part = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
        codes = [finding.code for finding in check_surface(part)]
        assert codes[-1] == "G03"
        assert codes[0] in ("D01", "G02")
    shape = Box(Pnt(0, 0, 0), Pnt(10, 10, 10)) - Box(Pnt(3, 3, 3), Pnt(7, 7, 7))
    shape.mat("body")
    for face in shape.faces:
        face.name = "cavity" if 2 < face.center.z < 8 and 2 < face.center.x < 8 and 2 < face.center.y < 8 else "outside"
    shape.faces.Max(Z).name = "outside"
    names = {"regions": ("body",), "faces": ("cavity", "outside")}
    box = Geometry(name="box", smallest_wall=3 * mm, cavity_volumes={}, solid_volume=936 * mm**3, shape=shape, **names)
    mesh = tg.mesh(box, size=3 * mm)
    top = (mesh.points[mesh.face("cavity")][:, :3, 2] > 6.99 * mm).all(axis=1)
    faces = {
        "cavity": mesh.face("cavity")[~top],
        "outside": np.concatenate([mesh.face("outside"), mesh.face("cavity")[top]]),
    }
    (finding,) = check_surface(tg.Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces))
    assert finding.code == "G02"  # plane, but in the wall of a closed void
    assert finding.severity is Severity.ERROR


def test_a_slice_between_two_planes_is_closed_at_both():
    """The rim of a quarter of a ring's bore: two straight sides and one arc in mirror planes, one arc in none."""
    angle = np.pi / 2 * np.arange(9) / 8
    arc = np.column_stack([5 * np.cos(angle), 5 * np.sin(angle), np.full(9, 2.0)])
    points = np.vstack([arc, arc * [1, 1, 0], arc[[0, -1]] * [1, 1, 0.5]])
    upper = np.array([[k, k + 2, k + 1] for k in range(0, 8, 2)])
    lower = np.array([[k + 2, k, k + 1] for k in range(9, 17, 2)])
    rim = np.vstack([upper, lower, [[8, 17, 19], [9, 0, 18]]])
    sector = np.pi * 25 / 4
    assert abs(cap_volume(points, rim)) == pytest.approx(2.0 * sector / 3, rel=1e-3)
    assert cap_volume(points, rim) == pytest.approx(cap_volume(points, upper), rel=1e-12)
    assert cap_volume(points * [1, 1, 2], rim) == pytest.approx(2 * cap_volume(points, rim), rel=1e-12)
