"""Fitting relaxation and cycles: known constants come back, and what tests do not determine is said."""

from itertools import pairwise

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.histories.fit_history import fit_history
from turgor.core.materials.fitting.histories.history_fit import quality_of
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.stress_history import stress_history
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.conventions import scaled_law
from turgor.core.materials.laws.laws import GeneralizedRivlin, Gent, NeoHooke, Ogden, Yeoh
from turgor.core.materials.material import Material

LAW = Yeoh(C10=2e4, C20=-200.0, C30=20.0)
SERIES = Prony(g=(0.2, 0.1), tau=(1.0, 30.0), moduli="instantaneous")
MULLINS = Mullins(r=1.8, m=4e3)


def measured(rubber, mode, corners, points=60, noise=0.0):
    """A test of a rubber along corners (time, stretch), with noise relative to its largest stress."""
    at, stretches = np.array(corners).T
    time = np.unique(np.concatenate([np.linspace(a, b, points) for a, b in pairwise(at)]))
    stretch = np.interp(time, at, stretches)
    stress = stress_history(rubber, mode, time, stretch).nominal_stress
    stress = stress + noise * np.abs(stress).max() * np.random.default_rng(0).normal(size=len(time))
    return MaterialTest(mode=mode, stretch=stretch, nominal_stress=stress, time=time, name="a test")


def cycles(*tops, rate=0.1):
    """Corners of cycles at a rate of stretch."""
    corners, at = [(0.0, 1.0)], 0.0
    for top in tops:
        for stretch in (top, 1.0):
            at += (top - 1) / rate
            corners.append((at, stretch))
    return corners


def test_a_ramp_and_hold_gives_the_series_back():
    rubber = Material(name="r", law=LAW, viscoelasticity=SERIES)
    held = measured(rubber, "uniaxial", [(0, 1), (0.2, 1.8), (5, 1.8), (200, 1.8)], 120, noise=2e-3)
    result = fit_history(scaled_law(LAW, 0.8), held, terms=2)
    assert result.values["scale"] == pytest.approx(1 / 0.8, rel=0.02)
    assert result.material.viscoelasticity.g == pytest.approx(SERIES.g, abs=0.01)
    assert result.material.viscoelasticity.tau == pytest.approx(SERIES.tau, rel=0.15)
    assert (result.bounds_hit, result.undetermined) == ((), ())
    for name, true in (("g1", 0.2), ("g2", 0.1), ("tau1", 1.0), ("tau2", 30.0)):
        assert abs(result.values[name] - true) < 4 * result.errors[name]
    assert pytest.approx(2e4, rel=0.02) == result.material.law.C10
    assert result.quality[0].r2 > 0.999
    assert "g1 = 0.2" in result.describe()


def test_terms_that_the_test_does_not_have_are_left_out():
    rubber = Material(name="r", law=LAW, viscoelasticity=Prony(g=(0.3,), tau=(2.0,), moduli="instantaneous"))
    result = fit_history(LAW, measured(rubber, "planar", [(0, 1), (0.1, 1.5), (30, 1.5)], 200), terms=3)
    assert sum(result.material.viscoelasticity.g) == pytest.approx(0.3, abs=1e-3)


def test_cycles_give_softening_back():
    rubber = Material(name="r", law=LAW, stress_softening=MULLINS)
    tests = [measured(rubber, "uniaxial", cycles(1.5, 1.5, 2.5)), measured(rubber, "equibiaxial", cycles(1.8))]
    result = fit_history(LAW, tests, stress_softening=True, rescale=False)
    assert result.material.viscoelasticity is None
    assert result.values["scale"] == 1.0
    assert (result.values["r"], result.values["m"]) == (pytest.approx(1.8, rel=1e-3), pytest.approx(4e3, rel=2e-3))
    assert [test.r2 for test in result.quality] == pytest.approx([1, 1], abs=1e-6)


def test_both_together_and_the_energy_of_a_scaled_law():
    rubber = Material(name="r", law=LAW, viscoelasticity=SERIES, stress_softening=MULLINS)
    tests = [
        measured(rubber, "uniaxial", cycles(1.5, 2.0, 2.0), noise=1e-3),
        measured(rubber, "planar", [(0, 1), (0.5, 2.0), (5, 2.0), (90, 2.0)], noise=1e-3),
    ]
    result = fit_history(scaled_law(LAW, 0.5), tests, terms=2, stress_softening=True)
    assert result.material.viscoelasticity.g == pytest.approx(SERIES.g, abs=0.02)
    assert result.material.stress_softening.r == pytest.approx(1.8, rel=0.1)
    assert result.material.stress_softening.m == pytest.approx(4e3, rel=0.1)
    unseen = measured(rubber, "equibiaxial", cycles(1.6, 1.6, rate=0.02))
    assert result.predict(unseen)[0].r2 > 0.998
    bare = Material(name="r", law=result.material.law)
    assert stress_history(bare, "uniaxial", [0.0], [1.5]).nominal_stress == pytest.approx(
        stress_history(Material(name="r", law=LAW), "uniaxial", [0.0], [1.5]).nominal_stress, rel=0.02
    )


