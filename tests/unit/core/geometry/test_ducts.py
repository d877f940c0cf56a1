"""Inlets on top lead through the wall above the cavity; their volume is that of a hole between two curved walls."""

from math import pi, sqrt

import pytest
from scipy.integrate import quad
from tube_cases import areas, assert_meshes

from refused import refused
from turgor.core.geometry.actuators.contracting_tube import ContractingTube
from turgor.core.geometry.actuators.eccentric_bender import EccentricBender
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender
from turgor.core.geometry.actuators.twisting_tube import TwistingTube
from turgor.core.geometry.actuators.two_material_bender import TwoMaterialBender
from turgor.units import mm

ON_TOP = {"inlet_diameter": 3 * mm, "inlet_side": "top"}


def hole(outer: float, inner: float, lift: float = 0.0) -> float:
    """Volume in mm³ of a hole of 3 mm diameter between two cylinders in mm, the inner one lifted."""

    def height(y: float) -> float:
        return sqrt(outer**2 - y**2) - lift - sqrt(inner**2 - y**2)

    return quad(lambda y: 2 * sqrt(1.5**2 - y**2) * height(y), -1.5, 1.5, epsabs=1e-12)[0]


@pytest.mark.parametrize(
    ("family", "expected"),
    [
        (SemicircularBender, hole(10, 8) / 2),
        (RectangularBender, pi * 1.5**2 * 2 / 2),
        (EccentricBender, hole(8, 4.5, 1.5) / 2),
        (TwoMaterialBender, hole(8.35, 6.35) / 2),
        (FiberReinforcedBender, hole(11, 8) / 2),
        (TwistingTube, hole(8.35, 6.35)),
    ],
)
def test_volume_of_the_hole(family, expected):
    with_inlet, plain = family(**ON_TOP), family()
    added = with_inlet.cavity_volumes["cavity"] - plain.cavity_volumes["cavity"]
    assert added * 1e9 == pytest.approx(expected, rel=1e-8)
    assert plain.solid_volume - with_inlet.solid_volume == pytest.approx(added, rel=1e-9)
    result, before = areas(with_inlet.build()), areas(plain.build())  # compares the volumes of CAD and dimensions
    assert set(result) == set(before)
    assert 0 < before["outside"] - result["outside"] < 1.1 * pi * 1.5**2
    for name in ("fixed", "tip"):
        assert result[name] == pytest.approx(before[name])


@pytest.mark.parametrize("family", [ExtendingCylinder, ContractingTube, FiberReinforcedCylinder])
def test_a_quarter_would_have_two_inlets(family):
    with refused("inlet_side", "'top'", "symmetric", "'fixed'"):
        family(**ON_TOP)
    assert family(**ON_TOP, symmetric=False).build().cavity_volume > family(symmetric=False).cavity_volumes["cavity"]


def test_it_meshes():
    assert_meshes(TwoMaterialBender(length=40 * mm, **ON_TOP), size=4 * mm)
    assert_meshes(SemicircularBender(length=40 * mm, **ON_TOP), size=4 * mm)


def test_what_cannot_be_is_said():
    with refused("inlet_side", "left", "fixed, top"):
        SemicircularBender(inlet_side="left")
    with refused("inlet_diameter", "9 mm", "0 (none) or 0.01 mm to 8 mm"):
        SemicircularBender(inlet_diameter=9 * mm, inlet_side="top")
    with refused("inlet_diameter", "3 mm", "0 (none) or 0.01 mm to 2.5 mm"):
        SemicircularBender(length=15 * mm, inlet_diameter=3 * mm, inlet_side="top")
