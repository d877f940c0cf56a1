"""Sobol indices, screening and local sensitivities: what they take, tell and refuse."""

import sys

import numpy as np
import pytest

import surrogate_cases as cases
from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.factor import Factor
from turgor.studies.sensitivity.figure import indices_figure
from turgor.studies.sensitivity.indices import screening, sobol_indices
from turgor.studies.sensitivity.local_sensitivity import Tolerance, local_sensitivities, sensitivities_of
from turgor.studies.sensitivity.predictors import Direct
from turgor.studies.surrogates.fit import surrogate
from turgor.studies.uncertainty.spread import Spread
from turgor.units import deg, kPa, mm

X, Y, Z = (Factor(name=name, low=0.0, high=1.0) for name in "xyz")


def plane(x: float, y: float, z: float = 0.0) -> Response:
    """4 x + 2 y + z."""
    return Response(columns=(Column("force", "N", [4 * x + 2 * y + z]),), source=Source(text="a plane"))


def constant(x: float, y: float) -> Response:
    """One."""
    return Response(columns=(Column("force", "N", [1.0]),), source=Source(text="a constant"))


def test_shares_of_a_plane():
    asked = Direct(function=plane, factors=(X, Y, Z), measures=("force",))
    (result,) = sobol_indices(asked, samples=256)
    assert result.total == pytest.approx(np.array([16, 4, 1]) / 21, abs=0.01)
    assert result.ranking == ("x", "y", "z")
    assert result.unexplained == 0
    assert result.deviation == pytest.approx(np.sqrt(21 / 12), rel=0.02)
    assert result.sentence().startswith("force varies by 1.3")
    (held,) = sobol_indices(asked, fixed={"x": 0.5}, samples=256)
    assert held.factors == ("y", "z")
    assert held.total == pytest.approx([0.8, 0.2], abs=0.01)


def test_shares_of_a_plane_of_normal_factors():
    """4 x + 2 y + z with deviations 0.05, 0.1 and, uniform over 1, 1/√12: shares as a²σ², which are exact."""
    asked = Direct(function=plane, factors=(X, Y, Z), measures=("force",))
    spreads = [Spread(name="x", mean=0.5, deviation=0.05), Spread(name="y", mean=0.5, deviation=0.1)]
    (result,) = sobol_indices(asked, spreads=spreads, samples=512)
    variances = np.array([16 * 0.05**2, 4 * 0.1**2, 1 / 12])  # ranges end at five deviations and more
    assert result.total == pytest.approx(variances / variances.sum(), abs=0.005)
    assert result.first == pytest.approx(variances / variances.sum(), abs=0.02)
    assert result.deviation == pytest.approx(np.sqrt(variances.sum()), rel=0.005)
    assert "with x, y normal" in result.sentence()


def test_a_normal_factor_is_cut_off_at_the_ends_of_its_range():
    """Within ± one deviation a normal distribution has the variance 1 − 2 φ(1)/(2 Φ(1) − 1) = 0.2911."""
    asked = Direct(function=plane, factors=(X, Y), measures=("force",))
    spreads = [Spread(name=each, mean=0.5, deviation=0.5) for each in "xy"]
    (result,) = sobol_indices(asked, spreads=spreads, samples=512)
    assert result.deviation == pytest.approx(np.sqrt(20 * 0.25 * 0.2911), rel=0.005)
    assert result.total == pytest.approx([0.8, 0.2], abs=0.01)


@pytest.mark.parametrize(
    ("spread", "held", "facts"),
    [
        ({"name": "v", "mean": 0.5}, {}, ["'v'", "x, y, z"]),
        ({"name": "x", "mean": 0.5}, {"x": 0.5}, ["'x'", "y, z"]),
        ({"name": "x"}, {}, ["'x'", "mean"]),
        ({"name": "x", "mean": 1.5}, {}, ["mean", "'x'", 1.5, "0 to 1"]),
    ],
)
def test_spreads_that_do_not_fit_are_refused(spread, held, facts):
    asked = Direct(function=plane, factors=(X, Y, Z), measures=("force",))
    with refused(*facts):
        sobol_indices(asked, spreads=[Spread(**spread, deviation=0.1)], fixed=held)


