"""A step of a network that flows: its equations hold, its tangent is exact and symmetric, however far the trial is."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.materials.history.flow import flowed
from turgor.core.materials.history.resistance import Resistance

LAWS = [
    tg.laws.NeoHooke(C10=1e5),
    tg.Yeoh(C10=1e5, C20=2e4, C30=1e3),
    tg.laws.Ogden(mu=(1e5, 2e4), alpha=(1.3, 5.0)),
]
#: Power, stress over the modulus, onset and hardening: from a fluid to a solid that hardly yields.
RESISTANCES = [
    (1.0, 1.0, 0.0, 0.0),
    (4.0, 1e-2, 0.0, 0.0),
    (8.0, 1e-2, 0.0, 0.0),
    (3.0, 2.0, 3e4, 0.02),
    (10.0, 5, 0, 0),
]


def strains(count=300):
    eps = np.random.default_rng(1).normal(size=(3, count)) * 0.35
    return eps - eps.mean(axis=0)


def resistance(power, stress, onset, hardened, count=300):
    return Resistance(np.full(count, 1e5 * stress), power, onset, np.full(count, hardened))


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("numbers", RESISTANCES)
def test_the_equations_of_a_step_hold(law, numbers):
    eps, opposed = strains(), resistance(*numbers)
    end = flowed(law, 1.0, np.exp(eps), opposed)
    q = np.sqrt(1.5 * (end.stress**2).sum(axis=0))
    assert np.isfinite(q).all() and (end.amount > 0).mean() > 0.3
    assert np.abs(end.stress.sum(axis=0)).max() < 1e-9 * q.max()
    moving = end.amount > 0
    p = end.amount[moving]
    assert opposed.at(moving).bound(p) == pytest.approx(q[moving], rel=1e-6)
    assert end.strain[:, moving] == pytest.approx(1.5 * p * end.stress[:, moving] / q[moving], abs=1e-9)
    assert (q[~moving] <= opposed.at(~moving).bound(np.full((~moving).sum(), 1e-9))).all()


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("numbers", RESISTANCES)
def test_the_moduli_are_derivatives_and_symmetric(law, numbers):
    eps, opposed, d = strains(), resistance(*numbers), 1e-6
    moduli = flowed(law, 1.0, np.exp(eps), opposed).moduli
    assert moduli == pytest.approx(np.swapaxes(moduli, 0, 1), abs=1e-9 * np.abs(moduli).max())
    for j in range(3):
        along = d * (np.arange(3) == j)[:, None] - d / 3
        ends = [flowed(law, 1.0, np.exp(eps + sign * along), opposed).stress for sign in (1, -1)]
        assert (ends[0] - ends[1]) / (2 * d) == pytest.approx(moduli[:, j], abs=1e-5 * np.abs(moduli).max())


def test_the_stress_is_the_derivative_of_a_potential():
    """The elastic energy and that of the flow: what lets the softening of a set keep the tangent symmetric."""
    plastic = tg.laws.PermanentSet(stress=2e5, exponent=3.0, onset=3e4)
    eps, d, before = strains(), 1e-5, np.full(300, 0.02)

    def potential(strain):
        end = flowed(LAWS[1], 1.0, np.exp(strain), plastic.resistance(before))
        return end.energy + plastic.work(before + end.amount)

    stress = flowed(LAWS[1], 1.0, np.exp(eps), plastic.resistance(before)).stress
    for j in range(3):
        along = d * (np.arange(3) == j)[:, None] - d / 3
        slope = (potential(eps + along) - potential(eps - along)) / (2 * d)
        assert slope == pytest.approx(stress[j], abs=1e-5 * np.abs(stress).max())


def test_a_law_without_stress_is_passed_on():
    """Beyond the locking stretch of Gent's law there is no energy, and no endless iteration."""
    locked = flowed(tg.laws.Gent(mu=1e5, Jm=5.0), 1.0, np.array([[4.0], [0.5], [0.5]]), resistance(3.0, 1.0, 0, 0, 1))
    assert np.isnan(locked.stress).all()


@pytest.mark.parametrize(
    ("kind", "changes", "facts"),
    [
        (tg.laws.BergstromBoyce, {"stiffness": 0.0}, ("BergstromBoyce", "stiffness", 0, "more than 0")),
        (tg.laws.BergstromBoyce, {"rate": np.inf}, ("rate", "inf", "finite")),
        (tg.laws.BergstromBoyce, {"exponent": 0.5}, ("exponent", 0.5, "1 or more")),
        (tg.laws.BergstromBoyce, {"strain_exponent": 0.5}, ("strain_exponent", 0.5, "from -1 to 0")),
        (tg.laws.BergstromBoyce, {"offset": 0.0}, ("offset", "more than 0")),
        (tg.laws.PermanentSet, {"stress": -1.0}, ("PermanentSet", "stress", -1, "more than 0")),
        (tg.laws.PermanentSet, {"exponent": 0.9}, ("exponent", 0.9, "1 or more")),
        (tg.laws.PermanentSet, {"onset": -2.0}, ("onset", -2, "0 or more")),
    ],
)
def test_constants_out_of_range_are_refused(kind, changes, facts):
    whole = {"stiffness": 1.6, "rate": 0.1, "stress": 1e5, "exponent": 4.0}
    constants = whole if kind is tg.laws.BergstromBoyce else {"stress": 1e6, "exponent": 2.0}
    with refused(*facts):
        kind(**(constants | changes))


def test_only_isotropic_rubber_has_them():
    plastic = tg.laws.PermanentSet(stress=1e6, exponent=2.0)
    with refused("'a'", "linear elastic", "permanent_set"):
        tg.Material(name="a", law=tg.laws.Hooke(E=1e9, nu=0.3), permanent_set=plastic)
    with refused("'a'", "foam", "permanent_set"):
        tg.Material(name="a", law=tg.laws.BlatzKo(mu=1e4), permanent_set=plastic)
    series = tg.laws.Prony(g=(0.2,), tau=(1.0,), moduli="long_term")
    with refused("'a'", "Prony", "permanent_set", "BergstromBoyce"):
        tg.Material(name="a", law=LAWS[0], viscoelasticity=series, permanent_set=plastic)
    assert repr(tg.Material(name="a", law=LAWS[0], permanent_set=plastic)).endswith("sets)")
