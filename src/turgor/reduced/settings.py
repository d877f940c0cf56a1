"""Settings of reduced models: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class NewtonSettings:
    """Settings of Newton's method in reduced coordinates.

    Parameters
    ----------
    tolerance : float
        Size of the last update over the largest size of trained coordinates, below which a state counts as one.
        What it leaves is some of its square.
    near : float
        Size of an update, over the same, below which the next tangent has the stresses of its place.
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
    near: float = 1e-3
    longest: float = 0.5
    iterations: int = 14
    shortest: float = 1 / 64
    substeps: int = 6
    starts: int = 3


NEWTON = NewtonSettings()


@dataclass(frozen=True, slots=True)
class StartSettings:
    """Settings of the spline from which Newton's method starts.

    Parameters
    ----------
    rows : int
        Values and slopes at most, with more training states than that some are left out: 200 states with nine inputs.
    steepest : float
        Derivative by an input times its range, over the largest size of trained coordinates, beyond which a training
        state is left out: a body about to buckle there.
    smoothing : float
        Number on the diagonal of the equations for the spline, so that states very near to each other do no harm.
    """

    rows: int = 2000
    steepest: float = 5.0
    smoothing: float = 1e-8


START = StartSettings()


@dataclass(frozen=True, slots=True)
class SamplingSettings:
    """Settings of the choice of sampled points.

    Parameters
    ----------
    tolerance : float
        Error of the sampled forces, as an error of the coordinates over their size and over the wanted error, at which
        no more cells are added. With half of it an arm with three pressures has 729 points, not 484, and the same
        errors at 64 held-out states.
    cells : float
        Share of the tolerance with which cells are chosen first; points are chosen among theirs. All points at once
        would need gigabytes.
    most : int
        Cells at most.
    points : int
        Points at most. An arm with nine inputs and 46 modes is 0.20 % off in the median of 64 held-out states with 524
        points, 0.18 % with 710.
    perturbation : float
        Random changes of the training states, over the size of each coordinate: the energy is needed near the
        states, too, where Newton's method passes.
    swing, swings : float, int
        With motion, changes of the training states along the responses to inertia, over the largest size, and how many
        of each state. With one the tip of a short finger was 2.6 % off in a step of 20 ms, with four 0.5 %.
    states : int
        Training states at most; more are thinned.
    rows : int
        Rows of the least squares at most; more are combined at random. Some times the number of points is enough.
    near : float
        Points of a surface that came nearer to another than this share of the cell behind it may touch. On the demo
        finger 0.1 and 0.5 give the same answers, with 607 and 1,627 points.
    near_obstacles : float
        The same for obstacles, whose places may lie between those of training.
    moments : float
        Share of the moments of the lost volume of hexahedra that their combinations may miss.
    """

    tolerance: float = 0.04
    cells: float = 0.5
    most: int = 300
    points: int = 520
    perturbation: float = 0.01
    swing: float = 0.2
    swings: int = 4
    states: int = 120
    rows: int = 3000
    near: float = 0.2
    near_obstacles: float = 1.0
    moments: float = 1e-4


SAMPLING = SamplingSettings()


@dataclass(frozen=True, slots=True)
class TensionSettings:
    """Settings of the modes of the tension of fibers that work in compression, too.

    Parameters
    ----------
    modes : int
        Modes at most. An arm with a force, gravity and 40 displacement modes answers as well with 6 as with 10; 40 make
        it as stiff as sampled fibers do.
    truncation : float
        Size of the smallest mode over the largest.
    largest : float
        Second Piola–Kirchhoff tension over the stiffness at most. At 0.9 a piece is ten times as long as at rest.
    tolerance : float
        Last change of the tension over the stiffness; what it leaves is of the size of its square.
    iterations : int
        Updates of the tensions.
    """

    modes: int = 8
    truncation: float = 1e-6
    largest: float = 0.9
    tolerance: float = 1e-4
    iterations: int = 30


TENSIONS = TensionSettings()