def test_what_a_surrogate_leaves_widens_the_intervals():
    study = cases.study_of(cases.finger, [cases.WALL, cases.C10], 16)
    fitted = surrogate(study, ["bending_angle"], at=("pressure", 40 * kPa))
    (result,) = sobol_indices(fitted, samples=256)
    left = 1 - fitted.error("bending_angle").r_squared
    assert result.unexplained == pytest.approx(left)
    low, high = result.interval("total")
    assert (low < result.total).all()
    assert high == pytest.approx(np.minimum((1 - left) * (result.total + result.total_error) + left, 1.0))
    axes = indices_figure([result]).axes[0]
    assert [each.get_text() for each in axes.get_yticklabels()] == list(reversed(result.ranking))


def test_effects_of_a_plane_are_its_slopes():
    (result,) = screening(Direct(function=plane, factors=(X, Y, Z), measures=("force",)), trajectories=6)
    assert result.size == pytest.approx([4, 2, 1])
    assert result.spread == pytest.approx([0, 0, 0], abs=1e-6)
    assert (result.ranking, result.count) == (("x", "y", "z"), 24)


def test_what_is_refused():
    asked = Direct(function=plane, factors=(X, Y), measures=("force",))
    with refused("samples", 100, "1024"):
        sobol_indices(asked, samples=100)
    with refused("'forc'", "'force'"):
        sobol_indices(asked, ["forc"])
    with refused("'w'", "x, y"):
        sobol_indices(asked, fixed={"w": 1.0})
    with refused("1 factors", "x, y", "two"):
        sobol_indices(asked, fixed={"x": 1.0})
    with refused("'force'", "variance"):
        sobol_indices(Direct(function=constant, factors=(X, Y), measures=("force",)), samples=8)
    thin = Factor(name="wall", low=0.5 * mm, high=2 * mm, unit="mm")
    failing = Direct(function=cases.finger, factors=(thin, cases.C10), measures=("bending_angle",))
    with refused("10 of 32 runs", "wall 0.51146 mm, C10 76.964 kPa", "0.9 mm"):
        sobol_indices(failing, samples=8)
    with refused("trajectories", 1, "2 or more"):
        screening(asked, trajectories=1)


def test_without_salib_there_is_a_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "SALib.sample.sobol", None)
    with refused("sensitivity", "SALib", "turgor[studies]"):
        sobol_indices(Direct(function=plane, factors=(X, Y), measures=("force",)), samples=8)


def test_what_a_tolerance_does():
    """d angle / d wall of arctan(a wall^-1.2): -1.2 a / wall / (1 + a²)."""
    wall, C10 = 1.5 * mm, 75 * kPa
    tolerances = [
        Tolerance(name="C10", nominal=C10, off=0.5 * kPa, unit="kPa"),
        Tolerance(name="wall", nominal=wall, off=0.1 * mm, unit="mm"),
    ]
    result = local_sensitivities(cases.finger, tolerances, ["bending_angle"], at=("pressure", 40 * kPa))
    a = 40 / 75
    assert [each.tolerance.name for each in result] == ["wall", "C10"]  # the larger change first
    assert result[0].derivative == pytest.approx(-1.2 * a / wall / (1 + a**2), rel=0.01)
    assert result[1].derivative == pytest.approx(-a / C10 / (1 + a**2), rel=1e-4)
    assert result[0].elasticity == pytest.approx(result[0].derivative * wall / np.arctan(a))
    assert result[0].change / deg == pytest.approx(-1.91, abs=0.01)
    assert result[0].error > 0.01 * abs(result[0].derivative)  # the curve of the wall is bent within 0.1 mm
    assert result[0].sentence().startswith("wall 1.5 mm + 0.1 mm: bending angle -1.9")


def test_derivatives_may_be_given():
    tolerance = Tolerance(name="wall", nominal=2.0, off=0.1)
    (result,) = sensitivities_of({"wall": -3.0}, [tolerance], measure="angle", value=6.0)
    assert (result.change, result.elasticity) == pytest.approx((-0.3, -1.0))
    assert "±" not in result.sentence()
    with refused("'wall'", "'wal'"):
        sensitivities_of({"wal": 1.0}, [tolerance], measure="angle", value=6.0)


def test_tolerances_and_their_runs_are_checked():
    with refused("'wall'", 0, "above 0"):
        Tolerance(name="wall", nominal=1.0, off=0.0)
    thin = Tolerance(name="wall", nominal=0.95 * mm, off=0.1 * mm, unit="mm")
    rubber = Tolerance(name="C10", nominal=75 * kPa, off=1 * kPa, unit="kPa")
    with refused("wall 0.85 mm, C10 75 kPa", "0.9 mm"):
        local_sensitivities(cases.finger, [thin, rubber], ["bending_angle"])
