"""Fits of networks that flow give back the constants that made the tests, and refuse what they cannot fit."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.histories.fit_flow import fit_flow
from turgor.core.materials.fitting.histories.history_fit import quality_of
from turgor.core.materials.history.stress_history import stress_history

LAW = tg.laws.NeoHooke(C10=1e5)
NETWORK = tg.laws.BergstromBoyce(stiffness=1.2, rate=0.05, stress=3e5, exponent=3.0)
FLOWING = tg.Material(name="r", law=LAW, viscoelasticity=NETWORK)


def cycle(rate, count=61):
    time = np.linspace(0, 2 / rate, count)
    stretch = 1 + rate * np.minimum(time, 2 / rate - time)
    stress = stress_history(FLOWING, "uniaxial", time, stretch).nominal_stress
    return MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stress, time=time, name=f"{rate:g} 1/s")


@pytest.fixture(scope="module")
def fitted():
    law = tg.laws.NeoHooke(C10=1.4e5)  # that of a first loading at some rate
    return fit_flow(law, [cycle(0.01), cycle(0.3)], rate_dependence=True, starts=1)


def test_two_rates_give_the_network_back(fitted):
    network = fitted.material.viscoelasticity
    assert fitted.values["scale"] * 1.4e5 == pytest.approx(1e5, rel=0.01)
    assert network.stiffness == pytest.approx(1.2, rel=0.03)
    assert network.exponent == pytest.approx(3.0, rel=0.02)
    same = NETWORK.rate * (network.stress / NETWORK.stress) ** NETWORK.exponent  # the rate at the other stress
    assert network.rate == pytest.approx(same, rel=0.05)
    assert not fitted.bounds_hit and not fitted.undetermined
    assert min(each.r2 for each in fitted.quality) > 0.9999


def test_a_rate_that_was_not_fitted_is_predicted(fitted):
    assert fitted.predict(cycle(0.05))[0].r2 > 0.999
    other = replace(fitted.material.viscoelasticity, exponent=2.0)
    wrong = replace(fitted.material, viscoelasticity=other)
    assert quality_of(wrong, [cycle(0.05)])[0].r2 < 0.999


def test_what_cannot_be_fitted_is_refused():
    test = cycle(0.1, 21)
    with refused("rate_dependence", "permanent_set", "fit_history"):
        fit_flow(LAW, test)
    with refused("test", "time"):
        fit_flow(LAW, [], rate_dependence=True)
    still = MaterialTest(mode="uniaxial", stretch=test.stretch, nominal_stress=test.nominal_stress, name="still")
    with refused("'still'", "time"):
        fit_flow(LAW, still, permanent_set=True)
