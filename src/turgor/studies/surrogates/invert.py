"""invert: find inputs that give target outputs, by a surrogate."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, minimize
from scipy.stats import qmc

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column
from turgor.studies.runs.factor import Value
from turgor.studies.runs.study import values_text
from turgor.studies.surrogates.settings import SURROGATE
from turgor.studies.surrogates.surrogate import Prediction, Surrogate

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Inverse:
    """Inputs that give target outputs.

    Parameters
    ----------
    values : mapping of str to float or str [SI]
        Every factor, those that were fixed, too.
    deviations : mapping of str to float [SI]
        Standard deviation of the unknown numbers, from that of the surrogate; infinite where the outputs do
        not depend on one.
    target : mapping of str to float [SI]
    prediction : Prediction
        What the surrogate gives there.
    reached : bool
        Whether the surrogate gives the target.
    others : tuple of mapping
        Further inputs that give the same, far from these.
    shown : str
        The inputs as text with their units.
    """

    values: Mapping[str, Value]
    deviations: Mapping[str, float]
    target: Mapping[str, float]
    prediction: Prediction
    reached: bool
    others: tuple[Mapping[str, Value], ...]
    shown: str

    def sentence(self) -> str:
        """Return the answer in a sentence; where no inputs give the target, how close they get."""
        given = ", ".join(f"{self._words(name)} {self.prediction.text(name)}" for name in self.target)
        more = f" {len(self.others)} other solutions lie in the range." if self.others else ""
        if self.reached:
            return f"{self.shown} give {given}.{more}"
        off = ", ".join(
            f"{self._words(name)} {self._text(name, self.prediction[name] - value, '+')} off {self._text(name, value)}"
            for name, value in self.target.items()
        )
        return f"Nothing in the range gives that. The closest, {self.shown}, gives {given}: {off}."

    def _text(self, name: str, value: float, sign: str = "") -> str:
        unit = self.prediction.units[name]
        shown = Column(name, unit, np.array([value])).in_unit[0]
        return f"{shown:{sign}.4g} {unit}".rstrip()

    @staticmethod
    def _words(name: str) -> str:
        return name.replace("_", " ")


def invert(
    surrogate: Surrogate,
    target: Mapping[str, float],
    *,
    fixed: Mapping[str, Value] | None = None,
    prefer: Mapping[str, Value] | None = None,
) -> Inverse:
    """Find inputs within the range that give target outputs: from shape to pressures.

    The distance of all outputs, each over its range, is minimized from several starts (bounded least squares with the
    exact slopes of the surrogate). If there are more unknown inputs than target outputs, many inputs give the same;
    then those nearest to the preferred ones are returned, each difference over the range of its factor. Of choices, all
    combinations are searched; another choice than the preferred one counts as far as a whole range.

    Parameters
    ----------
    surrogate : Surrogate
    target : mapping of str to float [SI]
        By the name of the measure.
    fixed : mapping of str to float or str, optional [SI]
        Factors that are given, such as the dimensions of the actuator at hand.
    prefer : mapping of str to float or str, optional [SI]
        Factors with their preferred values; by default the middle of each range, and no choice.

    Returns
    -------
    Inverse
        With the closest inputs where none gives the target.

    Raises
    ------
    TurgorError
        If a name is unknown, a fixed or preferred value lies beyond the range, or nothing is left to seek.
    """
    fixed = fixed or {}
    ends = [(each, end) for each in _searches(surrogate, target, fixed, prefer or {}) for end in each.ends()]
    best = min(search.distance(end) for search, end in ends)
    good = [(each, end) for each, end in ends if each.distance(end) <= max(SURROGATE.reached, best * (1 + 1e-3))]
    nearest = [(search, search.nearest(end)) for search, end in good]
    nearest.sort(key=lambda each: each[0].from_preferred(each[1]))
    search, share = nearest[0]
    reached = search.distance(share) <= SURROGATE.reached
    values = search.values(share)
    return Inverse(
        values=values,
        deviations=search.deviations(share),
        target=dict(target),
        prediction=surrogate.predict(values),
        reached=reached,
        others=tuple(each.values(other) for each, other in _others(nearest)) if reached else (),
        shown=values_text(surrogate.factors, values),
    )


def _others(nearest: "Sequence[tuple[_Search, Array]]") -> "list[tuple[_Search, Array]]":
    """Return solutions that are far from the first one and from each other.

    With fewer outputs than numbers, the solutions of one combination of choices are a continuum, of which one counts.
    """
    distinct = [nearest[0]]
    for search, share in nearest[1:]:
        same = [other for each, other in distinct if each is search]
        isolated = len(search.outputs) >= len(search.free)
        if not same or (isolated and all(float(np.abs(share - other).max(initial=0.0)) > 0.02 for other in same)):
            distinct.append((search, share))
    return distinct[1:]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Search:
    """A search over the shares of the free numbers; choices are fixed.

    Parameters
    ----------
    surrogate : Surrogate
    outputs : list of int
        Places of the target measures.
    target, scale : (w,) array [SI]
        Values, and the range of each.
    point : (w,) array
        Inputs of the model; those of free numbers are replaced.
    free : list of int
        Places of the unknown numbers among the factors.
    preferred : (f,) array
        Shares.
    apart : int
        Number of choices that are not the preferred ones.
    """

    surrogate: Surrogate
    outputs: list[int]
    target: Array
    scale: Array
    point: Array
    free: list[int]
    preferred: Array
    apart: int

    @property
    def columns(self) -> list[int]:
        """Places of the free numbers among the inputs."""
        return [self.surrogate.coding.columns(n).start for n in self.free]

    def off(self, share: Array) -> Array:
        """Return the differences from the target, over the ranges."""
        return np.asarray(
            (self.surrogate.model.mean(self._whole(share)[None])[0][self.outputs] - self.target) / self.scale
        )

    def slope(self, share: Array) -> Array:
        """Return the derivatives of `off`, (w, f)."""
        table = self.surrogate.model.slope(self._whole(share))
        return np.asarray(table[np.ix_(self.outputs, self.columns)] / self.scale[:, None])

    def distance(self, share: Array) -> float:
        """Return the largest difference over its range."""
        return float(np.abs(self.off(share)).max())

    def from_preferred(self, share: Array) -> float:
        """Return the distance from the preferred inputs."""
        return float(np.sum((share - self.preferred) ** 2)) + self.apart

    def ends(self) -> list[Array]:
        """Return where searches from the best points of the range end."""
        if not self.free:
            return [np.zeros(0)]
        tried = qmc.Sobol(len(self.free), seed=0).random(SURROGATE.tried)
        points = np.tile(self.point, (SURROGATE.tried, 1))
        points[:, self.columns] = tried
        off = (self.surrogate.model.mean(points)[:, self.outputs] - self.target) / self.scale
        starts = [self.preferred, *_far_apart(tried, (off**2).sum(axis=1), SURROGATE.starts)]
        ends = []
        for start in starts:
            # a start on a bound cannot move along it
            inner = np.clip(start, 1e-6, 1 - 1e-6)
            ended = least_squares(self.off, inner, self.slope, bounds=(0.0, 1.0), xtol=1e-12, ftol=1e-12, gtol=1e-12)
            ends.append(np.asarray(ended.x))
        return ends

    def nearest(self, share: Array) -> Array:
        """Return the inputs nearest to the preferred ones that give the same outputs."""
        if len(self.outputs) >= len(self.free):
            return share
        same = self.off(share)
        ended = minimize(
            self.from_preferred,
            share,
            jac=lambda at: 2 * (at - self.preferred),
            bounds=[(0.0, 1.0)] * len(self.free),
            constraints={"type": "eq", "fun": lambda at: self.off(at) - same, "jac": self.slope},
            method="SLSQP",
            options={"ftol": 1e-12, "maxiter": 200},
        )
        at = np.clip(ended.x, 0.0, 1.0)
        return at if float(np.abs(self.off(at) - same).max()) < SURROGATE.reached / 2 else share

    def values(self, share: Array) -> dict[str, Value]:
        """Return the factors [SI] at shares of the free ones."""
        return self.surrogate.values_at(self._whole(share))

    def deviations(self, share: Array) -> dict[str, float]:
        """Return the standard deviations of the free factors: those of the outputs through the inverse slopes."""
        _, deviation = self.surrogate.spreads(self.surrogate.coding.points(self._whole(share))[None])
        slope = self.slope(share)
        spread = deviation[0][self.outputs] / self.scale
        back = np.linalg.pinv(slope, rcond=1e-9) * spread
        deviations = {}
        for n, place in enumerate(self.free):
            factor = self.surrogate.factors[place]
            low, high = factor.bounds
            size = float(np.sqrt((back[n] ** 2).sum()))
            deviations[factor.name] = size * (high - low) if np.abs(slope[:, n]).max() > 1e-9 else float("inf")
        return deviations

    def _whole(self, share: Array) -> Array:
        point = self.point.copy()
        point[self.columns] = share
        return point


def _searches(
    surrogate: Surrogate, target: Mapping[str, float], fixed: Mapping[str, Value], prefer: Mapping[str, Value]
) -> list[_Search]:
    """Return a search for each combination of the choices that are not fixed."""
    _check(surrogate, target, (*fixed, *prefer))
    choices = [each for each in surrogate.factors if each.is_choice and each.name not in fixed]
    count = prod(len(each.levels) for each in choices)
    if count > SURROGATE.tried:
        raise TurgorError(
            f"{count} combinations of choices are too many; up to {SURROGATE.tried} are searched. Hold some."
        )
    free = [n for n, each in enumerate(surrogate.factors) if not each.is_choice and each.name not in fixed]
    if not free and not choices:
        names = ", ".join(each.name for each in surrogate.factors)
        raise TurgorError(f"all factors are fixed ({names}); there is nothing to search.")
    wished = {each.name: each.levels[int(each.number(prefer[each.name]))] for each in choices if each.name in prefer}
    searches = []
    for levels in product(*(each.levels for each in choices)):
        chosen = {each.name: level for each, level in zip(choices, levels, strict=True)}
        apart = sum(chosen[name] != level for name, level in wished.items())
        searches.append(_search(surrogate, target, {**prefer, **fixed, **chosen}, free, apart))
    return searches


def _check(surrogate: Surrogate, target: Mapping[str, float], given: Sequence[str]) -> None:
    """Raise an error for names that are unknown, and for target values that are not finite."""
    names = [each.name for each in surrogate.factors]
    for name in target:
        if name not in surrogate.measures:
            raise unknown("measure of the surrogate", name, surrogate.measures)
        if not np.isfinite(target[name]):
            raise TurgorError(f"'{name}' is {target[name]}; a finite number is needed.")
    for name in given:
        if name not in names:
            raise unknown("factor of the surrogate", name, names)
    if not target:
        raise TurgorError("nothing is wanted; name a measure and its value.")


def _search(
    surrogate: Surrogate, target: Mapping[str, float], known: Mapping[str, Value], free: list[int], apart: int
) -> _Search:
    middle = {each.name: sum(each.bounds) / 2 for each in surrogate.factors if not each.is_choice}
    point = surrogate.point({**middle, **known})
    surrogate.means(point[None])  # refuses what lies beyond the ranges
    shares = surrogate.shares(point)
    outputs = [surrogate.measures.index(name) for name in target]
    scale = np.array([surrogate.held_out[n].range or 1.0 for n in outputs])
    return _Search(
        surrogate=surrogate, outputs=outputs, target=np.array(list(target.values()), dtype=np.float64), scale=scale,
        point=shares, free=free, preferred=shares[[surrogate.coding.columns(n).start for n in free]], apart=apart,
    )  # fmt: skip


def _far_apart(points: Array, costs: Array, count: int) -> list[Array]:
    """The best points of which none lies near a better one."""
    apart: list[Array] = []
    for n in np.argsort(costs):
        if all(float(np.abs(points[n] - each).max()) > 0.15 for each in apart):
            apart.append(points[n])
        if len(apart) == count:
            break
    return apart
