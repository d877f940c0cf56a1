"""STL and STEP files: closed, whole, of the right volume, and on the nodes of the mesh."""

import numpy as np
import pytest
from netgen.occ import OCCGeometry
from scipy.spatial import cKDTree

import turgor as tg
from refused import refused
from turgor.core.geometry.write_step import write_step
from turgor.core.meshing.exchange.formats.stl import read_stl, stl_bytes
from turgor.core.meshing.exchange.formats.write_stl import write_stl
from turgor.core.meshing.exchange.surface_filling import mesh_surfaces
from turgor.units import mm

pytestmark = pytest.mark.usefixtures("read_here")

FINGER = tg.FastPneuNet(chambers=2, length=20 * mm)


@pytest.fixture(scope="module")
def geometry():
    return FINGER.build()


@pytest.fixture(scope="module", params=["geometry", "tetrahedra", "hexahedra"])
def source(request, geometry):
    return geometry if request.param == "geometry" else tg.mesh(geometry, size=4 * mm, cells=request.param)


def test_body_is_closed_and_whole(tmp_path, source):
    write_stl(source, tmp_path / "body.stl")
    read = read_stl(tmp_path / "body.stl")
    assert read.open_edges == 0
    assert read.volume == pytest.approx(2 * FINGER.solid_volume * 1e9, rel=1e-5)  # single precision
    outer, inner = read.shells()
    assert np.ptp(outer.points, axis=0) == pytest.approx([20, 20, 15])
    assert inner.volume == pytest.approx(-2 * FINGER.cavity_volume * 1e9, rel=1e-5)


def test_cavity_encloses_its_volume(tmp_path, source):
    made = write_stl(source, tmp_path / "cavity.stl", face="cavity")
    assert made.volume == pytest.approx(2 * FINGER.cavity_volume)
    assert read_stl(tmp_path / "cavity.stl").volume == pytest.approx(2 * FINGER.cavity_volume * 1e9, rel=1e-5)


def test_corners_are_nodes_of_the_mesh(tmp_path, source):
    if not isinstance(source, tg.Mesh):
        pytest.skip("a geometry has no nodes")
    made = write_stl(source, tmp_path / "body.stl", whole=False)
    assert cKDTree(source.points).query(made.points)[0].max() < 1e-9


def test_half_cavity_alone_is_open(tmp_path, source):
    with refused("cavity", "fast PneuNet, 2 chambers, half", "edges"):
        write_stl(source, tmp_path / "cavity.stl", face="cavity", whole=False)
    with refused("cavty", "cavity"):
        write_stl(source, tmp_path / "cavity.stl", face="cavty")


def test_what_was_written_can_be_filled_again(tmp_path, geometry):
    whole = write_stl(geometry, tmp_path / "body.stl")
    mesh = mesh_surfaces(tmp_path / "body.stl")
    assert set(mesh.faces) == {"cavity", "outside"}
    assert mesh.faces["cavity"].shape[0] == len(whole.shells()[1].triangles)


def test_text_files_are_read_like_binary_ones(tmp_path):
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    triangles = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    (tmp_path / "binary.stl").write_bytes(stl_bytes(points, triangles))
    lines = ["solid one"]
    for triangle in points[triangles]:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x:g} {y:g} {z:g}" for x, y, z in triangle), "endloop"]
    (tmp_path / "text.stl").write_text("\n".join([*lines, "endsolid one"]))
    for name in ("binary", "text"):
        assert read_stl(tmp_path / f"{name}.stl").volume == pytest.approx(1 / 6)
    (tmp_path / "short.stl").write_bytes(stl_bytes(points, triangles)[:-10])
    with refused("short.stl", "STL"):
        read_stl(tmp_path / "short.stl")


def test_open_and_crossing_surfaces_are_refused(tmp_path):
    points = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]])
    triangles = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    (tmp_path / "open.stl").write_bytes(stl_bytes(points, triangles[:3]))
    with refused("open.stl", "3 edges"):
        mesh_surfaces(tmp_path / "open.stl")
    (tmp_path / "outer.stl").write_bytes(stl_bytes(points, triangles))
    (tmp_path / "inner.stl").write_bytes(stl_bytes(points * 0.5 + 3, triangles))
    with refused("outer.stl", "3 places"):
        mesh_surfaces(tmp_path / "outer.stl", cavities={"cavity": tmp_path / "inner.stl"})


def test_step_keeps_names_and_volume(tmp_path, geometry):
    write_step(geometry, tmp_path / "finger.step")
    read = OCCGeometry(str(tmp_path / "finger.step")).shape
    assert sorted(solid.name for solid in read.solids) == ["base", "body"]
    assert sum(solid.mass for solid in read.solids) == pytest.approx(FINGER.solid_volume * 1e9)
    assert {face.name for face in read.faces} - {None} == set(geometry.faces)
    with refused("finger.step", tmp_path / "nowhere"):
        write_step(geometry, tmp_path / "nowhere" / "finger.step")
