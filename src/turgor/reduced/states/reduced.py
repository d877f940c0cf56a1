"""Reduced: a model in a few coordinates, which answers in milliseconds."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.model import Model
from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.foundation.store.archive import Content, write_archive
from turgor.foundation.store.codec import FOUR_DIGITS, Encoder
from turgor.foundation.store.saved_objects import Saved
from turgor.reduced.parts.inertia import Masses
from turgor.reduced.settings import NEWTON
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.equations import Equations, Part
from turgor.reduced.states.estimate import KnownErrors
from turgor.reduced.states.following import Followed, Moving, checked_history, follow_history
from turgor.reduced.states.held_out import HeldOutErrors
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.known_measures import KnownMeasures
from turgor.reduced.states.newton import Balance, follow, newton
from turgor.reduced.states.spline import Spline

Array = NDArray[np.float64]
Small = NDArray[np.float32]

#: Ending of the files.
ENDING = ".reduced"


@dataclass(frozen=True, kw_only=True, eq=False)
class Reduced(Saved, Shown):
    """A model in the coordinates of a few modes.

    Parameters
    ----------
    model : Model
        The full one.
    inputs : Inputs
        What varies, in which range.
    equations : Equations
        Sampled.
    checks : tuple of Part
        The sampled parts at other points, for an indicator of the error.
    modes, stresses : (3 nodes, r), (m, k) float32 arrays
        Modes of scaled displacement and mean stress.
    scales : (float, float)
        Length [m] and stress [Pa].
    faces : tuple of str
        Cavities and other faces under pressure.
    tip : (3, r) array
        Scaled mean displacement of the face ``tip`` of the modes; zeros without one.
    trained_inputs, trained : (t, 1 + n), (t, r + k) arrays
        Training states: share of the loads that are no inputs, inputs, coordinates.
    penalties : tuple of float32 arrays
        Factors on the penalty of each part of contact.
    counts : mapping of str to int
        Sampled cells, points of contact, full solves.
    wanted : float [-]
        Error that was requested, of the displacement over its largest.
    held_out : HeldOutErrors
    known : KnownErrors
        Errors at training and held-out states, from which the error of an answer is estimated.
    spline : Spline or None
        Answers at training states, from which Newton's method starts; None where it starts from the nearest.
    masses : Masses or None
        For motion; None where it was trained without.
    measures : KnownMeasures
        Measures that answers state, with their errors; see `with_measures`.
    """

    model: Model
    inputs: Inputs
    equations: Equations
    checks: tuple[Part, ...]
    modes: Small = field(metadata=FOUR_DIGITS)
    stresses: Small
    scales: tuple[float, float]
    faces: tuple[str, ...]
    tip: Array
    trained_inputs: Array
    trained: Array
    penalties: tuple[Small, ...] = ()
    counts: Mapping[str, int] = field(default_factory=dict)
    wanted: float = 0.005
    held_out: HeldOutErrors
    known: KnownErrors = field(default_factory=KnownErrors)
    spline: Spline | None = None
    masses: Masses | None = None
    measures: KnownMeasures = field(default_factory=KnownMeasures)

    def __repr__(self) -> str:
        r, m = self.equations.sizes
        counts = ", ".join(f"{count} {name}" for name, count in self.counts.items())
        error = f"held-out error {self.held_out.worst:.2g}" if len(self.held_out.inputs) else "nothing held out"
        return f"Reduced('{self.model.mesh.name}', {', '.join(self.inputs.keys)}; {r} + {m} modes, {counts}; {error})"

    def solve(
        self, values: Mapping[str, float | Sequence[float]] | float, *, start: ReducedState | None = None
    ) -> ReducedState:
        """Find the equilibrium at values of the inputs.

        Parameters
        ----------
        values : mapping of str to float [SI], or float
            By the keys of the inputs, or the ends of the keys: ``{"pressure": 10e3}``; a vector has all its components,
            ``{"tip.vector": (0, 0, 0.02)}``. A number where there is one input.
        start : ReducedState, optional
            One to go on from, such as the last of a loop; by default a spline through answers at training states.

        Returns
        -------
        ReducedState

        Raises
        ------
        TurgorError
            If an input is unknown or outside of the trained range.
        NotSolved
            If no equilibrium was found.
        """
        given = values if isinstance(values, Mapping) else {self._only_input: values}
        return self.at(self.inputs.vector(given), start)

    def solve_all(self, table: Iterable[Mapping[str, float | Sequence[float]] | float]) -> list[ReducedState]:
        """Find the equilibria at many values of the inputs, each on its own."""
        return [self.solve(values) for values in table]

    def follow(
        self,
        times: Sequence[float] | Array,
        values: Mapping[str, Sequence[float]] | Sequence[float],
        moving: Moving | None = None,
    ) -> Followed:
        """Follow histories of the inputs from the equilibrium at the first of them.

        Parameters
        ----------
        times : (k,) sequence [s]
            Rising.
        values : mapping of str to (k,) sequences [SI]
            Of each input at these times, by its key or the end of its key; between them inputs are linear. A sequence
            where there is one input.
        moving : Moving, optional
            Inertia, damping and time steps; without, every state is an equilibrium.

        Returns
        -------
        Followed

        Raises
        ------
        TurgorError
            If an input is unknown or outside of the trained range, or the model was trained without motion.
        NotSolved
            If no state was found.
        """
        given = values if isinstance(values, Mapping) else {self._only_input: values}
        columns = {name: np.asarray(each, dtype=np.float64) for name, each in given.items()}
        rows = min((len(each) for each in columns.values()), default=0)
        table = np.array([self.inputs.vector({name: each[k] for name, each in columns.items()}) for k in range(rows)])
        at = checked_history(times, max(columns.values(), key=len, default=table))
        if moving is not None and self.masses is None:
            raise TurgorError("this reduced model was trained without motion; train it with motion.")
        return follow_history(self, at, table, moving, self.at(table[0]))

    @property
    def _only_input(self) -> str:
        if len(self.inputs.keys) != 1:
            raise TurgorError(
                f"there are {len(self.inputs.keys)} inputs, {', '.join(self.inputs.keys)}; name each with its value."
            )
        return self.inputs.keys[0]

    def at(self, vector: Array, start: ReducedState | None = None) -> ReducedState:
        """Find the equilibrium at inputs (n,) in order; see `solve`."""
        return self.under(np.concatenate([[1.0], vector]), start)

    def under(self, aim: Array, start: ReducedState | None = None) -> ReducedState:
        """Find the equilibrium at a share of the loads that are no inputs, and inputs: (1 + n,); see `solve`."""
        vain = 0
        if start is None and self.spline is not None:
            result = newton(self.equations, self.spline.at(aim), aim, self._size)
            if isinstance(result, Balance):
                return ReducedState.of(self, result, vain)
            vain += result
        for begin, y in self._starts(aim, start):
            result = follow(self.equations, y, (begin, aim), self._size)
            if isinstance(result, Balance):
                return ReducedState.of(self, result, vain)
            vain += result
        raise NotSolved(
            f"the reduced model finds no equilibrium at {self.inputs.text(aim[1:])} within {vain} updates; "
            "train it more densely."
        )

    def _starts(self, aim: Array, start: ReducedState | None) -> Iterable[tuple[Array, Array]]:
        if start is not None:
            yield np.concatenate([[1.0], start.inputs]), start.y
        away = (self.trained_inputs - aim) * self.weights
        for place in np.argsort((away**2).sum(axis=1), kind="stable")[: NEWTON.starts]:
            yield self.trained_inputs[place], self.trained[place]

    @cached_property
    def weights(self) -> Array:
        """Weights of the distance to training states; the share counts where loads are no inputs."""
        fixed = bool(self.equations.pressures[:, 0].any() or self.equations.forces[:, 0].any())
        return np.concatenate([[1.0 if fixed else 0.0], 1.0 / (self.inputs.high - self.inputs.low)])

    @cached_property
    def _size(self) -> float:
        return float(np.linalg.norm(self.trained[:, : self.equations.sizes[0]], axis=1).max())

    @property
    def size(self) -> float:
        """Largest size of trained coordinates of the displacement."""
        return self._size

    @cached_property
    def yardsticks(self) -> tuple[float, float]:
        """Largest displacement of a node, and travel of the tip, of all training states, scaled."""
        q = self.trained[:, : self.modes.shape[1]].T
        travel = float(np.linalg.norm(self.tip @ q, axis=0).max())
        return float(np.abs(self.modes @ q).max()), travel

    def save(self, file: str | Path) -> Path:
        """Save it to a file, which holds numbers, text and arrays, no code; the ending ``.reduced`` is added."""
        path = Path(file)
        path = path if path.suffix == ENDING else path.with_name(path.name + ENDING)
        encoder = Encoder()
        write_archive(path, Content("Reduced", encoder.encode(self, "Reduced"), encoder.arrays))
        return path
