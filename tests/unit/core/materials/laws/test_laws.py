"""Every law: no energy and no stress at rest, the stated shear modulus, derivatives that belong to the energy."""

from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pytest
from scipy.optimize import brentq

from refused import refused
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.homogeneous import cauchy_stress, simple_shear, uniaxial
from turgor.core.materials.laws.laws import (
    ArrudaBoyce,
    ExtendedTube,
    GeneralizedRivlin,
    Gent,
    Hooke,
    InvariantLaw,
    Law,
    MooneyRivlin,
    NeoHooke,
    Ogden,
    StretchLaw,
    Yeoh,
    YeohN,
)

LAWS = [
    NeoHooke(C10=0.12e6),
    MooneyRivlin(C10=1.190e3, C01=23.028e3),
    Yeoh(C10=0.11e6, C20=0.02e6),
    Yeoh(C10=12.7e3, C20=423.0, C30=-1.46),
    GeneralizedRivlin.from_names({"C10": -7.48e3, "C01": 1.96e4, "C20": -198.0, "C02": -539.0, "C11": 3.21e3}),
    GeneralizedRivlin.from_names({"C01": 2e4, "C30": 3.0, "C12": 5.0}),
    YeohN(coefficients=(12.7e3, 423.0, -1.46, 0.02, 1e-3)),
    Gent(mu=80e3, Jm=90.0),
    ArrudaBoyce(mu=80e3, locking_stretch=4.0),
]
OGDENS = [
    Ogden(mu=(24361.0, 66.703, 453.81), alpha=(1.7138, 7.0679, -3.3659)),
    Ogden.from_abaqus(mu=(24361.0, 66.703, 453.81), alpha=(1.7138, 7.0679, -3.3659)),
    Ogden(mu=(5e4,), alpha=(3.3,)),
    ExtendedTube(Gc=4e4, Ge=6e4, delta=0.1, beta=0.4),
]


def _energy_at_rest(law: Law) -> float:
    return float(law.energy(3.0, 3.0) if isinstance(law, InvariantLaw) else law.energy_of_stretches(1.0, 1.0, 1.0))


@pytest.mark.parametrize("law", LAWS + OGDENS)
def test_undeformed_solid_stores_nothing_and_carries_nothing(law: Law) -> None:
    assert _energy_at_rest(law) == pytest.approx(0.0, abs=1e-16 * law.shear_modulus)
    assert np.abs(cauchy_stress(law, simple_shear(0.0))).max() == 0.0


@pytest.mark.parametrize("law", LAWS + OGDENS)
def test_shear_modulus_is_the_initial_slope(law: Law) -> None:
    amount = 1e-4  # the cubic term of Yeoh is of the relative order of amount²
    slope = cauchy_stress(law, simple_shear(amount))[0, 1] / amount
    assert slope == pytest.approx(law.shear_modulus, rel=1e-7)


@pytest.mark.parametrize("law", LAWS)
def test_derivatives_belong_to_the_energy(law: InvariantLaw) -> None:
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


@pytest.mark.parametrize("law", LAWS + OGDENS)
def test_derivatives_by_stretches_belong_to_the_energy(law: Law) -> None:
    at = np.array([[1.0, 1.9, 0.7], [1.0, 0.8, 0.7], [1.0, 0.6, 2.1]])
    W = stretch_derivatives(law, *at)
    h = 1e-5

    def difference(k: int, by: int) -> np.ndarray:
        step = h * (np.arange(3) == by)[:, None]
        return (stretch_derivatives(law, *(at + step))[k] - stretch_derivatives(law, *(at - step))[k]) / (2 * h)

    squares = at**2
    if isinstance(law, StretchLaw):
        energy = law.energy_of_stretches(*at)
    else:
        energy = law.energy(squares.sum(axis=0), (squares * np.roll(squares, 1, axis=0)).sum(axis=0))
    size = 10 * law.shear_modulus
    assert W[0] == pytest.approx(energy, rel=1e-12, abs=1e-13 * size)
    for i in range(3):
        assert W[1 + i] == pytest.approx(difference(0, i), rel=1e-6, abs=1e-7 * size)
    for value, (i, j) in zip(W[4:], STRETCH_PAIRS, strict=True):
        assert value == pytest.approx(difference(1 + i, j), rel=1e-6, abs=1e-7 * size)


@pytest.mark.parametrize("law", LAWS + OGDENS)
def test_laws_are_values(law: Law) -> None:
    twin = type(law)(**{field.name: getattr(law, field.name) for field in fields(law)})  # type: ignore[arg-type]
    assert twin == law
    assert hash(twin) == hash(law)


