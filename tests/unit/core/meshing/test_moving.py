"""Tetrahedra that follow their CAD shape: nodes stay on its faces, parts are matched, refusals say why."""

from dataclasses import replace

import meshing_cases
import numpy as np
import pytest
from netgen.occ import Box, Cylinder, Pnt, X, Y, Z

import turgor as tg
from refused import refused
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.wedge import HIGH, LOW, Wedge
from turgor.core.meshing.moving.movable_mesh import movable
from turgor.core.meshing.moving.shape_matching import matched
from turgor.core.meshing.quality.cell_quality import cell_volumes, refuse_inverted
from turgor.units import mm

TUBE = ExtendingCylinder(length=20 * mm)


@pytest.fixture(scope="module")
def tube():
    geometry = TUBE.build()
    return movable(tg.mesh(geometry, size=6 * mm, cells="tetrahedra"), geometry)


def test_nothing_moves_where_the_shape_stays(tube):
    assert np.array_equal(tube.at(TUBE.build()).points, tube.mesh.points)


def test_nodes_stay_on_curved_and_plane_faces(tube):
    wider = replace(TUBE, inner_radius=1.05 * TUBE.inner_radius, length=1.1 * TUBE.length)
    moved = tube.at(wider.build())
    for name, radius in (("outside", wider.outer_radius), ("cavity", wider.inner_radius)):
        nodes = moved.face_nodes(name)
        before = np.hypot(*tube.mesh.points[nodes, 1:].T) - getattr(
            TUBE, "outer_radius" if name == "outside" else "inner_radius"
        )
        round_ = np.abs(before) < 1e-9  # the others lie on a cap, or on an edge that was straightened
        assert round_.sum() > 20
        assert np.abs(np.hypot(*moved.points[nodes[round_], 1:].T) - radius).max() < 1e-12
    assert np.ptp(moved.points[moved.face_nodes("tip"), 0]) < 1e-15
    assert moved.points[:, 0].max() == pytest.approx(wider.length)
    refuse_inverted(moved)


def test_a_scaled_shape_scales_its_mesh(tube):
    larger = ExtendingCylinder(
        **{name: 1.25 * getattr(TUBE, name) for name in ("length", "inner_radius", "wall", "cap")}
    )
    assert np.abs(tube.at(larger.build()).points - 1.25 * tube.mesh.points).max() < 1e-12


def test_fillets_follow():
    known, wider = meshing_cases.filleted_pneunet(1.0), meshing_cases.filleted_pneunet(1.1)
    mesh = tg.mesh(known, size=6 * mm, cells="tetrahedra")
    moved = movable(mesh, known).at(wider)
    gained = cell_volumes(moved).sum() - cell_volumes(mesh).sum()
    assert gained == pytest.approx(wider.solid_volume - known.solid_volume, rel=0.01)
    refuse_inverted(moved)


def test_cells_that_were_cut_follow(tube):
    mesh = tg.mesh(TUBE.build(), size=6 * mm, cells="tetrahedra", wall_cells=2)
    wider = replace(TUBE, wall=1.05 * TUBE.wall).build()
    moved = movable(mesh, TUBE.build()).at(wider)
    assert len(mesh.cells) > len(tube.mesh.cells)
    lost = [cell_volumes(one).sum() / part.solid_volume - 1 for one, part in ((mesh, TUBE.build()), (moved, wider))]
    assert lost[0] == pytest.approx(lost[1], abs=1e-4)


def test_parts_are_matched_where_the_kernel_numbers_them_anew(tube):
    """Another order of vertices, edges and faces, and edges that run the other way, change nothing."""
    known, random = tube.parts, np.random.default_rng(7)
    vertices, edges, faces = (random.permutation(len(each)) for each in (known.vertices, known.curves, known.surfaces))
    number, place = np.argsort(vertices), {int(edge): i for i, edge in enumerate(edges)}
    turned = [replace(known.curves[i], low=known.curves[i].high, high=known.curves[i].low) for i in edges]
    shuffled = replace(
        known,
        vertices=known.vertices[vertices],
        curves=tuple(turned),
        ends=tuple(tuple(int(number[v]) for v in known.ends[i][::-1]) for i in edges),
        surfaces=tuple(known.surfaces[i] for i in faces),
        rims=tuple(frozenset(place[edge] for edge in known.rims[i]) for i in faces),
        names=tuple(known.names[i] for i in faces),
    )
    result = matched(known, shuffled, "tube")
    assert np.array_equal(result.vertices, known.vertices) and result.surfaces == known.surfaces
    for one, other in zip(result.curves, known.curves, strict=True):
        assert (one.low, one.high) == (other.low, other.high) and one.edge == other.edge


def sector(radius):
    """A quarter of a disc with a hole, as one of four sectors about x."""
    disc = Cylinder(Pnt(0, 0, 0), X, r=radius, h=4) - Cylinder(Pnt(0, 0, 0), X, r=4, h=4)
    shape = Box(Pnt(0, 0, 0), Pnt(4, 20, 20)) * disc
    shape.faces.Min(Z).name, shape.faces.Min(Y).name = LOW, HIGH
    return replace(meshing_cases.named(shape, "disc", 4), wedge=Wedge(axis="x", fold=4))


def test_cuts_of_a_wedge_still_match():
    mesh = tg.mesh(sector(10), size=3 * mm, cells="tetrahedra")
    moved = movable(mesh, sector(10)).at(sector(11))
    assert moved.wedge == mesh.wedge and (moved.leaders != np.arange(len(moved.points))).sum() > 5
    assert np.array_equal(moved.leaders, mesh.leaders)
    high = moved.face_nodes(HIGH)
    assert np.array_equal(moved.wedge.images(moved.points[moved.leaders[high]]), moved.points[high])
    assert cell_volumes(moved).sum() == pytest.approx(sector(11).solid_volume, rel=1e-3)


def test_what_cannot_follow_says_why(tube):
    finger = FastPneuNet(chambers=1, length=20 * mm).build()
    for name, fact, move in (
        (finger.name, "other faces", lambda: tube.at(finger)),
        ("cylinder, quarter", "CAD vertices", lambda: movable(tube.mesh, finger)),
        (finger.name, "by facets", lambda: movable(tube.mesh, replace(finger, shape=object()))),
        (finger.name, "hexahedra", lambda: movable(tg.mesh(finger, size=8 * mm, cells="hexahedra"), finger)),
    ):
        with refused(name, fact):
            move()
    bent = replace(tube.mesh, points=tube.mesh.points + 0.3 * mm * np.sin(400 * tube.mesh.points[:, [1, 2, 0]]))
    with refused("cylinder, quarter", "CAD vertices"):
        movable(bent, TUBE.build())
