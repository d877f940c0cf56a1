"""Sides of films cut in four: exact pieces with the names of the mesh, joined where the sides are."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.faces.surfaces import area
from turgor.core.engine.transfer import transfer_to
from turgor.core.meshing.mesh import has_area
from turgor.core.meshing.refining.split_films import refine_films
from turgor.units import GPa, mm


@pytest.fixture(scope="module")
def pouch():
    return tg.mesh(tg.actuators.Pouch(), size=20 * mm)


def curved():
    """A quarter of a ring."""
    corners = ((10 * mm, 0, 0), (0, 10 * mm, 0), (0, 20 * mm, 0), (20 * mm, 0, 0))
    center = (0.0, 0.0, 0.0)
    patch = tg.bodies.Patch(
        corners=corners, faces=("film",), edges=("inner", "", "outer", ""), arcs=(center, None, center, None)
    )
    return tg.mesh(tg.bodies.Film(patches=(patch,)), size=8 * mm)


@pytest.mark.parametrize("make", [lambda: tg.mesh(tg.actuators.Pouch(), size=20 * mm), curved])
def test_pieces_cover_their_sides_and_share_their_nodes(make):
    mesh = make()
    fine = refine_films(mesh).mesh
    assert len(fine.film_sides) == 4 * len(mesh.film_sides)
    places = np.unique((fine.points / (1e-6 * mm)).round(), axis=0)
    assert len(places) == len(fine.points) == len(np.unique(fine.film_sides))
    corners = np.unique(fine.film_sides[:, :4])
    assert corners.tolist() == list(range(len(corners)))  # corners come first
    for name, sides in mesh.faces.items():
        assert has_area(fine.faces[name]) == has_area(sides)
        if has_area(sides):
            assert area(fine.points, fine.faces[name]) == pytest.approx(area(mesh.points, sides), rel=1e-5)


def test_edges_are_cut_in_two_and_lie_on_the_rim(pouch):
    fine = refine_films(pouch).mesh
    edges = pouch.faces["symmetry_y"]
    assert len(fine.faces["symmetry_y"]) == 2 * len(edges)
    for side in fine.faces["symmetry_y"]:
        a, b, middle = fine.points[side[[0, 1, 4]]]
        assert middle == pytest.approx((a + b) / 2)
        assert side.tolist() == [side[0], side[1], side[1], side[0], *[side[4]] * 5]
    assert fine.points[fine.face_nodes("symmetry_y"), 1] == pytest.approx(0.0, abs=1e-12)


def test_a_quadratic_field_is_transferred_exactly(pouch):
    refinement = refine_films(pouch)

    def field(points):
        x, y = points[:, :1] / mm, points[:, 1:2] / mm
        return np.concatenate([x**2 * y**2, x - y, x * y**2], axis=1)

    got = transfer_to(pouch, refinement).nodal(field(pouch.points))
    assert got == pytest.approx(field(refinement.mesh.points), rel=1e-9, abs=1e-6)


def test_refinement_to_a_target_is_refused():
    film = tg.Membrane(tg.Material(name="film", law=tg.laws.Hooke(E=4 * GPa, nu=0.3)), 0.1 * mm)
    corners = ((0, 0, 0), (0, 10 * mm, 0), (10 * mm, 10 * mm, 0), (10 * mm, 0, 0))
    patch = tg.bodies.Patch(corners=corners, faces=("film",), edges=("left", "", "tip", ""))
    mesh = tg.mesh(tg.bodies.Film(patches=(patch,)), size=10 * mm)
    pull = tg.loads.Force("tip", (1.0, 0.0, 0.0))
    with refused("refined to a target", "films", "one size"):
        tg.mesh_to(tg.Model(mesh, {"film": film}, ["left", tg.Fixed("film", "z")], [pull]), tg.tip_displacement, 0.01)