def test_a_rubber_of_long_term_constants_is_compared_as_one():
    slow = Material(name="r", law=LAW, viscoelasticity=Prony(g=(0.4,), tau=(3.0,), moduli="long_term"))
    test = measured(slow, "planar", cycles(1.5, 2.0))
    assert quality_of(slow, [test])[0].r2 == pytest.approx(1, abs=1e-9)


def test_beta_needs_cycles_to_several_stretches():
    true = Mullins(r=1.5, m=1e3, beta=0.4)
    rubber = Material(name="r", law=LAW, stress_softening=true)
    result = fit_history(
        LAW, measured(rubber, "uniaxial", cycles(1.3, 1.6, 2.0, 2.6)), stress_softening=True, beta=True
    )
    assert result.values["beta"] == pytest.approx(0.4, rel=0.02)
    assert result.values["m"] == pytest.approx(1e3, rel=0.1)


def test_weak_softening_determines_the_loss_and_not_its_parts():
    rubber = Material(name="r", law=LAW, stress_softening=Mullins(r=1.5, m=2e5))
    result = fit_history(LAW, measured(rubber, "planar", cycles(2.0, 2.0), noise=5e-3), stress_softening=True)
    assert result.bounds_hit or result.undetermined
    exact = 1 - stress_history(rubber, "planar", [0, 1, 2], [1.0, 2.0, 1.0001]).softening[-1]
    assert result.largest_softening == pytest.approx(exact, rel=0.15)


def test_rest_is_not_held_against_a_fit():
    """Points at stretch 1 without any stress, as of a slack specimen, carry time and no misfit."""
    rubber = Material(name="r", law=LAW, viscoelasticity=SERIES)
    whole = measured(rubber, "planar", [(0, 1), (2, 1.8), (4, 1), (30, 1), (32, 1.8)])
    slack = whole.stretch == 1.0
    test = MaterialTest(
        mode="planar",
        stretch=whole.stretch,
        time=whole.time,
        name="slack",
        nominal_stress=np.where(slack, 0.0, whole.nominal_stress),
    )
    result = fit_history(LAW, test, terms=2)
    assert result.quality[0].points == (~slack).sum()
    assert result.quality[0].r2 > 0.99999


@pytest.mark.parametrize(
    "law",
    [
        Ogden(mu=(2e4, 1e3), alpha=(1.5, 4.0)),
        Gent(mu=4e4, Jm=20.0),
        GeneralizedRivlin.from_names({"C10": 2e4, "C01": 1e3, "C20": -100.0}),
    ],
    ids=lambda law: type(law).__name__,
)
def test_a_scaled_law_has_a_scaled_stress(law):
    one = stress_history(Material(name="r", law=law), "uniaxial", [0.0, 0.0], [1.5, 0.7]).nominal_stress
    two = stress_history(Material(name="r", law=scaled_law(law, 2.5)), "uniaxial", [0.0, 0.0], [1.5, 0.7])
    assert two.nominal_stress == pytest.approx(2.5 * one, rel=1e-12)


@pytest.mark.parametrize(
    ("values", "options", "facts"),
    [
        ({"time": None}, {"terms": 1}, ("'a'", "time", "Time (s)")),
        ({"mode": "simple_shear"}, {"terms": 1}, ("'a'", "simple_shear", "uniaxial, equibiaxial")),
        ({}, {}, ("terms is 0", "stress_softening is False", "terms=1", "stress_softening=True")),
        ({}, {"terms": -1, "stress_softening": True}, ("terms is -1", "0 or more")),
        ({"nominal_stress": np.zeros(4)}, {"terms": 1}, ("'a'", "no stress")),
    ],
)
def test_mistakes_are_named(values, options, facts):
    given = {"mode": "uniaxial", "stretch": [1.0, 1.5, 1.5, 1.4], "nominal_stress": [0.0, 1e5, 9e4, 8e4]}
    test = MaterialTest(**given | {"time": [0.0, 1.0, 2.0, 3.0], "name": "a"} | values)
    with refused(*facts):
        fit_history(NeoHooke(C10=1e5), test, **options)


def test_a_test_that_flows_is_refused():
    time = np.linspace(0, 20, 100)
    test = MaterialTest(
        mode="uniaxial", stretch=np.full(100, 1.5), nominal_stress=1e5 * np.exp(-time / 3), time=time, name="putty"
    )
    with refused("terms is 1", "no long-term stress"):
        fit_history(NeoHooke(C10=1e5), test, terms=1)
