"""V00: the verification meshes themselves: volume, orientation, closed surface, matching blocks.

Volumes are integrated by the divergence theorem over the six-node triangles, independently of the cells.
Tolerance: 1e-12 for boxes (exact), and the cubic/quartic interpolation error of quadratic sides for curved bodies.
"""

import numpy as np
import pytest

import meshes


def _six_volumes(mesh):
    vertices = mesh.points[mesh.cells[:, :4]]
    return np.linalg.det(vertices[:, 1:] - vertices[:, :1])


ALL = [
    meshes.box((2.0, 1.0, 0.5), (3, 2, 1)),
    meshes.tube_sector(5.0, 7.0, 1.0, (2, 4, 1)),
    meshes.sphere_octant(10.0, 15.0, 2, 2),
    meshes.hollow_box(),
    meshes.blind_tube(),
    meshes.two_cavities(),
    meshes.glued([meshes.Block((2, 1, 1), lambda p: p * [-1, 1, 1], mirrored=True)]),
]


@pytest.mark.parametrize("mesh", ALL)
def test_cells_are_positive_and_the_named_faces_cover_the_surface_once(mesh):
    assert _six_volumes(mesh).min() > 0
    named = np.concatenate([np.sort(t[:, :3], axis=1) for t in mesh.faces.values()])
    free = np.sort(meshes.surface(mesh)[:, :3], axis=1)
    assert len(named) == len(free)
    assert {tuple(t) for t in named} == {tuple(t) for t in free}


@pytest.mark.parametrize("mesh", ALL)
def test_faces_point_outward(mesh):
    """The vertex normals of a closed outward surface enclose the volume of the straight-edged cells."""
    triangles = np.concatenate(list(mesh.faces.values()))
    a, b, c = (mesh.points[triangles[:, k]] for k in range(3))
    enclosed = float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6
    assert enclosed == pytest.approx(_six_volumes(mesh).sum() / 6, rel=1e-12)


def test_curved_sides_lie_on_the_surface_and_straight_ones_do_not(record_verification):
    curved, straight = (meshes.sphere_octant(10.0, 15.0, 2, 2, straight=s) for s in (False, True))
    radius = np.linalg.norm(curved.points[curved.face_nodes("cavity")], axis=1)
    worst = np.abs(radius / 10 - 1).max()
    record_verification("nodes of a curved sphere: error of their radius", "V00, exact", 0.0, worst, "1e-12")
    assert worst < 1e-12
    assert np.linalg.norm(straight.points[straight.face_nodes("cavity")], axis=1).min() < 9.9


def test_shuffled_mesh_is_the_same_body():
    mesh = meshes.tube_sector(5.0, 7.0, 1.0, (2, 4, 1))
    other, number = meshes.shuffled(mesh, np.random.default_rng(1))
    assert np.array_equal(other.points[number], mesh.points)
    assert _six_volumes(other).sum() == pytest.approx(_six_volumes(mesh).sum(), rel=1e-13)
    ends = other.points[other.cells[:, :4]]
    middle = (ends[:, 1] + ends[:, 2]) / 2  # node 5 lies between vertices 1 and 2, up to the curvature of the side
    assert np.abs(other.points[other.cells[:, 5]] - middle).max() < 0.35