def test_laws_of_the_same_form_share_their_derivatives_and_others_do_not() -> None:
    one = np.array([4.0])
    two, three = YeohN(coefficients=(1.0, 2.0)), YeohN(coefficients=(1.0, 2.0, 3.0))
    assert energy_and_derivatives(two, one, one)[0] == pytest.approx([3.0])
    assert energy_and_derivatives(three, one, one)[0] == pytest.approx([6.0])
    first, second = (
        GeneralizedRivlin.from_names({"C10": 1.0, "C20": 5.0}),
        GeneralizedRivlin.from_names({"C10": 1.0, "C02": 5.0}),
    )
    assert energy_and_derivatives(first, one, 2 + one)[0] == pytest.approx([6.0])
    assert energy_and_derivatives(second, one, 2 + one)[0] == pytest.approx([46.0])


def test_rivlin_law_may_be_given_by_names_mapping_or_terms() -> None:
    by_name = GeneralizedRivlin.from_names({"C01": 2.0, "C10": 1.0, "C20": 0.5})
    assert by_name == GeneralizedRivlin.from_names({"C20": 0.5, "C10": 1, "C01": 2})
    assert by_name == GeneralizedRivlin(coefficients=((2, 0, 0.5), (1, 0, 1.0), (0, 1, 2.0)))
    assert by_name.coefficients == ((1, 0, 1.0), (0, 1, 2.0), (2, 0, 0.5))


def test_ogden_converts_between_its_conventions_and_back() -> None:
    mu, alpha = (24361.0, 66.703, 453.81), (1.7138, 7.0679, -3.3659)
    law = Ogden.from_abaqus(mu=mu, alpha=alpha)
    back, exponents = law.to_abaqus()
    assert back == pytest.approx(mu, rel=1e-15)
    assert exponents == alpha
    assert law.shear_modulus == pytest.approx(sum(mu), rel=1e-15)
    printed = sum(2 * m / a**2 * (1.3**a + 1.1**a + 0.7**a - 3) for m, a in zip(mu, alpha, strict=True))
    assert law.energy_of_stretches(1.3, 1.1, 0.7) == pytest.approx(printed, rel=1e-14)


def test_gent_and_arruda_boyce_tend_to_neo_hooke() -> None:
    F = uniaxial([0.6, 1.5, 3.0])
    expected = cauchy_stress(NeoHooke(C10=5.0), F)
    for law in (Gent(mu=10.0, Jm=1e9), ArrudaBoyce(mu=10.0, locking_stretch=1e5)):
        assert cauchy_stress(law, F) == pytest.approx(expected, rel=1e-7, abs=1e-9)


def test_arruda_boyce_is_the_series_of_the_inverse_langevin_function() -> None:
    """∂W/∂I₁ = μ λm/(6 λc) L⁻¹(λc/λm) with λc² = I₁/3; the series leaves out 2/3 (λc/λm)¹⁰ of it, here 7e-8."""
    law = ArrudaBoyce(mu=10.0, locking_stretch=7.5)
    chain = 1.5
    inverse = brentq(lambda x: 1 / np.tanh(x) - 1 / x - chain / 7.5, 0.1, 5.0, xtol=1e-14)
    slope = energy_and_derivatives(law, np.array([3 * chain**2]), np.array([5.0]))[1]
    assert slope == pytest.approx([10.0 * 7.5 / (6 * chain) * inverse], rel=2e-7)


def test_gent_has_no_stress_beyond_its_locking_stretch() -> None:
    pull = cauchy_stress(Gent(mu=80e3, Jm=9.0), uniaxial([3.0, 4.0]))[:, 0, 0]
    assert np.isfinite(pull[0])
    assert np.isnan(pull[1])


