"""Episode: a simulated actuator that is commanded period by period."""

from collections import deque

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import NotSolved
from turgor.reduced.states.answer import ReducedState
from turgor.systems.control.controller import Air
from turgor.systems.control.outputs import trained_states
from turgor.systems.control.search import moved
from turgor.systems.learning.task import FollowTask
from turgor.systems.learning.valves import pressed

Array = NDArray[np.float64]

#: Inputs through which a drawn path passes, and its rows that are computed between two of them.
PLACES, BETWEEN = 5, 4


class Episode:
    """A simulated actuator with its air, limits and sensors, and the path that it is to follow.

    Parameters
    ----------
    task : FollowTask
    """

    def __init__(self, task: FollowTask) -> None:
        self.task, self.output = task, task.output.of(task.reduced)
        self.limits, (self.places, _) = task.limits.of(task.reduced), pressed(task.reduced)
        trained = np.array([self.output.at(state)[0] for state in trained_states(task.reduced)])
        self.reach = float(np.linalg.norm(trained - trained[0], axis=1).max())
        self._rest = np.clip(np.zeros(len(self.limits.low)), self.limits.low, self.limits.high)

    @property
    def low(self) -> Array:
        """Least commands (k,) [Pa]."""
        return self.limits.low[self.places]

    @property
    def high(self) -> Array:
        """Largest commands (k,) [Pa]."""
        return self.limits.high[self.places]

    @property
    def pressures(self) -> Array:
        """Pressures (k,) [Pa] in the cavities."""
        return self.state.inputs[self.places]

    @property
    def value(self) -> Array:
        """The output (m,) [SI], without noise."""
        return self.output.at(self.state)[0]

    def reset(self, random: np.random.Generator) -> None:
        """Begin again at rest, with other inputs and a path that are drawn."""
        self.random, self.time = random, 0
        inputs = random.uniform(self.limits.low, self.limits.high)
        inputs[self.places] = self._rest[self.places]
        self.state: ReducedState = self.task.reduced.at(inputs)
        self.command, self.share = self.pressures.copy(), self._shares(self.pressures)
        self._queue = deque([self.command] * self.task.air.periods(self.task.period))
        self.path = self._drawn() if self.task.path is None else np.asarray(self.task.path)

    def step(self, share: Array) -> float:
        """Command pressures as shares (k,) of their ranges, −1 to 1, for a period; return the reward.

        Raises
        ------
        NotSolved
            If the reduced model has no equilibrium there.
        """
        task = self.task
        wanted = self.low + 0.5 * (np.clip(share, -1.0, 1.0) + 1.0) * (self.high - self.low)
        most = self.limits.rate[self.places] * task.period
        self.command = np.clip(wanted, self.command - most, self.command + most)
        change, self.share = np.clip(share, -1.0, 1.0) - self.share, np.clip(share, -1.0, 1.0)
        self._queue.append(self.command)
        inputs = self.state.inputs.copy()
        inputs[self.places] = np.clip(self._after(self._queue.popleft()), self.low, self.high)
        self.time += 1
        self.state = moved(self.state, inputs)
        return -self.distance / self.reach - task.effort * float(change @ change) / len(change)

    def _after(self, command: Array) -> Array:
        task = self.task
        if isinstance(task.air, Air):
            decay = task.air.decay(task.period)
            return decay * self.pressures + (1 - decay) * command
        return task.air.after(self.state, command, task.period)

    @property
    def distance(self) -> float:
        """Distance [SI] between the output and the path."""
        return float(np.linalg.norm(self.value - self.row(self.time)))

    def row(self, time: int) -> Array:
        """Row (m,) [SI] of the path; the last one stays."""
        return np.asarray(self.path[min(time, len(self.path) - 1)])

    def observed(self) -> Array:
        """What an agent sees: the measured output, the path, measured pressures, the last action; see `environment`."""
        task, random = self.task, self.random
        seen = self.value + task.noise * random.normal(size=len(self.output.names))
        rows = [self.row(self.time + k) for k in range(1, task.ahead + 2)]
        pressures = self.pressures + task.pressure_noise * random.normal(size=len(self.places))
        outputs = [each / self.reach for each in (seen, *rows)]
        return np.concatenate([*outputs, self._shares(pressures), self.share])

    def _shares(self, pressures: Array) -> Array:
        widths = np.where(self.high > self.low, self.high - self.low, 1.0)
        return 2.0 * (pressures - self.low) / widths - 1.0

    def _drawn(self) -> Array:
        """Rows of a smooth path (1 + steps, m) through outputs that pressures within the limits give."""
        count, state, knots = self.task.steps, self.state, np.linspace(0.0, 1.0, PLACES)
        table = self.random.uniform(self.low, self.high, (PLACES, len(self.places)))
        table[0] = self.pressures
        rows, shares = [], np.linspace(0.0, 1.0, (PLACES - 1) * BETWEEN + 1)
        for share in shares:
            place = min(int(share * (PLACES - 1)), PLACES - 2)
            inner = (share - knots[place]) * (PLACES - 1)
            inputs = state.inputs.copy()
            inputs[self.places] = table[place] + (3 * inner**2 - 2 * inner**3) * (table[place + 1] - table[place])
            state = self._near(state, inputs)
            rows.append(self.output.at(state)[0])
        times = np.linspace(0.0, 1.0, count + 1)
        return np.column_stack([np.interp(times, shares, column) for column in np.array(rows).T])

    def _near(self, state: ReducedState, inputs: Array) -> ReducedState:
        """The equilibrium at inputs; the state itself where there is none."""
        try:
            return moved(state, inputs)
        except NotSolved:
            return state
