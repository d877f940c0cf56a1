"""A Miura tube encloses the volume of its dimensions, folds as Miura-ori does, and refuses what cannot be."""

from dataclasses import replace
from math import cos, degrees, sqrt

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.geometry.actuators.miura_tube import MiuraTube
from turgor.units import deg, mm


@pytest.mark.parametrize("changed", [{}, {"rows": 1, "fold_angle": 20 * deg}, {"rows": 3, "sector_angle": 80 * deg}])
def test_the_film_encloses_the_volume_of_the_dimensions(changed):
    tube = MiuraTube(**changed)
    mesh = tg.mesh(tube.build(), size=20 * mm)
    assert cavity_volume(mesh, "cavity") == pytest.approx(tube.cavity_volumes["cavity"])
    assert set(mesh.faces) == {"cavity", "film", "fixed", "tip"}
    assert np.ptp(mesh.points[mesh.face_nodes("fixed"), 0]) == 0
    assert mesh.points[mesh.face_nodes("tip"), 0] == pytest.approx(tube.length)


@pytest.mark.parametrize("fold", [15, 45, 75])
def test_parallelograms_keep_their_size_at_every_fold(fold):
    tube = MiuraTube(fold_angle=fold * deg)
    walls = tube.build().shape.patches[:-1]
    assert len(walls) == 16
    for wall in walls:
        a, b, c, d = np.array(wall.corners)
        side, slant = b - a, c - b
        assert d - c == pytest.approx(-side)
        assert np.linalg.norm(side) == pytest.approx(tube.side)
        assert np.linalg.norm(slant) == pytest.approx(tube.slant)
        sector = degrees(np.arccos(abs(side @ slant) / (tube.side * tube.slant)))
        assert sector == pytest.approx(60)
        normal = np.cross(side, slant)
        assert degrees(np.arccos(abs(normal[2]) / np.linalg.norm(normal))) == pytest.approx(fold)


def test_width_and_length_follow_each_other():
    tube = MiuraTube(side=30 * mm, slant=15 * mm, sector_angle=65 * deg)
    for fold in (20, 50, 80):
        folded = replace(tube, fold_angle=fold * deg)
        shift = sqrt(folded.slant**2 - folded.row_length**2)
        assert folded.width / 2 * shift == pytest.approx(folded.side * folded.slant * cos(65 * deg))


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"sector_angle": 90 * deg}, ("sector_angle", "90 deg", "20 deg to 85 deg", "slanted")),
        ({"fold_angle": 5 * deg}, ("fold_angle", "5 deg", "10 deg to 80 deg", "height")),
        ({"side": 20}, ("side", "20000 mm", "1 mm to 1000 mm", "unit")),
        ({"slant": 0}, ("slant", "0 mm", "0.5 mm to 1000 mm")),
        ({"rows": 0}, ("rows", 0, "1 to 50")),
    ],
)
def test_wrong_dimensions_are_refused(wrong, facts):
    with refused(*facts):
        MiuraTube(**wrong)
