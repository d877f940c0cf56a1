"""Tip forces: stiffness of the tip and blocked force, where forces on the face ``tip`` are inputs."""

from dataclasses import dataclass

import numpy as np

from turgor.foundation.errors import NotSolved
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.robots.backbone import Array

#: The search for the forces that block the tip: updates, and the travel that is left over the largest.
UPDATES, SMALL = 12, 1e-6

#: Cosine from which on a dead force of the reduced model counts as one on the tip.
PARALLEL = 1 - 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class TipForces:
    """Inputs that are forces on the tip.

    Parameters
    ----------
    places : tuple of int
        Places of these inputs.
    axes : (k, 3) array
        Work of a unit of each for a motion of the tip: its direction, with the size of the force [N].
    """

    places: tuple[int, ...]
    axes: Array

    def row(self, answer: ReducedState) -> dict[tuple[str, str], float]:
        """Stiffness along each direction where the others are free, and blocked forces; nan outside of the range."""
        if not self.places:
            return {}
        compliance = self.compliance(answer)
        names = ["xyz"[int(np.abs(axis).argmax())] for axis in self.axes]
        row = {(f"stiffness_{name}", "N/m"): 1 / float(c) for name, c in zip(names, np.diag(compliance), strict=True)}
        blocked = self.blocked(answer)
        return row | {(f"blocked_force_{name}", "N"): float(f) for name, f in zip(names, blocked, strict=True)}

    def compliance(self, answer: ReducedState) -> Array:
        """Motion (k, k) [m/N] of the tip along each direction by a newton along each."""
        sizes = np.linalg.norm(self.axes, axis=1)
        return np.asarray((self.axes / sizes[:, None]) @ answer.tip_rates[:, list(self.places)] / sizes)

    def blocked(self, answer: ReducedState) -> Array:
        """Forces (k,) [N] of the actuator on what blocks its tip where it is at rest."""
        reduced, at, places = answer.reduced, answer, list(self.places)
        sizes = np.linalg.norm(self.axes, axis=1)
        travel = float(np.linalg.norm(reduced.trained[:, : reduced.tip.shape[1]] @ reduced.tip.T, axis=1).max())
        for _ in range(UPDATES):
            away = (self.axes / sizes[:, None]) @ at.tip
            if np.abs(away).max() <= SMALL * travel * reduced.scales[0]:
                return -at.inputs[places] * sizes
            inputs = at.inputs.copy()
            inputs[places] -= np.linalg.solve(self.compliance(at), away) / sizes
            if reduced.inputs.outside(inputs):
                break
            try:
                at = reduced.at(inputs, at)
            except NotSolved:
                break
        return np.full(len(places), np.nan)


def tip_forces_of(reduced: Reduced) -> TipForces:
    """Find the inputs that are forces on the tip along an axis; none for other actuators."""
    forces, pressures = reduced.equations.forces[:, 1:], reduced.equations.pressures[:, 1:]
    places, axes = [], []
    for place, (force, pressure) in enumerate(zip(forces.T, pressures.T, strict=True)):
        size = float(np.linalg.norm(force))
        if not size or pressure.any() or not reduced.tip.any():
            continue
        axis, rest = np.linalg.lstsq(reduced.tip.T, force, rcond=None)[:2]
        if (rest.sum() if len(rest) else 0.0) <= (1 - PARALLEL**2) * size**2:
            places.append(place)
            axes.append(axis * _newton(reduced))
    return TipForces(tuple(places), np.array(axes).reshape(-1, 3))


def _newton(reduced: Reduced) -> float:
    """Force [N] of a unit of the scaled force of the whole actuator."""
    return reduced.scales[1] * reduced.scales[0] ** 2 * reduced.model.mesh.symmetry_factor
