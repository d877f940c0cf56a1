"""A Kresling tube encloses the volume of its dimensions, has the names of films, and refuses what cannot be."""

from math import cos, pi, sqrt

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.geometry.actuators.kresling_tube import KreslingTube
from turgor.units import deg, mm


@pytest.mark.parametrize(
    "changed",
    [{}, {"cells": 3, "alternating": True}, {"sides": 3, "turn": 50 * deg}, {"sides": 8, "turn": 20 * deg}],
)
def test_the_film_encloses_the_volume_of_the_dimensions(changed):
    tube = KreslingTube(**changed)
    mesh = tg.mesh(tube.build(), size=20 * mm)
    assert cavity_volume(mesh, "cavity") == pytest.approx(tube.cavity_volumes["cavity"])
    assert set(mesh.faces) == {"cavity", "film", "fixed", "tip"}
    assert np.ptp(mesh.points[mesh.face_nodes("fixed"), 0]) == 0
    assert mesh.points[mesh.face_nodes("tip"), 0] == pytest.approx(tube.length)


def test_triangles_turned_by_half_a_side_make_an_octahedron():
    radius = 10 * mm
    edge = sqrt(3) * radius
    tube = KreslingTube(cells=1, sides=3, radius=radius, height=edge * sqrt(2 / 3), turn=60 * deg)
    assert tube.cavity_volumes["cavity"] == pytest.approx(sqrt(2) / 3 * edge**3)


def test_edges_have_the_lengths_of_the_formulas():
    tube = KreslingTube(cells=1)
    points = tg.mesh(tube.build(), size=20 * mm).points
    ring = points[np.isclose(points[:, 0], 0) & np.isclose(np.hypot(points[:, 1], points[:, 2]), tube.radius)]
    top = points[np.isclose(points[:, 0], tube.height) & np.isclose(np.hypot(points[:, 1], points[:, 2]), tube.radius)]
    lengths = np.linalg.norm(ring[:, None] - top[None], axis=2)
    for turn in (tube.turn, tube.turn - 2 * pi / 6):
        length = sqrt(tube.height**2 + 2 * tube.radius**2 * (1 - cos(turn)))
        assert np.isclose(lengths, length).sum() >= 6


@pytest.mark.parametrize(("alternating", "turn"), [(False, 80 * deg), (True, 0.0)])
def test_every_other_row_turns_back_where_rows_alternate(alternating, turn):
    tube = KreslingTube(cells=2, turn=40 * deg, alternating=alternating)
    mesh = tg.mesh(tube.build(), size=20 * mm)
    corner = np.array([tube.length, tube.radius * np.cos(turn), tube.radius * np.sin(turn)])
    assert np.linalg.norm(mesh.points[mesh.face_nodes("tip")] - corner, axis=1).min() < 1e-9


def test_the_middle_of_each_edge_belongs_to_both_triangles():
    mesh = tg.mesh(KreslingTube(cells=1).build(), size=20 * mm)
    quads = mesh.face("cavity")
    edges = np.sort(np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]))
    sides, counts = np.unique(edges, axis=0, return_counts=True)
    rim = np.isclose(mesh.points[sides][..., 0], 0).all(axis=1)
    assert (counts[~rim] == 2).all()
    assert (counts[rim] == 1).all()


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"turn": 130 * deg}, ("turn", "130 deg", "5 deg to 120 deg", "6 sides")),
        ({"turn": 0.0}, ("turn", "0 deg", "5 deg to 120 deg")),
        ({"sides": 2}, ("sides", 2, "3 to 24")),
        ({"cells": 0}, ("cells", 0, "1 to 50")),
        ({"radius": 20}, ("radius", "20000 mm", "1 mm to 1000 mm", "unit")),
        ({"height": 0}, ("height", "0 mm", "0.5 mm to 1000 mm")),
        ({"alternating": "yes"}, ("alternating", "'yes'", "True or False")),
    ],
)
def test_wrong_dimensions_are_refused(wrong, facts):
    with refused(*facts):
        KreslingTube(**wrong)
