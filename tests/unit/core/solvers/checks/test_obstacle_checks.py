"""Obstacles that reach into the actuator at rest are told, with the place and the depth; those that touch are not."""

import numpy as np
import pytest

import turgor as tg
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Box, Obstacle, Plane, RigidSurface, Sphere
from turgor.core.solvers.checks.obstacles import enclosed_obstacles, overlapping_obstacles
from turgor.units import mm

CORNERS = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
CUBE = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    + [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)


@pytest.fixture(scope="module")
def mesh():
    return tg.mesh(tg.FastPneuNet(chambers=1, length=10 * mm).build(), size=4 * mm)


def found(mesh, shape, **given):
    """Findings about one obstacle."""
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=1e5))
    contact = Contact(obstacles=[Obstacle(name="stone", shape=shape, **given)])
    model = tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [], contact=contact)
    return overlapping_obstacles(model)


def in_void(mesh, **given):
    """Findings about a ball in the cavity, in the middle of its box, which touches nothing."""
    low, high = (pick(mesh.points[mesh.face_nodes("cavity")], axis=0) for pick in (np.min, np.max))
    ball = Sphere(center=tuple((low + high) / 2 * (1, 0, 1)), radius=0.2 * mm)
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=1e5))
    contact = Contact(obstacles=[Obstacle(name="ball", shape=ball, **given)])
    return enclosed_obstacles(
        tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [], contact=contact)
    )


def test_an_obstacle_in_the_cavity_never_acts(mesh):
    (finding,) = in_void(mesh)
    assert finding.code == "B29"
    assert (
        finding.message == "The obstacle 'ball' lies in 'cavity', and no wall of a cavity may touch it: it never acts."
    )
    (finding,) = in_void(mesh, face="tip")
    assert "and only 'tip' may touch it" in finding.message
    assert in_void(mesh, face="cavity") == ()
    assert in_void(mesh, path=[(0, (0, 0, 0)), (1, (0, 0, -0.1))]) == ()  # it leaves the cavity


def test_place_and_depth(mesh):
    low = mesh.points[:, 2].min()
    (finding,) = found(mesh, Plane(point=(0, 0, low + 0.3 * mm), normal=(0, 0, 1)))
    assert finding.code == "B08"
    count = int((mesh.points[:, 2] < low + 0.29 * mm).sum())
    assert f"'stone' reaches into the actuator at rest: {count} nodes lie in it, up to 0.3 mm deep" in finding.message


def test_what_just_touches_is_no_overlap(mesh):
    low = mesh.points[:, 2].min()
    assert found(mesh, Plane(point=(0, 0, low + 1e-7), normal=(0, 0, 1))) == ()
    assert found(mesh, Sphere(center=(5 * mm, 0, low - 3 * mm), radius=3 * mm)) == ()


def test_only_the_named_face_counts(mesh):
    at_clamp = Plane(point=(0.5 * mm, 0, 0), normal=(1, 0, 0))
    assert len(found(mesh, at_clamp)) == 1
    assert found(mesh, at_clamp, face="tip") == ()


def test_start_of_the_path_counts(mesh):
    low = mesh.points[:, 2].min()
    deep = Plane(point=(0, 0, low + 1 * mm), normal=(0, 0, 1))
    assert found(mesh, deep, path=[(0, (0, 0, -2 * mm)), (1, (0, 0, 0))]) == ()
    assert len(found(mesh, deep, path=[(0, (0, 0, 0)), (1, (0, 0, -2 * mm))])) == 1


def test_cavity_and_mirror_plane_are_not_outside(mesh):
    outside = mesh.points[np.unique(np.concatenate([mesh.face_nodes(name) for name in ("outside", "fixed", "tip")]))]
    hidden = {name: mesh.face_nodes(name) for name in ("cavity", "symmetry_y")}
    for name, other in (("cavity", "symmetry_y"), ("symmetry_y", "cavity")):
        own = mesh.points[np.setdiff1d(hidden[name], hidden[other])]
        clear = np.array([np.linalg.norm(outside - point, axis=1).min() for point in own])
        inner = Sphere(center=tuple(own[clear.argmax()]), radius=0.9 * clear.max())
        assert clear.max() > 0.1 * mm
        assert found(mesh, inner) == ()


def test_triangles_like_the_box(mesh):
    low, side = mesh.points.min(axis=0), 6 * mm
    corner = low + np.array([2 * mm, -side / 3, -side / 2])
    cube = RigidSurface(points=corner + side * CORNERS, triangles=CUBE)
    box = Box(center=tuple(corner + side / 2), size=(side, side, side))
    (by_triangles,), (by_formula,) = found(mesh, cube), found(mesh, box)
    assert by_triangles.message.split(" nodes ")[0] == by_formula.message.split(" nodes ")[0]
    assert found(mesh, RigidSurface(points=corner - 1 + side * CORNERS, triangles=CUBE)) == ()


def test_triangles_count_what_is_inside_not_what_is_in_their_box(mesh):
    low, side = mesh.points.min(axis=0) - 1 * mm, 12 * mm
    tetrahedron = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    spike = RigidSurface(points=low + side * np.concatenate([np.zeros((1, 3)), np.eye(3)]), triangles=tetrahedron)
    (finding,) = found(mesh, spike)
    outer = np.unique(np.concatenate([mesh.face_nodes(name) for name in ("outside", "fixed", "tip")]))
    inside = ((mesh.points[outer] - low) / side).sum(axis=1) < 1
    assert f" {inside.sum()} nodes lie in it, at (" in finding.message
