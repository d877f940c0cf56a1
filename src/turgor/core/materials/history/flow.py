"""Flow of a network in one step: the principal log strains that are elastic at its end, implicitly.

A network has an isotropic law and the elastic gradient Fₑ. With the gradient of the step the trial is Fₑ = F G, where G
= F_v⁻¹ is what flowed before. The step flows by the exponential map, implicitly (backward Euler), along the principal
axes of the trial:

    εₑ = ε − 3/2 p(q) τ′(εₑ)/q,    G ← G exp(−3/2 p τ′/q)

with the log strains ε of the trial, the Kirchhoff stress τ′ and the equivalent strain p of a `Resistance` (C. Miehe,
Int. J. Numer. Methods Eng. 37 (1994) 1981; J. C. Simo, Comput. Methods Appl. Mech. Eng. 99 (1992) 61). Where p depends
on q alone, the step has a potential in ε, the elastic energy plus that of the flow. Its first derivatives are τ′ and
its second ones H (1 + M H)⁻¹ with H = ∂τ′/∂εₑ, so the tangent is exact and symmetric. Rate and plastic strain of a step
are of first order in its length.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.history.resistance import Resistance
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, stretch_derivatives
from turgor.core.materials.laws.laws import Law

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowSettings:
    """Numbers of the local iteration.

    Parameters
    ----------
    tolerance : float [-]
        Largest last update in log strains; round-off is 1e-15.
    iterations : int
        Most updates; ten suffice for the steps of a run.
    mostly : float [-]
        Share of the trial strain beyond which the equations are solved for the stress.
    """

    tolerance: float = 1e-12
    iterations: int = 50
    mostly: float = 0.5


FLOW = FlowSettings()

_TINY = np.finfo(np.float64).tiny


@dataclass(frozen=True, slots=True, eq=False)
class Flowed:
    """A network at the end of a step.

    Parameters
    ----------
    strain : (3, ...) array
        By which it flowed along the principal axes of the trial, log.
    amount : (...) array
        Equivalent strain p.
    energy : (...) array [Pa]
        Elastic energy density.
    stress : (3, ...) array [Pa]
        Deviator of the Kirchhoff stress; not a number where the iteration did not converge.
    moduli : (3, 3, ...) array [Pa]
        Its derivatives by the log strains of the trial.
    """

    strain: Array
    amount: Array
    energy: Array
    stress: Array
    moduli: Array

    def derivatives(self, bar: Array) -> tuple[Array, Array]:
        """First (3, ...) and second (6, ...) derivatives of the step's potential by the trial stretches [Pa]."""
        second = [
            (self.moduli[i, j] - (self.stress[i] if i == j else 0.0)) / (bar[i] * bar[j]) for i, j in STRETCH_PAIRS
        ]
        return self.stress / bar, np.stack(second)


def flowed(law: Law, share: float, bar: Array, resistance: Resistance) -> Flowed:
    """Let a network flow in a step.

    Parameters
    ----------
    law : Law
    share : float [-]
        Factor on the energy of the law.
    bar : (3, ...) array
        Isochoric principal stretches of the trial.
    resistance : Resistance
        Of points of the shape (...).

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> stiff = Resistance(np.array([1e5]), 1.0, 0.0, np.zeros(1))
    >>> flowed(NeoHooke(C10=1e5), 1.0, np.array([[1.5], [1.5**-0.5], [1.5**-0.5]]), stiff).amount.round(4)
    array([0.349])
    """
    shape = bar.shape[1:]
    trial = np.log(bar.reshape(3, -1))
    flat = Resistance(resistance.stress.ravel(), resistance.exponent, resistance.onset, resistance.hardened.ravel())
    W, s, H = _elastic(law, share, trial)
    q = _mises(s)
    flows = flat.amount(q)[0] > FLOW.tolerance
    elastic = trial.copy()
    if flows.any():
        elastic[:, flows] = _solved(law, share, trial[:, flows], (s[:, flows], q[flows]), flat.at(flows))
        W[flows], s[:, flows], H[:, :, flows] = _elastic(law, share, elastic[:, flows])
        H[:, :, flows] = _consistent(H[:, :, flows], _compliance(s[:, flows], flat.at(flows)))
    strain = trial - elastic
    return Flowed(
        strain.reshape(3, *shape), _equivalent(strain).reshape(shape), W.reshape(shape), s.reshape(3, *shape),
        H.reshape(3, 3, *shape),
    )  # fmt: skip


