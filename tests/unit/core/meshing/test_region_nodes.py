"""Nodes of the regions: doubled where regions meet, and nowhere else."""

from dataclasses import replace

import numpy as np
import results_cases as cases

from turgor.core.meshing.refining.region_nodes import region_nodes


def test_nodes_are_doubled_between_regions_only():
    mesh = cases.body()
    nodes = region_nodes(mesh)
    base, body = (np.unique(mesh.cells[mesh.region(name)]) for name in ("base", "body"))
    shared = np.intersect1d(base, body)
    assert len(nodes.node) == len(mesh.points) + len(shared)
    np.testing.assert_array_equal(nodes.node[: len(mesh.points)], np.arange(len(mesh.points)))
    np.testing.assert_array_equal(np.sort(nodes.node[len(mesh.points) :]), shared)
    np.testing.assert_array_equal(nodes.node[nodes.cells], mesh.cells)
    for number, name in enumerate(mesh.regions):
        assert set(nodes.region[nodes.cells[mesh.region(name)]].ravel()) == {number}


def test_rows_are_found_by_node_and_region():
    mesh = cases.body()
    nodes = region_nodes(mesh)
    for number, name in enumerate(mesh.regions):
        cells = mesh.region(name)
        result = nodes.of(mesh.cells[cells], np.full((len(cells), 10), number))
        np.testing.assert_array_equal(result, nodes.cells[cells])


def test_one_region_has_no_doubles():
    mesh = cases.body()
    nodes = region_nodes(replace(mesh, regions={"body": np.arange(len(mesh.cells))}))
    np.testing.assert_array_equal(nodes.node, np.arange(len(mesh.points)))
    np.testing.assert_array_equal(nodes.cells, mesh.cells)
