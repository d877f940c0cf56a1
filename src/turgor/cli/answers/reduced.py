"""Results of ``turgor reduce`` and of ``turgor predict`` with a reduced model, for programs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.reduced.measures import Reading
    from turgor.reduced.states.answer import ReducedState
    from turgor.reduced.states.following import Followed
    from turgor.reduced.states.reduced import Reduced


#: Errors of held-out states, by their names in `HeldOutErrors`.
ERRORS = ("displacement", "tip", "volume", "force")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReducedResult:
    """``turgor reduce``: the reduced model, in SI units.

    Parameters
    ----------
    inputs : list of tables
        ``key``, ``low`` and ``high`` of each input.
    modes, mean_stress_modes : int
    counts : table
        Sampled cells, points of contact, training paths.
    held_out : table
        ``states``, and the largest errors ``displacement``, ``tip``, ``volume`` and ``force`` there.
    file : str
    """

    inputs: list[dict[str, Any]]
    modes: int
    mean_stress_modes: int
    counts: Mapping[str, int]
    held_out: dict[str, float]
    file: Path


def reduced_result(reduced: "Reduced", file: Path) -> ReducedResult:
    """Make the result of a reduction."""
    errors, box = reduced.held_out, reduced.inputs
    largest = {name: float(getattr(errors, name).max(initial=0.0)) for name in ERRORS}
    return ReducedResult(
        inputs=[
            {"key": key, "low": float(low), "high": float(high)}
            for key, low, high in zip(box.keys, box.low, box.high, strict=True)
        ],
        modes=reduced.equations.sizes[0],
        mean_stress_modes=reduced.equations.sizes[1],
        counts=dict(reduced.counts),
        held_out={"states": len(errors.inputs)} | largest,
        file=file,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class ReducedAnswer:
    """``turgor predict`` with a reduced model, in SI units.

    Parameters
    ----------
    inputs : table
    measures : table of tables
        ``value``, ``mesh_error`` and ``reduction_error`` of each measure of the job.
    volumes : table
        Of every pressed cavity.
    volume_rates : table
        Their derivatives by the inputs, in order.
    tip : list of float
        Mean displacement of the tip.
    tip_rates : list of lists
        Its derivatives by the inputs.
    obstacle_forces : table
        Force of the actuator on every obstacle.
    obstacle_force_rates : table
        Their derivatives by the inputs.
    estimate : float
        Estimated error of the displacement here, over the largest displacement in training.
    doubtful : bool
        Whether that error may be more than two percent.
    held_out_error, indicator : float
        Largest held-out error of the reduced model, and what other sampled points change here.
    """

    inputs: Mapping[str, float]
    measures: Mapping[str, Mapping[str, float]]
    volumes: Mapping[str, float]
    volume_rates: Mapping[str, Sequence[float]]
    tip: Sequence[float]
    tip_rates: Sequence[Sequence[float]]
    obstacle_forces: Mapping[str, Sequence[float]]
    obstacle_force_rates: Mapping[str, Sequence[Sequence[float]]]
    estimate: float
    doubtful: bool
    held_out_error: float
    indicator: float


def answer_result(result: "ReducedState", read: "Sequence[Reading]") -> ReducedAnswer:
    """Make the result of an answer and its measures."""
    return ReducedAnswer(
        inputs=dict(zip(result.reduced.inputs.keys, result.inputs.tolist(), strict=True)),
        measures={
            each.name: {
                "value": each.value,
                "mesh_error": each.mesh_error,
                "reduction_error": each.reduction_error,
            }
            for each in read
        },
        volumes=result.volumes,
        volume_rates={face: rates.tolist() for face, rates in result.volume_rates.items()},
        tip=result.tip.tolist(),
        tip_rates=result.tip_rates.tolist(),
        obstacle_forces={name: force.tolist() for name, force in result.obstacle_forces.items()},
        obstacle_force_rates={name: rates.tolist() for name, rates in result.obstacle_force_rates.items()},
        estimate=result.estimate,
        doubtful=result.doubtful,
        held_out_error=result.reduced.held_out.worst,
        indicator=result.indicator,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class FollowedAnswer:
    """``turgor predict --history`` with a reduced model, in SI units.

    Parameters
    ----------
    times : list of float
    tip : list of lists
        Mean displacement of the tip at each time.
    estimate : float
        Largest estimated error of the displacement, over the largest in training.
    doubtful : int
        States whose error may be more than two percent.
    file : str
        The table.
    """

    times: Sequence[float]
    tip: Sequence[Sequence[float]]
    estimate: float
    doubtful: int
    file: Path


def followed_result(followed: "Followed", file: Path) -> FollowedAnswer:
    """Make the result of a history."""
    return FollowedAnswer(
        times=followed.times.tolist(),
        tip=followed.tip.tolist(),
        estimate=max(each.estimate for each in followed.answers),
        doubtful=sum(each.doubtful for each in followed.answers),
        file=file,
    )
