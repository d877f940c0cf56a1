"""Stress of a material along a history of stretch: relaxation, hysteresis and softening in a homogeneous test."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.history.flow_history import flowing_stress, setting_stress
from turgor.core.materials.history.isochoric import isochoric_stress
from turgor.core.materials.history.softening import softening
from turgor.core.materials.history.viscoelastic import (
    Prony,
    memory_at_rest,
    next_memory,
    remembered_stress,
    step_factor,
)
from turgor.core.materials.laws.derivatives import energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.homogeneous import DEFORMATIONS, cauchy_stress
from turgor.core.materials.laws.laws import Law, StretchLaw
from turgor.core.materials.material import Material
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.symmetric import COLUMNS, ROWS

Array = NDArray[np.float64]
HistoryMode = Literal["uniaxial", "equibiaxial", "planar"]

HISTORY_MODES = get_args(HistoryMode)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StressHistory:
    """Stress of a material along a history of stretch.

    Parameters
    ----------
    mode : str
        ``"uniaxial"``, ``"equibiaxial"`` or ``"planar"``.
    time : (n,) array [s]
        Times.
    stretch : (n,) array [-]
        Stretch along the first axis.
    nominal_stress : (n,) array [Pa]
        Force per initial area along the first axis.
    softening : (n,) array [-]
        Factor η of stress softening; 1 where there is none.
    """

    mode: str
    time: Array
    stretch: Array
    nominal_stress: Array
    softening: Array

    __repr__ = brief

    @property
    def work(self) -> Array:
        """Work done on the specimen up to each time, per initial volume, by trapezoids; (n,) array [J/m³].

        At the end of a closed cycle it is the dissipated energy. A jump at the first time starts at zero stress.
        """
        stretch, stress = np.concatenate([[1.0], self.stretch]), np.concatenate([[0.0], self.nominal_stress])
        pieces = 0.5 * (stress[1:] + stress[:-1]) * np.diff(stretch)
        return np.asarray(np.cumsum(pieces) * (2.0 if self.mode == "equibiaxial" else 1.0))


def stress_history(material: Material, mode: HistoryMode, time: ArrayLike, stretch: ArrayLike) -> StressHistory:
    """Compute the stress of an incompressible rubber along a history of stretch.

    The specimen is at rest before the first time: a first stretch other than 1 is a sudden one, and so is a change
    between two equal times. Between the times the
    stress of the law is taken as linear, with an error of second order; what flows has one of first order.

    Parameters
    ----------
    material : Material
        A rubber; its viscoelasticity, stress softening and permanent set count, its bulk modulus does not.
    mode : {"uniaxial", "equibiaxial", "planar"}
        The test.
    time : (n,) array [s]
        Times, not decreasing.
    stretch : (n,) array [-]
        Stretches along the first axis at these times.

    Returns
    -------
    StressHistory

    Raises
    ------
    TurgorError
        If time runs backwards, or the material is no rubber.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> series = Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli="instantaneous")
    >>> rubber = Material(name="rubber", law=NeoHooke(C10=0.12e6), viscoelasticity=series)
    >>> stress_history(rubber, "uniaxial", [0.0, 1.0, 10.0], [1.5, 1.5, 1.5]).nominal_stress.round()
    array([253333., 218895., 186655.])
    """
    if mode not in HISTORY_MODES:
        raise unknown("mode", mode, HISTORY_MODES)
    if not isinstance(material.law, Law):
        raise TurgorError(f"material '{material.name}' is linear elastic; a history is that of a rubber's law.")
    if material.is_foam:
        raise TurgorError(f"material '{material.name}' is a foam, which has no history; take its curve.")
    t, along = _checked(time, stretch)
    F = DEFORMATIONS[mode](along)
    S, eta = softened_stress(material, F)
    if material.prony is not None:
        S = _relaxing(material.prony, t, S, _components(F.swapaxes(-1, -2) @ F))
    if material.flowing_network is not None:
        stretches = _stretches(F)
        S = S + _along(flowing_stress(material, t, stretches), stretches)
    return StressHistory(mode=mode, time=t, stretch=along, nominal_stress=pull_of(S, F), softening=eta)


def softened_stress(material: Material, F: Array) -> tuple[Array, Array]:
    """Return the isochoric second Piola–Kirchhoff stress before any relaxation, and the factor of softening in it.

    Parameters
    ----------
    material : Material
        A rubber.
    F : (n, 3, 3) array [-]
        Deformation gradients of determinant 1, in the order of time; diagonal ones of rubber with a permanent set.

    Returns
    -------
    (n, 6) array [Pa], (n,) array [-]
        Components 11 22 33 12 23 13; η.
    """
    law = material.law
    assert isinstance(law, Law)
    if material.permanent_set is not None:
        stretches = _stretches(F)
        tau, eta = setting_stress(material, stretches)
        return _along(tau, stretches), eta
    sigma = cauchy_stress(law, F)
    deviator = sigma - (np.trace(sigma, axis1=-2, axis2=-1) / 3.0)[..., None, None] * np.eye(3)
    inverse = np.linalg.inv(F)
    S = _components(inverse @ deviator @ inverse.swapaxes(-1, -2))
    if material.stress_softening is None:
        return S, np.ones(len(F))
    W = energy_of(law, F)
    eta, _ = softening(material.stress_softening, W, np.maximum.accumulate(np.maximum(W, 0.0)))
    return eta[:, None] * S, eta


def energy_of(law: Law, F: Array) -> Array:
    """Energy density of a law at volume-preserving deformations.

    Parameters
    ----------
    law : Law
        Any law of a rubber.
    F : (n, 3, 3) array [-]
        Deformation gradients.

    Returns
    -------
    (n,) array [Pa]
    """
    C = F.swapaxes(-1, -2) @ F
    if isinstance(law, StretchLaw):
        return stretch_derivatives(law, *np.sqrt(np.linalg.eigvalsh(C)).T)[0]
    I1 = np.trace(C, axis1=-2, axis2=-1)
    I2 = 0.5 * (I1**2 - np.trace(C @ C, axis1=-2, axis2=-1))
    return energy_and_derivatives(law, I1, I2)[0]


def pull_of(S: Array, F: Array) -> Array:
    """Nominal stress along the first axis, the third being free of traction, from the isochoric stress.

    Parameters
    ----------
    S : (..., 6) array [Pa]
        Isochoric second Piola–Kirchhoff stress.
    F : (..., 3, 3) array [-]
        Diagonal deformation gradients.

    Returns
    -------
    (...) array [Pa]
    """
    return np.asarray(F[..., 0, 0] * S[..., 0] - F[..., 2, 2] ** 2 / F[..., 0, 0] * S[..., 2])


def _relaxing(series: Prony, time: Array, S: Array, C: Array) -> Array:
    """Stress update at a point, step by step, as at a quadrature point of a finite element."""
    memory = memory_at_rest(series, ())
    out = np.empty_like(S)
    for n, step in enumerate(np.diff(time, prepend=time[0])):
        h = remembered_stress(series, step, memory)
        out[n] = step_factor(series, step) * S[n] + isochoric_stress(h, C[n])
        memory = next_memory(series, step, memory, S[n])
    return out


def _stretches(F: Array) -> Array:
    """Principal stretches (3, n) of diagonal deformation gradients."""
    return np.asarray(np.diagonal(F, axis1=-2, axis2=-1).T)


def _along(tau: Array, stretches: Array) -> Array:
    """Second Piola–Kirchhoff stress (n, 6) of principal Kirchhoff stresses (3, n)."""
    out = np.zeros((tau.shape[1], 6))
    out[:, :3] = (tau / stretches**2).T
    return out


def _components(tensor: Array) -> Array:
    return np.asarray(tensor[..., ROWS, COLUMNS])


def _checked(time: ArrayLike, stretch: ArrayLike) -> tuple[Array, Array]:
    t, along = np.asarray(time, dtype=np.float64), np.asarray(stretch, dtype=np.float64)
    if t.ndim != 1 or t.shape != along.shape or not len(t):
        raise TurgorError(
            f"time has the shape {t.shape} and stretch {along.shape}; one stretch for each time is needed."
        )
    for name, values in (("time", t), ("stretch", along)):
        if not np.isfinite(values).all():
            n = int(np.argmin(np.isfinite(values)))
            raise TurgorError(f"{name} of point {n + 1} is {values[n]:g}; it must be a finite number.")
    back = np.flatnonzero(np.diff(t) < 0)
    if len(back):
        n = int(back[0])
        raise TurgorError(f"time runs backwards after point {n + 1}, from {t[n]:g} to {t[n + 1]:g} s.")
    return t, along
