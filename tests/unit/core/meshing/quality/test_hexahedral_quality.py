"""What is measured of tetrahedra is measured of hexahedra too: Jacobians, volumes, walls, gaps, surfaces."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes, jacobian_range, quality, refuse_inverted
from turgor.core.meshing.quality.checks import check_mesh, crossings
from turgor.core.meshing.quality.hexahedra_quality import gradients, node_places
from turgor.core.meshing.quality.proximity import find_facing_walls, smallest_gap
from turgor.units import mm


def one_cell(nodes: int = 27, move=lambda x: x) -> Mesh:
    """One hexahedron, its nodes moved from those of the unit cube."""
    points = np.array([move(x) for x in node_places(nodes)])
    return Mesh(points=points, cells=np.arange(nodes)[None], regions={"body": np.array([0])}, faces={})


@pytest.fixture(scope="module")
def finger() -> Mesh:
    return mesh(FastPneuNet(chambers=2, length=24 * mm).build(), size=4 * mm, cells="hexahedra")


def test_reference_nodes_are_those_of_the_cell_type() -> None:
    places = node_places(27)
    for number, (a, b) in enumerate(HEXAHEDRON.edges):
        assert places[8 + number] == pytest.approx((places[a] + places[b]) / 2)
    for side in HEXAHEDRON.sides:
        assert places[side[8]] == pytest.approx(places[list(side[:4])].mean(axis=0))
        corners, middle = places[list(side[:4])], places[side[8]]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        assert normal @ (middle - 0.5) > 0  # out of the cell


@pytest.mark.parametrize("nodes", [20, 27])
def test_shape_functions_reproduce_quadratics(nodes: int) -> None:
    at = np.random.default_rng(1).random((5, 3))
    for powers in product(range(3), repeat=3):
        if sum(powers) > 2:
            continue
        values = np.prod(node_places(nodes) ** powers, axis=1)
        for d in range(3):
            lower = np.array(powers) - np.eye(3, dtype=int)[d]
            exact = powers[d] * np.prod(at ** np.maximum(lower, 0), axis=1)
            assert gradients(at, nodes)[:, :, d] @ values == pytest.approx(exact, abs=1e-12)


@pytest.mark.parametrize("nodes", [20, 27])
def test_a_box_has_a_constant_jacobian(nodes: int) -> None:
    box = one_cell(nodes, lambda x: x * [2, 3, 4])
    low, high = jacobian_range(box)
    assert (low[0], high[0], cell_volumes(box)[0]) == pytest.approx((24, 24, 24))
    measured = quality(box)
    assert (measured.min_shape, measured.min_jacobian_ratio) == pytest.approx((1, 1))
    assert (measured.min_edge, measured.max_edge) == pytest.approx((2, 4))


def test_a_bulged_cell_has_the_volume_of_its_map() -> None:
    # z = t (1 + h r (1 − r)): the volume is 1 + h / 6, the Jacobian lies between 1 and 1 + h / 4
    bulged = one_cell(move=lambda x: x * [1, 1, 1 + 0.6 * x[0] * (1 - x[0])])
    assert cell_volumes(bulged) == pytest.approx([1.1])
    low, high = jacobian_range(bulged)
    assert (low[0], high[0]) == pytest.approx((1, 1.15))
    assert quality(bulged).min_shape == pytest.approx(1)  # of the straight cell


def test_a_sheared_cell_is_measured_by_its_sharpest_corner() -> None:
    sheared = one_cell(move=lambda x: x + [x[1], 0, 0])
    assert quality(sheared).min_shape == pytest.approx(np.sqrt(0.5))


def test_a_cell_turned_inside_out_is_refused() -> None:
    # the mid-side node lies beyond the middle of the edge, so that the edge turns back
    turned = one_cell(move=lambda x: [x[0] + 1.2 * x[0] * (1 - x[0]), x[1], x[2]])
    assert jacobian_range(turned)[0][0] < 0
    assert quality(turned).inverted == 1
    with refused("1 of 1", "(600, 500, 500) mm"):
        refuse_inverted(turned)


def test_walls_with_one_hexahedron_are_found(finger: Mesh) -> None:
    edges, thickness = crossings(finger)
    assert thickness.min() == pytest.approx(1 * mm)
    ends = finger.points[edges]
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) == pytest.approx(thickness)  # straight through


def test_gaps_are_measured_between_hexahedra(finger: Mesh) -> None:
    walls = find_facing_walls(finger)
    assert len(walls.pairs) == 1
    assert smallest_gap(walls) == pytest.approx(1 * mm)
    nearer = np.zeros_like(finger.points)
    nearer[finger.points[:, 0] > 12 * mm, 0] = -0.4 * mm
    assert smallest_gap(walls, nearer) == pytest.approx(0.6 * mm)


def test_faces_that_do_not_fit_hexahedra_are_found(finger: Mesh) -> None:
    turned = finger.faces | {"tip": finger.faces["tip"][:, [0, 3, 2, 1, 7, 6, 5, 4, 8]]}
    (result,) = [f for f in check_mesh(replace(finger, faces=turned)) if f.code == "G04"]
    assert "'tip' has 54 quadrilaterals facing inward, of 54" in result.message
    without = {name: face for name, face in finger.faces.items() if name != "outside"}
    (result,) = [f for f in check_mesh(replace(finger, faces=without)) if f.code == "G03"]
    assert "surface quadrilaterals belong to no named face" in result.message
    holed = finger.faces | {"cavity": finger.faces["cavity"][1:]}
    assert "G02" in [f.code for f in check_mesh(replace(finger, faces=holed))]
