"""Plots of a law: right numbers in their unit, dashed outside the fitted range, a cross where stability is lost."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from turgor.errors import TurgorError
from turgor.materials.laws.homogeneous import cauchy_stress, nominal_stress, simple_shear, uniaxial
from turgor.materials.laws.laws import NeoHooke, Ogden
from turgor.results.plots.curves import plot_curves

NEO = NeoHooke(C10=0.12e6)
OGDEN = Ogden(mu=(24361.0, 66.703, 453.81), alpha=(1.7138, 7.0679, -3.3659))


def _drawn(law, *more, **options):
    axes = Figure().add_subplot()
    assert plot_curves(axes, law, *more, **options) is axes
    return axes, axes.get_lines()


def test_solid_inside_the_fitted_range_and_dashed_outside() -> None:
    axes, (dashed, solid) = _drawn(NEO, ["uniaxial"], (1.0, 2.0), stretch=(0.5, 3.0))
    assert (dashed.get_linestyle(), solid.get_linestyle()) == ("--", "-")
    x = dashed.get_xdata()
    assert (x.min(), x.max()) == (0.5, 3.0)
    np.testing.assert_allclose(dashed.get_ydata(), nominal_stress(NEO, uniaxial(x))[:, 0, 0] / 1e6)
    shown = np.isfinite(solid.get_ydata())
    assert (shown == ((x >= 1.0) & (x <= 2.0))).all()
    assert (solid.get_label(), dashed.get_label()[0]) == ("uniaxial", "_")
    assert axes.get_ylabel() == "nominal stress [MPa]"


def test_unknown_range_is_solid_and_a_range_beyond_the_plot_is_dashed() -> None:
    assert [line.get_linestyle() for line in _drawn(NEO, ["planar"])[1]] == ["-"]
    assert [line.get_linestyle() for line in _drawn(NEO, ["planar"], (5.0, 6.0))[1]] == ["--"]


def test_loss_of_stability_is_a_cross_on_the_curve() -> None:
    axes, (line, cross) = _drawn(OGDEN, ["equibiaxial"], stretch=(1.0, 2.0))
    assert cross.get_marker() == "x"
    assert cross.get_xdata()[0] == pytest.approx(1.643, abs=5e-4)
    assert cross.get_ydata()[0] == pytest.approx(line.get_ydata().max(), rel=1e-4)
    assert axes.get_ylabel() == "nominal stress [kPa]"


def test_cauchy_stress_of_shear() -> None:
    axes, (line,) = _drawn(NEO, ["simple_shear"], stretch=(1.0, 3.0), stress="cauchy")
    amount = line.get_xdata()
    assert (amount.min(), amount.max()) == (0.0, 2.0)
    np.testing.assert_allclose(line.get_ydata(), cauchy_stress(NEO, simple_shear(amount))[:, 0, 1] / 1e6)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("stretch, amount of shear [-]", "Cauchy stress [MPa]")


@pytest.mark.parametrize(
    ("arguments", "options", "word"),
    [
        ((["biaxal"],), {}, "unknown mode 'biaxal'"),
        ((["planar"],), {"stress": "nominl"}, "did you mean 'nominal'"),
        ((["planar"],), {"stretch": (2.0, 1.0)}, "2 to 1; it must rise"),
    ],
)
def test_impossible_questions_are_refused(arguments, options, word) -> None:
    with pytest.raises(TurgorError, match=word):
        _drawn(NEO, *arguments, **options)
