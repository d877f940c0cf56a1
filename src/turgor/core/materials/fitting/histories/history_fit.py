"""HistoryFit: a rubber fitted to tests over time, with the uncertainty of its parameters."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.histories.history_points import HistoryPart
from turgor.core.materials.fitting.result import FitResidual
from turgor.core.materials.fitting.settings import HISTORY_FIT
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.foundation.display import brief


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HistoryFit:
    """A rubber with fitted viscoelasticity and stress softening, and the uncertainty of the parameters.

    Parameters
    ----------
    material : Material
        Law times ``scale``, which makes its constants instantaneous, with `Prony` series and `Mullins` softening.
    values : mapping of str to float
        Parameters in SI: ``scale`` of the law, ``g1``, ``tau1`` and so on, ``r``, ``m``, ``beta``.
    errors : mapping of str to float
        Standard errors of the parameters, from the scatter about the curve; 0 for a parameter at a bound. Deviations of
        neighboring points are correlated, so these errors are too small.
    bounds_hit : tuple of str
        Parameters at a bound, which the tests do not determine.
    undetermined : tuple of str
        Parameters whose standard error exceeds half their value.
    largest_softening : float [-]
        Share 1 − η of the stress that is lost near rest after the largest stretch of the tests. The tests determine
        this share even where they do not determine r, m and β one by one.
    quality : tuple of FitResidual
        Error of every test, over the points with load.
    """

    material: Material
    values: Mapping[str, float]
    errors: Mapping[str, float]
    bounds_hit: tuple[str, ...]
    undetermined: tuple[str, ...]
    largest_softening: float
    quality: tuple[FitResidual, ...]

    __repr__ = brief

    def predict(self, tests: MaterialTest | Sequence[MaterialTest]) -> tuple[FitResidual, ...]:
        """Compare the rubber with tests, such as tests that were not fitted.

        Parameters
        ----------
        tests : MaterialTest or sequence of MaterialTest
            Tests with time.
        """
        return quality_of(self.material, [tests] if isinstance(tests, MaterialTest) else tests)

    def describe(self) -> str:
        """Write the parameters with their standard errors, and name those that the tests do not determine."""
        lines = [f"{name} = {value:.4g} ± {self.errors[name]:.2g}" for name, value in self.values.items()]
        limits = (*self.bounds_hit, *(f"{name} is not determined" for name in self.undetermined))
        return "\n".join((*lines, *limits))


def quality_of(material: Material, tests: Sequence[MaterialTest]) -> tuple[FitResidual, ...]:
    """Compare a rubber with tests over time.

    Parameters
    ----------
    material : Material
        Rubber with its viscoelasticity and stress softening.
    tests : sequence of MaterialTest
        Tests with time; about 400 points of each are used.
    """
    series, law = material.prony, material.law
    assert isinstance(law, Law)
    g, tau = (series.g, series.tau) if series is not None else ((), ())
    factor = 1.0 if series is None else series.instantaneous
    residuals = []
    for test in tests:
        part = HistoryPart(law, test, HISTORY_FIT.points)
        if material.flowing_network or material.permanent_set:
            predicted = part.pulls(material)
        else:
            predicted = factor * (part.columns(material.stress_softening, tau) @ np.array([1 - sum(g), *g]))
        residuals.append(FitResidual.of(part.loaded_test, predicted * part.scale))
    return tuple(residuals)