@dataclass(frozen=True, slots=True)
class TrainingSettings:
    """Settings of the training.

    Parameters
    ----------
    modes : int
        Displacement modes at first. There are half as many mean stress modes: with as many, Newton's method finds
        nothing.
    pressed : int
        Mean stress modes at most. Each is a constraint, and where a body is soft too many of them bend it: an arm with
        three pressures and 30 displacement modes is 8 % off with 22, 2.1 % with 15 and 1.5 % with 10; with 40, it is
        1.3 % with 20 and 0.6 % with 10.
    missed : float
        Share of the wanted error that modes may miss of the states of the first paths; else there are more at first.
    differentiated : int
        States along a path whose derivatives by the inputs are snapshots, too, where there are several inputs. With
        three, 38 modes of an arm with nine miss 0.16 % of 128 held-out states in the median and 0.42 % at most, with
        the last alone 0.19 and 0.50 %.
    derivatives : float
        Derivatives of states by the inputs are shortened to this share of the largest state, in the stiffness at rest,
        before modes are found. They are multiplied by the whole ranges, and outweigh the states where the response is
        steep: an arm with three pressures misses its own training states by 30 % with 18 modes.
    more : int
        Modes that are added where the error at the training states themselves exceeds the wanted one.
    most : int
        Displacement modes at most.
    truncation : float
        Share of the snapshots' square sizes that modes may miss.
    steps : int
        Steps of a path at least.
    force : float
        Wanted error of the force on an obstacle, over the largest in training.
    candidates : int
        Random inputs whose estimated error is looked at in each round.
    apart : float
        Distance, over the ranges, within which inputs count as those that the full model did not reach.
    moving, responses : int
        For motion: states along a path at which responses to inertia are computed, and how many in a row for each
        input.
    sudden : float
        Duration of a sudden load and unloading, over the shortest relaxation time.
    inertial : int
        Modes of these responses at most, besides those of the states.
    """

    modes: int = 14
    pressed: int = 10
    missed: float = 0.3
    differentiated: int = 3
    derivatives: float = 0.1
    more: int = 4
    most: int = 26
    truncation: float = 1e-14
    steps: int = 12
    force: float = 0.05
    candidates: int = 1000
    apart: float = 0.15
    moving: int = 4
    responses: int = 3
    sudden: float = 1e-3
    inertial: int = 8


TRAINING = TrainingSettings()


@dataclass(frozen=True, slots=True)
class EstimateSettings:
    """Settings of the estimate of the error of an answer.

    Parameters
    ----------
    length : float
        Length of correlation of the errors, over the ranges, times the root of the number of inputs. Lengths from 0.3
        to 0.7 gave the same estimates on a short finger with one and two inputs.
    noise : float
        Part of the logarithm of the errors that does not depend on the inputs.
    deviations : float
        Standard deviations that are added. With 0, 0.1, 0.25, 0.5 and 1, at 128 states of 24 paths of an arm with nine
        inputs, 99, 99, 99, 96 and 95 % of estimates were within 0.3 to 3 times the error, nearly all others above; at
        64 states of 19 paths with three inputs and 30 modes 95, 94, 92, 92 and 89 %. With 16 paths and nine inputs 0.5
        gave 90 %, 1 96 %.
    rest : float
        Size of the answer, over the largest, below which the error no longer falls in proportion.
    smallest : float
        Errors below this count as this.
    spread : float
        Standard deviation of the logarithms at least.
    most : int
        Known errors at most; more are thinned.
    factor : float
        The error may be this many times the estimate.
    doubt : float
        Error that an answer may not have without a flag.
    sampling : float
        Share of the sampling's indicator in the yardstick of the errors, as a power; the size of the answer has the
        rest. At the same states of the arm it was 83, 91, 96 and 96 % with none, a half, three quarters and all of it,
        and with three inputs 88, 94, 100 and 100 %. With all of it errors above 2 % came without a flag.
    away : float
        In motion, share of the distance to the nearest training state, over the largest size, that counts as an error.
    """

    length: float = 0.5
    noise: float = 0.1
    deviations: float = 0.1
    rest: float = 0.1
    smallest: float = 1e-8
    spread: float = 0.1
    most: int = 400
    factor: float = 3.0
    doubt: float = 0.02
    sampling: float = 0.75
    away: float = 0.3


ESTIMATE = EstimateSettings()
