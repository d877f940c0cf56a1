"""Natural frequencies of rods about a state."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from turgor.fast_models.rod.layout import mass_matrices, nodal_mass
from turgor.fast_models.rod.model import RodModel
from turgor.fast_models.rod.state import RodState
from turgor.fast_models.rod.system import RodSystem
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RodModes:
    """Natural frequencies and mode shapes of rods.

    Parameters
    ----------
    frequencies : (k,) array [Hz]
        From the lowest; negative where a mode grows instead of swinging.
    shapes : (k, n, 6) array
        Twists of the nodes in their own axes; the largest entry is 1.
    """

    frequencies: Array
    shapes: Array

    @property
    def unstable(self) -> int:
        """How many modes grow."""
        return int((self.frequencies < 0).sum())


def natural_frequencies(model: RodModel, state: RodState | None = None, *, count: int = 6) -> RodModes:
    """Find the lowest natural frequencies about a state, without damping; following loads by their symmetric part.

    Parameters
    ----------
    model : RodModel
    state : RodState or None
        An equilibrium, such as the last of `static`; None is rest.
    count : int

    Returns
    -------
    RodModes

    Raises
    ------
    TurgorError
        If a section has no mass, or `count` is not positive.

    Examples
    --------
    >>> from turgor.fast_models.rod.model import Rod
    >>> from turgor.fast_models.rod.sections.section import RodSection
    >>> section = RodSection.from_moduli(EA=1e5, GA=1e5, EI=1.0, GJ=1.0, mass_per_length=1.0)
    >>> modes = natural_frequencies(RodModel(rods=[Rod(section=section, length=1.0)]), count=1)
    >>> print((2 * np.pi * modes.frequencies).round(2))  # 1.8751²
    [3.52]
    """
    if count < 1:
        raise TurgorError(f"count is {count}; at least 1 is needed.")
    model.check_mass("a natural frequency")
    system = RodSystem(model)
    at = system.evaluate(system.start() if state is None else state)
    masses = mass_matrices(*nodal_mass(model, system.layout))
    tangent = system.band.dense(at.blocks, at.own)
    mass = system.band.dense(np.zeros_like(at.blocks), masses)
    stiffness = 0.5 * (tangent + tangent.T)
    values, vectors = _pairs(stiffness, mass, count)
    shapes = np.zeros((len(values), at.residual.size))
    band = system.band
    shapes[:, band.of_node] = vectors.T[:, band.number[band.of_node]]
    shapes /= np.abs(shapes).max(axis=1, keepdims=True)
    frequencies = np.sign(values) * np.sqrt(np.abs(values)) / (2 * np.pi)
    return RodModes(frequencies=frequencies, shapes=shapes.reshape(len(values), *at.residual.shape))


def _pairs(stiffness: Array, mass: Array, count: int) -> tuple[Array, Array]:
    """Return the lowest squared circular frequencies and their vectors, where some motions may have no mass."""
    typical = np.trace(stiffness) / np.trace(mass)
    shift = 0.0
    for power in (None, -12, -9, -6, -4, -2, 0, 2):
        shift = 0.0 if power is None else typical * 10.0**power
        try:
            reciprocal, vectors = eigh(mass, stiffness + shift * mass)
        except np.linalg.LinAlgError:
            continue
        lowest = np.flatnonzero(reciprocal > 1e-14 * reciprocal.max())[::-1][:count]
        return 1 / reciprocal[lowest] - shift, vectors[:, lowest]
    raise TurgorError("no natural frequencies were found: the state is far from stable.")
