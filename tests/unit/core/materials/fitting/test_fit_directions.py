"""Laws with directions are recovered from tests of specimens cut along them; what is not determined is named."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_directions import CUTS, fit_directions, specimen_stress
from turgor.core.materials.orientation import Orientation

PRINT = tg.laws.Orthotropic(C10=0.8e6, C20=3e4, a1=0.5e6, a2=0.2e6, a3=0.05e6)
HGO = tg.laws.HolzapfelGasserOgden(C10=20e3, k1=80e3, k2=1.5, kappa=0.08)


def synthetic(law, angle=0.0, noise=0.0, cuts=tuple(CUTS)):
    random, tests = np.random.default_rng(2), {}
    for cut in cuts:
        lies = Orientation(along=CUTS[cut][0], across=CUTS[cut][1], angle=angle)
        stretch = np.linspace(1.03, 1.5, 25)
        exact = specimen_stress(tg.Material(name=cut, law=law, orientation=lies), stretch)
        exact = exact * (1 + noise * random.normal(size=len(stretch)))
        tests[cut] = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=exact, name=cut)
    return tests


def test_free_directions_bear_nothing_and_contract_unlike():
    lies = Orientation(along=(1, 0, 0), across=(0, 1, 0))
    stretch = np.array([1.4])
    pull = specimen_stress(tg.Material(name="print", law=PRINT, orientation=lies), stretch)
    isotropic = tg.laws.curve(tg.Yeoh(C10=0.8e6, C20=3e4), "uniaxial", stretch).nominal_stress
    assert pull > 1.5 * isotropic
    even = tg.laws.Orthotropic(C10=0.8e6, a1=0.5e6, a2=0.1e6, a3=0.1e6)  # contracts alike: the closed form
    closed = 1.6e6 * (1.4 - 1.4**-2) + 0.5e6 * (1.4**2 - 1) * 2.8 - 0.2e6 * (1 / 1.4 - 1) / 1.4**2
    assert specimen_stress(tg.Material(name="p", law=even, orientation=lies), stretch) == pytest.approx(
        closed, rel=1e-9
    )


def test_a_print_is_recovered():
    result = fit_directions("orthotropic", synthetic(PRINT), fixed={"C30": 0.0}, starts=1)
    expected = {"C10": 0.8e6, "C20": 3e4, "a1": 0.5e6, "a2": 0.2e6, "a3": 0.05e6}
    assert result.values == pytest.approx(expected, rel=1e-5)
    assert result.relative < 1e-7


def test_noise_stays_within_the_stated_errors():
    result = fit_directions("orthotropic", synthetic(PRINT, noise=0.01), fixed={"C30": 0.0, "C20": 3e4}, starts=1)
    for name, exact in (("C10", 0.8e6), ("a1", 0.5e6), ("a2", 0.2e6), ("a3", 0.05e6)):
        assert abs(result.values[name] - exact) < 4 * result.errors[name]
        assert 0 < result.errors[name] < 0.1 * 0.8e6


def test_fibers_and_their_angle_are_recovered():
    result = fit_directions("holzapfel_gasser_ogden", synthetic(HGO, np.radians(32)), starts=2)
    assert result.relative < 1e-6
    assert result.values == pytest.approx(
        {"C10": 20e3, "k1": 80e3, "k2": 1.5, "kappa": 0.08, "angle": np.radians(32)}, rel=1e-3
    )
    assert result.angle == result.values["angle"]


def test_what_cannot_be_fitted_is_said():
    along = synthetic(PRINT, cuts=("along",))
    with refused("Yeoh", "no directions"):
        fit_directions("yeoh", along)
    with refused("sideways", "along", "through"):
        fit_directions("orthotropic", {"sideways": along["along"]})
    with refused("parameter", "a4", "a1"):
        fit_directions("orthotropic", along, fixed={"a4": 0.0})
    fibers = synthetic(tg.laws.HolzapfelGasserOgden(C10=2e4, k1=8e4, k2=1.0), cuts=("across",))
    with refused("not determine", "k1"):
        fit_directions("holzapfel_gasser_ogden", fibers, fixed={"angle": 0.0, "kappa": 0.0}, starts=1)
