"""STL files of prints and scans: twelve surfaces are repaired, grouped into faces and named."""

import numpy as np
import pytest
from manifold3d import Manifold
from turgor.cad import SplitPlane, WithNormal

from prints import PRINTS, Print, along_x, corners_of, finger, half_round, punctured, union
from refused import refused
from turgor.core.geometry.cad.inspection import inspect_here
from turgor.core.geometry.cad.read import read_here
from turgor.core.geometry.cad.surface.grouping import grouped
from turgor.core.geometry.cad.surface.repair import repaired
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.units import mm

ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}
ROUGH = ("rough_tube", "rough_bender", "rough_omnidirectional")
REPAIRED = ("overlapping", "flipped", "doubled", "open_inlet", "punctured")


def codes(found):
    return {finding.code for finding in found.findings}


@pytest.mark.parametrize("name", PRINTS)
def test_a_print_is_read_with_its_cavities_and_ends(name, tmp_path):
    made = PRINTS[name]()
    part = read_here(made.write(tmp_path / f"{name}.stl"), faces=ENDS)
    assert isinstance(part.shape, SurfaceShape)
    assert part.solid_volume == pytest.approx(made.solid * mm**3, rel=max(made.tolerance, 1e-6))
    volumes = sorted(part.cavity_volumes.values())
    assert volumes == pytest.approx(sorted(v * mm**3 for v in made.cavities), rel=max(made.tolerance, 1e-6))
    assert {"fixed", "tip", "outside"} <= set(part.faces)
    if name not in ROUGH:
        assert ("D06" in codes(part)) == (name in REPAIRED)


def test_both_ends_of_a_rough_tube_are_whole_faces(tmp_path):
    part = read_here(PRINTS["rough_tube"]().write(tmp_path / "tube.stl"), faces=ENDS)
    areas = {face.name: face.mass for face in part.shape.faces if face.name in ENDS}
    assert areas == pytest.approx(dict.fromkeys(ENDS, np.pi * 64), rel=0.03)


def test_a_fillet_does_not_join_the_planes_that_it_connects():
    made = repaired(finger().corners, "finger")
    face = grouped(made.points, made.triangles)
    shape = SurfaceShape(points=made.points, triangles=made.triangles, face=face, faces=())
    normals = shape.vector_areas / np.linalg.norm(shape.vector_areas, axis=1, keepdims=True)
    bottom = np.unique(face[normals[:, 2] < -0.999])
    for number in bottom:
        assert (normals[face == number, 2] < -0.99).all()


def test_inspect_groups_facets_into_faces(tmp_path):
    result = inspect_here(PRINTS["bellows"]().write(tmp_path / "bellows.stl"))
    assert len(result.faces) == 6, "two ends and a side, outside and inside"
    assert [cavity.closed for cavity in result.cavities] == [True]


def test_what_was_repaired_is_told():
    made = punctured()
    (result,) = repaired(made.corners, "finger.stl").findings
    assert "6 holes closed, around (" in result.message
    assert "turned over" not in result.message, "the caps are not counted"


def test_a_wide_hole_that_is_not_plane_is_told_with_the_place():
    corners = corners_of(along_x(8, 0, 50))
    side = np.ptp(corners[:, :, 0], axis=1) > 40
    lacking = side & (corners[:, :, 2].min(axis=1) > 0)
    with refused("part.stl", "(25,", "50 wide", 3.9):
        repaired(corners[~lacking], "part.stl")


def test_bodies_apart_from_each_other_are_told(tmp_path):
    one = half_round()
    both = Print(np.concatenate([one.corners, one.corners + [0, 0, 30]]), 0, ())
    with refused("two.stl", "2 bodies"):
        read_here(both.write(tmp_path / "two.stl"))


def test_walls_that_touch_along_an_edge_are_no_hole():
    cube = Manifold.cube((10.0, 10.0, 10.0))
    corners = np.concatenate([corners_of(cube), corners_of(cube.translate((10, 10, 0)))])
    made = repaired(corners, "two cubes")
    shape = SurfaceShape(points=made.points, triangles=made.triangles, face=np.zeros(24, dtype=int), faces=())
    assert shape.mass == pytest.approx(2000)


def test_a_rough_part_cannot_be_split(tmp_path):
    path = half_round().write(tmp_path / "part.stl")
    with refused("split", "part.stl", "STEP"):
        read_here(path, split=SplitPlane(thickness=2 * mm))


def test_overlapping_shells_are_united_and_the_cavity_stays():
    cube = Manifold.cube((10.0, 10.0, 10.0))
    inner = Manifold.cube((12.0, 4.0, 4.0)).translate((2, 3, 3))
    shells = [cube, cube.translate((6, 0, 0))]
    corners = np.concatenate([*map(corners_of, shells), corners_of(inner)[:, ::-1]])
    made = repaired(corners, "part")
    shape = SurfaceShape(points=made.points, triangles=made.triangles, face=np.zeros(0, dtype=int), faces=())
    assert shape.mass == pytest.approx(union(shells).volume() - 192)
    assert "3 shells united that overlap" in made.findings[0].message
