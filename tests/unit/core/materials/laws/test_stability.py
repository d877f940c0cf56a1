"""Initial moduli and loss of stability of eight laws against independent values (V03), and what the criteria mean."""

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from refused import refused
from turgor.core.materials.laws.homogeneous import biaxial, cauchy_stress, equibiaxial, nominal_stress, planar, uniaxial
from turgor.core.materials.laws.laws import GeneralizedRivlin, Gent, Law, MooneyRivlin, NeoHooke, Ogden, Yeoh
from turgor.core.materials.laws.stability import MODES, _pull, first_instability

A = NeoHooke(C10=0.12e6)
B = Yeoh(C10=0.11e6, C20=0.02e6)
C = MooneyRivlin(C10=1.190e3, C01=23.028e3)
D = Yeoh(C10=12.7e3, C20=423.0, C30=-1.46)
E = GeneralizedRivlin.from_names({"C10": 279.3e3, "C01": 10.5e3, "C20": 59.1e3})
F = GeneralizedRivlin.from_names({"C10": -7.48e3, "C01": 19.6e3, "C20": -198.0, "C02": -539.0, "C11": 3.21e3})
PRINTED = {"mu": (24361.0, 66.703, 453.81), "alpha": (1.7138, 7.0679, -3.3659)}
G_ABAQUS, G_CANONICAL = Ogden.from_abaqus(**PRINTED), Ogden(**PRINTED)
MODULI = [
    (A, 240),
    (B, 220),
    (C, 48.436),
    (D, 25.4),
    (E, 579.6),
    (F, 24.24),
    (G_ABAQUS, 24.8815),
    (G_CANONICAL, 20.3469),
]


def nominal_slope(law: Law, mode: str, stretch: ArrayLike) -> NDArray[np.float64]:
    """Slope dP/dλ of the nominal stress [Pa], which the search for its maximum follows."""
    return _pull(law, mode, np.asarray(stretch, dtype=np.float64))[1]  # type: ignore[arg-type]


DEFORMATIONS = {"uniaxial": uniaxial, "equibiaxial": equibiaxial, "planar": planar}


@pytest.mark.parametrize(("law", "kilopascal"), MODULI)
def test_initial_moduli(law: Law, kilopascal: float) -> None:
    assert law.shear_modulus == pytest.approx(1e3 * kilopascal, rel=2e-6)  # half a unit of the last digit
    assert nominal_slope(law, "uniaxial", 1.0) == pytest.approx(3 * law.shear_modulus, rel=1e-12)
    assert nominal_slope(law, "planar", 1.0) == pytest.approx(4 * law.shear_modulus, rel=1e-12)
    assert nominal_slope(law, "equibiaxial", 1.0) == pytest.approx(6 * law.shear_modulus, rel=1e-12)


@pytest.mark.parametrize("law", [A, B, C, D, E, G_ABAQUS])
@pytest.mark.parametrize("mode", MODES)
def test_stable_rows(law: Law, mode: str) -> None:
    assert first_instability(law, mode, upper=6.0, lower=1.0) is None  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("law", "criterion", "expected"),
    [(F, "nominal", 2.653), (F, "cauchy", 2.7214), (G_CANONICAL, "nominal", 1.643)],
)
def test_peaks_of_equibiaxial_tension(law: Law, criterion: str, expected: float) -> None:
    """Each lies at the maximum of the curve, too. The reference of the second, 2.722, errs in its last digit."""
    result = first_instability(law, "equibiaxial", lower=1.0, criterion=criterion)  # type: ignore[arg-type]
    assert result == pytest.approx(expected, abs=5e-4)
    stretch = np.linspace(expected - 0.01, expected + 0.01, 2001)
    stress = {"nominal": nominal_stress, "cauchy": cauchy_stress}[criterion](law, equibiaxial(stretch))[:, 0, 0]
    assert result == pytest.approx(stretch[stress.argmax()], abs=2e-5)


@pytest.mark.parametrize("law", [B, D, F, G_CANONICAL])
@pytest.mark.parametrize("mode", MODES)
def test_slope_belongs_to_the_stress(law: Law, mode: str) -> None:
    stretch, h = np.array([0.5, 0.9, 1.0, 1.4, 3.0]), 1e-5
    ahead, behind = (nominal_stress(law, DEFORMATIONS[mode](stretch + d))[:, 0, 0] for d in (h, -h))
    expected = (ahead - behind) / (2 * h)
    assert nominal_slope(law, mode, stretch) == pytest.approx(expected, rel=1e-6, abs=1e-5)  # type: ignore[arg-type]


@pytest.mark.parametrize("law", [D, F, G_CANONICAL])
@pytest.mark.parametrize("mode", MODES)
def test_drucker_is_stricter_than_the_cauchy_stress(law: Law, mode: str) -> None:
    """It fails no later than the Cauchy stress falls, on both sides; the nominal stress may fall before."""
    for side in ({"lower": 1.0}, {"upper": 1.0}):
        fall = first_instability(law, mode, criterion="cauchy", **side)  # type: ignore[arg-type]
        drucker = first_instability(law, mode, criterion="drucker", **side)  # type: ignore[arg-type]
        if fall is not None:
            assert drucker is not None
            assert abs(np.log(drucker)) <= abs(np.log(fall)) + 1e-9


@pytest.mark.parametrize("law", [D, F, G_CANONICAL])
@pytest.mark.parametrize("mode", MODES)
def test_drucker_is_lost_where_the_slopes_of_the_cauchy_stresses_are(law: Law, mode: str) -> None:
    """Without volume change and with the third direction free, ∂W/∂εᵢ = σᵢ: differences of σ give the same matrix."""
    result = first_instability(law, mode, criterion="drucker")  # type: ignore[arg-type]
    if result is None:
        return

    def smallest(stretch: float) -> float:
        strain = np.log(DEFORMATIONS[mode](stretch).diagonal()[:2])
        columns = []
        for step in 1e-5 * np.eye(2):
            ahead, behind = (cauchy_stress(law, biaxial(*np.exp(strain + s))).diagonal()[:2] for s in (step, -step))
            columns.append((ahead - behind) / 2e-5)
        return float(np.linalg.eigvalsh(np.array(columns)).min()) / law.shear_modulus

    toward_rest = result ** (1 - 1e-3)
    assert abs(smallest(result)) < 1e-5
    assert smallest(toward_rest) > 1e-5


def test_nearest_of_tension_and_compression_is_reported() -> None:
    tension = first_instability(F, "equibiaxial", lower=1.0)
    compression = first_instability(F, "equibiaxial", upper=1.0)
    assert tension is not None
    assert compression is not None
    assert first_instability(F, "equibiaxial") == tension  # ln 2.653 is nearer to 0 than ln 0.239
    assert first_instability(F, "equibiaxial", upper=2.0) == compression


def test_locking_is_no_instability() -> None:
    assert first_instability(Gent(mu=8e4, Jm=5.0), "uniaxial") is None


@pytest.mark.parametrize(
    ("arguments", "facts"),
    [
        ({"mode": "uniaxal"}, ("mode 'uniaxal'", "'uniaxial'")),
        ({"mode": "uniaxial", "criterion": "druker"}, ("criterion 'druker'", "'drucker'")),
        ({"mode": "uniaxial", "upper": 0.9}, ("range 0.2 to 0.9", "stretch 1")),
        ({"mode": "uniaxial", "lower": 0.0}, ("range 0 to 8", "stretch 1")),
    ],
)
def test_impossible_questions_are_refused(arguments: dict, facts: tuple) -> None:
    with refused(*facts):
        first_instability(A, **arguments)
