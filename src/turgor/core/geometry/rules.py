"""Rules for dimensions; the error for a broken rule states the field, its value and the range."""

from collections.abc import Sequence
from dataclasses import fields
from math import floor, inf, isfinite
from numbers import Integral, Real
from typing import Any

from turgor.foundation.errors import TurgorError, near_match
from turgor.units import deg, mm

#: Smallest wall, gap or channel: molded parts are not thinner, and CAD tolerances are far smaller.
SMALLEST_LENGTH = 0.01 * mm

#: A larger length is more likely a number of millimeters without its unit.
SUSPICIOUS_LENGTH = 100 * mm

#: Most chambers of an actuator, folds of a bellows and ribs of parallel ones: more are hardly meant, and take minutes.
MOST_CHAMBERS, MOST_FOLDS, MOST_RIBS = 100, 50, 9


def in_mm(length: float) -> str:
    """Write a length in millimeters.

    Examples
    --------
    >>> in_mm(0.0015), in_mm(110.0)
    ('1.5 mm', '110000 mm')
    """
    return f"{length / mm:.10g} mm"


def as_length(name: str, value: object) -> float:
    """Return a length as a float; an error for anything but a finite number.

    Examples
    --------
    >>> as_length("wall", "1.5 mm")
    Traceback (most recent call last):
    turgor.TurgorError: wall is '1.5 mm'; a finite length in meters is needed, such as 1.5*mm.
    """
    if isinstance(value, bool) or not isinstance(value, Real) or not isfinite(value):
        raise TurgorError(f"{name} is {value!r}; a finite length in meters is needed, such as 1.5*mm.")
    return float(value)


def check_length(name: str, value: object, *, low: float = SMALLEST_LENGTH, high: float, why: str = "") -> None:
    """Raise an error for a length outside ``low`` to ``high``.

    Parameters
    ----------
    name : str
        Field that holds the length.
    value : float [m]
        The length.
    low, high : float [m]
        Allowed range, both ends included.
    why : str
        Reason of the limit, a clause that completes the sentence.

    Raises
    ------
    TurgorError
        If it is not a finite number within the range; a value that would fit in millimeters gets a hint.

    Examples
    --------
    >>> check_length("gap", -1e-3, high=5e-3)
    Traceback (most recent call last):
    turgor.TurgorError: gap is -1 mm; allowed is 0.01 mm to 5 mm.
    >>> check_length("length", 110.0, low=1e-3, high=2.0)
    Traceback (most recent call last):
    turgor.TurgorError: length is 110000 mm; allowed is 1 mm to 2000 mm; is the unit right?
    """
    length = as_length(name, value)
    if low <= length <= high:
        return
    shown = floor(high / mm * 1000 + 1e-6) / 1000  # rounded down, so that the printed number is in the range
    reason = f", {why}" if why else ""
    end = "; is the unit right?" if length >= SUSPICIOUS_LENGTH and low <= length * mm <= high else "."
    raise TurgorError(f"{name} is {in_mm(length)}; allowed is {in_mm(low)} to {shown:.10g} mm{reason}{end}")


def check_count(name: str, value: object, *, low: int, high: int) -> None:
    """Raise an error for a count that is not an integer from ``low`` to ``high``.

    Examples
    --------
    >>> check_count("chambers", 0, low=1, high=100)
    Traceback (most recent call last):
    turgor.TurgorError: chambers is 0; allowed is a whole number from 1 to 100.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= int(value) <= high:
        raise TurgorError(f"{name} is {value!r}; allowed is a whole number from {low} to {high}.")


def check_angle(name: str, value: object, *, low: float, high: float, why: str = "") -> None:
    """Raise an error for an angle [rad] outside ``low`` to ``high``, both included; ``why`` is the reason of the limit.

    Examples
    --------
    >>> check_angle("chamber_angle", 1.2, low=0, high=1.0)
    Traceback (most recent call last):
    turgor.TurgorError: chamber_angle is 68.755 deg; allowed is 0 deg to 57.295 deg.
    """
    if isinstance(value, bool) or not isinstance(value, Real) or not isfinite(value):
        raise TurgorError(f"{name} is {value!r}; a finite angle in radians is needed, such as 30*deg.")
    angle = float(value)
    if low <= angle <= high:
        return
    shown = floor(high / deg * 1000 + 1e-6) / 1000  # rounded down, so that the printed number is in the range
    reason = f", {why}" if why else ""
    raise TurgorError(f"{name} is {angle / deg:.5g} deg; allowed is {low / deg:.5g} deg to {shown:.10g} deg{reason}.")


def check_fields(actuator: Any) -> None:
    """Raise an error for fields of an actuator that are not finite numbers, or not True or False.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> FastPneuNet(symmetric="half")
    Traceback (most recent call last):
    turgor.TurgorError: symmetric is 'half'; allowed is True or False.
    """
    for field in fields(actuator):
        value, dimension = getattr(actuator, field.name), field.metadata.get("dimension", "length")
        if field.type is bool and not isinstance(value, bool):
            raise TurgorError(f"{field.name} is {value!r}; allowed is True or False.")
        if field.type is float and dimension == "length":
            as_length(field.name, value)
        elif field.type is float and dimension == "angle":
            check_angle(field.name, value, low=-inf, high=inf)


def check_choice(name: str, value: object, allowed: Sequence[str]) -> None:
    """Raise an error for a word that is not among the allowed ones.

    Examples
    --------
    >>> check_choice("fold_shape", "round", ("rounded", "straight"))
    Traceback (most recent call last):
    turgor.TurgorError: fold_shape is 'round'; did you mean 'rounded'? Allowed: rounded, straight.
    """
    if value not in allowed:
        hint = near_match(str(value), allowed) or "."
        raise TurgorError(f"{name} is {value!r}{hint} Allowed: {', '.join(allowed)}.")


def check_option(name: str, value: float, *, high: float, why: str = "") -> None:
    """Raise an error for a length that is neither 0, which leaves the feature out, nor in its range.

    Examples
    --------
    >>> check_option("inlet_diameter", 9e-3, high=5e-3, why="so that it ends in the cavity")
    Traceback (most recent call last):
    turgor.TurgorError: inlet_diameter is 9 mm; allowed is 0 (none) or 0.01 mm to 5 mm, so that it ends in the \
cavity.
    """
    if value == 0:
        return
    try:
        check_length(name, value, high=high, why=why)
    except TurgorError as error:
        raise TurgorError(str(error).replace("allowed is ", "allowed is 0 (none) or ")) from None
