"""Layers: fibers and sheets that wrinkle, of which few pieces are chosen as of the rubber."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.membrane_term import MembraneTerm
from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.engine.fibers.fiber_term import FiberTerm
from turgor.core.engine.system import System
from turgor.reduced.parts.threads import Threads
from turgor.reduced.parts.wrinkling import Wrinkling
from turgor.reduced.settings import SAMPLING
from turgor.reduced.training import forms, sampling

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """All pieces of a layer, in the order of the sides that carry them.

    Parameters
    ----------
    part : Threads or Wrinkling
    starts : (sides + 1,) int array
        Where the pieces of each side begin, and the end.
    """

    part: Threads | Wrinkling
    starts: Ints


def layers_of(system: System, vectors: Array) -> tuple[Layer, ...]:
    """Make the layers of a system for modes (3 n, r): a winding that may go slack each, and a sheet that wrinkles."""
    every = forms.positions(system, vectors)
    out = [_threads(pieces, every) for pieces in windings(system, slack=True)]
    for term in system.terms.all:
        if isinstance(term, MembraneTerm) and term.field is not None:
            moved = np.einsum("fqak,faiR->fqkiR", term.gradients, every[term.nodes], optimize=True)
            count = moved.shape[1]
            moved = moved.reshape(-1, 2, 3, every.shape[2])
            part = Wrinkling(moved[..., 0], np.ascontiguousarray(moved[..., 1:]), term.areas.ravel(), term.field)
            out.append(Layer(part, np.arange(0, len(moved) + 1, count)))
    return tuple(out)


def windings(system: System, slack: bool) -> Iterator[Pieces]:
    """Pieces of the windings that bear less compression than tension, or of the others."""
    for term in system.terms.all:
        if isinstance(term, FiberTerm) and bool((term.pieces.pushed < 1).any()) == slack:
            yield term.pieces


def _threads(p: Pieces, every: Array) -> Layer:
    """The pieces of a winding; ``every`` (n, 3, R) are positions at rest and displacements of the modes."""
    _, side = np.unique(p.sides, axis=0, return_inverse=True)
    order = np.argsort(side.ravel(), kind="stable")
    starts = np.append(np.flatnonzero(np.diff(side.ravel()[order], prepend=-1)), len(order))
    moved = np.einsum("ka,kaiR->kiR", p.along[order], every[p.sides[order]], optimize=True)
    part = Threads(
        moved[..., 0], np.ascontiguousarray(moved[..., 1:]), p.weights[order], p.stiffness[order], p.pushed[order]
    )
    return Layer(part, starts.astype(np.int64))


def sampled(
    layer: Layer, trials: Sequence[tuple[Array, Array]], tolerance: float, without: Ints | None = None
) -> tuple[Threads | Wrinkling, Ints]:
    """Choose sides, and then pieces of them, as `turgor.reduced.training.build.sample` does.

    Parameters
    ----------
    layer : Layer
    trials : sequence of ((r,), (r, r)) arrays
        Coordinates, and inverse tangents.
    tolerance : float
        Error of the coordinates in all trials.
    without : (k,) int array, optional
        Sides that are not taken.

    Returns
    -------
    Threads or Wrinkling, (k,) int array
        The pieces with their weights, and the sides.
    """
    part, starts = layer.part, layer.starts
    A = np.vstack([inverse @ part.at(q).forces(starts).T for q, inverse in trials])
    total = A.sum(axis=1)
    allowed = tolerance / max(float(np.linalg.norm(total)), 1e-300)
    sides = sampling.choose(A, total, SAMPLING.cells * allowed, SAMPLING.most, without).which
    which = np.concatenate([np.arange(starts[side], starts[side + 1]) for side in sides])
    there = part.chosen(which, part.weights[which])
    each = np.arange(len(which) + 1)
    rows = np.vstack([inverse @ there.at(q).forces(each).T for q, inverse in trials])
    best = sampling.choose(rows, total, allowed, len(which))
    return there.chosen(best.which, there.weights[best.which] * best.factors), sides
