"""Finite linear viscoelasticity: a Prony series on the isochoric stress, and its update over one step of time.

The instantaneous stress S₀ of the law relaxes in n internal stresses Hᵢ that live in the reference configuration:

    S = (1 − Σ gᵢ) S₀ + Σ gᵢ Hᵢ,    dHᵢ/dt + Hᵢ/τᵢ = dS₀/dt

(J. C. Simo, Comput. Methods Appl. Mech. Eng. 60 (1987) 153, doi 10.1016/0045-7825(87)90107-1). All these stresses are
scaled second Piola–Kirchhoff stresses J^(2/3) S of the isochoric part alone; the mean stress does not relax. Abaqus
pushes the same history forward to the current configuration, so its constants mean the same here. Over a step Δt with
x = Δt/τᵢ the stress S₀ is taken as linear in time, which gives the exact recursion

    Hᵢ ← exp(−x) Hᵢ + (1 − exp(−x))/x · (S₀,new − S₀,old)

of second order in Δt. Hence S = γ S₀,new + h with a number γ and a stress h that is known before the step: see
`step_factor` and `remembered_stress`. Δt = 0 gives the instantaneous response, Δt = ∞ the fully relaxed one.

**In an engine.** Arrays (c, q, 6) hold tensor components 11 22 33 12 23 13. Once per step: γ and h. In every iteration:
multiply the derivatives of the law's energy, first and second, by γ; add `isochoric_stress(h, C)` to the second
Piola–Kirchhoff stress and `isochoric_tangent(h, C)` to the material tangent; both are in
`turgor.core.materials.history.isochoric`. Together they are the exact derivatives of γ W + ½ h : C̄ with C̄ = J^(−2/3)
C, so the tangent stays symmetric. Once per accepted step: `next_memory` with S₀,new, the `scaled_stress` of the law
itself, without γ. Where the rubber also softens, `turgor.core.materials.history.softening` comes first, and W and S₀
are those of the softened rubber.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]

#: Meaning of the constants of the law, in the terms of Abaqus: an infinitely fast test, or an infinitely slow one.
MODULI = ("instantaneous", "long_term")


@dataclass(frozen=True, slots=True, kw_only=True)
class Prony:
    """Prony series of the isochoric response: modulus over its instantaneous value, 1 − Σ gᵢ (1 − exp(−t/τᵢ)).

    Parameters
    ----------
    g : tuple of float [-]
        Relaxed share of each term, positive; their sum below 1.
    tau : tuple of float [s]
        Relaxation time of each term.
    moduli : str
        What the constants of the law mean: ``"instantaneous"`` or ``"long_term"``, as in Abaqus, which takes long_term
        by default. The two differ by the factor 1 − Σ gᵢ, so one must be chosen.

    Examples
    --------
    >>> silicone = Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli="instantaneous")
    >>> silicone.modulus([0.0, 1.0, 1e9]).round(4)
    array([1.    , 0.8641, 0.7   ])
    """

    g: tuple[float, ...]
    tau: tuple[float, ...]
    moduli: str

    def __post_init__(self) -> None:
        for name in ("g", "tau"):
            object.__setattr__(self, name, _numbers(name, getattr(self, name)))
        if len(self.g) != len(self.tau) or not self.g:
            raise TurgorError(f"Prony: g has {len(self.g)} terms and tau {len(self.tau)}; as many, at least one.")
        for name, values in (("g", self.g), ("tau", self.tau)):
            if not all(0 < value < np.inf for value in values):
                raise TurgorError(f"Prony: {name} is {values}; every entry must be more than 0 and finite.")
        if not sum(self.g) < 1:
            raise TurgorError(f"Prony: the sum of g is {sum(self.g):g}; it must be below 1.")
        if self.moduli not in MODULI:
            raise unknown("moduli", str(self.moduli), MODULI)

    @property
    def relaxed(self) -> float:
        """Long-term over instantaneous modulus, 1 − Σ gᵢ [-]."""
        return 1.0 - sum(self.g)

    @property
    def instantaneous(self) -> float:
        """Instantaneous modulus over that of the law as written [-]."""
        return 1.0 if self.moduli == "instantaneous" else 1.0 / self.relaxed

    def modulus(self, time: ArrayLike) -> Array:
        """Modulus a time after a sudden stretch, over that of the law as written.

        Parameters
        ----------
        time : (n,) array [s]
            Times since the stretch.
        """
        t = np.asarray(time, dtype=np.float64)[..., None]
        lost = -np.expm1(-t / np.array(self.tau)) @ np.array(self.g)
        return np.asarray(self.instantaneous * (1.0 - lost))


def memory_at_rest(series: Prony, shape: tuple[int, ...]) -> Array:
    """Return the internal variables of points that have never been stretched.

    Parameters
    ----------
    series : Prony
        With n terms.
    shape : tuple of int
        Shape of the points, such as (c, q).

    Returns
    -------
    (n + 1, *shape, 6) array [Pa]
        First S₀ at the end of the last step, then the internal stresses; all zero.

    Examples
    --------
    >>> memory_at_rest(Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli="instantaneous"), (8, 4)).shape
    (3, 8, 4, 6)
    """
    return np.zeros((len(series.g) + 1, *shape, 6))


def step_factor(series: Prony, step: float) -> float:
    """Return γ, by which the stress and the tangent of the law are multiplied in a step.

    Parameters
    ----------
    series : Prony
        The series.
    step : float [s]
        Length Δt of the step; 0 for an instantaneous one, infinite for a relaxed equilibrium.

    Examples
    --------
    >>> series = Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli="instantaneous")
    >>> [round(step_factor(series, step), 6) for step in (0.0, 1.0, float("inf"))]
    [1.0, 0.921587, 0.7]
    """
    rise = _shares(series, step)[1]
    return series.instantaneous * (series.relaxed + float(np.dot(series.g, rise)))


def remembered_stress(series: Prony, step: float, memory: Array) -> Array:
    """Return h, the part of the scaled isochoric stress that is known before a step.

    Parameters
    ----------
    series : Prony
        With n terms.
    step : float [s]
        Length of the step.
    memory : (n + 1, ..., 6) array [Pa]
        Internal variables at the beginning of the step.

    Returns
    -------
    (..., 6) array [Pa]
    """
    decay, rise = _shares(series, step)
    g = np.array(series.g)
    return np.asarray(series.instantaneous * (np.tensordot(g * decay, memory[1:], 1) - (g @ rise) * memory[0]))


def next_memory(series: Prony, step: float, memory: Array, stress: Array) -> Array:
    """Return the internal variables at the end of a step.

    Parameters
    ----------
    series : Prony
        With n terms.
    step : float [s]
        Length of the step.
    memory : (n + 1, ..., 6) array [Pa]
        Internal variables at its beginning.
    stress : (..., 6) array [Pa]
        Scaled isochoric stress of the law at its end, see `scaled_stress`; softened, but not multiplied by γ.

    Examples
    --------
    >>> series = Prony(g=(0.5,), tau=(2.0,), moduli="instantaneous")
    >>> memory = next_memory(series, 0.0, memory_at_rest(series, ()), np.array([1.0, 0, 0, 0, 0, 0]))
    >>> round(float(remembered_stress(series, 2.0, memory)[0] + step_factor(series, 2.0)), 6)  # 1 − ½ (1 − 1/e)
    0.68394
    """
    decay, rise = _shares(series, step)
    column = (slice(None), *([None] * stress.ndim))
    moved = decay[column] * memory[1:] + rise[column] * (stress - memory[0])
    return np.concatenate([stress[None], moved])


def hereditary(time: Array, stress: Array, tau: float) -> Array:
    """Return the internal stress of one term along a whole history, by the recursion of `next_memory`.

    Parameters
    ----------
    time : (n,) array [s]
        Times, none before the one ahead of it.
    stress : (n, k) array [Pa]
        Stress S₀ of the law at these times, at rest before the first.
    tau : float [s]
        Relaxation time.

    Returns
    -------
    (n, k) array [Pa]

    Examples
    --------
    >>> hereditary(np.array([0.0, 1.0, 2.0]), np.ones((3, 1)), 1.0)[:, 0].round(4)
    array([1.    , 0.3679, 0.1353])
    """
    x = np.diff(time, prepend=time[0]) / tau
    rise = np.ones_like(x)
    np.divide(-np.expm1(-x), x, out=rise, where=x > 0)
    decay, gain = np.exp(-x).tolist(), rise[:, None] * np.diff(stress, axis=0, prepend=0.0)
    out = np.empty_like(gain)
    for k, gains in enumerate(gain.T.tolist()):  # plain floats: a loop over so little is slow in arrays
        stored = 0.0
        for n, (share, more) in enumerate(zip(decay, gains, strict=True)):
            stored = share * stored + more
            out[n, k] = stored
    return out


def _shares(series: Prony, step: float) -> tuple[Array, Array]:
    """Share of each internal stress that outlives a step, and share of the new stress that it takes up."""
    if not step >= 0:
        raise TurgorError(f"a step of {step:g} s goes back in time; it must be 0 s or more.")
    x = step / np.array(series.tau)
    rise = np.ones_like(x)
    np.divide(-np.expm1(-x), x, out=rise, where=x > 0)
    return np.exp(-x), rise


def _numbers(name: str, values: object) -> tuple[float, ...]:
    try:
        return tuple(float(value) for value in values)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise TurgorError(f"Prony: {name} is {values!r}; give a sequence with one number for each term.") from None
