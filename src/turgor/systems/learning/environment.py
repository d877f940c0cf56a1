"""environment: a task with a simulated actuator, for Gymnasium."""

from functools import cache
from typing import Any

import numpy as np

from turgor.foundation.errors import NotSolved
from turgor.studies.runs.optional_parts import needed
from turgor.systems.learning.episode import Episode
from turgor.systems.learning.task import FollowTask

#: Largest number that is observed.
LARGEST = 10.0


def environment(task: FollowTask) -> Any:
    """Make an environment of Gymnasium, in which an actuator is to follow a path.

    - **Action**, (k,) from −1 to 1: the commanded pressure of each input that is one, from its lower to its upper
      limit. A command changes by no more than the limit of its rate, and the air lets the pressure follow.
    - **Observation**, without unit: the output as measured and the rows of the path of the next period and of later
      ones, over the reach; the pressures as measured and the last action, from −1 to 1. The reach is the largest change
      of the output in training. Numbers end at ±10.
    - **Reward**: minus the distance between output and path over the reach, after the period, minus the effort times
      the mean square change of the action.
    - An episode is **truncated** after its steps. It is **terminated**, with a reward of −1 for each step that is left,
      where the model finds no equilibrium.

    ``info`` has the distance [SI], the pressures [Pa] and the estimated error of the model. The same seed gives the
    same episode.

    Parameters
    ----------
    task : FollowTask

    Returns
    -------
    gymnasium.Env

    Raises
    ------
    TurgorError
        If Gymnasium is not installed.
    """
    return _kind()(task)


@cache
def _kind() -> Any:
    """Class of the environments; Gymnasium is imported on first use."""
    gymnasium = needed("gymnasium", "an environment", "learning")
    base: Any = gymnasium.Env

    class FollowEnvironment(base):  # type: ignore[misc]
        """An actuator that is to follow a path; see `turgor.learning.environment`."""

        metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012  that is what Gymnasium reads

        def __init__(self, task: FollowTask) -> None:
            self.task, self.episode = task, Episode(task)
            k, m = len(self.episode.places), len(self.episode.output.names)
            self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (k,), np.float32)
            size = (m * (2 + task.ahead) + 2 * k,)
            self.observation_space = gymnasium.spaces.Box(-LARGEST, LARGEST, size, np.float32)
            self.render_mode = None

        def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> Any:
            super().reset(seed=seed)
            self.episode.reset(self.np_random)
            return self._observed(), self._info()

        def step(self, action: Any) -> Any:
            try:
                reward, lost = self.episode.step(np.asarray(action, dtype=np.float64)), False
            except NotSolved:
                reward, lost = float(self.episode.time - 1 - self.task.steps), True
            ended = self.episode.time >= self.task.steps
            return self._observed(), reward, lost, ended and not lost, self._info()

        def _observed(self) -> Any:
            return np.clip(self.episode.observed(), -LARGEST, LARGEST).astype(np.float32)

        def _info(self) -> dict[str, Any]:
            episode = self.episode
            estimate = episode.state.estimate
            return {"distance": episode.distance, "pressures": episode.pressures, "estimate": estimate}

    return FollowEnvironment
