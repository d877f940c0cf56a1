"""Rules of casting: what a mold and its rubber allow, from the dimensions alone, before anything is computed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi, tan
from typing import Any

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.core.geometry.rules import in_mm
from turgor.foundation.errors import TurgorError
from turgor.studies.optimization.rules import Margin, Rule
from turgor.studies.runs.factor import Value
from turgor.units import deg, mm

Make = Callable[[Mapping[str, Value]], Any]
Part = Callable[[Any], tuple[float, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Casting:
    """What can be cast.

    Parameters
    ----------
    smallest_wall : float [m]
        Thinnest wall of the actuator that is filled without holes.
    smallest_web : float [m]
        Thinnest web of the mold, which forms a gap between chambers.
    smallest_pin : float [m]
        Thinnest part of the core, which forms the inside of a chamber.
    draft : float [rad]
        Angle by which webs and cores taper on each side towards their ends, so that the casting comes off; they are at
        least as thick at the end as the two lengths above say.
    deepest : float [-]
        Largest depth of a web or a core over its thickness: longer ones break or hold the casting.
    mold : bool
        Whether the mold must have the webs and pins that are judged here, which molds of PneuNets have.

    Raises
    ------
    TurgorError
        If a number is out of range.
    """

    smallest_wall: float = 1 * mm
    smallest_web: float = 0.8 * mm
    smallest_pin: float = 1.5 * mm
    draft: float = 0.0
    deepest: float = 20.0
    mold: bool = True

    def __post_init__(self) -> None:
        for name in ("smallest_wall", "smallest_web", "smallest_pin"):
            if not 0 <= getattr(self, name) <= 100 * mm:
                raise TurgorError(f"{name} is {in_mm(getattr(self, name))}; allowed is 0 mm to 100 mm.")
        if not 0 <= self.draft <= pi / 6:
            raise TurgorError(f"draft is {self.draft / deg:g} deg; allowed is 0 deg to 30 deg.")
        if not self.deepest >= 1:
            raise TurgorError(f"deepest is {self.deepest:g}; allowed is 1 or more, a depth over a thickness.")


def casting_rules(make: Make, casting: Casting | None = None) -> tuple[Rule, ...]:
    """Return the rules that an actuator must satisfy to be cast.

    Parameters
    ----------
    make : callable
        Function of the values of the factors by name [SI] that returns the actuator, such as a `FastPneuNet`; an error
        of its dimensions breaks the rules.
    casting : Casting, optional
        What can be cast.

    Returns
    -------
    tuple of Rule
        For `optimize`. Webs and cores are known for PneuNets; of other families the walls alone are checked, and only
        with ``mold=False``.

    Raises
    ------
    TurgorError
        If a mold is requested, and there is none for the family.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> rules = casting_rules(lambda values: FastPneuNet(wall=values["wall"], gap=values["gap"]))
    >>> [rule.broken({"wall": 1.5e-3, "gap": 0.5e-3}) for rule in rules if rule.broken({"wall": 1.5e-3, "gap": 0.5e-3})]
    ['web of the mold of at least 0.8 mm', 'web of the mold at most 20 times as deep as thick']
    """
    limits = casting or Casting()
    least = f"walls of at least {in_mm(limits.smallest_wall)}"
    rules = [Rule(least, lambda values: _checked(make, values, limits).smallest_wall - limits.smallest_wall)]
    for words, part, smallest in (("web of the mold", web, limits.smallest_web), ("core", core, limits.smallest_pin)):
        thick = f"{words} of at least {in_mm(smallest)}{_drafted(limits)}"
        rules.append(Rule(thick, _thickness(make, part, smallest, limits)))
        slender = f"{words} at most {limits.deepest:g} times as deep as thick"
        rules.append(Rule(slender, _slenderness(make, part, limits)))
    return tuple(rules)


def _thickness(make: Make, part: Part, smallest: float, casting: Casting) -> Margin:
    """Return by how much a part of the mold is thicker at its end than the smallest thickness."""

    def margin(values: Mapping[str, Value]) -> float:
        thickness, depth = part(_checked(make, values, casting))
        return thickness - 2 * depth * tan(casting.draft) - smallest

    return margin


def _slenderness(make: Make, part: Part, casting: Casting) -> Margin:
    """Return by how much a part of the mold is thicker than its depth demands."""

    def margin(values: Mapping[str, Value]) -> float:
        thickness, depth = part(_checked(make, values, casting))
        return thickness - depth / casting.deepest

    return margin


def web(actuator: Any) -> tuple[float, float]:
    """Return thickness and depth of the webs of the mold between chambers [m]; wide and flat where there are none."""
    if isinstance(actuator, FastPneuNet) and actuator.chambers > 1:
        return actuator.gap, actuator.height - actuator.base - actuator.floor
    return _NONE


def core(actuator: Any) -> tuple[float, float]:
    """Return thickness and depth of the thinnest core of a chamber [m]; wide and flat for families without a mold."""
    if isinstance(actuator, FastPneuNet):
        inner = actuator.end_wall if actuator.chambers == 1 else actuator.wall
        walls = inner + actuator.end_wall  # of the first and the last chamber
        along = actuator.chamber_length - (max(walls, 2 * actuator.wall) if actuator.chambers > 2 else walls)
    elif isinstance(actuator, SlowPneuNet):
        along = (actuator.length - 2 * actuator.end_wall - (actuator.chambers - 1) * actuator.wall) / actuator.chambers
    else:
        return _NONE
    across = actuator.width - 2 * actuator.side_wall
    return min(along, across), actuator.height - actuator.base - actuator.floor - actuator.top_wall


#: A part that no rule finds too thin or too deep [m].
_NONE = (1.0, 0.0)


def _checked(make: Make, values: Mapping[str, Value], casting: Casting) -> Any:
    actuator = make(values)
    if casting.mold and not isinstance(actuator, FastPneuNet | SlowPneuNet):
        raise TurgorError(
            f"there is no mold with webs and pins for {type(actuator).__name__}, only for FastPneuNet and SlowPneuNet; "
            "state mold=False."
        )
    return actuator


def _drafted(casting: Casting) -> str:
    return f" at its end, with a draft of {casting.draft / deg:g} deg" if casting.draft else ""
