"""How near facing walls come, against plates whose distance is known exactly."""

from math import inf

import numpy as np
import pytest
from netgen.occ import Box, Cylinder, Glue, Pnt, WorkPlane, Y

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.facing_walls import first_hits
from turgor.core.meshing.quality.proximity import FacingWalls, find_facing_walls, smallest_gap
from turgor.core.meshing.quality.settings import ProximitySettings
from turgor.units import mm


def boxes(*corners: tuple[tuple[float, float, float], tuple[float, float, float]], size: float = 3.0) -> Mesh:
    """Separate boxes [mm] in one mesh."""
    shape = Glue([Box(Pnt(*low), Pnt(*high)) for low, high in corners])
    shape.mat("body")
    shape.faces.name = "outside"
    volume = sum(float(np.prod(np.subtract(high, low))) for low, high in corners) * mm**3
    thin = min(float(np.subtract(high, low).min()) for low, high in corners) * mm
    names = {"regions": ("body",), "faces": ("outside",)}
    geometry = Geometry(name="boxes", smallest_wall=thin, cavity_volumes={}, solid_volume=volume, shape=shape, **names)
    return mesh(geometry, size=size * mm)


@pytest.fixture(scope="module")
def plates() -> Mesh:
    """Two plates of 20 x 20 x 2 mm, 3 mm apart."""
    return boxes(((0, 0, 0), (20, 20, 2)), ((0, 0, 5), (20, 20, 7)))


@pytest.fixture(scope="module")
def walls(plates: Mesh) -> FacingWalls:
    return find_facing_walls(plates)


def upper(mesh: Mesh) -> np.ndarray:
    return mesh.points[:, 2] > 4 * mm


def test_two_plates_face_each_other_over_the_air_between(plates: Mesh, walls: FacingWalls) -> None:
    assert len(walls.pairs) == 1
    assert sorted(float(np.ptp(walls.points[wall][..., 2])) for wall in walls.walls) == pytest.approx([0, 0], abs=1e-12)
    heights = sorted(float(walls.points[wall][..., 2].mean()) / mm for wall in walls.walls)
    assert heights == pytest.approx([2, 5])
    assert smallest_gap(walls) == pytest.approx(3 * mm)
    assert smallest_gap(walls, np.zeros_like(plates.points)) == pytest.approx(3 * mm)


@pytest.mark.parametrize("approach", [-2.0, 1.0, 2.5, 2.999, 3.0, 3.2, 4.5])
def test_plates_that_approach_and_pass_through_each_other(plates: Mesh, walls: FacingWalls, approach: float) -> None:
    displacement = np.zeros_like(plates.points)
    displacement[upper(plates)] = [0.3 * mm, -0.2 * mm, -approach * mm]  # sliding a little does not matter
    assert smallest_gap(walls, displacement) == pytest.approx((3 - approach) * mm, abs=1e-9 * mm)


def test_a_turn_of_everything_changes_nothing(plates: Mesh, walls: FacingWalls) -> None:
    angle = np.deg2rad(75)
    turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    assert smallest_gap(walls, plates.points @ turn.T - plates.points) == pytest.approx(3 * mm)


@pytest.mark.parametrize("height", [2.0, 2.9, 3.5])
def test_a_plate_that_bulges_nears_by_the_height_of_its_bulge(plates: Mesh, walls: FacingWalls, height: float) -> None:
    # the upper plate bulges down by a paraboloid; its lowest point is between nodes, so nodes alone see it late
    x, y = (plates.points[:, i] / mm for i in (0, 1))
    displacement = np.zeros_like(plates.points)
    bulge = height * (1 - ((x - 10.4) ** 2 + (y - 9.7) ** 2) / 200)
    displacement[upper(plates), 2] = -bulge[upper(plates)] * mm
    # nearest node within half of 1.7 mm (half edge) of the lowest point: the error is below 200⁻¹ · height · 0.85²
    assert smallest_gap(walls, displacement) == pytest.approx((3 - height) * mm, abs=0.02 * mm)


def test_two_tilted_plates_are_nearest_at_their_edge(plates: Mesh, walls: FacingWalls) -> None:
    displacement = np.zeros_like(plates.points)
    displacement[upper(plates), 2] = -0.1 * plates.points[upper(plates), 0]  # by 2 mm at x = 20 mm
    # measured along the normals of either plate: at the edge the foot point on the tilted one lies beyond its rim
    assert smallest_gap(walls, displacement) == pytest.approx(1 * mm, abs=0.02 * mm)