def _elastic(law: Law, share: float, strain: Array) -> tuple[Array, Array, Array]:
    """Energy (n,), stress deviator (3, n) and its derivatives (3, 3, n) at elastic log strains (3, n)."""
    bar = np.exp(strain)
    W = [share * each for each in stretch_derivatives(law, *bar)]
    t = bar * np.stack(W[1:4])
    h = np.empty((3, 3, bar.shape[1]))
    for (i, j), second in zip(STRETCH_PAIRS, W[4:], strict=True):
        h[i, j] = h[j, i] = bar[i] * bar[j] * second + (t[i] if i == j else 0.0)
    rows = h.mean(axis=1)
    return W[0].copy(), t - t.mean(axis=0), h - rows[:, None] - rows[None] + rows.mean(axis=0)


def _mises(s: Array) -> Array:
    return np.asarray(np.sqrt(1.5 * (s**2).sum(axis=0)))


def _compliance(s: Array, resistance: Resistance) -> Array:
    """M (3, 3, n): ∂(3/2 p s/q)/∂s."""
    q = np.maximum(_mises(s), _TINY)
    p, slope = resistance.amount(q)
    factor, rate = 1.5 * p / q, 1.5 * (slope - p / q) / q
    return np.asarray(factor * np.eye(3)[..., None] + 1.5 * rate / q * s[:, None] * s[None])


def _consistent(H: Array, M: Array) -> Array:
    """H (1 + M H)⁻¹, (3, 3, n)."""
    h, m = np.moveaxis(H, -1, 0), np.moveaxis(M, -1, 0)
    out = np.swapaxes(np.linalg.solve(np.swapaxes(np.eye(3) + m @ h, -1, -2), np.swapaxes(h, -1, -2)), -1, -2)
    return np.moveaxis(0.5 * (out + np.swapaxes(out, -1, -2)), 0, -1)


def _solved(law: Law, share: float, trial: Array, known: tuple[Array, Array], resistance: Resistance) -> Array:
    """Elastic log strains (3, n) of points that flow, by Newton's method; not numbers where it does not converge.

    ``known`` are stress and Mises stress of the trial. Where most of the trial flows the equations are solved for the
    stress, elsewhere for the strain: each is nearly linear there, the other a high power.
    """
    s, q = known
    p = _first_guess(trial, q, resistance)
    elastic, result = trial - 1.5 * p * s / q, np.full(trial.shape, np.nan)
    flowing = p > FLOW.mostly * _equivalent(trial)
    for points, update in ((flowing, _by_stress), (~flowing, _by_strain)):
        left = np.flatnonzero(points)
        for _ in range(FLOW.iterations):
            if not len(left):
                break
            _, s, H = _elastic(law, share, elastic[:, left])
            change = update(elastic[:, left] - trial[:, left], s, H, resistance.at(left))
            elastic[:, left] += change
            done = np.abs(change).max(axis=0) < FLOW.tolerance
            result[:, left[done]] = elastic[:, left[done]]
            left = left[~done & np.isfinite(change).all(axis=0)]
    return result


def _by_strain(lost: Array, s: Array, H: Array, resistance: Resistance) -> Array:
    """Update of εₑ (3, n) from εₑ − ε + 3/2 p(q) s/q = 0; ``lost`` is εₑ − ε."""
    q = np.maximum(_mises(s), _TINY)
    residual = lost + 1.5 * resistance.amount(q)[0] * s / q
    J = np.eye(3) + np.moveaxis(_compliance(s, resistance), -1, 0) @ np.moveaxis(H, -1, 0)
    return _step(J, residual)


def _by_stress(lost: Array, s: Array, H: Array, resistance: Resistance) -> Array:
    """Update of εₑ (3, n) from s + 2/3 q(p) (εₑ − ε)/p = 0."""
    p = np.maximum(_equivalent(lost), _TINY)
    q, slope = resistance.bound(p), resistance.slope(p)
    Y = 2.0 / 3.0 * (q / p * np.eye(3)[..., None] + (slope - q / p) / p * (2.0 / 3.0 / p) * lost[:, None] * lost[None])
    return _step(np.moveaxis(H + Y, -1, 0), s + 2.0 / 3.0 * q / p * lost)


def _step(J: Array, residual: Array) -> Array:
    """−J⁻¹ r (3, n); not numbers where J (n, 3, 3) is not finite."""
    out, finite = np.full(residual.shape, np.nan), np.isfinite(J).all(axis=(1, 2))
    out[:, finite] = -np.linalg.solve(J[finite], residual.T[finite, :, None])[..., 0].T
    return out


def _equivalent(strain: Array) -> Array:
    return np.asarray(np.sqrt(2.0 / 3.0 * (strain**2).sum(axis=0)))


def _first_guess(trial: Array, q: Array, resistance: Resistance) -> Array:
    """Equivalent strain if the network kept its secant modulus: Newton's method from above on a convex function."""
    strain = _equivalent(trial)
    modulus = q / strain
    x = np.minimum(q, resistance.bound(strain))
    for _ in range(8):
        p, slope = resistance.amount(x)
        x = x - (x + modulus * p - q) / (1.0 + modulus * slope)
    return np.asarray((q - x) / modulus)
