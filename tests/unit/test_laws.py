"""Every law: no energy and no stress at rest, the stated shear modulus, derivatives that belong to the energy."""

from dataclasses import fields

import numpy as np
import pytest

from turgor.errors import TurgorError
from turgor.materials.derivatives import energy_and_derivatives
from turgor.materials.homogeneous import cauchy_stress, simple_shear
from turgor.materials.laws import Hooke, Law, MooneyRivlin, NeoHooke, Yeoh

LAWS = [
    NeoHooke(C10=0.12e6),
    MooneyRivlin(C10=1.190e3, C01=23.028e3),
    Yeoh(C10=0.11e6, C20=0.02e6),
    Yeoh(C10=12.7e3, C20=423.0, C30=-1.46),
]


@pytest.mark.parametrize("law", LAWS)
def test_undeformed_solid_stores_nothing_and_carries_nothing(law: Law) -> None:
    assert law.energy(3.0, 3.0) == 0.0
    assert np.abs(cauchy_stress(law, simple_shear(0.0))).max() == 0.0


@pytest.mark.parametrize("law", LAWS)
def test_shear_modulus_is_the_initial_slope(law: Law) -> None:
    amount = 1e-4  # the cubic term of Yeoh is of the relative order of amount²
    slope = cauchy_stress(law, simple_shear(amount))[0, 1] / amount
    assert slope == pytest.approx(law.shear_modulus, rel=1e-7)


@pytest.mark.parametrize("law", LAWS)
def test_derivatives_belong_to_the_energy(law: Law) -> None:
    I1, I2 = np.array([3.5, 6.0, 12.0]), np.array([3.4, 7.0, 30.0])
    W, W1, W2, W11, W12, W22 = energy_and_derivatives(law, I1, I2)
    h = 1e-4

    def difference(k: int, by: int) -> np.ndarray:
        ahead = energy_and_derivatives(law, I1 + h * (by == 1), I2 + h * (by == 2))[k]
        behind = energy_and_derivatives(law, I1 - h * (by == 1), I2 - h * (by == 2))[k]
        return (ahead - behind) / (2 * h)

    assert pytest.approx(law.energy(I1, I2), rel=1e-14) == W
    scale = law.shear_modulus
    for got, expected in [
        (W1, difference(0, 1)),
        (W2, difference(0, 2)),
        (W11, difference(1, 1)),
        (W12, difference(1, 2)),
        (W22, difference(2, 2)),
    ]:
        assert got == pytest.approx(expected, rel=1e-6, abs=1e-6 * scale)


@pytest.mark.parametrize("law_type", [NeoHooke, MooneyRivlin, Yeoh, Hooke])
def test_there_is_no_default_stiffness(law_type: type) -> None:
    with pytest.raises(TypeError):
        law_type()


@pytest.mark.parametrize("law_type", [NeoHooke, MooneyRivlin, Yeoh])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan")])
def test_shear_modulus_must_be_positive(law_type: type, value: float) -> None:
    names = [field.name for field in fields(law_type)]
    with pytest.raises(TurgorError, match=f"{law_type.__name__} has an initial shear modulus"):
        law_type(**dict.fromkeys(names, value))


@pytest.mark.parametrize(("E", "nu", "word"), [(0.0, 0.2, "E is"), (1e9, 0.5, "nu is"), (1e9, -1.0, "nu is")])
def test_impossible_elastic_constants_are_refused(E: float, nu: float, word: str) -> None:
    with pytest.raises(TurgorError, match=word):
        Hooke(E=E, nu=nu)
