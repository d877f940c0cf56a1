"""next_design: which designs to compute next, to learn most or to come closer to a target."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from turgor.foundation.errors import TurgorError, unknown
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.surrogates.coding import Coding
from turgor.studies.surrogates.settings import SURROGATE
from turgor.studies.surrogates.surrogate import Surrogate

Array = NDArray[np.float64]


def next_design(
    surrogate: Surrogate,
    count: int = 1,
    *,
    target: Mapping[str, float] | None = None,
    avoid: Sequence[Mapping[str, float | int | str]] = (),
    seed: int = 0,
) -> tuple[dict[str, Value], ...]:
    """Choose the designs that are worth computing next.

    Without a target, each is the one with the largest variance that is left once those before are computed: for a
    Gaussian process the variance does not depend on what they will give, so that a batch is spread out. With a target
    it is the one of the largest expected improvement, which those before are taken to bring already (Jones, Schonlau
    and Welch 1998, J. Glob. Optim. 13, 455; for the distance from a target by draws).

    Parameters
    ----------
    surrogate : Surrogate
    count : int
        Designs of the batch, which can be computed at the same time.
    target : mapping of str to float, optional [SI]
        Measures with target values.
    avoid : sequence of mapping [SI]
        Designs that failed, which the surrogate does not know: none near them is chosen.
    seed : int
        Another one gives other candidates.

    Returns
    -------
    tuple of dict of str to float or str [SI]
        Values of the factors; without the drive, because a run goes along it.

    Raises
    ------
    TurgorError
        If ``count`` is below 1 or a measure is unknown.
    """
    if not 1 <= count <= SURROGATE.tried:
        raise TurgorError(f"count is {count}; allowed is 1 to {SURROGATE.tried}.")
    for name in target or {}:
        if name not in surrogate.measures:
            raise unknown("measure of the surrogate", name, surrogate.measures)
    candidates = _candidates(surrogate, avoid, seed)
    chosen = candidates.for_target(count, target) if target else candidates.to_learn(count)
    varied = [each for each in surrogate.factors if each.name != surrogate.along]
    designs = []
    for number in chosen:
        design = surrogate.values_at(candidates.points[number * candidates.each])
        for each in varied:
            if each.whole:
                design[each.name] = round(float(design[each.name]))
        designs.append({each.name: design[each.name] for each in varied})
    return tuple(designs)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Candidates:
    """Designs that are compared.

    Parameters
    ----------
    surrogate : Surrogate
    points : (c·each, w) array
        As inputs of the model; the points of one design stand behind each other.
    each : int
        Points of one design: values of the drive.
    avoided : (a, w) array
        Designs of which none near is chosen, as inputs without the drive.
    """

    surrogate: Surrogate
    points: Array
    each: int
    avoided: Array

    @property
    def count(self) -> int:
        """Number of designs."""
        return len(self.points) // self.each

    def to_learn(self, count: int) -> list[int]:
        """Designs with the largest variance, each after those before are known."""
        scale = np.array([error.range or 1.0 for error in self.surrogate.held_out])
        covariance = self.surrogate.model.covariance(self.points) / scale[:, None, None] ** 2
        noise = 1e-6 * float(np.max(np.einsum("mqq->mq", covariance))) + 1e-15
        chosen: list[int] = []
        for _ in range(count):
            variance = np.einsum("mqq->q", covariance).reshape(self.count, self.each).mean(axis=1)
            variance = variance * self._away(chosen)
            variance[chosen] = -np.inf
            chosen.append(int(np.argmax(variance)))
            place = slice(chosen[-1] * self.each, (chosen[-1] + 1) * self.each)
            block = covariance[:, place, place] + noise * np.eye(self.each)
            across = covariance[:, :, place]
            covariance = covariance - across @ np.linalg.solve(block, across.transpose(0, 2, 1))
        return chosen

    def for_target(self, count: int, target: Mapping[str, float]) -> list[int]:
        """Designs with the largest expected improvement, each given those before."""
        places = [self.surrogate.measures.index(name) for name in target]
        goal = np.array(list(target.values()), dtype=np.float64)
        scale = np.array([self.surrogate.held_out[n].range or 1.0 for n in places])
        computed = np.stack([self.surrogate.held_out[n].computed for n in places], axis=1)
        best = float((((computed - goal) / scale) ** 2).sum(axis=1).min())
        mean, deviation = self.surrogate.spreads(self.surrogate.coding.points(self.points))
        draws = np.random.default_rng(0).standard_normal((SURROGATE.tried, 1, len(places)))
        off = (mean[:, places] + draws * deviation[:, places] - goal) / scale
        distance = (off**2).sum(axis=2).reshape(SURROGATE.tried, self.count, self.each).min(axis=2)
        brought = np.full(SURROGATE.tried, best)
        chosen: list[int] = []
        for _ in range(count):
            gain = np.maximum(brought[:, None] - distance, 0.0).mean(axis=0)
            if gain.max() <= 0:  # nothing is expected to improve: the nearest mean
                gain = -distance.mean(axis=0)
            # points near a chosen one have correlated outcomes, which independent draws do not know
            gain = gain * self._away(chosen) if gain.max() > 0 else gain
            gain[chosen] = -np.inf
            chosen.append(int(np.argmax(gain)))
            brought = np.minimum(brought, distance[:, chosen[-1]])
        return chosen

    def _away(self, chosen: list[int]) -> Array:
        """Factor from 0 at designs that are chosen or avoided to 1 away from them.

        The variance of the process falls near a design, too; the factor separates designs where its kernel is long.
        """
        k = self.avoided.shape[1]
        designs = self.points[:: self.each, :k]
        factor = np.ones(self.count)
        for away in (*designs[chosen], *self.avoided):
            square = ((designs - away) ** 2).sum(axis=1)
            factor *= 1 - np.exp(-square / (2 * 0.1**2))
        return factor


def _at(factor: Factor, share: float) -> float:
    """Return the value of a factor at a share of the range, or of the levels of a choice."""
    if factor.is_choice:
        return factor.number(factor.at(share))
    low, high = factor.bounds
    return low + share * (high - low)


def _candidates(surrogate: Surrogate, avoid: Sequence[Mapping[str, float | int | str]], seed: int) -> _Candidates:
    k = len(surrogate.factors) - bool(surrogate.along)
    coding = Coding(factors=surrogate.factors[:k])
    failed = [[each.number(design[each.name]) for each in coding.factors] for design in avoid]
    avoided = coding.inputs(np.array(failed, dtype=np.float64).reshape(-1, k))
    designs = qmc.Sobol(k, seed=seed).random(SURROGATE.tried)
    # the variance is often largest at the corners, which no sample has
    corners = np.array(np.meshgrid(*[(0.0, 1.0)] * k)).reshape(k, -1).T if k <= 6 else np.zeros((0, k))
    drawn = np.concatenate([corners, designs]).tolist()
    points = [[_at(each, share) for each, share in zip(coding.factors, row, strict=True)] for row in drawn]
    designs = coding.inputs(np.array(points))
    if not surrogate.along:
        return _Candidates(surrogate=surrogate, points=designs, each=1, avoided=avoided)
    drives = np.tile(np.linspace(0.25, 1.0, SURROGATE.points), len(designs))
    along = np.column_stack([np.repeat(designs, SURROGATE.points, axis=0), drives])
    return _Candidates(surrogate=surrogate, points=along, each=SURROGATE.points, avoided=avoided)
