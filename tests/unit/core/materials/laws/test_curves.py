"""Curves of a law: the right stress, moduli, instability and range; impossible questions are refused."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.laws.curves import curve
from turgor.core.materials.laws.homogeneous import cauchy_stress, nominal_stress, planar, simple_shear
from turgor.core.materials.laws.laws import Hooke, NeoHooke, Ogden

NEO = NeoHooke(C10=0.12e6)
OGDEN = Ogden(mu=(24361.0, 66.703, 453.81), alpha=(1.7138, 7.0679, -3.3659))


def test_planar_curve_has_both_stresses() -> None:
    stretch = np.array([0.6, 1.0, 1.5, 3.0])
    got = curve(OGDEN, "planar", stretch)
    expected = nominal_stress(OGDEN, planar(stretch))
    assert (got.nominal_stress == expected[:, 0, 0]).all()
    assert (got.second_nominal_stress == expected[:, 1, 1]).all()
    assert got.cauchy_stress == pytest.approx(stretch * got.nominal_stress, rel=1e-12, abs=1e-9)
    assert (got.second_stretch == 1).all()


def test_shear_curve_is_odd_and_starts_with_the_shear_modulus() -> None:
    amount = np.array([-1.0, -1e-6, 1e-6, 1.0])
    got = curve(NEO, "simple_shear", amount)
    assert (got.cauchy_stress == cauchy_stress(NEO, simple_shear(amount))[:, 0, 1]).all()
    assert got.cauchy_stress / amount == pytest.approx([240e3] * 4)
    assert (got.shear_modulus, got.young_modulus) == (240e3, 720e3)


def test_biaxial_curve_holds_equibiaxial_and_planar_tension() -> None:
    stretch = np.array([1.2, 1.7, 2.5])
    equal = curve(OGDEN, "biaxial", stretch, stretch)
    held = curve(OGDEN, "biaxial", stretch, 1.0)
    assert equal.nominal_stress == pytest.approx(curve(OGDEN, "equibiaxial", stretch).nominal_stress, rel=1e-12)
    assert equal.second_nominal_stress == pytest.approx(equal.nominal_stress, rel=1e-12)
    assert held.second_cauchy_stress == pytest.approx(curve(OGDEN, "planar", stretch).second_cauchy_stress, rel=1e-12)


def test_instability_is_looked_for_in_the_range_of_the_curve() -> None:
    assert curve(OGDEN, "equibiaxial", [1.0, 3.0]).instability == pytest.approx(1.643, abs=5e-4)
    assert curve(OGDEN, "equibiaxial", [1.0, 1.6]).instability is None
    assert curve(OGDEN, "simple_shear", [0.0, 3.0]).instability is None


def test_range_tells_points_inside_from_points_outside() -> None:
    assert curve(NEO, "uniaxial", [0.9, 1.5, 2.5]).inside((1.0, 2.0)).tolist() == [False, True, False]
    assert curve(NEO, "planar", [1.5]).inside((1.2, 2.0)).tolist() == [True]  # the held width is no test of the range
    assert curve(NEO, "simple_shear", [0.5, 2.0]).inside((1.0, 2.0)).tolist() == [True, False]  # λ = 1.28, 2.41
    assert curve(NEO, "biaxial", [1.5, 1.5], [1.5, 2.5]).inside((1.0, 2.0)).tolist() == [True, False]
    assert curve(NEO, "uniaxial", [9.0]).inside(None).tolist() == [True]


@pytest.mark.parametrize(
    ("arguments", "facts"),
    [
        ((NEO, "uniaxal", [1.5]), ("mode 'uniaxal'", "'uniaxial'")),
        ((NEO, "uniaxial", [0.0]), ("stretch is 0", "more than 0")),
        ((NEO, "uniaxial", []), ("stretch is []",)),
        ((NEO, "uniaxial", [1.0, np.nan]), ("stretch is [1.0, nan]",)),
        ((NEO, "uniaxial", [1.5], [1.5]), ("'uniaxial'", "second_stretch", "given")),
        ((NEO, "biaxial", [1.5]), ("'biaxial'", "second_stretch", "missing")),
        ((NEO, "biaxial", [1.5, 2.0], [1.0, 1.1, 1.2]), ("second_stretch", "3 points", "has 2")),
        ((Hooke(E=1e9, nu=0.2), "uniaxial", [1.5]), ("Hooke", "NeoHooke or Ogden")),
    ],
)
def test_impossible_questions_are_refused(arguments: tuple, facts: tuple) -> None:
    with refused(*facts):
        curve(*arguments)
