"""What a fit says about itself: constants that the tests leave open, lost stability, and what a saved fit keeps."""

from math import inf

import numpy as np
import pytest
import sympy

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.ranking import rank
from turgor.core.materials.fitting.save import save_fits, save_material
from turgor.core.materials.fitting.uncertainty import uncertainty_of
from turgor.core.materials.laws.laws import MooneyRivlin, Yeoh
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.laws.stability import instabilities
from turgor.core.materials.library.doubts import doubts_of, find_doubts
from turgor.core.materials.library.record_files import read_records
from turgor.core.materials.library.records import from_library
from turgor.foundation.finding import Severity

RUBBER = MooneyRivlin(C10=10e3, C01=4.53e3)


def made(mode, law=RUBBER, noise=0.01, upto=2.0):
    stretch = np.linspace(1.05, upto, 40)
    blank = MaterialTest(mode=mode, stretch=stretch - (mode == "simple_shear"), nominal_stress=stretch, name=mode)
    scatter = 1 + noise * np.random.default_rng(0).normal(size=40)
    return MaterialTest(mode=mode, stretch=blank.stretch, nominal_stress=blank.predicted(law) * scatter, name=mode)


def codes(found):
    return [finding.code for finding in found.findings]


@pytest.mark.parametrize("modes", [["planar"], ["simple_shear"], ["planar", "simple_shear"]])
def test_planar_tests_determine_only_the_sum_of_the_mooney_rivlin_constants(modes):
    """The fit once reported C10 = C01 = 7.27 ± 0.05 kPa, with a correlation of 1 and no finding."""
    result = fit("mooney-rivlin", [made(mode) for mode in modes])
    assert result.errors == {"C10": inf, "C01": inf}
    assert result.unconstrained == ("C10", "C01")
    assert abs(result.correlation[0, 1]) == pytest.approx(1.0)
    assert result.describe().count("not determined") == 2
    assert result.values["C10"] + result.values["C01"] == pytest.approx(14.53e3, rel=0.01)
    (finding,) = (each for each in result.findings if each.code == "M02")
    assert finding.severity is Severity.WARNING
    assert "tests alone do not determine coefficients of the second invariant" in finding.message
    assert "do not determine C10 and C01 separately; they determine only C10 + C01 = 14.5" in finding.message
    assert "Yeoh's law is 12 to 48 % off in equibiaxial tension" in finding.advice


def test_the_error_of_the_sum_is_that_of_a_law_with_one_constant():
    """In planar tests C10 + C01 plays the part of the neo-Hookean C10."""
    test = made("planar")
    alone = fit("neo-hooke", test)
    combination = fit("mooney-rivlin", test).combination
    assert combination == f"C10 + C01 = {alone.values['C10'] / 1e3:.5g} ± {alone.errors['C10'] / 1e3:.2g} kPa"


def test_two_modes_determine_both_constants():
    result = fit("mooney-rivlin", [made("planar"), made("equibiaxial")])
    assert result.unconstrained == ()
    assert result.combination == ""
    assert codes(result) == []
    assert result.values == pytest.approx({"C10": 10e3, "C01": 4.53e3}, rel=0.02)
    assert all(0 < error < 200 for error in result.errors.values())


@pytest.mark.parametrize("law", ["ogden-2", "mooney-rivlin", "rivlin-2"])
@pytest.mark.parametrize("mode", ["uniaxial", "equibiaxial", "planar", "simple_shear"])
def test_one_mode_alone_leaves_the_others_open(law, mode):
    assert "M02" in codes(fit(law, made(mode), starts=2))


@pytest.mark.parametrize("mode", ["uniaxial", "planar"])
def test_a_law_of_the_first_invariant_is_determined_by_one_mode(mode):
    assert codes(fit("yeoh-2", made(mode, Yeoh(C10=1e4, C20=1e3)))) == []


def test_the_ranking_says_what_is_open_and_gives_the_advice_once():
    words = rank(["mooney-rivlin", "ogden-2", "yeoh"], made("planar"), starts=2).words
    open_ones = [text for text in words if "(M02)" in text]
    assert [text.split(":")[0] for text in open_ones] == sorted(text.split(":")[0] for text in open_ones)
    assert {text.split(":")[0] for text in open_ones} == {"mooney-rivlin", "ogden-2"}
    assert sum("Add tests of another mode" in text for text in words) == 1


