"""Reach: how far each dimension of a family can move while all others stay.

The range that a family states for a dimension is that of its own rule; others may break before. A slider must not get
there, so its ends are searched by trying.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.units import UNITS

#: Trials of a bisection: the end is found to a thousandth of the way to it.
TRIALS = 10

#: Digits of an end, rounded towards the value.
DIGITS = 4


def reach(actuator: Any, key: str, limits: dict[str, Any]) -> dict[str, Any] | None:
    """Return the limits of a dimension within which the actuator is possible; None where there is no room.

    Parameters
    ----------
    actuator : dataclass
        A family with its dimensions.
    key : str
    limits : dict
        ``low``, ``high``, ``unit`` and ``zero`` from the sentence on the key.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> stated = {"low": 0.01, "high": 9.995, "unit": "mm", "zero": False}
    >>> reach(FastPneuNet(), "side_wall", stated)["high"]  # the channel of 3 mm must fit
    8.488
    """
    unit = limits["unit"]
    size = next((units[unit] for units in UNITS.values() if unit in units), 1.0) if unit else 1

    def right(value: float) -> bool:
        try:
            replace(actuator, **{key: value * size if unit else round(value)})
        except TurgorError:
            return False
        return True

    value = getattr(actuator, key) / size
    if limits["zero"] and value < limits["low"]:
        value = limits["low"]  # a slider that moves turns on what a zero left out
    if not right(value):
        return None
    end = _end if unit else _whole_end
    low, high = end(right, value, limits["low"]), end(right, value, limits["high"])
    return {**limits, "low": low, "high": high} if low < high else None


def _end(right: Callable[[float], bool], value: float, end: float) -> float:
    """The farthest right value on the way to an end, by bisection."""
    good, bad = value, end
    if right(end):
        return end
    for _ in range(TRIALS):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if right(middle) else (good, middle)
    rounded = float(f"{good:.{DIGITS}g}")
    return rounded if right(rounded) else good


def _whole_end(right: Callable[[float], bool], value: float, end: float) -> float:
    """The last of the whole numbers without a gap on the way to an end."""
    way = 1 if end > value else -1
    number = value
    while number != end and right(number + way):
        number += way
    return number
