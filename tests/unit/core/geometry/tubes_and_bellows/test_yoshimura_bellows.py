"""A Yoshimura bellows encloses the volume of its dimensions, has the names of films, and refuses what cannot be."""

from math import cos, pi, sqrt

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.geometry.actuators.yoshimura_bellows import YoshimuraBellows
from turgor.units import mm


@pytest.mark.parametrize("changed", [{}, {"sides": 3, "folds": 1}, {"inner_radius": 20 * mm, "sides": 8}])
def test_the_film_encloses_the_volume_of_the_dimensions(changed):
    bellows = YoshimuraBellows(**changed)
    mesh = tg.mesh(bellows.build(), size=20 * mm)
    assert cavity_volume(mesh, "cavity") == pytest.approx(bellows.cavity_volumes["cavity"])
    assert set(mesh.faces) == {"cavity", "film", "fixed", "tip"}
    assert np.ptp(mesh.points[mesh.face_nodes("fixed"), 0]) == 0
    assert mesh.points[mesh.face_nodes("tip"), 0] == pytest.approx(bellows.length)


def test_two_octahedra_on_each_other_computed_by_hand():
    radius = 10 * mm
    edge = sqrt(3) * radius
    bellows = YoshimuraBellows(sides=3, folds=1, outer_radius=radius, inner_radius=radius, pitch=2 * edge * sqrt(2 / 3))
    assert bellows.cavity_volumes["cavity"] == pytest.approx(2 * sqrt(2) / 3 * edge**3)


def test_slanted_edges_are_equally_long():
    bellows = YoshimuraBellows(folds=1)
    points = tg.mesh(bellows.build(), size=20 * mm).points
    away = np.hypot(points[:, 1], points[:, 2])
    low = points[np.isclose(points[:, 0], 0) & np.isclose(away, bellows.inner_radius)]
    crest = points[np.isclose(points[:, 0], bellows.pitch / 2) & np.isclose(away, bellows.outer_radius)]
    inner, outer = bellows.inner_radius, bellows.outer_radius
    slanted = sqrt((bellows.pitch / 2) ** 2 + inner**2 + outer**2 - 2 * inner * outer * cos(pi / 6))
    near = np.sort(np.linalg.norm(low[:, None] - crest[None], axis=2), axis=1)
    assert (len(low), len(crest)) == (6, 6)
    assert near[:, :2] == pytest.approx(slanted)
    assert (near[:, 2] > 1.5 * slanted).all()


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"inner_radius": 25 * mm}, ("inner_radius", "25 mm", "1 mm to 20 mm", "crests")),
        ({"outer_radius": 20}, ("outer_radius", "20000 mm", "1 mm to 1000 mm", "unit")),
        ({"pitch": 0}, ("pitch", "0 mm", "0.5 mm to 1000 mm")),
        ({"sides": 25}, ("sides", 25, "3 to 24")),
        ({"folds": 0}, ("folds", 0, "1 to 50")),
    ],
)
def test_wrong_dimensions_are_refused(wrong, facts):
    with refused(*facts):
        YoshimuraBellows(**wrong)
