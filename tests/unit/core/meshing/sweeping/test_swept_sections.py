"""Sections of sweeps: quadrilaterals that follow every outline, without gaps, folds or degenerate corners."""

from math import pi

import numpy as np
import pytest

from turgor.core.geometry.actuators.bellows_of_revolution import BellowsOfRevolution
from turgor.core.geometry.actuators.bidirectional_bender import BidirectionalBender
from turgor.core.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet
from turgor.core.geometry.actuators.contracting_tube import ContractingTube
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.helical_pneunet import HelicalPneuNet
from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.core.geometry.actuators.two_material_bender import TwoMaterialBender
from turgor.core.geometry.extrusion import Layer
from turgor.core.geometry.parts.folds import Folds
from turgor.core.geometry.shapes.sections import Outline, disc, half_disc, polygon, rectangle, ring_sector
from turgor.core.meshing.sizing.settings import SIZING
from turgor.core.meshing.sweeping.general import general_section
from turgor.core.meshing.sweeping.grid import grid_section
from turgor.core.meshing.sweeping.pairing import corner_sines, paired
from turgor.core.meshing.sweeping.polar import core_section, polar_section
from turgor.core.meshing.sweeping.section import Fineness, SectionMesh, divided, divided_turn, inside, names_at
from turgor.core.meshing.sweeping.swept import section_of, short_at_edges, swept_mesh
from turgor.units import mm

FINE = Fineness(size=2 * mm)

#: Reference coordinates of the nine nodes, as (first, second) in halves.
NODES = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1))


def lagrange(t: float) -> tuple[np.ndarray, np.ndarray]:
    """Values and derivatives of the three quadratics on 0, 1/2, 1."""
    return np.array([(2 * t - 1) * (t - 1), 4 * t * (1 - t), t * (2 * t - 1)]), np.array(
        [4 * t - 3, 4 - 8 * t, 4 * t - 1]
    )


def jacobians(mesh: SectionMesh, points: np.ndarray) -> np.ndarray:
    """Jacobian determinants (q, p²) of the quadrilaterals at a lattice of reference points."""
    rows = []
    for s in points:
        for t in points:
            (Na, da), (Nb, db) = lagrange(s), lagrange(t)
            gradient = np.array([[da[i] * Nb[j], Na[i] * db[j]] for i, j in NODES])
            rows.append(np.linalg.det(np.einsum("qad,ae->qde", mesh.points[mesh.quads], gradient)))
    return np.stack(rows, axis=1)


def measured_area(mesh: SectionMesh) -> float:
    x, w = np.polynomial.legendre.leggauss(3)
    return float(jacobians(mesh, (x + 1) / 2).sum(axis=0) @ np.outer(w / 2, w / 2).ravel())


def check_sound(mesh: SectionMesh, area: float, tolerance: float) -> None:
    """All cells counterclockwise everywhere, their areas add up, and no edge belongs to three of them."""
    assert jacobians(mesh, np.linspace(0, 1, 5)).min() > 0
    assert measured_area(mesh) == pytest.approx(area, rel=tolerance)
    edges = np.sort(np.concatenate([mesh.quads[:, [i, (i + 1) % 4]] for i in range(4)]), axis=1)
    assert np.unique(edges, axis=0, return_counts=True)[1].max() == 2


def test_a_point_on_the_line_between_two_corners_is_inside() -> None:
    assert inside(disc(1.0), np.array([[0.0, 0.5], [0.5, 0.0], [0.0, 0.0], [0.0, 1.5]])).tolist() == [True] * 3 + [
        False
    ]


@pytest.mark.parametrize(
    "outline",
    [
        disc(2.0, (0.3, -0.2)),
        half_disc(2.0),
        ring_sector(1.0, 2.0, -2.5, 2.5),
        polygon([(0, 0), (2, 0), (0.5, 0.5), (0, 2)]),
    ],
)
def test_inside_covers_the_area_of_the_outline(outline: Outline) -> None:
    x = np.linspace(-2.5, 2.5, 400)
    points = np.stack([grid.ravel() for grid in np.meshgrid(x, x)], axis=1)
    assert inside(outline, points).mean() * 5**2 == pytest.approx(outline.area, rel=0.01)


