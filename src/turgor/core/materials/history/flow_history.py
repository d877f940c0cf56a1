"""Flow of networks along a history of stretch without shear: all strains stay along the same three axes."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.history.flow import Flowed, flowed
from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.history.softening import Mullins, softening
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material

Array = NDArray[np.float64]


def flowing_stress(material: Material, time: Array, stretches: Array) -> Array:
    """Deviator of the Kirchhoff stress of the network that flows with time, step by step from rest.

    Parameters
    ----------
    material : Material
        With Bergström and Boyce's network.
    time : (n,) array [s]
    stretches : (3, n) array [-]
        Principal stretches of product 1.

    Returns
    -------
    (3, n) array [Pa]
    """
    network, law = material.flowing_network, material.law
    assert network is not None and isinstance(law, Law)
    out, logs, back = np.empty(stretches.shape), np.log(stretches), np.zeros(3)
    for n, step in enumerate(np.diff(time, prepend=time[0])):
        resistance = network.resistance(float(step), np.diag(np.exp(back))[None])
        end = flowed(law, network.stiffness, np.exp(logs[:, n] + back)[:, None], resistance)
        out[:, n], back = end.stress[:, 0], back - end.strain[:, 0]
    return out


def setting_stress(material: Material, stretches: Array) -> tuple[Array, Array]:
    """Deviator of the Kirchhoff stress of a law with a permanent set along a history, and its factor of softening.

    Parameters
    ----------
    material : Material
        With a permanent set.
    stretches : (3, n) array [-]
        Principal stretches of product 1, in the order of time.

    Returns
    -------
    (3, n) array [Pa], (n,) array [-]
    """
    plastic, law = material.permanent_set, material.law
    assert plastic is not None and isinstance(law, Law)
    out, eta = np.empty(stretches.shape), np.ones(stretches.shape[1])
    logs, back, hardened, largest = np.log(stretches), np.zeros(3), np.zeros(1), np.zeros(1)
    for n in range(stretches.shape[1]):
        end = flowed(law, 1.0, np.exp(logs[:, n] + back)[:, None], plastic.resistance(hardened))
        out[:, n], back = end.stress[:, 0], back - end.strain[:, 0]
        if material.stress_softening is not None:
            eta[n] = _softened(material.stress_softening, plastic, end, hardened, largest)
            largest = np.maximum(largest, end.energy)
        hardened = hardened + end.amount
    return eta * out, eta


def _softened(mullins: Mullins, plastic: PermanentSet, end: Flowed, hardened: Array, largest: Array) -> float:
    energy = end.energy + plastic.work(hardened + end.amount) - plastic.work(hardened)
    return float(softening(mullins, energy, largest)[0][0])
