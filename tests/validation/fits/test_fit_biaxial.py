"""General biaxial tests: Kawabata's field of 117 points with both stresses, Jones and Treloar's stress differences.

A law of I₁ alone cannot follow a biaxial field; Ogden's can (Kawabata et al. 1981, Macromolecules 14, 154, found that
∂W/∂I₂ is small and changes with the stretch). The errors are recorded; the order is the claim.
"""

import numpy as np
import pytest
from fit_data import DATA

from turgor.core.materials.experiments.read_tests import read_test
from turgor.core.materials.fitting.fit_laws import fit


def test_kawabata_field_needs_more_than_the_first_invariant():
    field = read_test(DATA / "kawabata-1981-rubber" / "biaxial.csv")
    assert len(field.measured) == 2 * 117
    errors = {law: fit(law, field).relative for law in ("ogden-3", "mooney-rivlin", "yeoh")}
    assert errors == pytest.approx({"ogden-3": 0.019, "mooney-rivlin": 0.11, "yeoh": 0.13}, rel=0.05)


def test_kawabata_special_paths_follow_from_the_field():
    folder = DATA / "kawabata-1981-rubber"
    law = fit("ogden-3", read_test(folder / "biaxial.csv"))
    paths = law.predict([read_test(folder / f"{mode}.csv") for mode in ("uniaxial", "equibiaxial", "pure_shear")])
    assert min(path.r2 for path in paths) > 0.995  # the two compilations differ by up to 1.6 %


def test_jones_and_treloar_differences_and_nominal_stresses_go_together():
    """One column is a Cauchy difference, the other nominal: one law follows both only if each is read as what it is."""
    folder = DATA / "jones-treloar-1975-rubber"
    tests = [read_test(folder / f"{name}.csv") for name in ("biaxial_fixed_lambda2", "uniaxial")]
    result = fit("ogden-3", tests, weights="absolute")
    assert min(test.r2 for test in result.quality) > 0.995
    # the difference vanishes where both stretches are equal
    assert np.interp(1.0, *_series(tests[0], 1.0)) == pytest.approx(0.0, abs=0.02e6)


def _series(test, second):
    of_series = test.stretch_2 == second
    order = np.argsort(test.stretch[of_series])
    return test.stretch[of_series][order], test.nominal_stress[of_series][order]