def test_later_fills_lie_over_earlier_ones() -> None:
    layer = Layer(start=0, end=1, fill=(("body", disc(3.0)), ("cavity", disc(2.0)), (None, disc(1.0))))
    assert names_at([layer], np.array([[2.5, 0], [1.5, 0], [0.5, 0], [4.0, 0]])).tolist() == [
        ["body", "cavity", None, None]
    ]


def test_lines_are_divided_with_a_node_in_each_middle() -> None:
    wanted = [
        *(0.0, 0.25, 0.5, 0.75, 1.0),
        *(1 + 1 / 3, 1 + 2 / 3, 2.5, 3 + 1 / 3, 4 + 1 / 6, 5.0),  # beside the line at 1 a third of the size
    ]
    assert np.allclose(divided(np.array([0.0, 1.0, 5.0]), Fineness(size=2.0, wall_cells=2)), wanted)
    around = divided_turn(np.array([0.0, pi]), 1.0, Fineness(size=10.0))
    assert len(around) == 2 * 7 + 1  # two cells along a radius: 2 π, rounded up
    assert len(divided_turn(np.array([0.0, pi]), 1.0, Fineness(size=10.0), multiple=4)) == 2 * 8 + 1


def test_cells_grow_away_from_feature_lines_where_edges_ask_for_short_ones() -> None:
    fine = Fineness(size=3.0, edge=0.2)
    ticks = divided(np.array([0.0, 10.0, 11.0]), fine)[::2]
    assert np.allclose(ticks, [0, 3, 6, 9, 9.8, 10, 10.2, 11])  # free ends need none
    inner = divided(np.array([0.0, 1.0, 9.0, 10.0]), fine)[::2]
    lengths = np.diff(inner)
    assert inner[[0, -1]].tolist() == [0, 10] and np.allclose(lengths, lengths[::-1])
    assert np.isclose(lengths.min(), 0.2) and lengths.max() <= 3 + 1e-12
    assert (lengths[1:] / lengths[:-1]).max() <= 4 + 1e-9


def test_a_grid_follows_all_edges_of_its_rectangles() -> None:
    mesh = grid_section([rectangle((0, 10 * mm), (0, 4 * mm)), rectangle((3 * mm, 4 * mm), (1 * mm, 3 * mm))], FINE)
    assert mesh is not None
    check_sound(mesh, 40 * mm**2, 1e-12)
    assert {0, 3, 4, 10} <= set(np.round(mesh.points[:, 0] / mm, 9))
    assert len(mesh.quads) == (3 + 1 + 4) * 3  # 3 mm: 0.67 mm beside the inner rectangle and twice 1.17 mm


def test_a_grid_follows_slanted_walls_and_tapering_sides() -> None:
    slanted = polygon([(2 * mm, 0), (3 * mm, 0), (4 * mm, 4 * mm), (3 * mm, 4 * mm)])
    for turn in (1, -1):
        outlines = [rectangle((0, 10 * mm), (0, 4 * mm)), slanted]
        if turn < 0:
            outlines = [Outline(corners=tuple((y, x) for x, y in o.corners[::-1]), arcs=o.arcs) for o in outlines]
        mesh = grid_section(outlines, FINE)
        assert mesh is not None
        check_sound(mesh, 40 * mm**2, 1e-12)
        assert inside(outlines[1], mesh.points[mesh.quads[:, 8]]).sum() == 2  # one column of two cells


def test_crossing_lines_are_no_grid() -> None:
    crossing = [
        rectangle((0, 10), (0, 4)),
        polygon([(2, 0), (4, 0), (5, 4), (4, 4)]),
        polygon([(5, 0), (6, 0), (6, 4), (4.5, 4)]),
    ]
    assert grid_section(crossing, Fineness(size=2.0)) is None
    assert grid_section([disc(1.0)], Fineness(size=2.0)) is None


