"""Rows of equal parts are recognized by their cells, and shortened without a change of the parts that stay."""

from dataclasses import replace

import numpy as np
import pytest

from turgor.core.engine.cells.reference import reference_nodes
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.bodies.short_row import ShortRow, short_row
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.units import mm


def row(chambers: int) -> Mesh:
    finger = FastPneuNet(chambers=chambers, length=(10 * chambers - 1) * mm, clamp_length=5 * mm)
    return swept_mesh(finger.build(), Fineness(size=6e-3, row=np.inf))


@pytest.fixture(scope="module")
def long() -> Mesh:
    return row(9)


@pytest.fixture(scope="module")
def short(long: Mesh) -> ShortRow:
    shorter = short_row(long)
    assert shorter is not None
    return shorter


def test_row_of_nine_chambers_becomes_that_of_five(short: ShortRow):
    five = row(5)
    assert short.spared == 4
    assert len(short.mesh.cells) == len(five.cells)
    assert np.sort(cell_volumes(short.mesh)) == pytest.approx(np.sort(cell_volumes(five)), rel=1e-9)
    assert len(short.mesh.points) == len(five.points)
    assert np.ptp(short.mesh.points, axis=0) == pytest.approx(np.ptp(five.points, axis=0), rel=1e-9)


def test_faces_and_regions_are_those_of_the_five(short: ShortRow):
    five = row(5)
    assert {name: len(sides) for name, sides in short.mesh.faces.items()} == {
        name: len(sides) for name, sides in five.faces.items()
    }
    assert {name: len(cells) for name, cells in short.mesh.regions.items()} == {
        name: len(cells) for name, cells in five.regions.items()
    }


def test_each_cell_is_that_of_the_short_row_moved_by_whole_pitches(long: Mesh, short: ShortRow):
    moved = short.mesh.points[short.mesh.cells[short.cells]]
    moved[:, :, 0] += 10 * mm * short.turns[:, None]
    assert np.abs(moved - long.points[long.cells]).max() < 1e-9
    begin, end = short.mesh.points[short.ends]
    assert np.abs(begin + np.array([10 * mm, 0, 0]) - end).max() < 1e-9


def test_few_chambers_and_a_cell_that_differs_make_no_row(long: Mesh):
    assert short_row(row(7)) is None
    bent = long.points.copy()
    bent[long.cells[len(long.cells) // 2, 0]] += 1e-5
    assert short_row(replace(long, points=bent)) is None


def test_cell_with_other_order_of_nodes_is_not_that_of_the_next_part(long: Mesh, short: ShortRow):
    """Half a turn about its third direction leaves the shape and changes the order."""
    here = reference_nodes(27)
    turned = here * [-1, -1, 1] + [1, 1, 0]
    order = np.argmin(np.abs(turned[:, None] - here[None]).sum(axis=2), axis=1)
    number = int(np.flatnonzero(short.turns == 1)[0])
    cells = long.cells.copy()
    cells[number] = cells[number][order]
    assert short_row(replace(long, cells=cells)) is None
