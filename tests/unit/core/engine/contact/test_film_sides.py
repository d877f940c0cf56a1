"""Which sides of films may touch is decided at rest."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.contact.films import film_exceptions, film_surface
from turgor.units import GPa, MPa, mm

FILM = tg.Membrane(tg.Material(name="PET", law=tg.laws.Hooke(E=4 * GPa, nu=0.35)), 0.05 * mm, compression=0)
SQUARE = ((0, 0), (0, 20), (20, 20), (20, 0))  # mm, clockwise from above: the cavity is below


def _film(name, z, below=True, edge="", shift=0.0):
    corners = tuple(((x + shift) * mm, y * mm, z * mm) for x, y in (SQUARE if below else SQUARE[:1] + SQUARE[:0:-1]))
    return tg.bodies.Patch(corners=corners, faces=(name,), edges=(edge,) * 4)


def _may_touch(*patches, size=10 * mm):
    """Allowed contacts between films of names, with the sides that look into (i) and out of (o) their cavities."""
    mesh = tg.mesh(tg.bodies.Film(patches=patches), size=size)
    model = tg.Model(mesh, {patch.name: FILM for patch in patches}, [], [])
    surface = film_surface(model, mesh.points, 1 * MPa)
    start, listed = film_exceptions(mesh, surface, mesh.points)
    count = len(mesh.film_sides)
    films = [patch.name for patch in patches]
    names = [next(n for n in films if set(side[:4]) <= set(mesh.face_nodes(n))) for side in mesh.film_sides]
    sides = [(name, out) for out in "io" for name in names]
    allowed = np.zeros((2 * count, 2 * count), dtype=bool)
    allowed[count:, count:] = True
    for row in range(2 * count):
        allowed[row, listed[start[row] : start[row + 1]]] ^= True
    assert (allowed == allowed.T).all()
    pairs = {(sides[a], sides[b]) for a, b in zip(*np.nonzero(allowed), strict=True)}
    return {(m + a, n + b) for (m, a), (n, b) in pairs if m < n}


def test_two_films_of_a_flat_pouch_touch_within():
    assert _may_touch(_film("a", 0, below=False), _film("b", 0)) == {("ai", "bi")}


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        (False, True, ("ai", "bi")),
        (True, False, ("ao", "bo")),
        (True, True, ("ao", "bi")),
        (False, False, ("ai", "bo")),
    ],
)
def test_films_of_two_bodies_touch_with_the_sides_that_look_at_each_other(first, second, expected):
    assert _may_touch(_film("a", 0, below=first), _film("b", 1, below=second)) == {expected}


@pytest.mark.parametrize("below", [True, False])
def test_films_beside_each_other_touch_with_the_sides_that_look_out(below):
    assert _may_touch(_film("a", 0), _film("b", 0, below=below, shift=22)) == {("ao", "bo")}


def test_films_on_each_other_without_a_cavity_between_them_are_refused():
    with refused("films", "(5, 5, 0) mm", "thickness", "self-contact"):
        _may_touch(_film("a", 0, edge="symmetry_z"), _film("b", 0, edge="symmetry_z"))


@pytest.mark.parametrize(("closed", "expected"), [(False, {("ai", "co")}), (True, set())])
def test_only_an_open_film_touches_itself_with_both_sides(closed, expected):
    """A film that rises like the letter S: its lowest part sees the other side of the highest, unless it is a pouch."""
    path = ((0, 0), (20, 0), (20, 8), (0, 8), (0, 16), (20, 16))
    patches = []
    for name, (x, z), (x2, z2) in zip("abdec", path[:-1], path[1:], strict=True):
        corners = tuple((a * mm, b * mm, c * mm) for a, b, c in ((x, 0, z), (x2, 0, z2), (x2, 20, z2), (x, 20, z)))
        patches.append(tg.bodies.Patch(corners=corners, faces=(name, "cavity")))
        if closed:
            patches.append(tg.bodies.Patch(corners=corners[::-1], faces=(name.upper(), "cavity")))
    pairs = _may_touch(*patches, size=4 * mm)
    assert {(m, n) for m, n in pairs if m[0] + n[0] == "ac" and m[1] != n[1]} == expected