def test_a_disc_has_a_core_without_collapsed_cells() -> None:
    layers = [Layer(start=0, end=1, fill=(("body", disc(6 * mm)),))]
    mesh = polar_section(layers, [disc(6 * mm), disc(5 * mm)], FINE)
    assert mesh is not None
    check_sound(mesh, pi * 36 * mm**2, 2e-5)
    assert corner_sines(mesh.points, mesh.quads[:, :4]).min() > 0.8
    quarter = core_section(5 * mm, 2, FINE, quadrants=(0,))
    check_sound(quarter, pi * 25 * mm**2 / 4, 2e-4)
    assert quarter.points.min() > -1e-15


def test_a_ring_needs_no_core() -> None:
    layers = [Layer(start=0, end=1, fill=(("body", disc(6 * mm)), ("cavity", disc(5 * mm))))]
    mesh = polar_section(layers, [disc(6 * mm), disc(5 * mm)], FINE)
    assert mesh is not None
    solid = np.array([name == "body" for name in names_at(layers, mesh.centers)[0]])
    kept = SectionMesh(points=mesh.points, quads=mesh.quads[solid])
    check_sound(kept, pi * 11 * mm**2, 1e-4)


def test_eccentric_circles_are_not_polar() -> None:
    layers = [Layer(start=0, end=1, fill=(("body", disc(6 * mm)),))]
    assert polar_section(layers, [disc(6 * mm), disc(3 * mm, (1 * mm, 0))], FINE) is None
    assert polar_section(layers, [disc(6 * mm), ring_sector(2 * mm, 5 * mm, 0.1, 1.0)], FINE) is None


@pytest.mark.parametrize("size", [1 * mm, 2 * mm, 5 * mm])
def test_any_outlines_are_followed_by_sound_cells(size: float) -> None:
    outlines = [disc(10 * mm), disc(5 * mm, (1 * mm, 0)), rectangle((-8 * mm, 2 * mm), (-1 * mm, 0))]
    mesh = general_section(outlines, Fineness(size=size))
    check_sound(mesh, pi * 100 * mm**2, 1e-4)
    assert corner_sines(mesh.points, mesh.quads[:, :4]).min() > 0.05
    rim = np.hypot(*mesh.points.T)
    on_rim = rim[rim > 9.9 * mm]  # nodes near the rim lie on it
    assert on_rim == pytest.approx(10 * mm, rel=1e-9)


def test_triangles_are_paired_unless_an_edge_must_stay() -> None:
    points = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    alone, quads = paired(points, triangles, np.array([[2, 0]]))
    assert (len(alone), len(quads)) == (2, 0)
    flat = points * [1, 0.2] + points[:, 1:] * [1, 0]  # a parallelogram of 11° makes no good cell
    assert len(paired(flat, triangles, np.zeros((0, 2), dtype=int))[1]) == 0


def test_cells_are_short_where_straight_folds_bend_and_nowhere_else() -> None:
    # four straight folds extend 14 % too little without, 0.9 % with short cells (benchmarks/accuracy/families.md)
    size = 4.5 * mm
    shortest = {}
    for shape in ("straight", "rounded"):
        geometry = BellowsOfRevolution(folds=2, fold_shape=shape).build()
        fine = short_at_edges(geometry, Fineness(size=size))
        section = section_of(geometry._sweep, geometry._sweep.outlines, fine)
        corners = section.points[section.quads[:, :4]]
        shortest[shape] = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).min()
    assert len(geometry._sweep.hinges) == 0
    assert shortest["straight"] < 0.06 * size < shortest["rounded"]


def test_hinges_are_the_re_entrant_corners_of_folds() -> None:
    folds = Folds(count=2, inner_radius=8 * mm, outer_radius=16 * mm, wall=1.5 * mm, pitch=10 * mm, shape="straight")
    inside, outside = folds.inside(4 * mm), folds.outside(4 * mm)
    crests = [point for point, _ in inside if point[1] > 9 * mm]
    necks = [point for point, _ in outside if point[1] < 11 * mm and point[0] < 24 * mm]
    assert sorted(folds.hinges(4 * mm)) == [pytest.approx(point) for point in sorted([*crests, *necks])]


