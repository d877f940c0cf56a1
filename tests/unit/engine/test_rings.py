"""Rings of an axisymmetric mesh: one mean stress for each side of a border, and no cuts around the axis."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from turgor.adaptivity.refine import refined, ring_sheets
from turgor.engine.algebra.rings import rings_of
from turgor.engine.cells.mean_stress_jumps import mean_stress_numbers
from turgor.meshing.refining.split_hexahedra import sheets
from turgor.units import MPa, mm


@pytest.fixture(scope="module")
def bellows():
    return tg.mesh(tg.actuators.BellowsOfRevolution(folds=1).build(), size=6 * mm, cells="axisymmetric")


def of_two(mesh):
    """The mesh with two rubbers: one below half its length, one above."""
    x = mesh.points[mesh.cells, 0].mean(axis=1)
    low = np.flatnonzero(x < np.median(x))
    halves = replace(mesh, regions={"low": low, "high": np.setdiff1d(np.arange(len(x)), low)})
    rubbers = {
        name: tg.Material(law=tg.laws.NeoHooke(C10=C10 * MPa), name=name) for name, C10 in (("low", 0.1), ("high", 1))
    }
    return tg.Model(halves, rubbers, [tg.Fixed("fixed")], [])


def test_a_ring_has_one_mean_stress_on_each_side_of_a_border(bellows):
    model = of_two(bellows)
    numbers, _ = mean_stress_numbers(model)
    leader = rings_of(bellows).leader[bellows.cells[:, :8]]
    sides = {}
    for name, cells in model.mesh.regions.items():
        pairs = np.unique(np.stack([leader[cells].ravel(), numbers[cells].ravel()], axis=1), axis=0)
        assert len(pairs) == len(np.unique(pairs[:, 0]))  # one number for each ring
        sides[name] = dict(pairs.tolist())
    shared = set(sides["low"]) & set(sides["high"])
    assert shared
    assert all(sides["low"][ring] != sides["high"][ring] for ring in shared)


def test_a_refined_mesh_has_as_many_cells_around(bellows):
    around = ring_sheets(bellows, sheets(bellows))
    assert len(around) == 2
    fine, _ = refined(bellows, np.full((len(bellows.cells), 3), 1.0), 8.0)
    assert fine.mesh.revolved == "x"
    assert len(fine.mesh.cells) == 4 * len(bellows.cells)
    assert len(ring_sheets(fine.mesh, sheets(fine.mesh))) == 2
