"""Build: the equations of a reduced model from training paths."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.system import System
from turgor.reduced import assembly, near, sampling
from turgor.reduced.equations import Equations, Part
from turgor.reduced.modes import Modes, modes_of
from turgor.reduced.settings import SAMPLING, TRAINING
from turgor.reduced.training import Path

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Built:
    """A reduced model without its file.

    Parameters
    ----------
    equations : Equations
        Sampled.
    whole : Whole
        Before sampling.
    modes, stresses : Modes
    inputs, y : (k, 1 + n), (k, r + m) arrays
        Inputs and coordinates of the training states.
    checks : tuple of Part
        Parts sampled once more, at other points.
    counts : dict
        Sampled cells, sides and edges; points of contact.
    """

    equations: Equations
    whole: assembly.Whole
    modes: Modes
    stresses: Modes
    inputs: Array
    y: Array
    checks: tuple[Part, ...]
    counts: dict[str, int]

    @property
    def size(self) -> float:
        """Largest size of the coordinates of the displacement."""
        return float(np.linalg.norm(self.y[:, : self.modes.vectors.shape[1]], axis=1).max())


def build(system: System, drive: assembly.Drive, paths: Sequence[Path], modes: int) -> Built:
    """Make modes and equations of training paths.

    Parameters
    ----------
    system : System
        Of the model; its contact takes the largest penalties of the paths.
    drive : Drive
    paths : sequence of Path
    modes : int
        Displacement modes at most.

    Returns
    -------
    Built
    """
    for place, part in enumerate(system.contact.parts):
        part.penalty_scale = np.max([path.scales[place] for path in paths], axis=0)
    basis, stresses = bases(system, paths, modes)
    whole = assembly.assemble(system, drive, basis, stresses)
    moved = np.concatenate([path.displacements for path in paths])
    touching = near.contact_parts(system, near.near_points(system, moved), basis.vectors)
    exact = whole.exact
    whole = assembly.Whole(
        whole.rubber, whole.cells, whole.pieces,
        Equations((*exact.parts, *touching), exact.cubics, exact.pressures, exact.forces, exact.compliance),
    )  # fmt: skip
    inputs = np.concatenate([path.inputs for path in paths])
    pressed = np.concatenate([path.mean_stresses for path in paths])
    y = np.hstack([moved.reshape(len(moved), -1) @ basis.dual, pressed @ stresses.dual])
    sampled, checks, counts = sample(whole, inputs, y)
    counts["contact points"] = sum(len(part.rest) if hasattr(part, "slopes") else len(part.points) for part in touching)
    return Built(whole.with_parts(sampled), whole, basis, stresses, inputs, y, checks, counts)


def bases(system: System, paths: Sequence[Path], modes: int) -> tuple[Modes, Modes]:
    """Modes of displacement and, half as many, of mean stress."""
    at = system.evaluate(np.zeros(system.size), 0.0)
    assert at is not None
    n = 3 * system.node_count
    stiffness = system.pattern.full(system.tangent_data(at))[:n, :n]
    moved = [path.displacements.reshape(len(path.displacements), -1) for path in paths]
    moved += [path.derivatives[0] for path in paths]
    pressed = [path.mean_stresses for path in paths] + [path.derivatives[1] for path in paths]
    basis = modes_of(np.concatenate(moved).T, stiffness, modes, TRAINING.truncation)
    half = max(1, basis.vectors.shape[1] // 2)
    volumes = sp.diags(system.mean_stress_volumes).tocsr()
    return basis, modes_of(np.concatenate(pressed).T, volumes, half, 0.0)


def sample(whole: assembly.Whole, inputs: Array, y: Array) -> tuple[tuple[Part, ...], tuple[Part, ...], dict[str, int]]:
    """Choose cells, sides and edges: the sampled parts, other ones to check them, and how many there are."""
    equations, r = whole.equations, whole.exact.sizes[0]
    starts = np.append(np.flatnonzero(np.diff(whole.cells, prepend=-1)), len(whole.cells))
    columns: list[list[Array]] = [[] for _ in range(1 + len(whole.pieces))]
    random, spread = np.random.default_rng(0), np.abs(y[:, :r]).max(axis=0)
    every = np.unique(np.linspace(0, len(y) - 1, min(len(y), SAMPLING.states)).astype(int))
    for place in every:
        for factor in (0.0, SAMPLING.perturbation):
            moved = y[place].copy()
            moved[:r] += factor * spread * random.standard_normal(r)
            at = equations.at(moved, inputs[place])
            if at is None:
                continue
            inverse = np.linalg.inv(at.tangent())[:r, :r]
            columns[0].append(inverse @ at.parts[0].forces(starts).T)  # type: ignore[call-arg]
            for part, its in zip(at.parts[1:], columns[1:], strict=False):
                its.append(inverse @ part.by_group().T)  # type: ignore[attr-defined]
    size = float(np.linalg.norm(y[every][:, :r], axis=1).mean())
    parts: list[Part] = []
    checks: list[Part] = []
    counts: dict[str, int] = {}
    for name, part, its in zip(("cells", "sides", "edges", "edges_2"), (whole.rubber, *whole.pieces), columns, strict=False):
        A = np.vstack(its)
        b = A.sum(axis=1)
        rows = np.sqrt(len(its))
        tolerance = SAMPLING.tolerance * size * rows / max(float(np.linalg.norm(b)), 1e-300)
        first = sampling.choose(A, b, min(tolerance, 0.5), SAMPLING.most)
        second = sampling.choose(A, b, min(tolerance, 0.5), SAMPLING.most, first.which)
        counts[name] = len(first.which)
        for out, chosen in ((parts, first), (checks, second)):
            out.append(_restricted(part, starts, chosen) if part is whole.rubber else part.chosen(chosen.which, chosen.factors))
    return tuple(parts), tuple(checks), counts


def _restricted(rubber: assembly.Points, starts: Ints, chosen: sampling.Sample) -> Part:
    which = np.concatenate([np.arange(starts[c], starts[c + 1]) for c in chosen.which])
    factors = np.repeat(chosen.factors, starts[chosen.which + 1] - starts[chosen.which])
    return rubber.chosen(which, rubber.weights[which] * factors)