def test_the_nearest_of_several_gaps_counts() -> None:
    row = boxes(((0, 0, 0), (3, 10, 10)), ((5, 0, 0), (8, 10, 10)), ((9.5, 0, 0), (12, 10, 10)))
    walls = find_facing_walls(row, reach=10 * mm)
    assert len(walls.pairs) == 2  # the outer two do not see each other through the middle one
    assert smallest_gap(walls) == pytest.approx(1.5 * mm)
    displacement = np.zeros_like(row.points)
    displacement[row.points[:, 0] < 4 * mm, 0] = 1 * mm
    assert smallest_gap(walls, displacement) == pytest.approx(1 * mm)


def test_walls_beyond_reach_are_left_out(plates: Mesh) -> None:
    for reach, count in ((2.9 * mm, 0), (3.1 * mm, 1)):
        assert len(find_facing_walls(plates, reach=reach).pairs) == count
    assert smallest_gap(find_facing_walls(plates, reach=2.9 * mm)) == inf
    for wrong in (0.0, -1.0, inf):
        with refused("reach", f"{wrong * 1e3:g} mm", "more than 0"):
            find_facing_walls(plates, reach=wrong)


@pytest.mark.parametrize("side", [1, -1])  # either wall may come first
def test_a_wall_opposite_a_much_smaller_one_is_seen_whole(side: int) -> None:
    small = ((14, 14, 3.5), (16, 16, 6)) if side > 0 else ((14, 14, -4), (16, 16, -1.5))
    uneven = boxes(((0, 0, 0), (30, 30, 2)), small, size=6.0)
    walls = find_facing_walls(uneven)
    assert len(walls.pairs) == 1
    assert smallest_gap(walls) == pytest.approx(1.5 * mm)


def test_a_single_box_faces_nothing() -> None:
    assert smallest_gap(find_facing_walls(boxes(((0, 0, 0), (10, 10, 10)), size=5))) == inf


def groove(bottom: float, angle: float) -> Mesh:
    """A block with a groove of given width [mm] at its bottom whose walls enclose an angle [degrees]."""
    run = 8 * np.tan(np.deg2rad(angle / 2))
    left, right = 15 - bottom / 2, 15 + bottom / 2
    sharp = [] if bottom == 0 else [(right, 2)]
    outline = [(0, 0), (30, 0), (30, 10), (right + run, 10), *sharp, (left, 2), (left - run, 10), (0, 10)]
    plane = WorkPlane().MoveTo(*outline[0])
    for corner in outline[1:]:
        plane.LineTo(*corner)
    shape = plane.Close().Face().Extrude(10)
    shape.mat("body")
    shape.faces.name = "outside"
    volume = shape.mass * mm**3
    names = {"regions": ("body",), "faces": ("outside",)}
    part = Geometry(name="groove", smallest_wall=2 * mm, cavity_volumes={}, solid_volume=volume, shape=shape, **names)
    return mesh(part, size=3 * mm)


def test_steep_walls_of_a_groove_face_each_other_and_flat_ones_do_not() -> None:
    steep = find_facing_walls(groove(1.0, 30))
    assert len(steep.pairs) == 1
    # at the bottom: 1 mm along the normal of the wall on the other side, which is tilted by 30°
    assert 1 * mm * np.cos(np.deg2rad(30)) < smallest_gap(steep) < 1.6 * mm
    assert len(find_facing_walls(groove(1.0, 60)).pairs) == 0


def test_walls_that_share_an_edge_are_left_out() -> None:
    sharp = find_facing_walls(groove(0.0, 30))
    assert len(sharp.pairs) == 0
    assert smallest_gap(sharp) == inf


def test_walls_end_at_sharp_edges() -> None:
    # a block in the corner of two plates: one wall of it faces each, although they meet at its edge
    walls = find_facing_walls(
        boxes(((0, 0, 0), (2, 20, 20)), ((3.7, 4, 0), (20, 20, 20)), ((5, 0, 0), (20, 2.5, 20))), reach=2 * mm
    )
    assert (len(walls.walls), len(walls.pairs)) == (4, 2)
    assert smallest_gap(walls) == pytest.approx(1.5 * mm)


