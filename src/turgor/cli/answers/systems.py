"""Results of commands on actuators with what drives them, for programs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turgor.systems.control.track import Track
    from turgor.systems.robots.mechanisms.mechanism import ArmState


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackResult:
    """``turgor track``: inputs that follow a path, in SI units.

    Parameters
    ----------
    time : list of float
    inputs : table
        Values of each input, by its key.
    reached : table
        Each output, by its name.
    distance : list of float
        Distance between the wanted and the reached output.
    active : list of lists of str
        Limits that each row has reached.
    folder : str
    """

    time: Sequence[float]
    inputs: Mapping[str, Sequence[float]]
    reached: Mapping[str, Sequence[float]]
    distance: Sequence[float]
    active: Sequence[Sequence[str]]
    folder: Path


def track_result(result: "Track", folder: Path) -> TrackResult:
    """Make the result of a path."""
    keys = result.states[0].reduced.inputs.keys
    return TrackResult(
        time=result.times.tolist(),
        inputs=dict(zip(keys, result.inputs.T.tolist(), strict=True)),
        reached=dict(zip(result.output.names, result.reached.T.tolist(), strict=True)),
        distance=result.distance.tolist(),
        active=[list(names) for names in result.active],
        folder=folder,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotArm:
    """An arm, in SI units.

    Parameters
    ----------
    name : str
    tip : list of float
        Place of the tip.
    turn : list of lists of float
        Rotation of the tip.
    force : list of float
        On the object.
    depth : float
        How far the arm is inside of the object.
    """

    name: str
    tip: Sequence[float]
    turn: Sequence[Sequence[float]]
    force: Sequence[float]
    depth: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotResult:
    """``turgor robot``: how arms stand.

    Parameters
    ----------
    name : str
    arms : list of RobotArm
    errors : mapping of str to str
        What is known of the error of the chain of each file.
    folder : str
    """

    name: str
    arms: Sequence[RobotArm]
    errors: Mapping[str, str]
    folder: Path


def robot_result(name: str, states: "Mapping[str, ArmState]", errors: Mapping[str, str], folder: Path) -> RobotResult:
    """Make the result of a mechanism."""
    arms = [
        RobotArm(name=s.name, tip=s.tip.tolist(), turn=s.turn.tolist(), force=s.force.tolist(), depth=s.depth)
        for s in states.values()
    ]
    return RobotResult(name=name, arms=arms, errors=dict(errors), folder=folder)
