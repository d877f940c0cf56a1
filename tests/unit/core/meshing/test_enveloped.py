"""Tetrahedra within an envelope of facets: their boundary lies on the surface, with its names."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from turgor.cad import WithNormal

import turgor as tg
from prints import PRINTS
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.geometry.cad.read import read_cad, read_here
from turgor.core.geometry.cad.surface.shape import SurfaceShape, surface_shape
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.cavities import distances
from turgor.core.meshing.exchange.formats.stl import Triangles
from turgor.core.meshing.generate import _meshed_by_facets
from turgor.core.meshing.quality.cell_quality import cell_volumes, quality
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.tetwild import tetrahedra
from turgor.core.meshing.tetwild.background import background
from turgor.core.meshing.tetwild.boundary import boundary_of
from turgor.core.meshing.tetwild.nearest import sharp_edges
from turgor.core.meshing.tetwild.snapping import on_mirrors, pressed_flat, volumes
from turgor.units import mm

ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}


@pytest.fixture(scope="module")
def bender(tmp_path_factory):
    """Half-round bender from an STL file, and its mesh."""
    part = read_here(PRINTS["half_round"]().write(tmp_path_factory.mktemp("stl") / "bender.stl"), faces=ENDS)
    return part, tg.mesh(part, size=4 * mm)


def test_the_mesh_has_the_volumes_and_names_of_the_surface(bender):
    part, mesh = bender
    assert cell_volumes(mesh).sum() == pytest.approx(part.solid_volume, rel=2e-3)
    assert cavity_volume(mesh, "cavity") == pytest.approx(part.cavity_volume, rel=2e-3)
    assert set(mesh.faces) == {"cavity", "fixed", "outside", "tip"}
    assert quality(mesh).min_shape > 0.05
    assert not list(Path.cwd().glob("__tracked_surface*")), "the mesher leaves no file behind"


def test_the_corners_of_the_boundary_lie_on_the_surface(bender):
    part, mesh = bender
    shape = part.shape
    surface = Triangles(points=shape.points, triangles=shape.triangles)
    for name, x in (("fixed", 0.0), ("tip", 50.0)):
        assert np.abs(mesh.points[np.unique(mesh.faces[name][:, :3]), 0] / mm - x).max() < 1e-5
    for name in ("outside", "cavity"):
        off = distances(mesh.points[np.unique(mesh.faces[name][:, :3])] / mm, surface)
        assert np.quantile(off, 0.9) < 1e-5
        assert off.max() < 0.05 * 4, "corners that would spoil a cell stay in the envelope"


@pytest.mark.slow
def test_a_rough_scan_gets_a_mesh(tmp_path):
    part = read_here(PRINTS["rough_tube"]().write(tmp_path / "scan.stl"), faces=ENDS)
    mesh = tg.mesh(part)
    assert cell_volumes(mesh).sum() == pytest.approx(part.solid_volume, rel=0.01)
    assert {"cavity", "fixed", "outside", "tip"} == set(mesh.faces)


@pytest.mark.slow
def test_a_face_gets_cells_of_its_own_size(bender):
    part, coarse = bender
    fine = tg.mesh(part, size=4 * mm, face_sizes={"tip": 1.2 * mm})
    assert len(fine.faces["tip"]) > 3 * len(coarse.faces["tip"])
    assert len(fine.faces["fixed"]) < 2 * len(coarse.faces["fixed"])


def test_sizes_grow_away_from_a_face(bender):
    part, _ = bender
    sizes = background(part.shape, 4.0, {"tip": 1.0}, 0.5)
    at = sizes.points[:, 0]
    assert sizes.values[at < 30].min() == 4.0
    assert sizes.values[np.abs(at - 50) < 1].min() == 1.0
    corners = sizes.points[sizes.cells]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert np.abs(volumes).sum() == pytest.approx(float(np.prod(np.ptp(sizes.points, axis=0))))


def test_edges_and_corners_of_a_cube():
    corner = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))])
    shape = surface_shape(corner, triangles)
    assert shape.mass == pytest.approx(1)
    assert [face.mass for face in shape.faces] == pytest.approx([1] * 6)
    edges = sharp_edges(shape)
    assert len(edges.ends) == 12
    faces = frozenset(shape.face[[0, 4]].tolist())
    assert edges.on_edge(np.array([0.1, 0.2, 0.6]), faces) == pytest.approx([0, 0, 0.6])
    three = frozenset(shape.face[[0, 4, 8]].tolist())
    assert edges.at_corner(np.array([0.1, 0.2, 0.6]), three) == pytest.approx([0, 0, 0])
    assert edges.on_edge(np.zeros(3), frozenset(shape.face[[0, 2]].tolist())) is None, "opposite faces do not meet"


def test_a_cad_part_is_meshed_by_its_facets(tmp_path):
    tube = ExtendingCylinder(length=30 * mm, symmetric=False).build()
    tube.shape.WriteStep(str(tmp_path / "tube.step"))
    part = replace(read_cad(tmp_path / "tube.step", faces=ENDS), name="tube")
    mesh = _meshed_by_facets(part, MeshSettings(size=4 * mm, cells="tetrahedra"))
    assert set(mesh.faces) == set(part.faces)
    assert cell_volumes(mesh).sum() == pytest.approx(part.solid_volume, rel=0.015), "facets cut off the curves"
    assert not isinstance(part.shape, SurfaceShape)


def test_nodes_of_a_mirror_plane_lie_on_it():
    """Corners that went back for the sake of a cell, and middles between two faces, were off it."""
    corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 0, 3], [0, 2, 0]])
    shape = surface_shape(corners, np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]))
    names = ["outside"] * len(shape.faces)
    names[int(shape.face[0])] = "symmetry_y"
    shape = shape.named(tuple(names))
    sides = shape.triangles
    off = corners + 0.05
    out = on_mirrors(off, sides, shape.face, shape)
    assert np.abs(out[:3, 1]).max() == 0
    assert out[:, [0, 2]] == pytest.approx(off[:, [0, 2]])
    assert out[3] == pytest.approx(off[3])


#: A pyramid below a square, whose fourth corner fTetWild put 0.1 below the square: the first cell lies on the square.
PYRAMID = np.array([[0.0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [2, 2, -3]])
LOW = PYRAMID - [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0.1], [0, 0, 0]]
FLAT_ON_TOP = np.array([[0, 1, 3, 2], [0, 1, 4, 3], [1, 2, 4, 3]])


def test_a_cell_that_is_pressed_flat_onto_a_face_is_dropped(monkeypatch):
    """Its corner went back into the envelope before, so that the end of a part was not flat."""
    sides = np.array([[0, 1, 2], [0, 2, 3], [0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0]])
    shape = surface_shape(PYRAMID, sides)
    volume = 16.0
    cells = FLAT_ON_TOP.copy()
    inverted = volumes(LOW, cells) < 0
    cells[inverted] = cells[inverted][:, [0, 2, 1, 3]]
    monkeypatch.setattr(tetrahedra, "_filled", lambda *_: (LOW, cells))
    shape = shape.named(("outside",) * len(shape.faces))
    part = Geometry(
        name="pyramid",
        regions=("body",),
        faces=("outside",),
        solid_volume=volume * mm**3,
        smallest_wall=3 * mm,
        cavity_volumes={},
        shape=shape,
    )
    raw = tetrahedra.enveloped_cells(part, MeshSettings(size=4 * mm, cells="tetrahedra"))
    assert len(raw.cells) == 2
    assert raw.points[:4, 2] == pytest.approx(0, abs=1e-12)
    assert volumes(raw.points, raw.cells[:, :4]).sum() / mm**3 == pytest.approx(volume)


def test_a_flat_cell_stays_where_the_boundary_would_touch_itself():
    cells = FLAT_ON_TOP
    before, after = LOW, PYRAMID
    sides = boundary_of(before, cells)
    around = {node: frozenset({0}) for node in range(5)}
    assert pressed_flat(before, after, cells, sides, around).tolist() == [0]
    beyond = np.vstack([sides, [[1, 3, 4]]])  # the boundary has the edge between 1 and 3, below the flat cell
    assert not len(pressed_flat(before, after, cells, beyond, around))
    assert not len(pressed_flat(before, after, cells, sides, around | {3: frozenset({1})})), "not on one face"
