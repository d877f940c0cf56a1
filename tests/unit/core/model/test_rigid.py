"""read_rigid: rigid bodies from STL files, turned outwards, and refused where they have no inside."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.meshing.exchange.formats.stl import Triangles, stl_bytes
from turgor.core.meshing.exchange.formats.write_stl import write_stl
from turgor.core.model.rigid import read_rigid
from turgor.units import mm

CORNERS = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
CUBE = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    + [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # outwards


def written(path, points, triangles):
    path.write_bytes(stl_bytes(np.asarray(points, dtype=float), np.asarray(triangles)))
    return path


def cubes(*bodies):
    """Cubes of (side, lowest corner, outwards) as points and triangles."""
    points = [np.array(low) + side * CORNERS for side, low, _ in bodies]
    triangles = [8 * i + (CUBE if outwards else CUBE[:, ::-1]) for i, (_, _, outwards) in enumerate(bodies)]
    return np.concatenate(points), np.concatenate(triangles)


def volume(surface):
    return Triangles(points=surface.points, triangles=surface.triangles).volume


@pytest.fixture(scope="module")
def finger(tmp_path_factory):
    path = tmp_path_factory.mktemp("rigid") / "finger.stl"
    design = tg.FastPneuNet(chambers=1, length=10 * mm)
    write_stl(design.build(), path)
    return design, path


def test_body_written_by_the_project(finger):
    design, path = finger
    surface = read_rigid(path)
    assert surface.name == "finger"
    assert volume(surface) == pytest.approx(2 * design.solid_volume, rel=1e-5)  # single precision
    assert np.ptp(surface.points, axis=0) == pytest.approx([10 * mm, 20 * mm, 15 * mm])
    assert np.bincount(surface.triangles.ravel()).min() > 2  # corners are shared
    assert volume(read_rigid(str(path), unit="cm")) == pytest.approx(1e3 * volume(surface))


def test_text_is_read_like_binary(tmp_path):
    lines = ["solid cube"]
    for triangle in CORNERS[CUBE]:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x:g} {y:g} {z:g}" for x, y, z in triangle), "endloop"]
    (tmp_path / "cube.stl").write_text("\n".join([*lines, "endsolid cube"]))
    surface = read_rigid(tmp_path / "cube.stl")
    assert surface.points.shape == (8, 3)
    assert volume(surface) == pytest.approx(1e-9)


def test_shells_are_turned_outwards_and_voids_inwards(tmp_path):
    wrong = cubes((9, (0, 0, 0), False), (3, (1, 1, 1), True), (1, (2, 2, 2), False), (2, (20, 0, 0), False))
    surface = read_rigid(written(tmp_path / "nested.stl", *wrong), unit="m")
    assert volume(surface) == pytest.approx(9**3 - 3**3 + 1 + 2**3)


def test_nearby_corners_are_joined(tmp_path):
    corners = CORNERS[CUBE] + 1e-7 * np.random.default_rng(3).uniform(-1, 1, (12, 3, 3))
    path = written(tmp_path / "loose.stl", corners.reshape(-1, 3), np.arange(36).reshape(-1, 3))
    assert read_rigid(path).points.shape == (8, 3)


def test_open_surface_is_refused(tmp_path):
    path = written(tmp_path / "lid.stl", 10 * CORNERS, CUBE[:10])
    with refused("lid.stl", "4 edges", "(5, 5, 10)"):
        read_rigid(path)


def test_triangles_wound_both_ways_are_refused(tmp_path):
    turned = np.concatenate([CUBE[:1, ::-1], CUBE[1:]])
    path = written(tmp_path / "turned.stl", CORNERS, turned)
    with refused("turned.stl", "3 edges", "(0, 0.3333, 0.6667)"):
        read_rigid(path)


def test_triangle_without_an_area_is_refused(tmp_path):
    points = np.concatenate([CORNERS, [[0, 0, 0.5]]])  # on the edge 0-1, which one side has with it, the other without
    split = [[0, 8, 3], [8, 1, 3], [0, 1, 8]]
    path = written(tmp_path / "sliver.stl", points, np.concatenate([split, CUBE[1:]]))
    with refused("sliver.stl", "1 triangles", "(0, 0, 0.5)"):
        read_rigid(path)


def test_crossing_bodies_are_refused(tmp_path):
    path = written(tmp_path / "two.stl", *cubes((3, (0, 0, 0), True), (2, (2.2, 0.3, 0.6), True)))
    with refused("two.stl", "crosses itself", "a union"):
        read_rigid(path)


def test_body_without_a_volume_is_refused(tmp_path):
    path = written(tmp_path / "sheet.stl", CORNERS, np.concatenate([CUBE[:1], CUBE[:1, ::-1]]))
    with refused("sheet.stl", "no volume", "(0, 0.3333, 0.6667)"):
        read_rigid(path)


def test_a_point_is_refused(tmp_path):
    path = written(tmp_path / "point.stl", np.zeros((3, 3)), [[0, 1, 2]])
    with refused("point.stl", "no triangle"):
        read_rigid(path)


def test_what_is_not_there_has_a_near_match(tmp_path, finger):
    with refused("fingr.stl", "finger.stl"):
        read_rigid(finger[1].with_name("fingr.stl"))
    with refused("unit", "mmm", "mm"):
        read_rigid(finger[1], unit="mmm")
    (tmp_path / "text.stl").write_text("nothing")
    with refused("text.stl", "STL", "'solid'"):
        read_rigid(tmp_path / "text.stl")