@pytest.mark.parametrize(
    ("make", "facts"),
    [
        (lambda: Ogden(mu=(1.0, 2.0), alpha=(1.0,)), ("Ogden", "2 coefficients mu", "1 exponents alpha")),
        (lambda: Ogden.from_abaqus(mu=(1.0,), alpha=()), ("Ogden", "1 coefficients mu", "0 exponents alpha")),
        (lambda: Ogden(mu=(), alpha=()), ("Ogden", "mu", "empty", "least one")),
        (lambda: Ogden(mu=(1.0,), alpha=(0.0,)), ("Ogden", "alpha 1 is 0")),
        (lambda: Ogden.from_abaqus(mu=(1.0,), alpha=(0.0,)), ("Ogden", "alpha 1 is 0")),
        (lambda: Ogden(mu=(1.0,), alpha=(-2.0,)), ("Ogden", "-1 Pa", "positive")),
        (lambda: Ogden(mu=1.0, alpha=2.0), ("Ogden", "mu is 1.0", "sequence")),  # type: ignore[arg-type]
        (lambda: Ogden(mu=(float("inf"),), alpha=(2.0,)), ("Ogden", "mu 1 is inf", "finite")),
        (lambda: YeohN(coefficients=()), ("YeohN", "coefficients", "empty", "least one")),
        (lambda: YeohN(coefficients=(1.0, float("nan"))), ("YeohN", "C20 is nan", "finite")),
        (lambda: YeohN(coefficients=(-1.0, 2.0)), ("YeohN", "-2 Pa", "positive")),
        (lambda: GeneralizedRivlin(coefficients=()), ("GeneralizedRivlin", "coefficients", "empty", "C10 or C01")),
        (lambda: GeneralizedRivlin.from_names({"C1": 1.0}), ("GeneralizedRivlin", "'C1'", "C10")),
        (lambda: GeneralizedRivlin.from_names({"C00": 1.0}), ("GeneralizedRivlin", "exponents 0, 0", "at least 0")),
        (lambda: GeneralizedRivlin(coefficients=((1, 0),)), ("GeneralizedRivlin", "(1, 0)", "(i, j, Cij)")),  # type: ignore[arg-type]
        (lambda: GeneralizedRivlin(coefficients=((1, 0, 1.0), (1, 0, 2.0))), ("GeneralizedRivlin", "C10 twice")),
        (lambda: GeneralizedRivlin.from_names({"C20": 1.0}), ("GeneralizedRivlin", "0 Pa", "positive")),
        (lambda: Gent(mu=1.0, Jm=0.0), ("Gent", "Jm is 0", "positive")),
        (lambda: Gent(mu=-1.0, Jm=1.0), ("Gent", "-1 Pa", "positive")),
        (lambda: ArrudaBoyce(mu=1.0, locking_stretch=1.0), ("ArrudaBoyce", "locking_stretch is 1", "more than 1")),
        (lambda: ExtendedTube(Gc=-1.0, Ge=2.0, delta=0.1, beta=0.2), ("ExtendedTube", "Gc is -1 Pa", "negative")),
        (lambda: ExtendedTube(Gc=1.0, Ge=2.0, delta=0.8, beta=0.2), ("ExtendedTube", "delta is 0.8", "0.707")),
        (lambda: ExtendedTube(Gc=1.0, Ge=2.0, delta=0.1, beta=0.0), ("ExtendedTube", "beta is 0", "up to 1")),
        (lambda: ArrudaBoyce(mu=0.0, locking_stretch=2.0), ("ArrudaBoyce", "0 Pa", "positive")),
        (lambda: Yeoh(C10=1.0, C20=float("nan")), ("Yeoh", "C20 is nan", "finite")),
    ],
)
def test_impossible_coefficients_are_refused(make: Callable[[], Law], facts: tuple) -> None:
    with refused(*facts):
        make()


@pytest.mark.parametrize(
    "law_type", [NeoHooke, MooneyRivlin, Yeoh, Hooke, GeneralizedRivlin, YeohN, Ogden, Gent, ArrudaBoyce]
)
def test_there_is_no_default_stiffness(law_type: type) -> None:
    with pytest.raises(TypeError):
        law_type()


@pytest.mark.parametrize("law_type", [NeoHooke, MooneyRivlin, Yeoh])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan")])
def test_shear_modulus_must_be_positive(law_type: type, value: float) -> None:
    names = [field.name for field in fields(law_type)]
    with refused(law_type.__name__, "positive"):
        law_type(**dict.fromkeys(names, value))


@pytest.mark.parametrize(
    ("E", "nu", "facts"),
    [
        (0.0, 0.2, ("E", "0 Pa", "positive")),
        (1e9, 0.5, ("nu is 0.5", "between -1 and 0.5")),
        (1e9, -1.0, ("nu is -1", "between -1 and 0.5")),
    ],
)
def test_impossible_elastic_constants_are_refused(E: float, nu: float, facts: tuple) -> None:
    with refused(*facts):
        Hooke(E=E, nu=nu)


def test_extended_tube_pulls_as_its_authors_write() -> None:
    """Kaliske and Heinrich (1999), doi 10.5254/1.3538822, uniaxial tension."""
    law, stretch = ExtendedTube(Gc=4e4, Ge=6e4, delta=0.1, beta=0.4), np.array([0.6, 1.5, 4.0])
    D, d2 = stretch**2 + 2 / stretch - 3, law.delta**2
    tube = 2 * law.Ge / law.beta * (stretch ** (law.beta / 2 - 1) - stretch ** (-law.beta - 1))
    net = law.Gc * (stretch - stretch**-2) * ((1 - d2) / (1 - d2 * D) ** 2 - d2 / (1 - d2 * D))
    pull = cauchy_stress(law, uniaxial(stretch))[:, 0, 0] / stretch
    assert pull == pytest.approx(net + tube, rel=1e-10)
