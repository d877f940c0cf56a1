"""Newton values: the settings of Newton's method, where it starts and how it ended."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.system import Evaluation, Stresses
from turgor.core.solvers.step_reasons import Reason

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class NewtonSettings:
    """How Newton's method iterates.

    Parameters
    ----------
    tolerance : float [-]
        Largest relative residual.
    max_iterations : int
        Updates before it gives up.
    mixed_points : bool
        Whether stresses may be linearized where the tangent is set to that.
    recount : bool
        Whether unstable modes are counted by new factors where the last ones are stale.
    enough : float [-]
        Relative residual that is accepted where round-off keeps it above the tolerance.
    """

    tolerance: float = 1e-6
    max_iterations: int = 15
    mixed_points: bool = True
    recount: bool = False
    enough: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NewtonResult:
    """How Newton's method ended.

    Parameters
    ----------
    evaluation : Evaluation or None
        The equations at the last iterate.
    iterations : int
        Updates in all.
    residual : float [-]
        The last relative residual.
    converged : bool
    scalars : (k,) array
        The scalars at the last iterate.
    unstable_modes : int or None
        None where a border needs them counted with the rates.
    reason : Reason or None
        Why it failed, or how the state was found.
    hardest : int
        Updates of the longest pass where friction and contact stiffness were renewed.
    """

    evaluation: Evaluation | None
    iterations: int
    residual: float
    converged: bool
    scalars: Array = field(default_factory=lambda: np.empty(0))
    unstable_modes: int | None = None
    reason: Reason | None = None
    hardest: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """Where Newton's method starts.

    Parameters
    ----------
    unknowns : (size,) array
    stresses : Stresses or None
        For the geometric stiffness of the first update; None takes those of the start.
    scalars : (k,) array
        None under load control.
    evaluation : Evaluation or None
        The equations there, where they were evaluated already.
    fresh : bool
        Whether the first update needs factors of its own, or those of the last solve will do.
    """

    unknowns: Array
    stresses: Stresses | None
    scalars: Array = field(default_factory=lambda: np.empty(0))
    evaluation: Evaluation | None = None
    fresh: bool = True


Report = Callable[[int, float, float, float], None]  # iteration, residual, correction, step length
