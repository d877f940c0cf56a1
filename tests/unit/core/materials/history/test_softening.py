"""Stress softening at a point: its derivatives against differences, and the energy that it loses."""

import numpy as np
import pytest
from scipy.integrate import quad

from refused import refused
from turgor.core.materials.history.softening import Mullins, softened_derivatives, softening, softening_dissipation
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.laws import Ogden, Yeoh

MULLINS = Mullins(r=1.7, m=8e3, beta=0.1)
LAW = Yeoh(C10=3e4, C20=2e3)


def test_eta_falls_from_one_and_its_slope_is_its_derivative():
    W, top, d = np.linspace(0, 2e4, 21), 2e4, 1.0
    eta, slope = softening(MULLINS, W, top)
    assert (np.diff(eta) > 0).all()
    assert (eta[-1], slope[-1]) == (1.0, 0.0), "on the way to a new maximum the law is that of the virgin rubber"
    inside = W[1:-1]
    difference = (softening(MULLINS, inside + d, top)[0] - softening(MULLINS, inside - d, top)[0]) / (2 * d)
    assert slope[1:-1] == pytest.approx(difference, rel=1e-6)
    assert eta[0] > 1 - 1 / MULLINS.r


def test_a_virgin_point_at_rest_is_not_softened_even_without_m():
    assert softening(Mullins(r=2.0, m=0.0, beta=0.3), 0.0, 0.0) == (1.0, 0.0)


def test_derivatives_are_those_of_the_softened_energy_in_invariants():
    """With W_m fixed the stress is that of the energy ∫ η dW; its derivatives by differences of ∫ η dW."""
    top, at, d = 3e4, np.array([3.4, 3.5]), 1e-4

    def energy(I1, I2):
        W = float(energy_and_derivatives(LAW, np.array(I1), np.array(I2))[0])
        return quad(lambda w: float(softening(MULLINS, w, top)[0]), 0, W, epsabs=1e-9, epsrel=1e-13)[0]

    W, *derivatives = energy_and_derivatives(LAW, *at[:, None])
    result = softened_derivatives(*softening(MULLINS, W, top), derivatives)[:, 0]
    one, two = np.array([d, 0]), np.array([0, d])
    first = (energy(*(at + one)) - energy(*(at - one))) / (2 * d)
    second = (energy(*(at + one)) - 2 * energy(*at) + energy(*(at - one))) / d**2
    assert result[0] == pytest.approx(first, rel=1e-6)
    assert result[2] == pytest.approx(second, rel=1e-3)
    assert result[1] == pytest.approx((energy(*(at + two)) - energy(*(at - two))) / (2 * d), abs=1e-3)


def test_derivatives_in_stretches_go_by_their_pairs():
    law, l = Ogden(mu=(2e4, 5e3), alpha=(1.7, -2.0)), np.array([1.6, 0.9, 0.8])
    d, top = 1e-6, 2e4

    def slopes(l):
        W, *derivatives = stretch_derivatives(law, *l[:, None])
        return softened_derivatives(*softening(MULLINS, W, top), derivatives, STRETCH_PAIRS)[:, 0]

    result = slopes(l)
    for n, (i, j) in enumerate(STRETCH_PAIRS):
        step = d * np.eye(3)[j]
        assert result[3 + n] == pytest.approx((slopes(l + step)[i] - slopes(l - step)[i]) / (2 * d), rel=1e-6)


def test_lost_energy_is_what_lies_between_loading_and_unloading():
    tops = np.array([1e2, 2e4, 3e5])
    for top, lost in zip(tops, softening_dissipation(MULLINS, tops), strict=True):
        below = quad(lambda w, top=top: float(softening(MULLINS, w, top)[0]), 0, top, epsrel=1e-12)[0]
        assert lost == pytest.approx(top - below, rel=1e-9)
    assert (np.diff(softening_dissipation(MULLINS, np.linspace(0, 1e5, 50))) > 0).all()


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"r": 1.0}, ("r", 1, "more than 1")),
        ({"m": -1.0}, ("m", "-1 Pa", "0 or more")),
        ({"beta": float("nan")}, ("beta", "nan", "0 or more")),
        ({"m": 0.0}, ("m and beta", 0, "more than 0")),
    ],
)
def test_mistakes_are_named(wrong, facts):
    with refused(*facts):
        Mullins(**{"r": 2.0, "m": 1e3} | wrong)
