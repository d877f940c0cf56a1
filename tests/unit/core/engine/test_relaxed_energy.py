"""The energy of a tension field: its three states, its derivatives, and that it is the least over all shortenings."""

import numpy as np
import pytest
from scipy.optimize import minimize

from refused import refused
from turgor.core.engine.faces.membranes import plane_stress_moduli
from turgor.core.engine.faces.settings import TENSION_FIELD
from turgor.core.engine.faces.tension_field import (
    TensionField,
    tension_field,
)
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import Material
from turgor.core.model.sheets import Membrane

YOUNG, NU = 3.0, 0.3
MODULI = plane_stress_moduli(Hooke(E=YOUNG, nu=NU))
SHARP = TensionField(MODULI, 0.0, 1e-9)
STATES = {"taut": (0.05, 0.01), "wrinkled": (0.05, -0.04), "slack": (-0.02, -0.05)}


def _turned(e1, e2, angle):
    """Strain E₁₁, E₂₂, 2 E₁₂ of principal strains whose first direction lies at an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([e1 * c * c + e2 * s * s, e1 * s * s + e2 * c * c, 2 * (e1 - e2) * c * s])


@pytest.mark.parametrize("angle", [0.0, 0.7, -1.2])
def test_stress_of_the_three_states(angle):
    taut, wrinkled, slack = (SHARP.stress(_turned(*STATES[name], angle)) for name in STATES)
    assert taut == pytest.approx(MODULI @ _turned(*STATES["taut"], angle), rel=1e-6)
    along = _turned(YOUNG * 0.05, 0.0, angle) * (1, 1, 0.5)  # stresses have no factor 2
    assert wrinkled == pytest.approx(along, rel=1e-6, abs=1e-9)
    assert slack == pytest.approx(np.zeros(3), abs=1e-12)


@pytest.mark.parametrize("name", STATES)
def test_energy_is_the_least_over_all_shortenings(name):
    """min ½ (E + A) : ℂ : (E + A) over A = L Lᵀ, by a search that knows nothing of principal strains."""
    strain = _turned(*STATES[name], 0.4)

    def added(x):
        total = strain + np.array([x[0] ** 2, x[1] ** 2 + x[2] ** 2, 2 * x[0] * x[1]])
        return 0.5 * total @ MODULI @ total

    least = min(minimize(added, start, tol=1e-14).fun for start in ([0.1, 0.1, 0.1], [0.2, -0.2, 0.1], [0.1, 0.0, 0.3]))
    assert float(SHARP.energy(strain)) == pytest.approx(least, abs=1e-8)


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("scale", [1e-3, 0.1])
def test_stress_and_tangent_are_derivatives(share, scale):
    """In all states, on both sides of the toe, and where the principal strains are equal."""
    field, h = TensionField(MODULI, share, 5e-3), 1e-6 * scale
    strain = scale * np.random.default_rng(1).normal(size=(60, 3))
    strain[:2] = [[scale, scale, 0.0], [-scale, -scale, 0.0]]
    stress, tangent = field.stress(strain), field.tangent(strain)
    for k, way in enumerate(np.eye(3)):
        up, down = strain + h * way, strain - h * way
        assert (field.energy(up) - field.energy(down)) / (2 * h) == pytest.approx(stress[:, k], abs=1e-6 * scale)
        assert (field.stress(up) - field.stress(down)) / (2 * h) == pytest.approx(tangent[..., k], abs=1e-5)
    assert (np.linalg.eigvalsh(tangent) >= -1e-12).all()


@pytest.mark.parametrize("share", [0.0, 0.3])
def test_what_it_is_linearized_about(share):
    """A pair on the curve is kept; any other leads to the strain between what its stress and its strain say."""
    field, random = TensionField(MODULI, share, 5e-3), np.random.default_rng(3)
    strain, stress = random.normal(size=(60, 3)) * 0.05, random.normal(size=(60, 3)) * 0.05
    assert field.linearized_about(field.stress(strain), strain) == pytest.approx(strain, rel=1e-9, abs=1e-12)
    about, weight = field.linearized_about(stress, strain), TENSION_FIELD.strain_weight / MODULI[0, 0]
    assert field.stress(about) + weight * about @ MODULI == pytest.approx(stress + weight * strain @ MODULI, rel=1e-9)


def test_a_stiff_sheet_goes_slack_where_its_stress_is_released():
    """Strains of a stiff sheet that is nearly straight say little: rotations leave some of second order."""
    stiff = tension_field(1e4 * MODULI, 0.0)
    released, longer = np.array([-0.5, 0.0, 0.0]), np.array([1e-3, 0.0, 0.0])
    about = stiff.linearized_about(released, longer)
    assert stiff.stress(longer)[0] > 1 and abs(stiff.stress(about)[0]) < 1e-3


def test_all_of_the_stiffness_in_compression_is_hookes_law():
    strain = np.random.default_rng(2).normal(size=(5, 3))
    whole = TensionField(MODULI, 1.0, 1e-2)
    assert whole.stress(strain) == pytest.approx(strain @ MODULI)
    assert whole.tangent(strain) == pytest.approx(np.broadcast_to(MODULI, (5, 3, 3)))


def test_toe_and_share_follow_the_stiffness():
    """A stiff sheet reaches the tension 1 at the same small stretch, a soft one has hardly a toe."""
    stiff, soft = tension_field(1e3 * MODULI, 0.0), tension_field(MODULI, 0.0)
    assert stiff.share == pytest.approx(0.1 / (1e3 * MODULI[0, 0])) and soft.share == TENSION_FIELD.largest_share
    assert stiff.stress(np.array([1.42e-3, -NU * 1.42e-3, 0.0]))[0] == pytest.approx(1.0, rel=0.15)
    assert soft.toe < 1e-5 and tension_field(1e9 * MODULI, 0.0).toe == TENSION_FIELD.longest_toe
    assert tension_field(MODULI, 0.2).share == 0.2


def test_a_share_out_of_range_is_refused():
    film = Material(name="film", law=Hooke(E=1e9, nu=0.3))
    with refused("compression", -0.1, "0 (it wrinkles) to 1"):
        Membrane(film, 1e-4, compression=-0.1)
