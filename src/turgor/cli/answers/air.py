"""Result of ``turgor air``, for programs."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.systems.air.history import History
    from turgor.systems.air.performance import Performance


@dataclass(frozen=True, slots=True, kw_only=True)
class AirResult:
    """``turgor air``: the state of a network at its end, in SI units.

    Parameters
    ----------
    name : str
    time : float
        Its end.
    pressures : table
        Gauge pressure of each node.
    balance : float
        Largest error of the balance of mass, over the largest mass that a node received.
    performance : table or null
        ``fill_time``, ``vent_time``, ``bandwidth``, ``frequency``, ``lag``, ``delay``, ``volume``, ``flow``,
        ``energy``, ``stored``, ``limiting``, and ``wider`` with the times that each part twice as wide brings.
    folder : str
    """

    name: str
    time: float
    pressures: Mapping[str, float]
    balance: float
    performance: Mapping[str, Any] | None
    folder: Path


def air_result(name: str, run: "History", result: "Performance | None", folder: Path) -> AirResult:
    """Make the result of a network."""
    shown: dict[str, Any] | None = None
    if result is not None:
        numbers = (
            "fill_time",
            "vent_time",
            "bandwidth",
            "frequency",
            "lag",
            "delay",
            "volume",
            "flow",
            "energy",
            "stored",
        )
        shown = {key: float(getattr(result, key)) for key in numbers}
        shown["limiting"] = result.limiting.part
        shown["wider"] = {
            each.part: {"fill_time": each.fill_time, "vent_time": each.vent_time} for each in result.wider
        }
    ambient = run.equations.around.ambient
    ports = run.equations.ports(float(run.time[-1]), run.unknowns[-1].tolist())
    return AirResult(
        name=name,
        time=float(run.time[-1]),
        pressures={node: port[0] - ambient for node, port in zip(run.equations.names, ports, strict=True)},
        balance=run.balance(),
        performance=shown,
        folder=folder,
    )
