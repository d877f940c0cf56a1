"""Parameters of a calibration: starting values, bounds and priors, and the coordinates that the search moves in."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, inf, isfinite, log

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.runs.rounding import rounded
from turgor.units import unit_value

Array = NDArray[np.float64]

#: Ends of the names of parameters of the rig: the offset and the factor of a measured column.
OFFSET, SCALE = "_offset", "_scale"


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """A number that a calibration fits.

    Parameters
    ----------
    name : str
        Keyword of the function that computes the response; for a parameter of the rig, the name of a measured column
        with ``_offset`` or ``_scale``, such as ``"pressure_offset"``.
    start : float [SI]
        Where the search begins.
    lower, upper : float or None [SI]
        Bounds. By default a tenth and ten times the start where this is positive.
    prior : (float, float) or None [SI]
        What is known without the experiment: mean and standard deviation.
    unit : str
        Unit in which the value is shown, such as ``"kPa"``.
    step : float [-]
        Step of the finite differences: relative where both bounds are positive, else as a share of the range. A shape
        that is remeshed needs a larger one than a material, because the mesh changes with it.

    Raises
    ------
    TurgorError
        If a bound is missing or the start does not lie between the bounds.

    Examples
    --------
    >>> Parameter(name="C10", start=0.12e6, unit="MPa").bounds
    (12000.0, 1200000.0)
    """

    name: str
    start: float
    lower: float | None = None
    upper: float | None = None
    prior: tuple[float, float] | None = None
    unit: str = ""
    step: float = CALIBRATION.step

    def __post_init__(self) -> None:
        if not self.name:
            raise TurgorError("a parameter has no name.")
        low, high = self.bounds
        if not (isfinite(low) and isfinite(high) and isfinite(self.start)):
            raise TurgorError(
                f"parameter '{self.name}' starts at {self.shown(self.start)}, which is not positive; give lower and "
                "upper bounds."
            )
        if not low < high:
            raise TurgorError(
                f"parameter '{self.name}' has the bounds {self.shown(low)} and {self.shown(high)}; the lower one must "
                "be the smaller one."
            )
        if not low <= self.start <= high:
            raise TurgorError(
                f"parameter '{self.name}' starts at {self.shown(self.start)}; allowed is {self.shown(low)} to "
                f"{self.shown(high)}, its bounds."
            )
        if self.prior is not None and not (isfinite(self.prior[0]) and self.prior[1] > 0):
            raise TurgorError(
                f"parameter '{self.name}' has the prior {self.prior}; its standard deviation must be above 0."
            )
        if not 0 < self.step < 1:
            raise TurgorError(f"parameter '{self.name}' has the step {self.step:g}; allowed is between 0 and 1.")

    @property
    def bounds(self) -> tuple[float, float]:
        """Lower and upper bound [SI]."""
        positive = self.start > 0
        low = self.lower if self.lower is not None else self.start / CALIBRATION.bounds if positive else -inf
        high = self.upper if self.upper is not None else self.start * CALIBRATION.bounds if positive else inf
        return rounded(low), rounded(high)

    @property
    def logarithmic(self) -> bool:
        """Whether the search moves in the logarithm: where both bounds are positive."""
        return self.bounds[0] > 0

    @property
    def width(self) -> float:
        """Distance of the bounds in the coordinate of the search."""
        low, high = self.bounds
        return log(high / low) if self.logarithmic else 1.0

    def coordinate(self, value: float) -> float:
        """Return the coordinate of the search for a value; it is 1 at the start, and about one step from 0 to 2."""
        low, high = self.bounds
        value = min(max(value, low), high)
        if self.logarithmic:
            return 1.0 + log(value / rounded(min(max(self.start, low), high)))
        return 1.0 + (value - self.start) / (high - low)

    def value(self, coordinate: float) -> float:
        """Return the value at a coordinate of the search, within the bounds."""
        low, high = self.bounds
        far = min(max(coordinate - 1, -self.width), self.width)
        number = self.start * exp(far) if self.logarithmic else self.start + far * (high - low)
        return min(max(rounded(number), low), high)

    def slope(self, value: float) -> float:
        """Return the derivative of the value by the coordinate."""
        return value if self.logarithmic else self.bounds[1] - self.bounds[0]

    def shown(self, value: float, digits: int = 4) -> str:
        """Return a value with its unit."""
        return f"{value / unit_value(self.unit):.{digits}g} {self.unit}".rstrip()


def check_names(parameters: Sequence[Parameter]) -> None:
    """Raise an error if there is no parameter, or two have one name.

    Parameters
    ----------
    parameters : sequence of Parameter
    """
    if not parameters:
        raise TurgorError("a calibration needs a parameter that is free; name one or more.")
    names = [each.name for each in parameters]
    for name in names:
        if names.count(name) > 1:
            raise TurgorError(f"two parameters are called '{name}'.")


def values_at(parameters: Sequence[Parameter], at: Array) -> dict[str, float]:
    """Return values by name at a point of the search.

    Parameters
    ----------
    parameters : sequence of Parameter
    at : (n,) array
        Coordinates.

    Returns
    -------
    dict of str to float [SI]
    """
    return {each.name: each.value(float(x)) for each, x in zip(parameters, at, strict=True)}
