"""invert: find inputs that give wanted outputs, by a surrogate."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, minimize
from scipy.stats import qmc

from turgor.errors import TurgorError, unknown
from turgor.response import Column
from turgor.study.study import told
from turgor.surrogates.surrogate import Prediction, Surrogate

Array = NDArray[np.float64]

#: Points of the range that are tried (a power of two), and searches that start from the best of them.
TRIED, STARTS = 512, 6

#: Distance below which wanted outputs count as reached, as a share of the range of each.
REACHED = 1e-4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Inverse:
    """Inputs that give wanted outputs.

    Parameters
    ----------
    values : mapping of str to float [SI]
        Every factor, those that were held too.
    deviations : mapping of str to float [SI]
        Standard deviation of the factors that were sought, from that of the surrogate; infinite where the outputs do
        not depend on one.
    wanted : mapping of str to float [SI]
    prediction : Prediction
        What the surrogate gives there.
    reached : bool
        Whether the surrogate gives what was wanted.
    others : tuple of mapping
        Further inputs that give the same, far from these.
    shown : str
        The inputs as text with their units.
    """

    values: Mapping[str, float]
    deviations: Mapping[str, float]
    wanted: Mapping[str, float]
    prediction: Prediction
    reached: bool
    others: tuple[Mapping[str, float], ...]
    shown: str

    def sentence(self) -> str:
        """Return the answer in a sentence; where nothing gives what was wanted, how close it gets."""
        given = ", ".join(f"{self._words(name)} {self.prediction.told(name)}" for name in self.wanted)
        more = f" {len(self.others)} other solutions lie in the range." if self.others else ""
        if self.reached:
            return f"{self.shown} give {given}.{more}"
        off = ", ".join(
            f"{self._words(name)} {self._text(name, self.prediction[name] - value, '+')} off {self._text(name, value)}"
            for name, value in self.wanted.items()
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
    wanted: Mapping[str, float],
    *,
    held: Mapping[str, float] | None = None,
    prefer: Mapping[str, float] | None = None,
) -> Inverse:
    """Find inputs within the range that give wanted outputs: from shape to pressures.

    The distance of all outputs, each over its range, is minimized from several starts (bounded least squares with the
    exact slopes of the surrogate). Where more inputs are sought than outputs are wanted, many inputs give the same;
    then those nearest to the preferred ones are returned, each difference over the range of its factor.

    Parameters
    ----------
    surrogate : Surrogate
    wanted : mapping of str to float [SI]
        By the name of the measure.
    held : mapping of str to float, optional [SI]
        Factors that are given, such as the dimensions of the actuator at hand.
    prefer : mapping of str to float, optional [SI]
        Factors with their preferred values; by default the middle of each range.

    Returns
    -------
    Inverse
        With the closest inputs where none gives what was wanted.

    Raises
    ------
    TurgorError
        If a name is unknown, a held or preferred value lies beyond the range, or nothing is left to seek.
    """
    search = _search(surrogate, wanted, held or {}, prefer or {})
    ends = search.ends()
    best = min(search.distance(end) for end in ends)
    good = [end for end in ends if search.distance(end) <= max(REACHED, best * (1 + 1e-3))]
    nearest = [search.nearest(end) for end in good]
    nearest.sort(key=search.from_preferred)
    share = nearest[0]
    reached = search.distance(share) <= REACHED
    # with fewer outputs than inputs, solutions are a continuum and not counted
    apart = nearest[1:] if reached and len(wanted) >= len(search.free) else []
    others: list[Array] = []
    for each in apart:
        if all(float(np.abs(each - one).max()) > 0.02 for one in (share, *others)):
            others.append(each)
    values = search.values(share)
    return Inverse(
        values=values,
        deviations=search.deviations(share),
        wanted=dict(wanted),
        prediction=surrogate.predict(values),
        reached=reached,
        others=tuple(search.values(each) for each in others),
        shown=told(surrogate.factors, values),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Search:
    """A search over the shares of the free factors.

    Parameters
    ----------
    surrogate : Surrogate
    outputs : list of int
        Places of the wanted measures.
    wanted, scale : (w,) array [SI]
        Values, and the range of each.
    point : (k,) array
        Shares of all factors; those of free ones are replaced.
    free : list of int
        Places of the factors that are sought.
    preferred : (f,) array
        Shares.
    """

    surrogate: Surrogate
    outputs: list[int]
    wanted: Array
    scale: Array
    point: Array
    free: list[int]
    preferred: Array

    def off(self, share: Array) -> Array:
        """Return the differences from what is wanted, over the ranges."""
        return np.asarray(
            (self.surrogate.model.mean(self._whole(share)[None])[0][self.outputs] - self.wanted) / self.scale
        )

    def slope(self, share: Array) -> Array:
        """Return the derivatives of `off`, (w, f)."""
        table = self.surrogate.model.slope(self._whole(share))
        return np.asarray(table[np.ix_(self.outputs, self.free)] / self.scale[:, None])

    def distance(self, share: Array) -> float:
        """Return the largest difference over its range."""
        return float(np.abs(self.off(share)).max())

    def from_preferred(self, share: Array) -> float:
        """Return the distance from the preferred inputs."""
        return float(np.sum((share - self.preferred) ** 2))

    def ends(self) -> list[Array]:
        """Return where searches from the best points of the range end."""
        tried = qmc.Sobol(len(self.free), seed=0).random(TRIED)
        points = np.tile(self.point, (TRIED, 1))
        points[:, self.free] = tried
        off = (self.surrogate.model.mean(points)[:, self.outputs] - self.wanted) / self.scale
        starts = [self.preferred, *_far_apart(tried, (off**2).sum(axis=1), STARTS)]
        found = []
        for start in starts:
            # a start on a bound cannot move along it
            inner = np.clip(start, 1e-6, 1 - 1e-6)
            ended = least_squares(self.off, inner, self.slope, bounds=(0.0, 1.0), xtol=1e-12, ftol=1e-12, gtol=1e-12)
            found.append(np.asarray(ended.x))
        return found

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
        return at if float(np.abs(self.off(at) - same).max()) < REACHED / 2 else share

    def values(self, share: Array) -> dict[str, float]:
        """Return the factors [SI] at shares of the free ones."""
        names = [each.name for each in self.surrogate.factors]
        return dict(zip(names, self.surrogate.at_shares(self._whole(share)).tolist(), strict=True))

    def deviations(self, share: Array) -> dict[str, float]:
        """Return the standard deviations of the free factors: those of the outputs through the inverse slopes."""
        _, deviation = self.surrogate.spreads(self.surrogate.at_shares(self._whole(share))[None])
        slope = self.slope(share)
        spread = deviation[0][self.outputs] / self.scale
        back = np.linalg.pinv(slope, rcond=1e-9) * spread
        found = {}
        for n, place in enumerate(self.free):
            factor = self.surrogate.factors[place]
            low, high = factor.bounds
            size = float(np.sqrt((back[n] ** 2).sum()))
            found[factor.name] = size * (high - low) if np.abs(slope[:, n]).max() > 1e-9 else float("inf")
        return found

    def _whole(self, share: Array) -> Array:
        point = self.point.copy()
        point[self.free] = share
        return point


def _search(
    surrogate: Surrogate, wanted: Mapping[str, float], held: Mapping[str, float], prefer: Mapping[str, float]
) -> _Search:
    names = [each.name for each in surrogate.factors]
    for name in wanted:
        if name not in surrogate.measures:
            raise unknown("measure of the surrogate", name, surrogate.measures)
        if not np.isfinite(wanted[name]):
            raise TurgorError(f"'{name}' is {wanted[name]}; a finite number is needed.")
    for name in (*held, *prefer):
        if name not in names:
            raise unknown("factor of the surrogate", name, names)
    if not wanted:
        raise TurgorError("nothing is wanted; name a measure and its value.")
    free = [n for n, name in enumerate(names) if name not in held]
    if not free:
        raise TurgorError("all factors are held; there is nothing to seek.")
    middle = surrogate.at_shares(np.full(len(names), 0.5))
    point = np.array([{**prefer, **held}.get(name, value) for name, value in zip(names, middle, strict=True)])
    surrogate.means(point[None])  # refuses what lies beyond the ranges
    shares = surrogate.shares(point)
    outputs = [surrogate.measures.index(name) for name in wanted]
    scale = np.array([surrogate.held_out[n].range or 1.0 for n in outputs])
    return _Search(
        surrogate=surrogate, outputs=outputs, wanted=np.array(list(wanted.values()), dtype=np.float64), scale=scale,
        point=shares, free=free, preferred=shares[free],
    )  # fmt: skip


def _far_apart(points: Array, costs: Array, count: int) -> list[Array]:
    """The best points of which none lies near a better one."""
    found: list[Array] = []
    for n in np.argsort(costs):
        if all(float(np.abs(points[n] - each).max()) > 0.15 for each in found):
            found.append(points[n])
        if len(found) == count:
            break
    return found
