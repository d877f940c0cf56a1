"""Tensions: modes of the tension that fibers have in training states."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.engine.system import System
from turgor.reduced.parts.tensions import Tensions
from turgor.reduced.settings import SAMPLING, TENSIONS
from turgor.reduced.training import forms
from turgor.reduced.training.layers import windings
from turgor.reduced.training.modes import Modes
from turgor.reduced.training.trainer import Path

Array = NDArray[np.float64]


def tensions_of(system: System, displacements: Sequence[Array], vectors: Array) -> tuple[Tensions, ...]:
    """Make the modes of every winding that works in compression as in tension.

    Parameters
    ----------
    system : System
    displacements : sequence of (n, 3) arrays
        Scaled, of training states.
    vectors : (3 n, r) array
        Modes of the displacement.
    """
    return tuple(_tensions(system, pieces, displacements, vectors) for pieces in windings(system, slack=False))


def swinging(basis: Modes, paths: Sequence[Path]) -> Iterator[Array]:
    """Displacements (n, 3) on the ways of the responses to inertia: fibers resist these, too."""
    for path in paths:
        size = float(np.linalg.norm(path.displacements.reshape(len(path.displacements), -1) @ basis.dual, axis=1).max())
        for way in path.inertial[0] @ basis.dual if len(path.inertial[0]) else ():
            moved = basis.vectors @ (SAMPLING.swing * size / np.linalg.norm(way) * way)
            yield path.displacements[-1] + moved.reshape(-1, 3)[: len(path.displacements[-1])]


def _tensions(system: System, p: Pieces, displacements: Sequence[Array], vectors: Array) -> Tensions:
    """Few modes of S = N / λ, orthonormal in the compliance, and the quadratic forms of their strains."""
    snapshots = []
    for displacement in displacements:
        position = system.points.copy()
        position[: len(displacement)] += displacement
        stretch = np.linalg.norm(np.einsum("ka,kai->ki", p.along, position[p.sides]), axis=1)
        snapshots.append(p.stiffness * (1.0 - 1.0 / stretch))
    root = np.sqrt(p.weights / p.stiffness)
    _, sizes, rows = np.linalg.svd(np.array(snapshots) * root, full_matrices=False)
    count = min(TENSIONS.modes, int((sizes > TENSIONS.truncation * sizes[0]).sum()))
    modes = rows[:count] / root
    moved = np.einsum("ka,kaiR->kiR", p.along, forms.positions(system, vectors)[p.sides], optimize=True)
    flat = moved.reshape(-1, moved.shape[2])
    of_modes = np.array([(flat.T * np.repeat(p.weights * mode, 3)) @ flat for mode in modes])
    of_modes[:, 0, 0] -= modes @ p.weights
    return Tensions(of_modes, modes, p.weights, p.stiffness)
