"""The CAD shape of parallel bellows has the volumes, faces and names that its dimensions say."""

from math import pi, sqrt

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.bellows_of_revolution import BellowsOfRevolution
from turgor.core.geometry.actuators.parallel_bellows import ParallelBellows
from turgor.units import mm

FACES = {"fixed", "interface", "outside", "tip"}


@pytest.mark.parametrize("symmetric", [False, True])
@pytest.mark.parametrize("constrained", [False, True])
@pytest.mark.parametrize("shape", ["straight", "rounded"])
@pytest.mark.parametrize(
    ("folds", "ribs", "rib", "inlet"),
    [(4, 1, 2, 0), (3, 2, 1.5, 3), (2, 0, 5, 0)],
)
def test_volumes_computed_by_hand(folds, ribs, rib, inlet, shape, constrained, symmetric) -> None:
    bellows = ParallelBellows(
        folds=folds, ribs=ribs, rib_thickness=rib * mm, inlet_diameter=inlet * mm, fold_shape=shape,
        constrained=constrained, symmetric=symmetric, wall=1 * mm,
    )  # fmt: skip
    alone = BellowsOfRevolution(  # what `bellows of revolution` are is tested there
        folds=folds, inner_radius=5 * mm, outer_radius=10 * mm, wall=1 * mm, pitch=7 * mm, cap=3 * mm,
        fold_shape=shape, symmetric=False,
    )  # fmt: skip
    neck = bellows._folds.neck_radius / mm
    plate = pi * (24 / sqrt(3) + 10 + 2) ** 2
    necks = ribs * rib * pi * (neck**2 - 5**2)
    duct = pi / 4 * inlet**2
    body = alone.solid_volume * 1e9 + necks - 3 * duct
    cavity = alone.cavity_volumes["cavity"] * 1e9 + ribs * rib * pi * 5**2 + duct * (3 + 3)
    plates = 2 * 3 * plate - 3 * 3 * duct + (ribs * rib * (plate - 3 * pi * neck**2) if constrained else 0.0)
    cavities = {"cavity_1": cavity, "cavity_2": cavity, "cavity_3": cavity}
    if symmetric:
        cavities = {"cavity_1": cavity / 2, "cavity_2": cavity}
    assert_shape(
        bellows,
        solid=(3 * body + plates) / (2 if symmetric else 1),
        cavities=cavities,
        regions={"body", "plate"},
        faces=FACES | set(cavities) | ({"symmetry_y"} if symmetric else set()),
    )


def test_both_kinds_have_the_same_length_and_folds() -> None:
    free, held = (ParallelBellows(constrained=kind) for kind in (False, True))
    assert free.length == held.length == pytest.approx((4 * 7 + 2 + 2 * 3 + 2 * 3) * mm)
    assert free.cavity_volumes == held.cavity_volumes
    neck = held._folds.neck_radius / mm
    plate = pi * (24 / sqrt(3) + 12) ** 2
    of_free, of_held = areas(free.build()), areas(held.build())
    assert of_free["interface"] == pytest.approx(6 * pi * neck**2)
    assert of_held["interface"] - of_free["interface"] == pytest.approx(3 * 2 * pi * neck * 2)
    added = 2 * (plate - 3 * pi * neck**2) + 2 * 2 * sqrt(plate * pi) - 3 * 2 * pi * neck * 2
    assert of_held["outside"] - of_free["outside"] == pytest.approx(added)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"folds": 3}, ("folds", 3, "a multiple of 2 up to 50", "1 neck")),
        ({"ribs": 2}, ("folds", 4, "a multiple of 3 up to 48", "2 necks")),
        ({"ribs": -1}, ("ribs", -1, "0 to 9")),
        ({"side": 20 * mm}, ("side", "20 mm", "20.01 mm to 2000 mm")),
        ({"outer_radius": 5 * mm}, ("outer_radius", "5 mm", "5.03 mm to 1000 mm")),
        ({"rib_thickness": 0.0}, ("rib_thickness", "0 mm", "0.1 mm to 500 mm")),
        ({"plate_margin": -1 * mm}, ("plate_margin", "-1 mm", "0.1 mm to 500 mm")),
        ({"inlet_diameter": 10 * mm}, ("inlet_diameter", "10 mm", "0.01 mm to 9.98 mm")),
        ({"constrained": "yes"}, ("constrained", "yes", "True or False")),
    ],
)
def test_dimensions_that_cannot_be_are_refused(wrong, facts) -> None:
    with refused(*facts):
        ParallelBellows(**wrong)


@pytest.mark.parametrize("constrained", [False, True])
def test_the_half_meshes_coarsely(constrained) -> None:
    assert_meshes(ParallelBellows(folds=2, constrained=constrained, symmetric=True), size=4 * mm, rel=0.03)
