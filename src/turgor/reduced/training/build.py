"""Build: the equations of a reduced model from training paths."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.system import System
from turgor.reduced.parts.points import Points
from turgor.reduced.parts.polynomials import Sheets
from turgor.reduced.settings import SAMPLING, TRAINING
from turgor.reduced.states.equations import Equations, Part
from turgor.reduced.training import assembly, near, sampling
from turgor.reduced.training.layers import sampled
from turgor.reduced.training.modes import Modes, modes_of, normalized, rest_stiffness, with_more
from turgor.reduced.training.reference_points import with_points
from turgor.reduced.training.tensions import swinging, tensions_of
from turgor.reduced.training.trainer import Path

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
    faces : tuple of str
        Faces whose volumes are the first cubic polynomials.
    """

    equations: Equations
    whole: assembly.Whole
    modes: Modes
    stresses: Modes
    inputs: Array
    y: Array
    checks: tuple[Part, ...]
    counts: dict[str, int]
    faces: tuple[str, ...]

    @property
    def size(self) -> float:
        """Largest size of the coordinates of the displacement."""
        return float(np.linalg.norm(self.y[:, : self.modes.vectors.shape[1]], axis=1).max())


def build(system: System, drive: assembly.Drive, paths: Sequence[Path], modes: int, wanted: float) -> Built:
    """Make modes and equations of training paths.

    Parameters
    ----------
    system : System
        Of the model; its contact takes the largest penalties of the paths.
    drive : Drive
    paths : sequence of Path
    modes : int
        Displacement modes at most.
    wanted : float
        Wanted error of the displacement, over the largest.

    Returns
    -------
    Built
    """
    for place, part in enumerate(system.contact.parts):
        part.penalty_scale = np.max([path.scales[place] for path in paths], axis=0)
    basis, stresses = bases(system, paths, modes)
    whole = assembly.assemble(system, drive, basis, stresses)
    moved = np.concatenate([path.displacements for path in paths])
    trained = np.concatenate([path.inputs for path in paths])
    cycled = [(np.tile(path.inputs[-1], (len(path.cycle[0]), 1)), *path.cycle) for path in paths]
    seen = np.concatenate([moved, *(displaced for _, displaced, _ in cycled)])
    seen_at = np.concatenate([trained, *(aim for aim, _, _ in cycled)])
    close = near.near_points(system, list(seen), list(seen_at), drive.places)
    touching, obstacles = near.contact_parts(system, close, basis.vectors, drive.places)
    forces = np.concatenate([np.linalg.norm(path.obstacle_forces, axis=2) for path in paths])
    largest = dict(zip(drive.places, forces.max(axis=0), strict=True))
    obstacles = tuple(replace(each, largest=float(largest[each.name])) for each in obstacles)
    tensions = tensions_of(system, [*seen, *swinging(basis, paths)], basis.vectors)
    exact = replace(whole.exact, parts=(*whole.exact.parts, *tensions, *touching), obstacles=obstacles)
    whole = replace(whole, exact=exact)
    rest = _at_rest(exact, paths)
    inputs = np.concatenate([rest, trained])
    pressed = np.concatenate([path.mean_stresses for path in paths])
    y = np.hstack([moved.reshape(len(moved), -1) @ basis.dual, pressed @ stresses.dual])
    y = np.vstack([np.zeros((len(rest), y.shape[1])), y])
    if whole.exact.moments is not None:
        few = whole.exact.moments.combined(list(y), SAMPLING.moments)
        whole = replace(whole, exact=replace(whole.exact, moments=few))
    swings = np.concatenate([path.inertial[0] @ basis.dual for path in paths if len(path.inertial[0])] or [y[:0, :1]])
    trials = [np.hstack([u.reshape(len(u), len(basis.dual)) @ basis.dual, p @ stresses.dual]) for _, u, p in cycled]
    at = np.vstack([inputs, *(aim for aim, _, _ in cycled)])
    chosen, checks, counts = sample(whole, at, np.vstack([y, *trials]), swings, wanted)
    counts["contact points"] = sum(len(each.points) for each in close)
    return Built(_one_sheet(whole.with_parts(chosen)), whole, basis, stresses, inputs, y, checks, counts, drive.faces)


def _at_rest(equations: Equations, paths: Sequence[Path]) -> Array:
    """Inputs (k, 1 + n) of the state at rest, for each place of the obstacles where it touches none."""
    rows = np.unique([path.rest for path in paths], axis=0)
    still = np.zeros(len(equations.forces))
    return rows[[not any(each.at(still, row).every.any() for each in equations.obstacles) for row in rows]]


