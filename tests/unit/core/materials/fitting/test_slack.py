"""What is reported of tests whose specimen hung loose, and of points beyond the range of actuators."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test, read_tests
from turgor.core.materials.experiments.slack import check_slack, zero_stretch
from turgor.core.materials.fitting.checks import check_working_range
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.ranking import rank
from turgor.core.materials.laws.laws import MooneyRivlin, NeoHooke, Yeoh


def pull(law, zero=1.0, *, mode="uniaxial", upto=2.0, count=40):
    stretch = np.linspace(1.0 + 0.5 * (zero - 1), upto, count)
    taut = np.maximum(stretch / zero, 1.0)
    blank = MaterialTest(mode=mode, stretch=taut, nominal_stress=taut, name="pull")
    return MaterialTest(mode=mode, stretch=stretch, nominal_stress=blank.predicted(law), name="pull")


@pytest.mark.parametrize("law", [NeoHooke(C10=8e3), Yeoh(C10=8e3, C20=200.0), MooneyRivlin(C10=6e3, C01=3e3)], ids=str)
@pytest.mark.parametrize("mode", ["uniaxial", "planar", "equibiaxial"])
def test_the_stretch_without_stress_is_recovered(law, mode):
    assert zero_stretch(pull(law, mode=mode)) == pytest.approx(1.0, abs=0.007)
    assert zero_stretch(pull(law, 1.05, mode=mode)) == pytest.approx(1.05, abs=0.012)
    assert not check_slack([pull(law, mode=mode)])


def test_slack_makes_a_fit_too_soft_and_is_reported():
    fits = [fit("neo-hooke", pull(NeoHooke(C10=8e3), zero, upto=1.3)) for zero in (1.0, 1.05)]
    assert fits[1].values["C10"] < 0.8 * fits[0].values["C10"]
    assert [[each.code for each in one.findings if each.code == "P10"] for one in fits] == [[], ["P10"]]
    (finding,) = check_slack([pull(NeoHooke(C10=8e3), 1.05)])
    assert "pull" in finding.message and "1.05" in finding.message


def test_points_beyond_the_range_of_actuators_are_counted():
    (finding,) = check_working_range([pull(Yeoh(C10=8e3, C20=20.0), upto=17.0, count=60)])
    assert finding.code == "P11"
    assert "6 of 60" in finding.message and "17" in finding.message
    assert not check_working_range([pull(NeoHooke(C10=8e3), upto=2.4)])
    assert not check_working_range([pull(NeoHooke(C10=8e3), upto=4.0)])


def test_a_law_that_loses_its_stability_comes_last():
    """A polynomial of the second order follows the bend of a short test, and falls beyond it."""
    x = np.linspace(1.02, 1.4, 20)
    bent = MaterialTest(mode="uniaxial", stretch=x, nominal_stress=1e5 * (x - x**-2) * (1.6 - 0.5 * x), name="bent")
    ranking = rank(["neo-hooke", "rivlin-2", "yeoh"], bent)
    unstable = ["M06" in [finding.code for finding in each.findings] for each in ranking.fits]
    assert unstable == sorted(unstable) and unstable[-1] and not unstable[0]
    assert ranking.fits[-1].aic < ranking.best.aic
    assert any(ranking.fits[-1].spec.name in words and "comes later" in words for words in ranking.words)


def test_specimens_of_one_table_are_read_without_the_way_back(tmp_path):
    """Each pull of a testing machine ends with its way back, which is no cycle."""
    rows = ["specimen,stretch,nominal stress (kPa)"]
    for specimen in (1, 2):
        for stretch in (1.0, 1.2, 1.6, 2.0, 2.4, 1.9, 1.3, 1.0):
            rows.append(f"{specimen},{stretch},{100 * specimen * (stretch - 1)}")
    file = tmp_path / "uniaxial.csv"
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")
    tests = read_tests(file)
    assert [test.stretch.tolist() for test in tests] == 2 * [[1.0, 1.2, 1.6, 2.0, 2.4]]
    assert "3 points of 8" in tests[0].edits[-1].text
    cycles = tmp_path / "uniaxial_cycles.csv"
    cycles.write_text("stretch,nominal stress (kPa)\n" + "\n".join(f"{x},{x}" for x in (1, 2, 1, 2, 1)), "utf-8")
    with refused("uniaxial_cycles.csv", "cyclic=True"):
        read_test(cycles)
