"""Points of tests with time as one linear system: softened stress of a law, and internal stresses of Prony terms."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from turgor.core.materials.experiments.cycles import half_cycles
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.history.softening import Mullins, softening
from turgor.core.materials.history.stress_history import (
    HISTORY_MODES,
    energy_of,
    pull_of,
    softened_stress,
    stress_history,
)
from turgor.core.materials.history.viscoelastic import hereditary
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


class HistoryPoints:
    """Measured stresses of several tests over time, and the stresses of the terms of a model at these points.

    Parameters
    ----------
    law : Law
        The law of the virgin rubber.
    tests : sequence of MaterialTest
        Tests with time, in tension.
    points : int
        Approximate number of points of each test; all points where the stretch reverses are added.

    Attributes
    ----------
    span : (float, float) [s]
        Median time between points, and longest duration of a test.
    top : float [Pa]
        Largest energy density of the law in the tests.
    measured : (n,) array [-]
        Nominal stresses, divided by the largest stress of their test.
    """

    def __init__(self, law: Law, tests: Sequence[MaterialTest], points: int) -> None:
        self._parts = [HistoryPart(law, test, points) for test in tests]
        self.measured = np.concatenate([part.measured for part in self._parts])
        steps = np.concatenate([np.diff(part.time) for part in self._parts])
        self.span = float(np.median(steps[steps > 0])), max(float(np.ptp(part.time)) for part in self._parts)
        self.top = max(float(part.energy.max()) for part in self._parts)

    def columns(self, mullins: Mullins | None, tau: Sequence[float]) -> Array:
        """Return the softened stress of the law and each internal stress, over the largest stress of each test.

        Parameters
        ----------
        mullins : Mullins or None
            Stress softening.
        tau : sequence of float [s]
            Relaxation times.

        Returns
        -------
        (n, 1 + len(tau)) array [-]
        """
        return np.concatenate([part.columns(mullins, tau) for part in self._parts])

    def shares(self, columns: Array, rescale: bool) -> Array:
        """Return the nonnegative least-squares factors of the columns; their sum is 1 unless the law is rescaled.

        Parameters
        ----------
        columns : (n, 1 + terms) array [-]
            Result of `columns`.
        rescale : bool
            Whether the law may be multiplied by a factor.
        """
        if rescale:
            return np.asarray(nnls(columns, self.measured)[0])
        if columns.shape[1] == 1:
            return np.ones(1)
        relaxing = nnls(columns[:, 1:] - columns[:, :1], self.measured - columns[:, 0])[0]
        return np.concatenate([[1.0 - relaxing.sum()], relaxing])


class HistoryPart:
    """One test: its points with load, and the stress of the law at all of its points.

    Parameters
    ----------
    law : Law
        The law of the virgin rubber.
    test : MaterialTest
        A test with time.
    points : int
        Approximate number of its points that are used.

    Attributes
    ----------
    loaded_test : MaterialTest
        The points that carry load.
    scale : float [Pa]
        Largest nominal stress.
    measured : (n,) array [-]
        Nominal stress of the points that carry load, over ``scale``.
    """

    def __init__(self, law: Law, test: MaterialTest, points: int) -> None:
        if test.mode not in HISTORY_MODES:
            raise TurgorError(f"test '{test.name}' is {test.mode}; histories are fitted in {', '.join(HISTORY_MODES)}.")
        if test.time is None:
            raise TurgorError(f"test '{test.name}' has no time; its file needs a column such as 'Time (s)'.")
        keep = _chosen(test, points)
        self.time = test.time[keep]
        self.F = test.deformation[keep]
        self.S = softened_stress(Material(name=test.name, law=law), self.F)[0][:, [0, 2]]
        self.energy = energy_of(law, self.F)
        self.loaded = (test.stretch[keep] != 1.0) | (test.nominal_stress[keep] != 0.0)
        self.scale = float(np.abs(test.nominal_stress).max())
        if not self.loaded.any() or not self.scale > 0:
            raise TurgorError(f"test '{test.name}' has no stress at all; nothing can be fitted to it.")
        along, pull = test.stretch[keep][self.loaded], test.nominal_stress[keep][self.loaded]
        self.loaded_test = MaterialTest(mode=test.mode, stretch=along, nominal_stress=pull, name=test.name)
        self.measured = pull / self.scale

    def columns(self, mullins: Mullins | None, tau: Sequence[float]) -> Array:
        """Return the stresses of `HistoryPoints.columns` for this test."""
        S = self.S
        if mullins is not None:
            S = softening(mullins, self.energy, np.maximum.accumulate(self.energy))[0][:, None] * S
        stresses = [S, *(hereditary(self.time, S, each) for each in tau)]
        pulls = [pull_of(each[:, [0, 0, 1, 1, 1, 1]], self.F)[self.loaded] for each in stresses]
        return np.stack(pulls, axis=1) / self.scale

    def pulls(self, material: Material) -> Array:
        """Nominal stress of a rubber at the points that carry load, over the largest stress of the test."""
        mode: Any = self.loaded_test.mode
        history = stress_history(material, mode, self.time, self.F[:, 0, 0])
        return history.nominal_stress[self.loaded] / self.scale


def _chosen(test: MaterialTest, points: int) -> NDArray[np.intp]:
    """Indices of evenly spaced points and of the points where the stretch reverses."""
    count = len(test.stretch)
    stride = max(1, count // points)
    turns = [edge for half in half_cycles(test) for edge in (half.start, half.stop - 1)]
    return np.unique([*range(0, count, stride), *turns, count - 1])
