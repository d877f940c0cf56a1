"""reduce: make a reduced model from full solves."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.faces import surfaces
from turgor.core.engine.runtime import EngineOptions, use_threads
from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.reduced.settings import TRAINING
from turgor.reduced.states.held_out import HeldOutErrors
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.assembly import check_reducible, drive_of
from turgor.reduced.training.box import aims_of, corners, inputs_of, one_path, random_shares, with_all_cavities
from turgor.reduced.training.build import Built, build, modes_needed
from turgor.reduced.training.compare import aim_of, compared, known_errors, start_of
from turgor.reduced.training.masses import masses_of
from turgor.reduced.training.modes import Modes
from turgor.reduced.training.path_runs import PathRuns
from turgor.reduced.training.trainer import Path, Trainer

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Budget:
    """What a reduced model may cost.

    Parameters
    ----------
    error : float [-]
        Wanted error of the displacement, over the largest.
    paths : int
        Training paths at most.
    held_out : int
        Paths of full solves that are kept from training.
    modes : int
        Displacement modes at most; they become more where the error at training states exceeds the wanted one.
    steps : int
        Steps of a path at least.
    checks : int
        Paths in a row, each to the worst of many random inputs, on which the error must be the wanted one. With one
        input a path passes all values, and one is enough.
    motion : bool
        Whether there are modes for motion with inertia, too; every material needs a density.
    aims : sequence of sequences of float
        Where further paths lead that training begins with, as shares of the ranges, such as ``(1, 0.5, 0)``.

    Examples
    --------
    >>> Budget(error=0.01, paths=8).modes
    26
    """

    error: float = 0.005
    paths: int = 24
    held_out: int = 2
    modes: int = TRAINING.most
    steps: int = TRAINING.steps
    checks: int = 3
    motion: bool = False
    aims: Sequence[Sequence[float]] = ()

    def __post_init__(self) -> None:
        for name in ("paths", "modes", "steps", "checks"):
            if getattr(self, name) < 1:
                raise TurgorError(f"{name} of a reduced model is {getattr(self, name)}; allowed is 1 or more.")
        if not 0 < self.error < 1:
            raise TurgorError(f"error of a reduced model is {self.error:g}; allowed is more than 0 and less than 1.")


def reduce(
    model: Model,
    inputs: Mapping[str, tuple[float, float]],
    *,
    budget: Budget | None = None,
    options: EngineOptions | None = None,
    runs: PathRuns | None = None,
    say: Callable[[str], None] | None = None,
) -> Reduced:
    """Make a reduced model: full solves on training paths, modes of their states, sampled equations.

    Training begins at the corners of the box of inputs. It goes on with full solves to the random inputs at which the
    estimated error is worst, and ends when the errors of several such paths in a row are the wanted one, or with the
    budget.

    Parameters
    ----------
    model : Model
    inputs : mapping of str to (float, float) [SI]
        Range of each input by its key, as in `gradient`: ``{"loads.pressure": (0, 20e3)}``. A key without its last
        number stands for the three components of a vector, ``"loads.tip.vector"``; so does ``"loads.gravity.falling"``,
        the acceleration of gravity as a vector.
    budget : Budget, optional
        Wanted error, paths, modes.
    options : EngineOptions, optional
        Linear solver and threads.
    runs : PathRuns, optional
        Folder where training paths are saved as they end, so that the same call goes on after it was killed, and
        processes that compute them at once.
    say : callable, optional
        Receives a sentence after each path.

    Returns
    -------
    Reduced

    Raises
    ------
    TurgorError
        If the model has something that reduced models leave out, or a key is unknown or no load.
    """
    began, budget, options = perf_counter(), budget or Budget(), options or EngineOptions()
    box = inputs_of(model, inputs)
    model = with_all_cavities(model, box)
    variation = model_variation(model, list(box.keys), inputs=True)
    with use_threads(options.threads):
        training = Training(model, variation.model, box, budget, options, runs, say or _silent)
        reduced = training.run()
    training.say(f"{reduced!r} in {perf_counter() - began:.0f} s")
    return reduced


def _silent(text: str) -> None:
    pass


@dataclass(frozen=True, slots=True)
class Training:
    """The training of one reduced model."""

    model: Model
    model_at: Callable[[Mapping[str, float]], Model]
    box: Inputs
    budget: Budget
    options: EngineOptions
    runs: PathRuns | None
    say: Callable[[str], None]

    def run(self) -> Reduced:
        """Train from the corners on, then with the worst of random inputs, then look at inputs kept from training."""
        box, budget = self.box, self.budget
        system = System(self.model_at(dict(zip(box.keys, box.high.tolist(), strict=True))))
        check_reducible(system)
        trainer = Trainer(self.model_at, box, budget.steps, self.options, budget.motion)
        drive = drive_of(system, self.model_at, box)
        paths = self._paths(trainer, [*corners(box), *aims_of(box, budget.aims)][: budget.paths])
        count = modes_needed(system, paths, TRAINING.missed * budget.error, budget.modes)
        count = max(count, min(TRAINING.modes, budget.modes))
        reduced = self.reduced(system, build(system, drive, paths, count, budget.error), paths)
        good, needed = 0, 1 if one_path(box) else budget.checks
        while good < needed and len(paths) < budget.paths:
            path = self._paths(trainer, [self._worst(reduced, paths)])[0]
            errors = compared(reduced, path, reached_only=False)
            self.say(f"  error there {errors.worst:.2g}" + _forces_text(errors))
            forces = errors.force.max(initial=0.0) <= TRAINING.force
            good = good + 1 if forces and errors.worst <= budget.error else 0
            paths.append(path)
            if reduced.known.errors.max() > budget.error or not forces:
                count = min(count + TRAINING.more, budget.modes)
            reduced = self.reduced(system, build(system, drive, paths, count, budget.error), paths)
        if budget.motion:
            reduced = replace(reduced, masses=masses_of(system, reduced.modes.astype(np.float64)))
        return self._looked_at(reduced, trainer, paths)

    def _paths(self, trainer: Trainer, aims: Sequence[Array], kind: str = "training path") -> list[Path]:
        """Full solves from rest to some inputs."""
        every = (trainer.path(aim) for aim in aims) if self.runs is None else self.runs.paths(self.model, trainer, aims)
        paths = []
        for aim, path in zip(aims, every, strict=True):
            text = self.box.text(aim)
            end = "" if path.reached else ", which was not reached"
            self.say(f"{kind}: {text}{end}; {len(path.inputs)} states in {path.seconds:.0f} s")
            if not len(path.inputs):
                raise NotSolved(f"the full model finds no equilibrium on the way to {text}.")
            paths.append(path)
        return paths

    def _worst(self, reduced: Reduced, paths: Sequence[Path]) -> Array:
        """The worst of random inputs by the estimated error; one that the reduced model refuses comes first.

        Inputs near those that the full model did not reach are left out. Every other path leads to one that presses an
        obstacle, if any does: the estimate is of displacements, and forces need checks, too.
        """
        shares = random_shares(len(self.box.keys), len(paths), TRAINING.candidates)
        for path in paths:
            if not path.reached:
                away = np.linalg.norm(shares - self.box.scaled(aim_of(reduced.inputs, path)[1:]), axis=1)
                shares = shares[away > TRAINING.apart] if (away > TRAINING.apart).any() else shares
        worst, place = (False, -1.0), self.box.high
        for share in shares:
            values = self.box.at_shares(share)
            try:
                answer = reduced.at(values)
            except NotSolved:
                return np.asarray(values)
            pressing = len(paths) % 2 == 1 and any(force.any() for force in answer.obstacle_forces.values())
            if (pressing, answer.estimate) > worst:
                worst, place = (pressing, answer.estimate), values
        return place

    def _looked_at(self, reduced: Reduced, trainer: Trainer, trained: Sequence[Path]) -> Reduced:
        """Compare with full solves that training never saw."""
        shares = random_shares(len(self.box.keys), 2**20, self.budget.held_out)
        if one_path(self.box):
            shares = 0.9 + 0.1 * shares
        if not len(shares):
            return reduced
        aims = list(self.box.at_shares(shares))
        between = replace(trainer, steps=trainer.steps + 1)  # states lie between those of training
        paths = self._paths(between, aims, "held-out path")
        parts = [compared(reduced, path, reached_only=False) for path in paths]
        names = ("inputs", "displacement", "tip", "volume", "force")
        errors = HeldOutErrors(**{name: np.concatenate([getattr(part, name) for part in parts]) for name in names})
        return replace(reduced, held_out=errors, known=known_errors(reduced, [*trained, *paths]))

    def reduced(self, system: System, built: Built, paths: Sequence[Path]) -> Reduced:
        """Collect what answers need."""
        mesh = system.model.mesh
        tip = np.zeros((3, built.modes.vectors.shape[1]))
        if "tip" in mesh.faces:
            weights = surfaces.nodal_weights(mesh.points, mesh.face("tip"))
            modes = built.modes.vectors.reshape(system.node_count, 3, -1)[: len(weights)]
            mean = np.einsum("n,nir->ri", weights / weights.sum(), modes)
            tip = MeshFacts(mesh).of_whole(mean).T
        nothing = np.zeros(0)
        reduced = Reduced(
            model=system.model, inputs=self.box, equations=built.equations, checks=built.checks,
            modes=_small(built.modes)[: 3 * len(mesh.points)], stresses=_small(built.stresses),
            scales=(system.length, system.stress_scale), faces=built.faces, tip=tip,
            trained_inputs=built.inputs, trained=built.y, wanted=self.budget.error,
            penalties=tuple(part.penalty_scale.astype(np.float32) for part in system.contact.parts),
            counts=built.counts | {"training paths" if len(paths) > 1 else "training path": len(paths)},
            held_out=HeldOutErrors(inputs=nothing[:, None], displacement=nothing, tip=nothing, volume=nothing,
                                   force=nothing),
        )  # fmt: skip
        reduced = replace(reduced, spline=start_of(reduced))
        return replace(reduced, known=known_errors(reduced, paths))


def _small(modes: Modes) -> NDArray[np.float32]:
    return modes.vectors.astype(np.float32)


def _forces_text(errors: HeldOutErrors) -> str:
    """Error of the forces on obstacles in words; nothing without any."""
    return f", of the force {errors.force.max():.2g}" if errors.force.any() else ""