def _one_sheet(equations: Equations) -> Equations:
    """Equations with the sum of all their forms of sheets."""
    sheets = [part for part in equations.parts if isinstance(part, Sheets)]
    if len(sheets) < 2:
        return equations
    others = tuple(part for part in equations.parts if not isinstance(part, Sheets))
    whole = Sheets(np.asarray(sum(sheet.form for sheet in sheets)), sheets[0].size)
    return replace(equations, parts=(*others, whole))


def modes_needed(system: System, paths: Sequence[Path], error: float, most: int) -> int:
    """Displacement modes whose combinations are within an error of all states, over their largest displacement."""
    states = np.concatenate([path.displacements.reshape(len(path.displacements), -1) for path in paths])
    basis, _ = bases(system, paths, most)
    vectors = basis.vectors[: states.shape[1], :most]
    left, largest = states.copy(), np.abs(states).max()
    for count, vector in enumerate(vectors.T):
        if np.abs(left).max() <= error * largest:
            return count
        left -= np.outer(states @ basis.dual[:, count], vector)
    return len(vectors.T)


def bases(system: System, paths: Sequence[Path], modes: int, of_stress: int = 0) -> tuple[Modes, Modes]:
    """Modes of displacement and, half as many by default and not too many, of mean stress."""
    stiffness = rest_stiffness(system)
    moved = [path.displacements.reshape(len(path.displacements), -1) for path in paths]
    derivatives = np.concatenate([path.derivatives[0] for path in paths])
    largest = max(float(np.einsum("kn,kn->k", each, (stiffness @ each.T).T).max()) for each in moved)
    sizes = np.einsum("kn,kn->k", derivatives, (stiffness @ derivatives.T).T)
    shares = np.minimum(1.0, TRAINING.derivatives * (largest / np.maximum(sizes, 1e-300)) ** 0.5)
    moved.append(derivatives * shares[:, None])  # else they outweigh the states
    moved += [path.cycle[0].reshape(len(path.cycle[0]), -1) for path in paths if len(path.cycle[0])]
    pressed = [path.mean_stresses for path in paths] + [path.derivatives[1] for path in paths]
    pressed += [path.cycle[1] for path in paths if len(path.cycle[0])]
    basis = modes_of(np.concatenate(moved).T, stiffness, modes, TRAINING.truncation)
    responses = [path.inertial for path in paths if len(path.inertial[0])]
    if responses:
        swings, sizes = normalized(np.concatenate([each[0] for each in responses]).T, stiffness)
        basis = with_more(basis, swings, stiffness, TRAINING.inertial)
        largest = np.sqrt(max(np.einsum("kn,kn->k", each, (stiffness @ each.T).T).max() for each in moved))
        pressed.append(np.concatenate([each[1] for each in responses]) * (SAMPLING.swing * largest / sizes)[:, None])
    half = of_stress or max(1, min(basis.vectors.shape[1] // 2, TRAINING.pressed))
    volumes = sp.diags(system.mean_stress_volumes).tocsr()
    basis = replace(basis, vectors=with_points(system, basis.vectors))
    return basis, modes_of(np.concatenate(pressed).T, volumes, half, 0.0)


def sample(
    whole: assembly.Whole, inputs: Array, y: Array, swings: Array, wanted: float
) -> tuple[tuple[Part, ...], tuple[Part, ...], dict[str, int]]:
    """Choose cells, and sides and edges of shells: the sampled parts, other ones to check them, and how many.

    Training states and others near them count, with motion those on the ways ``swings`` (k, r) too.
    """
    starts = np.append(np.flatnonzero(np.diff(whole.cells, prepend=-1)), len(whole.cells))
    trials = list(_trials(whole, inputs, y, (starts, swings)))
    size = float(np.linalg.norm([trial.q for trial in trials], axis=1).mean())
    tolerance = SAMPLING.tolerance * wanted * size * float(np.sqrt(len(trials)))
    A = np.vstack([trial.rubber for trial in trials])
    total = A.sum(axis=1)
    allowed = tolerance / max(float(np.linalg.norm(total)), 1e-300)
    cells = sampling.choose(A, total, SAMPLING.cells * allowed, SAMPLING.most).which
    chosen = [_points_in(whole, trials, starts, cells, (total, allowed))]
    others = sampling.choose(A, total, SAMPLING.cells * allowed, SAMPLING.most, cells).which
    chosen.append(_points_in(whole, trials, starts, others, (total, allowed)))
    counts = {"points": len(chosen[0].weights), "cells": len(cells)}
    parts: list[Part] = [chosen[0]]
    checks: list[Part] = [chosen[1]]
    for layer in whole.layers:
        places = [(trial.q, trial.inverse) for trial in trials]
        part, sides = sampled(layer, places, tolerance)
        parts.append(part)
        checks.append(sampled(layer, places, tolerance, sides)[0])
        counts["pieces of layers"] = counts.get("pieces of layers", 0) + len(part.weights)
    if whole.pieces:
        bending, error = bending_form([(trial.q, trial.inverse, trial.bending) for trial in trials])
        if error <= tolerance:
            parts.append(bending)
        else:
            parts += whole.pieces
            checks += whole.pieces
            counts["sides"] = sum(len(each.term.nodes) for each in whole.pieces)
    return tuple(parts), tuple(checks), counts


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """A training state or one near it.

    Parameters
    ----------
    q : (r,) array
    inverse : (r, r) array
        Of the tangent, its block of displacements.
    rubber : (r, cells) array
        Forces of every cell, times the inverse.
    bending : (r,) array
        Forces of the bending of shells.
    """

    q: Array
    inverse: Array
    rubber: Array
    bending: Array


def _trials(whole: assembly.Whole, inputs: Array, y: Array, more: tuple[Ints, Array]) -> Iterator[Trial]:
    """Evaluate training states, and others near them: Newton's method and motions pass there."""
    starts, swings = more
    equations, r = whole.equations, whole.exact.sizes[0]
    random, spread = np.random.default_rng(0), np.abs(y[:, :r]).max(axis=0)
    size = float(np.linalg.norm(y[:, :r], axis=1).max())
    inverse = np.zeros((r, r))
    for place in np.unique(np.linspace(0, len(y) - 1, min(len(y), SAMPLING.states)).astype(int)):
        for factor in (0.0, *[SAMPLING.perturbation] * (SAMPLING.swings if len(swings) else 1)):
            moved = y[place].copy()
            moved[:r] += factor * spread * random.standard_normal(r)
            if factor and len(swings):
                way = swings[random.integers(len(swings))]
                moved[:r] += SAMPLING.swing * random.uniform(-1, 1) * size * way / np.linalg.norm(way)
            at = equations.at(moved, inputs[place])
            if at is None:
                continue
            rubber, *pieces = at.parts[: 1 + len(whole.pieces)]
            if not factor or len(swings):  # so near to the state its own is good enough, and costs most of the time
                inverse = np.linalg.inv(at.tangent())[:r, :r].astype(np.float64)
            of_cells: Array = np.asarray(rubber.forces(starts)) @ inverse.T  # type: ignore[call-arg]
            yield Trial(moved[:r], inverse, of_cells.T, np.sum([part.forces() for part in pieces], axis=0))


def bending_form(trials: Sequence[tuple[Array, Array, Array]]) -> tuple[Sheets, float]:
    """Fit the bending energy of shells by a quadratic polynomial, and return it with the error of the coordinates.

    Sheets that bend without stretching have a quadratic energy in the displacements (Bergou and others 2006, doi
    10.2312/SGP/SGP06/227-230); those of shells do almost.

    Parameters
    ----------
    trials : sequence of ((r,), (r, r), (r,)) arrays
        Coordinates, inverse tangent, forces of the bending.
    """
    r = len(trials[0][0])
    i, j = np.triu_indices(r)
    rows, right = [], []
    for q, inverse, force in trials:
        one = np.zeros((r, len(i)))
        one[i, np.arange(len(i))] += q[j]
        one[j, np.arange(len(i))] += q[i]
        rows.append(inverse @ np.hstack([np.eye(r), one]))
        right.append(inverse @ force)
    A, b = np.vstack(rows), np.concatenate(right)
    scale = 1.0 / np.maximum(np.linalg.norm(A, axis=0), 1e-300)
    numbers = scale * np.linalg.lstsq(A * scale, b, rcond=1e-10)[0]
    R = r + 1
    place = np.zeros((R, R), dtype=np.int64)
    place[np.triu_indices(R)] = np.arange(R * (R + 1) // 2)
    form = np.zeros((R * (R + 1) // 2,) * 2)
    columns = np.concatenate([place[0, 1:], place[i + 1, j + 1]])
    form[0, columns] = form[columns, 0] = numbers
    return Sheets(form, R), float(np.linalg.norm(A @ numbers - b))


def _points_in(
    whole: assembly.Whole, trials: Sequence[Trial], starts: Ints, cells: Ints, wanted: tuple[Array, float]
) -> Points:
    """Choose few of the points in some cells: the whole forces that they have to give, and the error allowed."""
    which = np.concatenate([np.arange(starts[c], starts[c + 1]) for c in cells])
    there = whole.rubber.chosen(which, whole.rubber.weights[which])
    each = np.arange(len(which) + 1)
    rows = [trial.inverse @ at.forces(each).T for trial in trials if (at := there.at(trial.q)) is not None]
    chosen = sampling.choose(np.vstack(rows), wanted[0], wanted[1], min(SAMPLING.points, len(which)))
    return there.chosen(chosen.which, there.weights[chosen.which] * chosen.factors)
