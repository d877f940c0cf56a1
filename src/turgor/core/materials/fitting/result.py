"""Fit: a fitted law with its errors, its range and its findings."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, nan
from typing import Any, Self

import numpy as np

from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.fitting.settings import DETERMINATION, FIT
from turgor.core.materials.laws.law_spec import LawSpec
from turgor.core.materials.material import Material
from turgor.foundation.display import Shown
from turgor.foundation.finding import Finding
from turgor.foundation.source import Source


def stress_text(stress: float) -> str:
    """Write a stress with three digits.

    Examples
    --------
    >>> stress_text(52e3), stress_text(36.6e6)
    ('52 kPa', '36.6 MPa')
    """
    return f"{stress / 1e6:.3g} MPa" if abs(stress) >= 1e6 else f"{stress / 1e3:.3g} kPa"


@dataclass(frozen=True, slots=True, kw_only=True)
class FitResidual:
    """Error of a law for one test.

    Parameters
    ----------
    name : str
        Name of the test.
    mode : str
        Its mode.
    points : int
        Number of stresses that were compared.
    relative : float [-]
        Root mean square of the deviation divided by the measured stress (at least 5 % of the largest).
    r2 : float [-]
        Coefficient of determination, 1 − Σ deviation² / Σ (measured − mean)²; negative where the mean fits better, NaN
        if all stresses are equal.
    """

    __test__ = False  # not a class of tests for pytest

    name: str
    mode: str
    points: int
    relative: float
    r2: float

    @classmethod
    def of(cls, test: MaterialTest, predicted: Array) -> Self:
        """Compare a prediction with a test.

        Parameters
        ----------
        test : MaterialTest
            The test.
        predicted : (n,) array [Pa]
            Nominal stress of a law, in the order of ``test.measured``.
        """
        off = predicted - test.measured
        size = np.abs(test.measured)
        relative = off / np.maximum(size, FIT.weight_floor * size.max())
        spread = test.measured - test.measured.mean()
        return cls(
            name=test.name,
            mode=test.mode,
            points=len(off),
            relative=float(np.sqrt((relative**2).mean())),
            r2=1 - float(off @ off) / float(spread @ spread) if np.ptp(test.measured) > 0 else nan,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fit(Shown):
    """A fitted law with its errors, the uncertainty of its parameters, and its range of use.

    Parameters
    ----------
    spec : LawSpec
        Name and parameters of the law.
    law : Law
        The law itself.
    values : mapping of str to float
        Parameters in SI, by name.
    errors : mapping of str to float
        Standard errors, from the scatter about the curve; 0 for a parameter at a bound, infinite for one that the tests
        leave open. If the law cannot follow the curve, the deviations are not scatter, and these errors are too small.
    correlation : (n, n) array [-]
        Correlations of the parameters; ±1 means that the tests determine only a combination.
    bounds_hit : tuple of str
        Active bounds and constraints, in words.
    quality : tuple of FitResidual
        Error of every test.
    aic : float
        Akaike's criterion; smaller is better. Comparable only for the same tests, range and weights.
    stretch : (float, float) [-]
        Requested range.
    stretch_range : (float, float) [-]
        Part of the requested range that the tests cover, in which the law may be used; includes the undeformed state.
    instability : mapping of str to float
        Stretch at which stability is first lost in the requested range, by mode, according to the strictest of the
        criteria of `turgor.laws.instabilities`; empty where the law is stable.
    weights : str
        ``"relative"``, ``"absolute"`` or ``"even"``.
    starts : (int, int)
        Number of starts of the search that reached this residual, and number of all starts.
    tests : tuple of MaterialTest
        The points that were used.
    combination : str
        The sum of two parameters that the tests determine, where they leave both open; empty otherwise.
    findings : tuple of Finding
        Findings of the checks.
    """

    spec: LawSpec
    law: Any
    values: Mapping[str, float]
    errors: Mapping[str, float]
    correlation: Array
    bounds_hit: tuple[str, ...]
    quality: tuple[FitResidual, ...]
    aic: float
    stretch: tuple[float, float]
    stretch_range: tuple[float, float]
    instability: Mapping[str, float]
    weights: str
    starts: tuple[int, int]
    tests: tuple[MaterialTest, ...]
    combination: str = ""
    findings: tuple[Finding, ...] = ()

    def __repr__(self) -> str:
        return f"Fit({self.spec.name}: {self.describe()}; {100 * self.relative:.2g} % off)"

    @property
    def relative(self) -> float:
        """Root mean square relative error over all points [-]."""
        count = sum(test.points for test in self.quality)
        return float(np.sqrt(sum(test.points * test.relative**2 for test in self.quality) / count))

    @property
    def unconstrained(self) -> tuple[str, ...]:
        """Parameters that the tests do not determine at all."""
        return tuple(name for name, error in self.errors.items() if error == inf)

    @property
    def undetermined(self) -> tuple[str, str] | None:
        """The two most correlated parameters, if the tests determine only a combination of them, else None."""
        off = np.abs(self.correlation - np.diag(np.diag(self.correlation)))
        i, j = np.unravel_index(int(np.argmax(off)), off.shape)
        names = self.spec.names
        open_ones = any(self.errors[names[k]] > abs(self.values[names[k]]) for k in (i, j))
        return (names[i], names[j]) if off[i, j] > DETERMINATION.correlated and open_ones else None

    @property
    def material(self) -> Material:
        """The law as a material with its range and source."""
        return self.named("")

    def named(self, name: str, density: float | None = None, bulk_modulus: float = inf) -> Material:
        """Return the law as a material.

        Parameters
        ----------
        name : str
            Name of the material; by default the names of law and tests.
        density : float, optional [kg/m³]
            Mass per volume.
        bulk_modulus : float [Pa]
            Bulk modulus; infinite (incompressible) by default.
        """
        names = ", ".join(test.name for test in self.tests)
        detail = (
            f"{self.spec.name} by {self.weights} least squares, {100 * self.relative:.2g} % off on average; "
            f"{'; '.join(dict.fromkeys(test.source.detail or test.source.text for test in self.tests))}"
        )
        return Material(
            name=name or f"{self.spec.name} of {names}",
            law=self.law,
            density=density,
            bulk_modulus=bulk_modulus,
            stretch_range=self.stretch_range,
            source=Source(
                text=f"fitted to {names}",
                detail=detail,
                # M01 and M03 concern a use, and M06 is checked again for every law; M02 concerns the tests
                doubts=tuple(
                    f"{finding.code} {finding.severity}: {finding.message}"
                    for finding in self.findings
                    if finding.code == "M02"
                ),
            ),
        )

    def describe(self) -> str:
        """Write the parameters with their standard errors.

        Moduli are in kPa, shape parameters without a unit.
        """
        return ", ".join(self.parameter(name) for name in self.spec.names)

    def parameter(self, name: str) -> str:
        """Write one parameter with its standard error, or with the words "not determined".

        Parameters
        ----------
        name : str
            One of the names of the law.
        """
        factor, unit = (1e3, " kPa") if name in self.spec.coefficients else (1.0, "")
        value, error = self.values[name] / factor, self.errors[name] / factor
        if error == inf:
            return f"{name} = {value:.5g}{unit}, not determined"
        return f"{name} = {value:.5g} ± {error:.2g}{unit}" if error > 0 else f"{name} = {value:.5g}{unit}"

    def predict(self, tests: Sequence[MaterialTest]) -> tuple[FitResidual, ...]:
        """Compare the law with tests that it was not fitted to.

        Parameters
        ----------
        tests : sequence of MaterialTest
            Any tests.
        """
        return tuple(FitResidual.of(test, test.predicted(self.law)) for test in tests)

    def with_findings(self, findings: Sequence[Finding]) -> "Fit":
        """Return the fit with these findings.

        Parameters
        ----------
        findings : sequence of Finding
            Findings of the checks.
        """
        return replace(self, findings=tuple(findings))
