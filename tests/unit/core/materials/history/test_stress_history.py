"""Homogeneous tests with a history: loops, softening, and what is refused."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from refused import refused
from turgor.core.materials.history.softening import Mullins, softening_dissipation
from turgor.core.materials.history.stress_history import energy_of, stress_history
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.homogeneous import equibiaxial, nominal_stress, planar, uniaxial
from turgor.core.materials.laws.laws import Gent, Hooke, NeoHooke, Ogden, Yeoh
from turgor.core.materials.material import Material

DEFORMATIONS = {"uniaxial": uniaxial, "equibiaxial": equibiaxial, "planar": planar}
LAWS = [Yeoh(C10=3e4, C20=-500.0, C30=40.0), Ogden(mu=(2e4, 800.0), alpha=(1.5, 4.0)), Gent(mu=5e4, Jm=20.0)]
SERIES = Prony(g=(0.2, 0.15), tau=(0.5, 8.0), moduli="instantaneous")
MULLINS = Mullins(r=1.6, m=6e3, beta=0.05)


def cycles(*tops, points=200, period=4.0):
    """Times and stretches of triangular cycles from 1 to each of the tops."""
    corners = np.array([1.0, *(s for top in tops for s in (top, 1.0))])
    at = 0.5 * period * np.arange(len(corners))
    time = np.linspace(0, at[-1], points * len(tops) * 2 + 1)
    return time, np.interp(time, at, corners)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("mode", DEFORMATIONS)
def test_a_rubber_without_either_follows_its_law(law, mode):
    time, stretch = cycles(2.2, points=20)
    result = stress_history(Material(name="r", law=law), mode, time, stretch)
    exact = nominal_stress(law, DEFORMATIONS[mode](stretch))[:, 0, 0]
    assert result.nominal_stress == pytest.approx(exact, rel=1e-10, abs=1e-6)
    assert result.work[-1] == pytest.approx(0, abs=1e-6 * result.work.max()), "what is put in comes back"


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_fast_and_slow_are_the_instantaneous_and_the_relaxed_law(law):
    time, stretch = cycles(1.9, points=30)
    rubber = Material(name="r", law=law, viscoelasticity=SERIES)
    bare = stress_history(Material(name="r", law=law), "planar", time, stretch).nominal_stress
    fast = stress_history(rubber, "planar", 1e-9 * time, stretch).nominal_stress
    slow = stress_history(rubber, "planar", 1e9 * time, stretch).nominal_stress
    size = np.abs(bare).max()
    assert fast == pytest.approx(bare, abs=1e-6 * size)
    assert slow == pytest.approx(SERIES.relaxed * bare, abs=1e-6 * size)


def test_loading_lies_above_unloading_and_the_loop_is_widest_near_the_relaxation_time():
    rubber = Material(name="r", law=LAWS[0], viscoelasticity=Prony(g=(0.3,), tau=(2.0,), moduli="instantaneous"))
    lost = {}
    for period in (0.02, 12.0, 4000.0):
        time, stretch = cycles(2.0, period=period)
        result = stress_history(rubber, "uniaxial", time, stretch)
        up, down = result.nominal_stress[:201], result.nominal_stress[:199:-1]
        assert (up[1:-1] > down[1:-1]).all()
        lost[period] = result.work[-1]
    assert lost[12.0] > 5 * max(lost[0.02], lost[4000.0])


@pytest.mark.parametrize("mode", DEFORMATIONS)
def test_reloading_follows_the_unloading_until_the_old_maximum(mode):
    rubber = Material(name="r", law=LAWS[1], stress_softening=MULLINS)
    time, stretch = cycles(1.8, 1.8, 2.5, points=100)
    result = stress_history(rubber, mode, time, stretch).nominal_stress
    virgin = nominal_stress(LAWS[1], DEFORMATIONS[mode](stretch))[:, 0, 0]
    first, down, again = result[:101], result[100:201][::-1], result[200:301]
    size = result.max()
    assert first == pytest.approx(virgin[:101], abs=1e-9 * size)
    assert again == pytest.approx(down, abs=1e-9 * size)
    assert (down[1:-1] < 0.99 * first[1:-1]).all()
    third, old = result[400:501], stretch[400:501] <= 1.8
    assert third[old] == pytest.approx(np.interp(stretch[400:501][old], stretch[:101], down), abs=2e-3 * size)
    assert third[~old] == pytest.approx(virgin[400:501][~old], abs=1e-9 * size), "beyond it, the virgin rubber"


@pytest.mark.parametrize("mode", DEFORMATIONS)
def test_a_softening_cycle_loses_what_the_formula_says_and_only_once(mode):
    rubber = Material(name="r", law=LAWS[1], stress_softening=MULLINS)
    time, stretch = cycles(1.8, 1.8, points=2000)
    result = stress_history(rubber, mode, time, stretch)
    W = energy_of(LAWS[1], DEFORMATIONS[mode](np.array([1.8])))[0]
    assert result.work[4000] == pytest.approx(float(softening_dissipation(MULLINS, W)), rel=1e-5)
    assert result.work[-1] == pytest.approx(result.work[4000], rel=1e-9)


def test_both_together_relax_what_is_softened():
    both = Material(name="r", law=LAWS[0], viscoelasticity=SERIES, stress_softening=MULLINS)
    soft = Material(name="r", law=LAWS[0], stress_softening=MULLINS)
    time, stretch = cycles(2.0, 2.0, points=50)
    slow = stress_history(both, "uniaxial", 1e9 * time, stretch)
    bare = stress_history(soft, "uniaxial", time, stretch)
    assert slow.nominal_stress == pytest.approx(SERIES.relaxed * bare.nominal_stress, abs=1.0)
    assert (slow.softening == bare.softening).all()
    assert slow.softening.min() < 0.9


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from(sorted(DEFORMATIONS)),
    st.sampled_from([NeoHooke(C10=1e5), *LAWS]),
    st.lists(st.tuples(st.floats(0.02, 30.0), st.floats(0.5, 2.5)), min_size=1, max_size=5),
    st.booleans(),
)
def test_no_history_gives_back_more_work_than_it_took(mode, law, path, softens):
    """From rest along any corners and back to the first length. Points are dense: trapezoids have errors, too."""
    corners = np.array([1.0, *(stretch for _, stretch in path), 1.0])
    at = np.concatenate([[0.0], np.cumsum([*(step for step, _ in path), 3.0])])
    time = np.unique(np.concatenate([np.linspace(a, b, 150) for a, b in pairwise(at)]))
    rubber = Material(name="r", law=law, viscoelasticity=SERIES, stress_softening=MULLINS if softens else None)
    result = stress_history(rubber, mode, time, np.interp(time, at, corners))
    assert result.work[-1] >= -1e-4 * np.abs(np.diff(result.work)).sum()


@pytest.mark.parametrize(
    ("arguments", "facts"),
    [
        (("uniaxial", [0.0, 1.0], [1.0]), ("time", "(2,)", "stretch (1,)")),
        (("uniaxial", [0.0, 2.0, 1.0], [1.0, 1.1, 1.2]), ("time", "point 2", "2 to 1 s")),
        (("uniaxial", [0.0, np.nan], [1.0, 1.1]), ("time", "point 2", "nan")),
        (("unaxial", [0.0, 1.0], [1.0, 1.1]), ("mode", "unaxial", "uniaxial")),
    ],
)
def test_mistakes_are_named(arguments, facts):
    with refused(*facts):
        stress_history(Material(name="r", law=LAWS[0]), *arguments)


def test_a_linear_elastic_material_has_no_history():
    with refused("paper", "linear elastic"):
        stress_history(Material(name="paper", law=Hooke(E=1e9, nu=0.3)), "uniaxial", [0.0], [1.1])
