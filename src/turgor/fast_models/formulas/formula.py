"""Formula: an analytic model with its assumptions, and what all of them share."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.fitting.checks import check_stretch_range
from turgor.core.materials.laws.laws import FiberLaw, Hooke, Law
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity, by_weight
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: Bulk modulus over shear modulus from which on a rubber may count as incompressible: radii are then right to 0.1 %.
NEARLY_INCOMPRESSIBLE = 500.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Formula:
    """Name, assumptions, families and source of a formula.

    Parameters
    ----------
    name : str
        Name of its function in `turgor.fast_models.formulas`.
    title : str
        What it gives, in one sentence.
    families : tuple of str
        Names of the families in `turgor.actuators` that it takes; empty where it takes none of them.
    assumptions : tuple of str
        What must hold, each in one sentence; the docstring of the function has the same sentences.
    source : Source
        Who published it, and what was derived here.

    Examples
    --------
    >>> from turgor import formulas
    >>> formulas.about("thick_tube").assumptions[0]
    'The rubber is incompressible and elastic: no relaxation, no softening.'
    """

    name: str
    title: str
    families: tuple[str, ...]
    assumptions: tuple[str, ...]
    source: Source

    def check_family(self, actuator: object) -> None:
        """Raise an error unless the actuator is of one of the families."""
        given = type(actuator).__name__
        if given not in self.families:
            raise TurgorError(f"{self.name} is for {', '.join(self.families)}; {given} is none of them.")

    def response(
        self,
        columns: Sequence[Column],
        findings: Sequence[Finding | None] = (),
        *,
        status: str = "converged",
        message: str = "",
    ) -> Response:
        """Make the response, with the findings that there are."""
        return Response(
            columns=tuple(columns),
            source=Source(text=f"the formula {self.name}", detail=str(self.source), doubts=self.source.doubts),
            status=status,
            message=message,
            findings=by_weight(finding for finding in findings if finding is not None),
        )


def path_of(name: str, values: ArrayLike, *, points: int = 21, low: float = 0.0) -> Array:
    """Make the points of a path: a number becomes equal steps from ``low`` to it, a list stays as it is.

    Parameters
    ----------
    name : str
        What it is, for messages.
    values : float or (n,) array
    points : int
        Points from ``low`` to a number.
    low : float
        Start, and the smallest value that is allowed.

    Returns
    -------
    (n,) array

    Raises
    ------
    TurgorError
        If a value is no finite number or below ``low``.

    Examples
    --------
    >>> path_of("pressure", 30e3, points=4)
    array([    0., 10000., 20000., 30000.])
    """
    given = np.asarray(values, dtype=np.float64)
    if given.ndim > 1 or not given.size or not np.isfinite(given).all():
        raise TurgorError(f"{name} is {values!r}; a finite number or a list of them is needed.")
    if float(given.min()) < low:
        raise TurgorError(f"{name} is {float(given.min()):g}; allowed is {low:g} or more.")
    return np.linspace(low, float(given), points) if given.ndim == 0 else given


def law_of(material: Material) -> Law:
    """Return the law of a rubber; a linear elastic material and a foam are refused."""
    if isinstance(material.law, Hooke):
        raise TurgorError(
            f"material '{material.name}' is linear elastic (Hooke); the formula needs a rubber, such as NeoHooke."
        )
    _require_isotropic(material)
    if material.is_foam:
        raise TurgorError(
            f"material '{material.name}' is a foam ({type(material.law).__name__}); the formula is for rubber that "
            "keeps its volume. Take finite elements."
        )
    assert not isinstance(material.law, FiberLaw)
    return material.law


def _require_isotropic(material: Material) -> None:
    if material.has_fibers:
        raise TurgorError(
            f"material '{material.name}' has directions ({type(material.law).__name__}); formulas are for isotropic "
            "materials. Take finite elements."
        )


def young_modulus(material: Material) -> float:
    """Initial Young's modulus [Pa]: 3 μ of an incompressible rubber."""
    _require_isotropic(material)
    if isinstance(material.law, Hooke):
        return material.law.E
    return 2 * material.law.shear_modulus * (1 + poisson_ratio(material))


def poisson_ratio(material: Material) -> float:
    """Initial Poisson's ratio: ½ of an incompressible rubber."""
    if isinstance(material.law, Hooke):
        return material.law.nu
    share = material.law.shear_modulus / material.bulk_modulus
    return (3 - 2 * share) / (6 + 2 * share)


def not_so_simple(material: Material) -> Finding | None:
    """F01: the formula leaves out a behavior of the material."""
    if isinstance(material.law, Hooke):
        return None
    ratio = material.bulk_modulus / material.law.shear_modulus
    does = [f"is compressible (bulk modulus {ratio:.3g} times the shear modulus)"] * bool(ratio < NEARLY_INCOMPRESSIBLE)
    does += ["relaxes"] * (material.viscoelasticity is not None)
    does += ["softens"] * (material.stress_softening is not None)
    does += ["keeps a permanent set"] * (material.permanent_set is not None)
    if not does:
        return None
    return Finding(
        code="F01",
        severity=Severity.WARNING,
        message=f"The formula takes '{material.name}' as incompressible and elastic, but it {' and '.join(does)}.",
        advice="Compare with finite elements, which take all of it into account.",
    )


def beyond_tests(material: Material, stretches: ArrayLike) -> tuple[Finding, ...]:
    """M01: the law is used beyond the stretches of its tests."""
    known = np.asarray(stretches, dtype=np.float64)
    known = known[np.isfinite(known)]
    if material.stretch_range is None or not known.size:
        return ()
    return tuple(check_stretch_range(material, (1.0, max(1.0, float(known.max())))))


def too_short(length: float, diameter: float) -> Finding | None:
    """F05: the ends reach into the middle of a short actuator."""
    if length >= 5 * diameter:
        return None
    return Finding(
        code="F05",
        severity=Severity.NOTE,
        message=f"The cavity is {length / diameter:.2g} times as long as it is wide; the formula leaves out its ends, "
        "each of which is felt over about one diameter.",
        advice="Expect less motion than the formula says, or compare with finite elements.",
    )


def strained(largest: float, of: str) -> Finding | None:
    """F03: a linear theory is used at large strain."""
    if not largest > 0.1:
        return None
    return Finding(
        code="F03",
        severity=Severity.WARNING,
        message=f"The formula is linear, but the strain of {of} reaches {100 * largest:.3g} %.",
        advice="Use it where strains stay below some 10 %; beyond, only its first slope means something.",
    )
