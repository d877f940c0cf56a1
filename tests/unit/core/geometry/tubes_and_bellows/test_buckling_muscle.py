"""A buckling muscle has the volumes, faces and names that its dimensions say, and refuses what cannot be."""

import pytest
from tube_cases import areas, assert_shape

import turgor as tg
from refused import refused
from turgor.core.geometry.actuators.buckling_muscle import BucklingMuscle
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "tip"}


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize(("rows", "cavities"), [(2, 3), (1, 1)])
def test_volumes_computed_by_hand(rows, cavities, symmetric):
    muscle = BucklingMuscle(rows=rows, cavities=cavities, symmetric=symmetric)
    share = 2 if symmetric else 1
    length, width = 16 * rows + 3 * (rows + 1), 8 * cavities + 2 * (cavities - 1) + 6
    cavity = rows * cavities * 16 * 8 * 21
    assert_shape(
        muscle,
        solid=(length * width * 25 - cavity) / share,
        cavities={"cavity": cavity / share},
        regions={"body"},
        faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )
    part = areas(muscle.build())
    assert part["tip"] == pytest.approx(width * 25 / share)
    walls = rows * cavities * (16 * 8 + (16 + 8) * 21) * (1 if symmetric else 2)
    assert part["cavity"] == pytest.approx(walls)


def test_hexahedra_fill_it_without_cavities():
    muscle = BucklingMuscle()
    mesh = tg.mesh(muscle.build(), size=16 * mm, cells="hexahedra")
    assert cell_volumes(mesh).sum() == pytest.approx(muscle.solid_volume)
    assert set(mesh.faces) == FACES | {"symmetry_y"}
    assert len(mesh.cells) < 400  # a few seconds for a job


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"skin": 13 * mm}, ("skin", "13 mm", "0.01 mm to 12.495 mm", "25 mm")),
        ({"column": 0}, ("column", "0 mm", "0.01 mm to 1000 mm")),
        ({"column_length": 12}, ("column_length", "12000 mm", "0.1 mm to 1000 mm", "unit")),
        ({"rows": 0}, ("rows", 0, "1 to 50")),
        ({"cavities": 2.5}, ("cavities", 2.5, "1 to 50")),
        ({"symmetric": "half"}, ("symmetric", "'half'", "True or False")),
    ],
)
def test_wrong_dimensions_are_refused(wrong, facts):
    with refused(*facts):
        BucklingMuscle(**wrong)


def test_the_thinnest_wall_is_one_that_there_is():
    assert BucklingMuscle().smallest_wall == 2 * mm
    assert BucklingMuscle(cavities=1, column=0.5 * mm).smallest_wall == 2 * mm
    assert BucklingMuscle(rows=1, cavities=1, beam=0.5 * mm).smallest_wall == 2 * mm
