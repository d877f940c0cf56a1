"""Stress of the laws in homogeneous deformations against independent values of six digits (verification case V02).

The values were computed twice, by differentiation of the energy and by stress formulas. A relative tolerance of 5e-6,
half a unit of the last digit, is the tightest that they allow; closed forms are tested to 1e-12.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.laws.homogeneous import (
    biaxial,
    cauchy_stress,
    equibiaxial,
    nominal_stress,
    planar,
    simple_shear,
    uniaxial,
)
from turgor.core.materials.laws.laws import (
    ArrudaBoyce,
    GeneralizedRivlin,
    Gent,
    Hooke,
    Law,
    MooneyRivlin,
    NeoHooke,
    Ogden,
    StretchLaw,
    Yeoh,
)

TABLE_DIGITS = 5e-6
STRETCHES = np.array([0.7, 1.2, 1.5, 2.0, 3.0])


@dataclass(frozen=True)
class Polynomial:
    """A law from outside the library: C10, C01, C20 terms, written by a user."""

    C10: float
    C01: float
    C20: float

    def energy(self, I1: Any, I2: Any) -> Any:
        return self.C10 * (I1 - 3) + self.C01 * (I2 - 3) + self.C20 * (I1 - 3) ** 2

    @property
    def shear_modulus(self) -> float:
        return 2 * (self.C10 + self.C01)


A = NeoHooke(C10=0.12e6)
B = Yeoh(C10=0.11e6, C20=0.02e6)
C = MooneyRivlin(C10=1.190e3, C01=23.028e3)
D = Yeoh(C10=12.7e3, C20=423.0, C30=-1.46)
E = Polynomial(C10=279.3e3, C01=10.5e3, C20=59.1e3)
F = GeneralizedRivlin.from_names({"C10": -7.48e3, "C01": 19.6e3, "C20": -198.0, "C02": -539.0, "C11": 3.21e3})
G_PRINTED = {"mu": (24361.0, 66.703, 453.81), "alpha": (1.7138, 7.0679, -3.3659)}
G_ABAQUS, G_CANONICAL = Ogden.from_abaqus(**G_PRINTED), Ogden(**G_PRINTED)
EVERY = [A, B, C, D, E, F, G_ABAQUS, G_CANONICAL, Gent(mu=8e4, Jm=60.0), ArrudaBoyce(mu=8e4, locking_stretch=3.0)]

NOMINAL = [  # law, deformation, nominal stress [MPa] at STRETCHES
    (A, uniaxial, [-0.321796, 0.121333, 0.253333, 0.420000, 0.693333]),
    (A, equibiaxial, [-1.25998, 0.191549, 0.328395, 0.472500, 0.719012]),
    (A, planar, [-0.531708, 0.149111, 0.288889, 0.450000, 0.711111]),
    (B, uniaxial, [-0.332216, 0.115536, 0.281481, 0.665000, 2.17630]),
    (B, equibiaxial, [-2.05583, 0.198717, 0.486849, 1.23047, 4.25712]),
    (B, planar, [-0.581479, 0.143368, 0.331687, 0.750000, 2.33745]),
    (C, uniaxial, [-0.0914092, 0.0206064, 0.0349220, 0.0444640, 0.0512258]),
    (C, equibiaxial, [-0.130972, 0.0548315, 0.145049, 0.367377, 1.24894]),
    (C, planar, [-0.107308, 0.0300931, 0.0583026, 0.0908175, 0.143514]),
    (D, uniaxial, [-0.0348429, 0.0129323, 0.0278498, 0.0503107, 0.104840]),
    (D, equibiaxial, [-0.152189, 0.0207606, 0.0386507, 0.0664281, 0.146279]),
    (D, planar, [-0.0582568, 0.0159222, 0.0319833, 0.0546800, 0.109597]),
    (E, uniaxial, [-0.899238, 0.303999, 0.749972, 1.82333, 6.18684]),
    (E, equibiaxial, [-5.64864, 0.538315, 1.37809, 3.62127, 12.8719]),
    (E, planar, [-1.56208, 0.379850, 0.895275, 2.08406, 6.69827]),
    (F, uniaxial, [-0.0609015, 0.00941825, 0.0162793, 0.0282686, 0.0717335]),
    (F, planar, [-0.0653355, 0.0158865, 0.0374466, 0.0871819, 0.280246]),
    (G_ABAQUS, uniaxial, [-0.0342539, 0.0123488, 0.0251093, 0.0404641, 0.0739755]),
    (G_ABAQUS, equibiaxial, [-0.121291, 0.0203997, 0.0361799, 0.0608894, 0.223290]),
    (G_CANONICAL, uniaxial, [-0.0268876, 0.0102456, 0.0213130, 0.0369949, 0.101633]),
    (G_CANONICAL, equibiaxial, [-0.111938, 0.0159916, 0.0247134, 0.0192029, -0.140824]),
]

SHEAR = [  # law, amount of shear, Cauchy stress 12, 11, 22 [MPa]
    (A, 0.5, (0.12, 0.06, 0.0)),
    (A, 2.0, (0.48, 0.96, 0.0)),
    (B, 1.0, (0.30, 0.30, 0.0)),
    (B, 2.0, (1.08, 2.16, 0.0)),
    (C, 0.5, (0.024218, 0.000595, -0.011514)),
    (C, 2.0, (0.096872, 0.00952, -0.184224)),
    (E, 1.0, (0.816, 0.795, -0.021)),
    (E, 2.0, (3.0504, 6.0168, -0.084)),
]


@pytest.mark.parametrize(("law", "deformation", "expected"), NOMINAL)
def test_nominal_stress_matches_the_table(law: Law, deformation: Any, expected: list[float]) -> None:
    pull = nominal_stress(law, deformation(STRETCHES))[:, 0, 0]
    assert pull / 1e6 == pytest.approx(expected, rel=TABLE_DIGITS)


@pytest.mark.parametrize(("law", "amount", "expected"), SHEAR)
def test_shear_stress_matches_the_table(law: Law, amount: float, expected: tuple[float, ...]) -> None:
    stress = cauchy_stress(law, simple_shear(amount)) / 1e6
    assert (stress[0, 1], stress[0, 0], stress[1, 1]) == pytest.approx(expected, rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("law", EVERY)
def test_universal_relation_of_simple_shear(law: Law) -> None:
    amount = np.linspace(-2, 2, 9)
    stress = cauchy_stress(law, simple_shear(amount))
    assert stress[:, 0, 0] - stress[:, 1, 1] == pytest.approx(amount * stress[:, 0, 1], rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("law", EVERY)
@pytest.mark.parametrize("deformation", [uniaxial, equibiaxial, planar])
def test_work_of_the_stress_is_the_energy(law: Law, deformation: Any) -> None:
    """P : dF/dλ = dW/dλ, by a central difference of the energy itself."""

    def energy(stretch: float) -> float:
        stretches = deformation(stretch).diagonal()
        if isinstance(law, StretchLaw):
            return float(law.energy_of_stretches(*stretches))
        squares = stretches**2
        return float(law.energy(squares.sum(), (1 / squares).sum()))

    for stretch in STRETCHES:
        h = 1e-5 * stretch
        slope = (energy(stretch + h) - energy(stretch - h)) / (2 * h)
        rate = (deformation(stretch + h) - deformation(stretch - h)) / (2 * h)
        work = float((nominal_stress(law, deformation(stretch)) * rate).sum())
        assert work == pytest.approx(slope, rel=1e-7)


def test_planar_tension_also_gives_the_force_that_holds_the_width() -> None:
    stretch = 1.5
    held = nominal_stress(A, planar(stretch))[1, 1]
    assert held == pytest.approx(0.24e6 * (1 - stretch**-2), rel=1e-12)  # σ₂ = μ (1 − λ⁻²), unstretched width


def test_third_direction_is_free_and_shape_follows_the_input() -> None:
    stress = cauchy_stress(E, uniaxial(STRETCHES))
    assert stress.shape == (5, 3, 3)
    assert np.abs(stress[:, 2, :]).max() == 0.0
    assert np.abs(stress[:, 1, 1]).max() <= 1e-9 * np.abs(stress).max()
    assert cauchy_stress(E, uniaxial(1.5)).shape == (3, 3)


@pytest.mark.parametrize("stretch", [0.0, -1.0, [1.0, np.nan]])
def test_impossible_stretch_is_refused(stretch: Any) -> None:
    with refused("stretch", f"{np.min(stretch):g}", "more than 0"):
        uniaxial(stretch)


def test_change_of_volume_is_refused() -> None:
    with refused("det F", 0.1):
        cauchy_stress(A, np.diag([1.1, 1.0, 1.0]))


def test_laws_in_stretches_and_in_invariants_that_are_the_same_law_agree() -> None:
    """Ogden with α = 2 is neo-Hookean, with 2 and −2 Mooney–Rivlin, in any deformation, equal stretches included."""
    rng = np.random.default_rng(5)
    F = rng.uniform(-0.5, 0.5, (50, 3, 3)) + np.eye(3)
    F[:2] = np.eye(3)
    F[1, 0, 1] = 1e-9
    F = F[np.linalg.det(F) > 0]
    F /= np.cbrt(np.linalg.det(F))[:, None, None]
    pairs = [
        (Ogden(mu=(4e4,), alpha=(2.0,)), NeoHooke(C10=2e4)),
        (Ogden(mu=(4e4, -1e4), alpha=(2.0, -2.0)), MooneyRivlin(C10=2e4, C01=5e3)),
    ]
    for stretches, invariants in pairs:
        expected = cauchy_stress(invariants, F)
        assert np.abs(cauchy_stress(stretches, F) - expected).max() < 1e-11 * np.abs(expected).max()


def test_stress_turns_with_the_solid() -> None:
    """About the free direction, so that σ₃₃ = 0 stays what it says."""
    c, s = np.cos(0.7), np.sin(0.7)
    Q = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    before = cauchy_stress(G_ABAQUS, biaxial(1.7, 1.2))
    assert cauchy_stress(G_ABAQUS, Q @ biaxial(1.7, 1.2)) == pytest.approx(Q @ before @ Q.T, rel=1e-12, abs=1e-9)


def test_law_of_no_rubber_is_refused() -> None:
    with refused("Hooke", "NeoHooke or Ogden"):
        cauchy_stress(Hooke(E=1e9, nu=0.2), uniaxial(1.1))  # type: ignore[arg-type]
