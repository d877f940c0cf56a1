"""Meunier's silicone in tension: what a fit without the equibiaxial test predicts for it (review section 4.1).

The distances are recorded, not gated by a physical limit: they fail on drift, and on losing their order.
"""

import pytest
from fit_data import meunier

from turgor.core.materials.fitting.fit_laws import fit

#: Root mean square relative error of the predicted equibiaxial test: fitted to uniaxial alone, and with pure shear.
RECORDED = {"yeoh": (0.251, 0.307), "mooney-rivlin": (0.333, 0.207), "ogden-3": (15.2, 0.180)}


@pytest.fixture(scope="module")
def tests():
    return {mode: meunier(mode) for mode in ("uniaxial", "pure_shear", "equibiaxial")}


@pytest.mark.parametrize("law", RECORDED)
def test_prediction_of_the_equibiaxial_test(law, tests):
    alone = fit(law, tests["uniaxial"], stretch=(1.0, 2.2))
    both = fit(law, [tests["uniaxial"], tests["pure_shear"]], stretch=(1.0, 2.2))
    got = [each.predict([tests["equibiaxial"]])[0].relative for each in (alone, both)]
    # the runaway of Ogden's law hangs on the last digits of the fit: only its size is kept
    assert got[0] == pytest.approx(RECORDED[law][0], rel=0.5 if law == "ogden-3" else 0.03)
    assert got[1] == pytest.approx(RECORDED[law][1], rel=0.03)


def test_uniaxial_alone_does_not_determine_ogden(tests):
    """It fits the uniaxial test to 5 %, is stable, and is wrong by more than a factor of ten elsewhere."""
    alone = fit("ogden-3", tests["uniaxial"], stretch=(1.0, 2.2))
    assert alone.relative < 0.05
    assert alone.instability == {}
    assert "M02" in {finding.code for finding in alone.findings}
    assert alone.predict([tests["equibiaxial"]])[0].relative > 5


def test_yeoh_from_uniaxial_alone_predicts_pure_shear(tests):
    """Review section 4.1: Yeoh's law predicts other modes from uniaxial data; here pure shear to R² = 0.97.

    Equibiaxial tension it misses by 25 % (`RECORDED`), so that M02 does not advise it.
    """
    alone = fit("yeoh", tests["uniaxial"], stretch=(1.0, 2.2))
    assert not {"M02"} & {finding.code for finding in alone.findings}
    assert alone.predict([tests["pure_shear"]])[0].r2 == pytest.approx(0.974, abs=0.005)


def test_all_three_together_fit_well(tests):
    result = fit("ogden-3", list(tests.values()), stretch=(1.0, 2.2))
    assert {test.mode: round(test.r2, 2) for test in result.quality} == {
        "uniaxial": 1.00,
        "planar": 0.99,
        "equibiaxial": 1.00,
    }
