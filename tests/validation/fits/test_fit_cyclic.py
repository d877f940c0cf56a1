"""Ecoflex 00-30, cyclic planar tests of Moseley et al. 2016: how much it relaxes and softens, and what is not known.

Four records of ten cycles at 5 %/s, two specimens (4, 5), each to about 60 % strain (A), then to 90 % (B). The law is
Mooney–Rivlin, fitted to the first loading of 4B. The record of the other specimen, 5B, is not used for the fit.
"""

import numpy as np
import pytest
from fit_data import DATA

from turgor.core.materials.experiments.cycles import select_cycle
from turgor.core.materials.experiments.read_tests import read_test
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.experiments.test_edits import rest_below, thin
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.histories.fit_history import fit_history
from turgor.core.materials.fitting.histories.history_fit import quality_of
from turgor.core.materials.material import Material
from turgor.units import N, mm

SECTION = 150 * mm**2


@pytest.fixture(scope="module")
def tests():
    results = {}
    for name in ("4A", "4B", "5A", "5B"):
        file = DATA / "epfl-ecoflex30-actuators" / "planar" / f"planar{name}.csv"
        test = read_test(file, specimen=Specimen(length=9 * mm, area=SECTION), cyclic=True)
        results[name] = rest_below(test, 0.1 * N / SECTION)
    return results


@pytest.fixture(scope="module")
def law(tests):
    return fit("mooney-rivlin", thin(select_cycle(tests["4B"], 1))).law


def test_time_and_rest_are_read(tests):
    test = tests["4B"]
    assert test.time[-1] == pytest.approx(600.7, abs=0.1)
    assert test.range == (1.0, pytest.approx(1.9115, abs=1e-4))
    assert "at rest below it, 745 of 3569 points" in test.edits[-1].text


def test_softening_and_one_term_explain_the_cycles(tests, law):
    """The law of first loading alone explains 98.6 % of the variance; with both it is 99.95 %."""
    bare = quality_of(Material(name="law", law=law), [tests["4B"]])[0]
    result = fit_history(law, tests["4B"], terms=1, stress_softening=True)
    assert bare.r2 == pytest.approx(0.986, abs=0.001)
    assert result.quality[0].r2 == pytest.approx(0.9995, abs=0.0002)
    assert result.material.viscoelasticity.g[0] == pytest.approx(0.015, abs=0.004)
    assert result.largest_softening == pytest.approx(0.079, abs=0.015)
    assert result.values["scale"] == pytest.approx(1.0, abs=0.01)


def test_it_foretells_the_other_specimen(tests, law):
    result = fit_history(law, tests["4B"], terms=1, stress_softening=True)
    assert result.predict(tests["5B"])[0].r2 == pytest.approx(0.998, abs=0.001)


def test_softening_is_more_than_relaxation_to_larger_stretch(tests, law):
    """To 90 % strain softening alone explains more than any Prony series; to 60 % either does as well."""
    softer = fit_history(law, tests["4B"], stress_softening=True).quality[0].r2
    slower = fit_history(law, tests["4B"], terms=2).quality[0].r2
    assert softer > slower + 0.001
    assert fit_history(law, tests["4A"], stress_softening=True).quality[0].r2 == pytest.approx(
        fit_history(law, tests["4A"], terms=1).quality[0].r2, abs=0.0005
    )


def test_what_these_tests_do_not_determine_is_said(tests, law):
    """One rate of loading gives one time; weak softening gives the loss, not r and m."""
    two = fit_history(law, tests["4B"], terms=2)
    assert two.undetermined or two.bounds_hit
    both = fit_history(law, tests["4B"], terms=1, stress_softening=True)
    assert any("r is limited" in text for text in both.bounds_hit)
    again = fit_history(law, [tests["4A"], tests["4B"]], terms=1, stress_softening=True)
    assert abs(np.log(again.values["r"] / both.values["r"])) > np.log(3), "r changes with the tests; the loss does not"
    assert again.largest_softening == pytest.approx(both.largest_softening, abs=0.04)
