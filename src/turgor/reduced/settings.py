"""Settings of reduced models: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class NewtonSettings:
    """Settings of Newton's method in reduced coordinates.

    Parameters
    ----------
    tolerance : float
        Size of the last update over the largest size of trained coordinates, below which a state counts as one.
    longest : float
        Longest update, over the largest size of trained coordinates.
    iterations : int
        Updates before a step counts as failed.
    shortest : float
        Shortest update, as a share of the whole.
    substeps : int
        How often a failed step is halved before the start is given up.
    starts : int
        Training states that are tried as starts, the nearest first.
    """

    tolerance: float = 1e-5
    longest: float = 0.5
    iterations: int = 14
    shortest: float = 1 / 64
    substeps: int = 6
    starts: int = 3


NEWTON = NewtonSettings()


@dataclass(frozen=True, slots=True)
class SamplingSettings:
    """Settings of the choice of sampled points.

    Parameters
    ----------
    tolerance : float
        Error of the sampled forces, as an error of the coordinates over their size, at which no more cells are added.
    cells : float
        Share of the tolerance with which cells are chosen first; points are chosen among theirs. All points at once
        would need gigabytes.
    most : int
        Cells at most.
    perturbation : float
        Random changes of the training states, over the size of each coordinate: the energy is needed near the
        states, too, where Newton's method passes.
    states : int
        Training states at most; more are thinned.
    near : float
        Points of a surface that came nearer to another than this share of the cell behind it may touch. On the demo
        finger 0.1 and 0.5 give the same answers, with 607 and 1,627 points.
    near_obstacles : float
        The same for obstacles, whose places may lie between those of training.
    moments : float
        Share of the moments of the lost volume of hexahedra that their combinations may miss.
    """

    tolerance: float = 1e-4
    cells: float = 0.5
    most: int = 300
    perturbation: float = 0.01
    states: int = 120
    near: float = 0.2
    near_obstacles: float = 1.0
    moments: float = 1e-4


SAMPLING = SamplingSettings()


@dataclass(frozen=True, slots=True)
class TrainingSettings:
    """Settings of the training.

    Parameters
    ----------
    modes : int
        Displacement modes at most. There are half as many mean stress modes: with as many, Newton's method finds
        nothing.
    truncation : float
        Share of the snapshots' square sizes that modes may miss.
    steps : int
        Steps of a path at least.
    force : float
        Wanted error of the force on an obstacle, over the largest in training.
    candidates : int
        Random inputs whose indicator is looked at in each round.
    """

    modes: int = 14
    truncation: float = 1e-14
    steps: int = 12
    force: float = 0.05
    candidates: int = 16


TRAINING = TrainingSettings()
