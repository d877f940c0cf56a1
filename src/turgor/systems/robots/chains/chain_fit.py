"""Fit of a chain: springs and gains from equilibria of a reduced model and from the tangent of the full one.

At every sampled state the torques of springs, pressures and weight must balance; a joint's error counts as an angle,
its torque over its stiffness. At a few states the chain must answer to loads on its tip as the full model does. This
fixes the size of the stiffness, and by reciprocity the gains: a pressure turns a joint by its gain over its stiffness.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from turgor.systems.robots.backbone import Array
from turgor.systems.robots.chains.chain import Chain

#: Weight of answers to loads on the tip that are off by all of it, all together, over the largest coordinate.
ANSWER = 0.1

#: Repetitions in which the swept volumes follow from the last gains, and the bounds of their growth over the sweep.
REPEATED, GROWTH = 4, 3.0

#: Weight of a spring that is linear.
LINEAR = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class Answers:
    """Coordinates of a chain at a state, and their rates under loads on the tip.

    Parameters
    ----------
    x : (d,) array
    pressures : (p,) array [Pa]
    rates : (l, d) array
        By a unit of each load.
    loads : (l, d) array
        Generalized forces of a unit of each load, and the change of those of the weight.
    own : (d,) int array
        The load that each coordinate answers to: the moment about its axis, or the force along it.
    """

    x: Array
    pressures: Array
    rates: Array
    loads: Array
    own: NDArray[np.int64]

    @property
    def compliance(self) -> Array:
        """Motion (d,) of each coordinate by a unit of its force."""
        at = np.arange(len(self.x))
        return np.asarray(self.rates[self.own, at] / self.loads[self.own, at])


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """What a chain is fitted to.

    Parameters
    ----------
    x : (s, d) array
    pressures : (s, p) array [Pa]
    answers : tuple of Answers
        The first at rest.
    """

    x: Array
    pressures: Array
    answers: tuple[Answers, ...]


def fitted_chain(chain: Chain, samples: Samples, gains: Array) -> Chain:
    """Fit springs, gains and their growth.

    Parameters
    ----------
    chain : Chain
        With its shape and bodies; its springs and gains do not count.
    samples : Samples
    gains : (p, d) array
        At rest, to begin with.

    Returns
    -------
    Chain
    """
    weight = np.array([chain.weight(chain.placed(x)) for x in samples.x])
    sweep = np.abs(samples.x @ gains.T).max(axis=0)
    problem = _Problem(samples, weight, gains, 1 / np.maximum(sweep, 1e-300))

    def misfit(growth: Array) -> Array:
        return problem.solved(growth)[2]

    start = np.zeros(len(gains))
    best = least_squares(misfit, start, bounds=(start - 0.9, start + GROWTH), diff_step=1e-3, max_nfev=20).x
    springs, made, _ = problem.solved(best)
    return replace(chain, springs=springs, gains=made, growth=best * problem.sizes)


@dataclass(frozen=True, slots=True, eq=False)
class _Problem:
    samples: Samples
    weight: Array
    gains: Array
    sizes: Array

    def solved(self, relative: Array) -> tuple[Array, Array, Array]:
        """Springs (d, 3), gains (p, d) and what is left, for growths over the sweep."""
        growth, gains = relative * self.sizes, self.gains
        for _ in range(REPEATED):
            columns = [self._of_coordinate(j, growth, gains) for j in range(self.samples.x.shape[1])]
            gains = np.array([solution[3:] for solution, _ in columns]).T
        springs = np.array([solution[:3] for solution, _ in columns])
        return springs, gains, np.concatenate([left for _, left in columns])

    def _of_coordinate(self, j: int, growth: Array, gains: Array) -> tuple[Array, Array]:
        """Coefficients (3 + p,) of one coordinate by least squares, and what is left."""
        s, x = self.samples, self.samples.x[:, j]
        own = float(s.answers[0].compliance[j])
        size = max(float(np.abs(x).max()), 1e-12)
        swept = 1 + growth * (s.x @ gains.T)
        share = ANSWER * np.sqrt(len(x) / len(s.answers))
        balance = own * np.column_stack([x, x**2, x**3, -s.pressures * swept])
        rows, right = [balance], [own * self.weight[:, j]]
        for each in s.answers:
            load = each.own[j]  # others bend and stretch at once, which springs of single coordinates cannot
            a, rate = each.x[j], each.rates[load, j]
            geometric = each.pressures * growth * (gains @ each.rates[load])
            factor = share * size / each.loads[load, j]
            rows.append(factor * np.array([[rate, 2 * a * rate, 3 * a**2 * rate, *-geometric]]))
            right.append(factor * each.loads[load, j : j + 1])
        still = np.zeros((2, 3 + len(gains)))
        still[0, 1], still[1, 2] = LINEAR * own * size**2, LINEAR * own * size**3
        matrix, value = np.concatenate([*rows, still]), np.concatenate([*right, np.zeros(2)])
        scale = np.maximum(np.linalg.norm(matrix, axis=0), 1e-300)
        solution = np.linalg.lstsq(matrix / scale, value, rcond=1e-10)[0] / scale
        return solution, matrix @ solution - value