def test_sections_of_chambers_in_a_row_have_short_cells_next_to_outer_walls_alone() -> None:
    lines = np.array([0.0, 1.5, 3.0, 10.0, 12.0]) * mm
    ticks = {which: divided(lines, Fineness(size=4 * mm, lines=which))[::2] / mm for which in ("all", "outer", "none")}
    assert ticks["all"] == pytest.approx([0, 1.5, 3, 13 / 3, 6.5, 26 / 3, 10, 12])
    assert ticks["outer"] == pytest.approx([0, 1.5, 3, 35 / 6, 26 / 3, 10, 12])
    assert ticks["none"] == pytest.approx([0, 1.5, 3, 6.5, 10, 12])
    for chambers, which in ((2, "all"), (5, "outer"), (12, "none")):
        row = swept_mesh(FastPneuNet(chambers=chambers, length=chambers * 10 * mm).build(), Fineness(size=3 * mm))
        x, _, z = (np.unique(np.round(row.points[row.cells[:, :8], k] / mm, 6)) for k in range(3))
        expected = divided(np.array([0, 1.5, 3, 5, 6, 13, 15]), Fineness(size=3, lines=which))[::2]
        assert z == pytest.approx(expected)
        assert row.serendipity == (which != "all")
        assert (np.diff(x)[1] == pytest.approx(1)) == (which != "none")  # next to the end wall


def test_rectangular_tubes_have_short_cells_within_and_long_ones_along() -> None:
    bender = RectangularBender(length=110 * mm).build()
    made = swept_mesh(bender, Fineness(size=4.5 * mm))
    x = np.unique(np.round(made.points[made.cells[:, :8], 0], 9))
    y = np.unique(np.round(made.points[made.cells[:, :8], 1], 9))
    assert np.diff(x).max() > 4.6 * mm
    assert np.diff(y).min() == pytest.approx(0.5 * mm, rel=1e-6)
    two = short_at_edges(BidirectionalBender(length=110 * mm).build(), Fineness(size=4.5 * mm))
    assert (two.wall_cells, short_at_edges(bender, Fineness(size=4.5 * mm)).wall_cells) == (3, 1)
    pneunet = swept_mesh(FastPneuNet(chambers=2, length=20 * mm).build(), Fineness(size=4 * mm))
    assert len(pneunet.cells) == 373  # as before: no tube


def test_a_block_with_few_chambers_has_two_cells_through_its_walls() -> None:
    for chambers, short in ((2, True), (11, False)):
        made = swept_mesh(SlowPneuNet(chambers=chambers, length=chambers * 10 * mm).build(), Fineness(size=4.5 * mm))
        z = np.unique(np.round(made.points[made.cells[:, :8], 2] / mm, 6))
        assert (13.75 in z) == short  # 0.75 mm from the inner side of the top wall at 13 mm
        assert made.serendipity == short
        assert made.unknown_count <= SIZING.short_cells


@pytest.mark.parametrize(("kind", "length"), [(HelicalPneuNet, 24 * mm), (BidirectionalPneuNet, 20 * mm)])
def test_few_chambers_that_are_slanted_or_on_both_sides_have_shorter_cells(kind, length: float) -> None:
    for part, few in ((kind(chambers=2, length=length), True), (kind(), False)):
        made = swept_mesh(part.build(), Fineness(size=3 * mm))
        heights = np.ptp(made.points[made.cells[:, :8], 2], axis=1)
        assert (heights.max() < 0.77 * 3 * mm) == few
        assert made.serendipity


def test_the_wall_of_a_tube_of_two_materials_has_two_cells() -> None:
    for kind, cells in ((TwoMaterialBender, 2), (ExtendingCylinder, 1), (ContractingTube, 1)):
        sweep = kind().build()._sweep
        section = polar_section(sweep.layers, sweep.outlines, FINE)
        assert section is not None
        radii = np.unique(np.round(np.hypot(*section.points[section.quads[:, :4]].T) / mm, 6))
        through = radii[radii >= kind().inner_radius / mm - 1e-6]
        assert len(through) == cells + 1
