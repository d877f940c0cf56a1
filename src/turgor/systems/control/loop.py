"""Loop: a controller and a simulated actuator that differs from its model."""

from collections import deque
from dataclasses import dataclass, field
from time import process_time

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.display import Shown
from turgor.foundation.errors import TurgorError
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.controller import Air, Controller
from turgor.systems.control.outputs import OutputOf
from turgor.systems.control.search import moved
from turgor.systems.control.track import checked_path

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Plant:
    """A simulated actuator: a reduced model, perhaps a richer one, that differs from that of the controller.

    Parameters
    ----------
    reduced : Reduced
        Its inputs are pressures.
    air : Air
        Delay and lag between command and chamber.
    stiffness : float [-]
        All moduli over those of the reduced model. An actuator without weight that is stiffer by some factor has the
        same shape at pressures larger by this factor.
    noise : float [SI]
        Standard deviation of each measured number.
    seed : int
        Of the noise.

    Examples
    --------
    >>> Plant(reduced=None, stiffness=0)
    Traceback (most recent call last):
    turgor.TurgorError: stiffness of the plant is 0; allowed is more than 0.
    """

    reduced: Reduced
    air: Air = field(default_factory=Air)
    stiffness: float = 1.0
    noise: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        if not self.stiffness > 0:
            raise TurgorError(f"stiffness of the plant is {self.stiffness:g}; allowed is more than 0.")
        if not self.noise >= 0:
            raise TurgorError(f"noise of the plant is {self.noise:g}; allowed is 0 or more.")


@dataclass(frozen=True, slots=True, eq=False)
class LoopRun(Shown):
    """What a loop did.

    Parameters
    ----------
    output : OutputOf
    times : (k,) array [s]
    target, reached, measured : (k, m) arrays [SI]
        Wanted output; that of the plant without and with noise.
    inputs : (k, n) array [SI]
        Commands.
    seconds : (k,) array [s]
        Processor time of the controller.
    """

    output: OutputOf
    times: Array
    target: Array
    reached: Array
    measured: Array
    inputs: Array
    seconds: Array

    @property
    def distance(self) -> Array:
        """Distance (k,) [SI] between the wanted output and that of the plant, at the same time."""
        return np.asarray(np.linalg.norm(self.reached - self.target, axis=1))

    def rms(self, after: float = 0.0) -> float:
        """Root of the mean square of the distance after some time [SI]."""
        late = self.times >= after
        return float(np.sqrt((self.distance[late] ** 2).mean()))

    def __repr__(self) -> str:
        return f"LoopRun({len(self.times)} periods, root mean square of the distance {self.rms():.3g})"


def run_loop(controller: Controller, plant: Plant, path: Array) -> LoopRun:
    """Let a controller drive a simulated actuator along a path, one row each period.

    The controller sees the rows of its horizon in advance.

    Parameters
    ----------
    controller : Controller
        Reset before to where the path begins.
    plant : Plant
    path : (k, m) array [SI]

    Returns
    -------
    LoopRun
    """
    of = controller.output
    rows, period = checked_path(path, of), controller.period
    random, decay = np.random.default_rng(plant.seed), plant.air.decay(period)
    its, pressure = controller.follows.of(plant.reduced), controller.command.copy()
    queue = deque([pressure] * plant.air.periods(period))
    state = plant.reduced.at(pressure / plant.stiffness)
    reached: list[Array] = []
    measured: list[Array] = []
    commands: list[Array] = []
    seconds: list[float] = []
    ahead = controller.air.periods(period) + controller.tuning.horizon + 1
    for place in range(len(rows)):
        reached.append(its.at(state)[0])
        measured.append(reached[-1] + plant.noise * random.normal(size=len(reached[-1])))
        began = process_time()
        commands.append(controller.step(rows[place : place + ahead], measured[-1]))
        seconds.append(process_time() - began)
        queue.append(commands[-1])
        pressure = decay * pressure + (1 - decay) * queue.popleft()
        plant.reduced.inputs.check(pressure / plant.stiffness)
        state = moved(state, pressure / plant.stiffness)
    times: Array = period * np.arange(len(rows), dtype=np.float64)
    return LoopRun(of, times, rows, np.array(reached), np.array(measured), np.array(commands), np.array(seconds))
