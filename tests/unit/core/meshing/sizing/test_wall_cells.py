"""More than two cells through walls, and cells longer along a tube than its walls allow across."""

import numpy as np
import pytest
from meshing_cases import named
from netgen.occ import Box, Pnt
from turgor.actuators import ExtendingCylinder, FastPneuNet

import turgor as tg
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.units import MPa, kPa, mm


@pytest.mark.parametrize(("wall_cells", "share"), [(2, 1 / 2), (3, 1 / 4), (4, 1 / 4)])
def test_edges_that_begin_at_a_wall_reach_through_a_share_of_it(wall_cells, share):
    plate = named(Box(Pnt(0, 0, 0), Pnt(20, 20, 2)), "plate", 2)
    made = tg.mesh(plate, size=8 * mm, wall_cells=wall_cells)
    assert cell_volumes(made).sum() == pytest.approx(plate.solid_volume)
    ends = np.unique(np.sort(np.concatenate([made.cells[:, e] for e in TETRAHEDRON_EDGES]), axis=1), axis=0)
    heights = made.points[ends][:, :, 2] / (2 * mm)
    x, y, _ = made.points[ends].mean(axis=1).T / mm
    inside = (x > 1) & (x < 19) & (y > 1) & (y < 19)  # edges in the rim need no cut
    steps = np.abs(np.diff(heights[inside], axis=1))
    at_wall = (np.isclose(heights[inside], 0) | np.isclose(heights[inside], 1)).any(axis=1)
    assert steps[at_wall].max() < share + 0.01


def test_hexahedra_get_three_cells_through_a_wall():
    part = FastPneuNet(chambers=2, length=20 * mm).build()
    counts = [len(tg.mesh(part, size=3 * mm, cells="hexahedra", wall_cells=n).cells) for n in (1, 2, 3)]
    assert counts[0] < counts[1] < counts[2]


def stretched(size):
    """Displacement of the tip of an extending cylinder [m], and the unknowns of its mesh."""
    made = tg.mesh(ExtendingCylinder().build(), size=size, cells="hexahedra")
    model = tg.Model(
        made,
        materials=dict.fromkeys(made.regions, tg.Material(law=tg.laws.NeoHooke(C10=0.1 * MPa), name="rubber")),
        supports=[tg.supports.Fixed("fixed")],
        loads=[tg.loads.Pressure("cavity", 5 * kPa)],
    )
    response = tg.measure(tg.solve(model), tg.measures.tip_displacement_x, mesh_error=False)
    return response.find("tip_displacement_x").values[-1], made.unknown_count


def test_cells_may_be_longer_along_a_tube_than_four_walls():
    short, many = stretched(6 * mm)
    long, few = stretched(20 * mm)
    assert few < 0.7 * many
    assert long == pytest.approx(short, rel=5e-3)


def test_the_section_keeps_four_walls_where_a_larger_size_is_stated():
    finger = FastPneuNet(chambers=2, length=20 * mm, clamp_length=16 * mm).build()
    stated, four = (tg.mesh(finger, size=size * mm, cells="hexahedra") for size in (8, 4))
    (finding,) = stated.findings
    assert finding.code == "G09"
    assert "cells in the section stay below 4 mm" in finding.message
    assert not four.findings
    assert len(stated.cells) < len(four.cells)
    heights = [np.unique((made.points[:, 2] / mm).round(3)) for made in (stated, four)]
    assert heights[0] == pytest.approx(heights[1])  # as many cells through the height