def test_directions_that_are_open_and_fixed():
    random = np.random.default_rng(1)
    column = random.normal(size=(20, 1))
    jacobian = np.hstack([column, 2 * column, random.normal(size=(20, 1))])
    residual = 0.1 * random.normal(size=20)
    free = uncertainty_of(jacobian, residual, np.empty((0, 3)))
    assert list(np.isinf(free.errors)) == [True, True, False]
    assert free.combination(["a", "b", "c"], [1e3, 2e3, 0.0], 3).startswith("a + 2 b = 5 ± ")
    assert free.combination(["a", "b", "c"], [1e3, 2e3, 0.0], 1) == "", "a modulus and a number have no sum"
    held = uncertainty_of(jacobian, residual, np.array([[1.0, 0.0, 0.0]]))
    assert held.errors[0] == pytest.approx(0, abs=1e-12)
    assert np.isfinite(held.errors).all()


def soft(stretch):
    return MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=1e5 * np.tanh(stretch - 1), name="soft")


def test_a_fit_is_checked_for_stability_as_library_records_are():
    result = fit("yeoh", soft(np.linspace(1.05, 2.0, 40)))
    assert result.bounds_hit
    (finding,) = (each for each in result.findings if each.code == "M06")
    assert finding.severity is Severity.WARNING
    assert "uniaxial tension at stretch 2.09" in finding.message
    assert "M06" not in codes(fit("yeoh", soft(np.linspace(1.05, 2.0, 40)), stretch=(1.0, 4.0)))


def test_the_strictest_criterion_is_named_with_the_others():
    """The nominal stress of this law falls before Drucker's postulate fails."""
    law = MooneyRivlin(C10=35.68e3, C01=-9.17e3)
    lost = instabilities(law, "equibiaxial", lower=1.0)
    assert list(lost) == ["nominal", "drucker", "cauchy"]
    assert lost == pytest.approx({"nominal": 1.3893, "drucker": 1.4851, "cauchy": 1.4851}, abs=1e-4)
    assert list(instabilities(law, "planar", lower=1.0)) == ["drucker"]
    test = made("equibiaxial", law, noise=0.0, upto=1.6)
    result = fit("mooney-rivlin", test, stable=False)
    assert result.instability["equibiaxial"] == pytest.approx(1.3893, abs=1e-3)


def test_the_ranking_names_the_criterion_that_fails_first():
    words = " ".join(rank(["mooney-rivlin"], soft(np.linspace(1.05, 2.0, 40))).words)
    assert "in equibiaxial tests at stretch 1.42, where the nominal stress has an extreme; Drucker's" in words
    assert "in planar tests at stretch 1.946, where Drucker's postulate fails." in words


@pytest.mark.parametrize("law", ["mooney-rivlin", "yeoh"])
def test_a_saved_fit_shows_the_same_findings_once(tmp_path, law):
    """M02 once came back as 'M04 stated: M02: ...'; M06 is found anew and not saved."""
    result = fit(law, soft(np.linspace(1.05, 2.0, 40)))
    of_fit = [(each.code, each.message) for each in result.findings if each.code in ("M02", "M06")]
    save_fits(tmp_path / "fit.toml", "soft", [result])
    save_material(tmp_path / "material.toml", result.named("soft"))
    for name in ("fit", "material"):
        (record,) = read_records(str(tmp_path / f"{name}.toml"))
        assert sorted((doubt.code, doubt.message) for doubt in find_doubts(record)) == sorted(of_fit)
        again = doubts_of(from_library(str(tmp_path / f"{name}.toml")))
        assert sorted((each.code, each.message) for each in again) == sorted((c, f"soft: {m}") for c, m in of_fit)
        assert all(each.severity is Severity.WARNING for each in again)


def test_the_pull_of_a_law_that_takes_only_numbers():
    class Exponential:
        def energy(self, I1, I2):
            return 1e4 * (sympy.exp(I1 - 3) - 1)

    stretch = np.array([1.0, 1.2])
    x = stretch**2 + 2 / stretch - 3
    assert pull(Exponential(), "uniaxial", stretch) == pytest.approx(
        2e4 * np.exp(x) * (stretch - stretch**-2), abs=1e-3
    )