def test_the_walls_of_a_rounded_slot_end_in_its_bottom() -> None:
    # a slot 2 mm wide with a half-round bottom: one smooth surface, but two walls 2 mm apart
    shape = Box(Pnt(0, 0, 0), Pnt(12, 5, 9)) - Box(Pnt(5, 0, 4), Pnt(7, 5, 9)) - Cylinder(Pnt(6, 0, 4), Y, 1, 5)
    shape.mat("body")
    shape.faces.name = "outside"
    volume = shape.mass * mm**3
    names = {"regions": ("body",), "faces": ("outside",)}
    part = Geometry(name="slot", smallest_wall=3 * mm, cavity_volumes={}, solid_volume=volume, shape=shape, **names)
    walls = find_facing_walls(mesh(part, size=1.5 * mm))
    assert len(walls.pairs) == 1
    assert smallest_gap(walls) == pytest.approx(2 * mm, rel=1e-3)


def triangle(corners: list[tuple[float, float, float]]) -> np.ndarray:
    """Six nodes of a flat triangle."""
    a, b, c = np.array(corners)
    return np.array([a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2])


def test_a_node_beyond_the_rim_of_a_wall_is_not_opposite_to_it() -> None:
    below = triangle([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    for shift, expected in ((0.1, 0.5), (-0.3, inf)):
        above = triangle([(0, 0.1, 0.5), (0.05, 0.2, 0.5), (0.05, 0.1, 0.5)]) + [shift, 0, 0]
        pair = np.arange(6)[None], np.arange(6, 12)[None]
        walls = FacingWalls(points=np.vstack([below, above]), walls=pair, pairs=np.array([[0, 1]]))
        assert smallest_gap(walls) == pytest.approx(expected)


def test_a_foot_point_that_was_not_reached_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    below = triangle([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    above = triangle([(0.2, 0.2, 0.3), (0.3, 0.3, 0.3), (0.3, 0.2, 0.3)])  # between the nodes of the one below
    pair = np.arange(6)[None], np.arange(6, 12)[None]
    walls = FacingWalls(points=np.vstack([below, above]), walls=pair, pairs=np.array([[0, 1]]))
    assert smallest_gap(walls) == pytest.approx(0.3)
    monkeypatch.setattr("turgor.core.meshing.quality.proximity.PROXIMITY", ProximitySettings(iterations=0))
    assert smallest_gap(walls) == inf


def test_nodes_that_look_nearest_but_are_not_opposite_do_not_hide_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    below = triangle([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    above = triangle([(0.1, 0.1, 0.5), (0.2, 0.2, 0.5), (0.2, 0.1, 0.5)])
    beyond = triangle([(-0.3, 0.1, 0.2), (-0.2, 0.2, 0.2), (-0.2, 0.1, 0.2)])
    monkeypatch.setattr("turgor.core.meshing.quality.proximity.PROXIMITY", ProximitySettings(measured=1))
    upper = np.arange(6, 18).reshape(2, 6)
    points = np.vstack([below, above, beyond])
    walls = FacingWalls(points=points, walls=(np.arange(6)[None], upper), pairs=np.array([[0, 1]]))
    assert smallest_gap(walls) == pytest.approx(0.5)


def test_rays_see_the_first_triangle_only() -> None:
    # three squares of two triangles each: at x = 0 looking up x, at x = 2 looking back, at x = 5 looking back
    y, z = np.array([0.0, 1, 1, 0]), np.array([0.0, 0, 1, 1])
    points = np.vstack([np.stack([np.full(4, x), y, z], axis=1) for x in (0.0, 2.0, 5.0)])
    back = np.array([[0, 3, 2], [0, 2, 1]])
    triangles = np.vstack([[[0, 1, 2], [0, 2, 3]], back + 4, back + 8])
    assert first_hits(points, triangles, 10.0).tolist() == [3, 2, 1, 0, 2, 3]
    assert (first_hits(points, triangles, 1.9) == -1).all()


def test_the_gaps_of_a_pneunet_are_found_and_nothing_else() -> None:
    finger = FastPneuNet(chambers=4, length=40 * mm, gap=1.3 * mm)
    body = mesh(finger.build(), size=3 * mm)
    walls = find_facing_walls(body)
    assert len(walls.pairs) == 3
    assert smallest_gap(walls) == pytest.approx(1.3 * mm, rel=1e-9)
    places = sorted({round(float(x) / mm, 6) for wall in walls.walls for x in walls.points[wall][..., 0].ravel()})
    starts = [i * finger.pitch / mm + finger.chamber_length / mm for i in range(3)]
    # no wall runs over the floor, the bridges or the sides: all of them lie in the planes of the gaps
    assert places == pytest.approx(sorted([*starts, *(s + 1.3 for s in starts)]), abs=1e-5)
    stretched = np.zeros_like(body.points)
    stretched[:, 0] = -0.5 * body.points[:, 0]
    assert smallest_gap(walls, stretched) == pytest.approx(0.65 * mm, rel=1e-9)
