"""Rays from the surface hit what a comparison of every ray with every triangle finds."""

import numpy as np

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.quality.facing_walls import _ray_distances, first_hits
from turgor.core.meshing.surface import outer_triangles


def test_the_first_hit_is_that_among_all_triangles_and_only_rays_that_are_asked_for_count() -> None:
    made = mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3, cells="tetrahedra")
    triangles = outer_triangles(made)
    rays, reach = np.arange(len(triangles)) % 4 == 0, 5e-3
    result = first_hits(made.points, triangles, reach, rays)

    corners = made.points[triangles[:, :3]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    for ray in np.flatnonzero(rays):
        start = np.broadcast_to(corners[ray].mean(axis=0), normal.shape)
        distance = _ray_distances(start, np.broadcast_to(normal[ray], normal.shape), corners)
        distance[ray] = np.inf
        nearest = distance.min()
        assert (result[ray] >= 0) == (nearest <= reach)
        assert result[ray] < 0 or distance[result[ray]] <= nearest * (1 + 1e-9)
    assert (result[rays] >= 0).sum() > 20
    assert (result[~rays] == -1).all()
