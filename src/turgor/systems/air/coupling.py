"""Coupling: gas and actuators in motion, step by step.

In a step the gas flows while the volumes change in proportion to time; the pressures at its end move the actuators, and
their volumes there must be those that the gas had. Newton's method finds them, with the compressibility of the gas and
the compliance of the actuator in this step, improved by Broyden's updates.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import NotSolved
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.following import Followed, Now, Run
from turgor.systems.air.equations import Equations
from turgor.systems.air.history import History
from turgor.systems.air.integrate import between
from turgor.systems.air.network import Network
from turgor.systems.air.nodes import Chamber
from turgor.systems.air.settings import SOLVER
from turgor.systems.air.stores import Process, process_of
from turgor.systems.air.volumes.moving import FollowedVolume, MovingActuator, MovingChamber

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Mover:
    """An actuator in motion in a network.

    Parameters
    ----------
    actuator : MovingActuator
    run : Run
        Its steps.
    start : ReducedState
    names : tuple of str
        Nodes that are its chambers, in the order of its inputs.
    laws : tuple of FollowedVolume
        Their volumes over time.
    processes : tuple of Process
        What density does with the pressure in each.
    dead : (n,) array [m³]
        Volumes of tubes there.
    """

    actuator: MovingActuator
    run: Run
    start: ReducedState
    names: tuple[str, ...]
    laws: tuple[FollowedVolume, ...]
    processes: tuple[Process, ...]
    dead: Array

    def volumes(self, now: Now) -> Array:
        """Volumes (n,) [m³] of its chambers."""
        return np.asarray(now.at.cubics.values[: len(self.actuator.drives)] @ self.actuator.drives * self._unit)

    def growth(self, now: Now) -> Array:
        """Rates (n,) [m³/s] of the volumes."""
        return np.asarray(self._slopes(now) @ now.motion.velocity)

    def compliance(self, now: Now) -> Array:
        """Derivatives (n, n) of the volumes at the end of a step by the pressures there."""
        r = len(now.motion.unknowns)
        return np.asarray(self._slopes(now) @ -(now.inverse @ now.at.by_inputs())[:r, 1:])

    def stiffness(self, pressures: Array, volumes: Array) -> Array:
        """Derivatives (n,) of absolute pressures by volumes where nothing flows."""
        states = [process(p) for process, p in zip(self.processes, pressures.tolist(), strict=True)]
        return np.array([-density / rise for density, rise, _ in states]) / (volumes + self.dead)

    def _slopes(self, now: Now) -> Array:
        drives = self.actuator.drives
        return np.asarray(drives.T @ now.at.cubics.gradients[: len(drives)] * self._unit)

    @property
    def _unit(self) -> float:
        reduced = self.actuator.reduced
        return reduced.scales[0] ** 3 * reduced.model.mesh.symmetry_factor


def in_motion(network: Network) -> bool:
    """Whether a chamber of a network is in motion."""
    return any(isinstance(node, Chamber) and isinstance(node.volume, MovingChamber) for node in network.nodes.values())


def follow_coupled(network: Network, times: Array, until: float, how: tuple[float, str]) -> History:
    """Follow a network with actuators in motion; ``how`` is the relative error of a step of the gas, and the method."""
    movers = _movers(network, until)
    volumes = {name: law for mover in movers for name, law in zip(mover.names, mover.laws, strict=True)}
    nodes = {name: replace(node, volume=volumes[name]) if name in volumes else node  # type: ignore[type-var]
             for name, node in network.nodes.items()}  # fmt: skip
    steps = _Steps(Equations(replace(network, nodes=nodes), until), movers, *how)
    return steps.follow(times, until)


def _movers(network: Network, until: float) -> tuple[Mover, ...]:
    chambers: dict[int, dict[int, str]] = {}
    actuators: dict[int, MovingActuator] = {}
    for name, node in network.nodes.items():
        if isinstance(node, Chamber) and isinstance(node.volume, MovingChamber):
            actuators[id(node.volume.actuator)] = node.volume.actuator
            chambers.setdefault(id(node.volume.actuator), {})[node.volume.number] = name
    around, dead, movers = network.around(until), network.dead_volumes(), []
    for key, actuator in actuators.items():
        names = tuple(chambers[key][k] for k in range(len(chambers[key])))
        nodes = [network.nodes[name] for name in names]
        own = [node for node in nodes if isinstance(node, Chamber)]
        start = actuator.reduced.at(np.array([node.pressure for node in own]))
        reduced = actuator.reduced
        drives = actuator.drives
        at_start = np.array([start.volumes[face] for face in reduced.faces]) @ drives[: len(reduced.faces)]
        laws = tuple(FollowedVolume([0.0], [float(volume)]) for volume in at_start)
        processes = tuple(process_of(node, around) for node in own)
        run = Run(reduced, actuator.moving)
        movers.append(Mover(actuator, run, start, names, laws, processes, np.array([dead[name] for name in names])))
    return tuple(movers)


@dataclass(frozen=True, slots=True, eq=False)
class _Steps:
    """Steps of a network and its actuators."""

    equations: Equations
    movers: tuple[Mover, ...]
    tolerance: float
    method: str

    def follow(self, times: Array, until: float) -> History:
        """Step to all times at which states are stored, and to all jumps of signals."""
        y, nows, evaluations = self.equations.first, [mover.run.begin(mover.start, 0.0) for mover in self.movers], 0
        states, stored = np.full((len(times), self.equations.size), np.nan), {float(t): k for k, t in enumerate(times)}
        stored_nows: list[list[Now]] = []
        if 0.0 in stored:
            states[0] = y
            stored_nows.append(nows)
        longest = min(mover.actuator.moving.step for mover in self.movers)
        for aim in self._aims([*stored, until], longest):
            while nows[0].time < aim:
                length = aim - nows[0].time
                y, nows, count = self._advance(y, nows, aim, length / np.ceil(length / longest * (1 - 1e-9)))
                evaluations += count
            if aim in stored:
                states[stored[aim]] = y
                stored_nows.append(nows)
        motions: dict[str, Followed] = {}
        for place, mover in enumerate(self.movers):
            followed = _followed(mover, times, [each[place] for each in stored_nows])
            motions |= dict.fromkeys(mover.names, followed)
        return History(equations=self.equations, time=times, unknowns=states, evaluations=evaluations, motions=motions)

    def _aims(self, needed: list[float], longest: float) -> list[float]:
        """Ends of steps: times that are needed, and jumps of signals unless a step to them were tiny."""
        aims = sorted(set(needed) - {0.0})
        apart = SOLVER.apart * longest
        return sorted({*aims, *(t for t in self.equations.breaks if np.abs(np.array([0.0, *aims]) - t).min() > apart)})

    def _advance(self, y: Array, nows: list[Now], aim: float, length: float) -> tuple[Array, list[Now], int]:
        """Make one step towards a time, shorter where gas and actuators do not agree."""
        begin, count = nows[0].time, 0
        for _ in range(SOLVER.halvings + 1):
            end = aim if begin + length >= aim * (1 - 1e-14) else begin + length
            new, evaluations = self._tried(y, nows, end)
            count += evaluations
            if new is not None:
                self._check(new[0], end)
                return *new, count
            for law in self._laws:
                del law.times[-1], law.volumes[-1]
            length *= 0.5
        raise NotSolved(
            f"gas and actuator find no common volume at {end:.4g} s; take shorter steps, or train more densely."
        )

    @property
    def _laws(self) -> list[FollowedVolume]:
        return [law for mover in self.movers for law in mover.laws]

    def _tried(self, y: Array, nows: list[Now], end: float) -> tuple[tuple[Array, list[Now]] | None, int]:
        """A step to a time, where gas and actuators agree on the volumes; and the evaluations of the gas."""
        begin, count = nows[0].time, 0
        guesses = [mover.volumes(now) + (end - begin) * mover.growth(now)
                   for mover, now in zip(self.movers, nows, strict=True)]  # fmt: skip
        for law in self._laws:
            law.times.append(end)
            law.volumes.append(law.volumes[-1])
        slopes: list[Array] = []
        last: list[tuple[Array, Array]] = []
        for _ in range(SOLVER.rounds):
            for mover, guess in zip(self.movers, guesses, strict=True):
                for law, volume in zip(mover.laws, guess.tolist(), strict=True):
                    law.volumes[-1] = volume
            after, evaluations = self._flowed(y, begin, end)
            count += evaluations
            if after is None:
                return None, count
            pressures = [self._pressures(mover, end, after) for mover in self.movers]
            new = self._moved(nows, end, pressures)
            if new is None:
                return None, count
            wrong: list[Array] = [mover.volumes(now) - guess
                                  for mover, now, guess in zip(self.movers, new, guesses, strict=True)]  # fmt: skip
            if all((np.abs(w) <= SOLVER.agreed * np.abs(g)).all() for w, g in zip(wrong, guesses, strict=True)):
                return (after, new), count
            if not slopes:
                slopes = [np.eye(len(g)) - mover.compliance(now) * mover.stiffness(p, g)
                          for mover, now, p, g in zip(self.movers, new, pressures, guesses, strict=True)]  # fmt: skip
            else:
                slopes = [_broyden(J, step, w - before)
                          for J, w, (step, before) in zip(slopes, wrong, last, strict=True)]  # fmt: skip
            steps: list[Array] = [np.linalg.solve(J, w).astype(np.float64) for J, w in zip(slopes, wrong, strict=True)]
            guesses = [guess + step for guess, step in zip(guesses, steps, strict=True)]
            last = list(zip(steps, wrong, strict=True))
        return None, count

    def _flowed(self, y: Array, begin: float, end: float) -> tuple[Array | None, int]:
        """The gas at the end of a step, jumps of signals within it; None where it cannot be followed."""
        count, how = 0, (self.tolerance, self.equations.scales * self.tolerance, self.method)
        for stop in (*(t for t in self.equations.breaks if begin < t < end), end):
            solution = between(self.equations, np.array([begin, stop]), y, how)
            count += solution.nfev
            if not solution.success:
                return None, count
            begin, y = stop, solution.y[:, -1]
        return y, count

    def _pressures(self, mover: Mover, time: float, y: Array) -> Array:
        """Absolute pressures of the chambers of an actuator."""
        ports, names = self.equations.ports(time, y.tolist()), self.equations.names
        return np.array([ports[names.index(name)][0] for name in mover.names])

    def _moved(self, nows: list[Now], end: float, pressures: list[Array]) -> list[Now] | None:
        """The actuators after a step with pressures at its end; None where one finds no state."""
        new = []
        for mover, now, absolute in zip(self.movers, nows, pressures, strict=True):
            gauge = absolute - self.equations.around.ambient
            step = mover.run.step(now, end, np.concatenate([[1.0], gauge]))
            if step is None:
                return None
            new.append(step)
        return new

    def _check(self, y: Array, time: float) -> None:
        """Raise an error where a pressure leaves the trained range."""
        for mover in self.movers:
            box, gauge = mover.actuator.reduced.inputs, self._pressures(mover, time, y) - self.equations.around.ambient
            margin = SOLVER.beyond * (box.high - box.low)
            for k in np.flatnonzero((gauge < box.low - margin) | (gauge > box.high + margin)).tolist():
                raise NotSolved(
                    f"at {time:.4g} s, {mover.names[k]} reaches {box.shown(k, gauge[k])}, beyond the trained "
                    f"{box.shown(k, box.low[k])} to {box.shown(k, box.high[k])}."
                )


def _broyden(slope: Array, step: Array, change: Array) -> Array:
    """Derivatives of the error by the volumes, with a minus, improved by what the last step has shown."""
    return np.asarray(slope + np.outer(-change - slope @ step, step) / max(float(step @ step), 1e-300))


def _followed(mover: Mover, times: Array, nows: list[Now]) -> Followed:
    """States of an actuator at the stored times."""
    return Followed(
        times,
        tuple(mover.run.answer(now) for now in nows),
        np.array([now.motion.velocity for now in nows]),
        tuple(now.energies for now in nows),
    )
