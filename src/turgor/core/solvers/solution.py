"""Solution: the equilibrium path, every attempted step, and how the solve ended."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from enum import StrEnum
from textwrap import shorten
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.engine.points.motion import PointMotion
from turgor.core.model.model import Model
from turgor.core.solvers.energies import Energies
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.step_reasons import Cause, Reason
from turgor.foundation.display import Shown, brief, listed
from turgor.foundation.errors import NotSolved
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.store.saved_objects import Saved
from turgor.units import kPa, mm

#: Letters of the message that the representation of a solution shows.
LONGEST_MESSAGE = 160

#: Findings that it shows.
MOST_SHOWN = 2


class Status(StrEnum):
    """How a solve ended."""

    CONVERGED = "converged"
    FOLLOWED = "followed"
    STEP_TOO_SMALL = "step_too_small"
    LIMIT_POINT = "limit_point"
    TURNED_BACK = "turned_back"
    STEP_LIMIT = "step_limit"
    STOPPED = "stopped"
    INTERRUPTED = "interrupted"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Touch:
    """Results of one contact in one state: of the actuator with itself, or with an obstacle.

    Parameters
    ----------
    force : (n, 3) array [N]
        Forces of the contact on the nodes of the mesh, of the modeled part; with itself they sum to zero.
    pressure : (n,) array [Pa]
        Contact pressure on the deformed surface at every node, zero where nothing touches.
    area : float [m²]
        Contact area on the deformed surface, of the modeled part; both walls count where the actuator meets itself.
    penetration : float [m]
        Deepest penetration.
    place : (3,) array [m]
        How far the obstacle has moved from where it was at first; zeros for the contact with itself.
    share : float [-]
        Penetration as a share of what the tolerance allows, at the worst place; more than 1 where it does not hold.
    """

    force: NDArray[np.float64]
    pressure: NDArray[np.float64]
    area: float
    penetration: float
    place: NDArray[np.float64]
    share: float = 0.0

    __repr__ = brief


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class State(Shown):
    """Equilibrium at one point of the path.

    Parameters
    ----------
    model : Model
        The question.
    load_factor : float [-]
        How much of the loads acts, 0 to 1.
    displacement : (n, 3) array [m]
        Displacement of every node.
    mean_stress : (m,) array [Pa]
        Multipliers of the volume constraint (tension positive): at each vertex, then more where it jumps at a vertex
        (`turgor.core.engine.cells.element`); none in the displacement formulation.
    nodal_force : (n, 3) array [N]
        Internal minus external force at every node: zero where it is free, the support's reaction where it is fixed.
    unstable_modes : int or None
        Negative pivots of the tangent beyond those of the mean stress; 0 where the equilibrium is stable,
        None where it was not looked at.
    touches : mapping of str to Touch
        What every contact does, by the name of the obstacle, or ``"self"``.
    pressures : mapping of str to float [Pa], gauge
        What acts in each cavity and on each pressed face, stated by a load or found by the procedure; empty where
        nothing presses.
    driven : mapping of str to float [SI]
        What the procedure prescribed besides the load factor, by the names of columns: ``injected_volume`` [m³],
        ``gas_mass_ratio``.
    time : float or None [s]
        Time, where the procedure has one.
    velocity : (n, 3) array or None [m/s]
        Velocity of every node of a moving actuator.
    energies : Energies or None
        Where the work went, as far as the procedure counts it.
    stage : str
        Name of the stage in a sequence of procedures; the load factor is that of the stage then.
    memory : Memory or None
        Internal variables: of the rubber where any relaxes or softens, some hundred numbers a cell, and of friction.
    points : mapping of str to PointMotion
        Displacement, rotation and reactions of the reference points, by their names.
    """

    model: Model
    load_factor: float
    displacement: NDArray[np.float64]
    mean_stress: NDArray[np.float64]
    nodal_force: NDArray[np.float64]
    unstable_modes: int | None = None
    touches: Mapping[str, Touch] = field(default_factory=dict)
    pressures: Mapping[str, float] = field(default_factory=dict)
    driven: Mapping[str, float] = field(default_factory=dict)
    time: float | None = None
    velocity: NDArray[np.float64] | None = None
    energies: Energies | None = None
    stage: str = ""
    memory: Memory | None = None
    points: Mapping[str, PointMotion] = field(default_factory=dict)

    def __repr__(self) -> str:
        farthest = float(np.linalg.norm(self.displacement, axis=1).max(initial=0.0))
        parts = [f"{self.stage!r}"] if self.stage else []
        parts += [f"load factor {self.load_factor:.4g}"]
        parts += [] if self.time is None else [f"time {self.time:.4g} s"]
        acting = [f"{face} {pressure / kPa:.4g} kPa" for face, pressure in self.pressures.items()]
        parts += [listed(acting)] if acting else []
        parts += [f"largest displacement {farthest / mm:.4g} mm", f"{len(self.displacement):,} nodes"]
        parts += ["unstable"] if self.unstable_modes else []
        return f"State({', '.join(parts)})"


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitPoint:
    """Where the pressure on a path has a maximum or a minimum, found as a state of the path.

    Parameters
    ----------
    kind : str
        ``"maximum"`` or ``"minimum"``.
    load_factor : float [-]
        That of the state.
    pressure : float [Pa], gauge
        The pressure there; nan where no single pressure acts.
    face : str
        The face on which it acts; empty where all loads turn together.
    state : int
        Number of the state in the path.
    """

    kind: str
    load_factor: float
    pressure: float
    face: str
    state: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Iteration:
    """One Newton update, or the end of a step: what a progress bar shows.

    Parameters
    ----------
    step, iteration : int
        Number of the attempted step, and of the update in it.
    load_factor : float [-]
        That of the step.
    residual, correction, step_length : float [-]
        Relative residual, size of the update, and its share that the line search took.
    rejected : Reason or None
        Why the step was rejected, once it was: it is cut back then.
    """

    step: int
    iteration: int
    load_factor: float
    residual: float
    correction: float
    step_length: float
    rejected: Reason | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One attempted step: accepted, or rejected and cut back."""

    load_factor: float
    increment: float
    iterations: int
    residual: float
    accepted: bool
    seconds: float
    why: Reason | None = None
    stage: str = ""

    @property
    def reason(self) -> str:
        """Why the step was rejected, or how it was found after a failure; empty otherwise."""
        return "" if self.why is None else str(self.why)

    @property
    def cause(self) -> Cause | None:
        """The cause of the reason, which programs compare."""
        return None if self.why is None else self.why.cause


@dataclass(frozen=True, slots=True, kw_only=True)
class Timing:
    """Where the wall time went [s].

    Parameters
    ----------
    compile, setup : float
        Loading or compiling the kernels; pattern and analysis, once per mesh.
    assembly : float
        Forming tangents.
    residual : float
        Evaluating residuals, predictions included.
    factorization, solve : float
        Factoring tangents, solving with the factors.
    guide : float
        The path of a shorter row; the four before have their shares of it.
    total : float
        The whole of `turgor.solve`.
    factorizations : int
        Tangents formed and factored; fewer than iterations, because good factors are used again.
    linear_solver : str
        Its name.
    """

    compile: float = 0.0
    setup: float = 0.0
    assembly: float = 0.0
    residual: float = 0.0
    factorization: float = 0.0
    solve: float = 0.0
    guide: float = 0.0
    total: float = 0.0
    factorizations: int = 0
    linear_solver: str = ""

    @staticmethod
    def together(timings: "Sequence[Timing]") -> "Timing":
        """Sums over several solves, with the linear solver of the last."""
        values: dict[str, Any] = {}
        for each in fields(Timing):
            of_all = [getattr(timing, each.name) for timing in timings]
            values[each.name] = of_all[-1] if isinstance(of_all[-1], str) else sum(of_all)
        return Timing(**values)

    def parts(self) -> dict[str, float]:
        """Seconds of each part by its name in reports."""
        return {
            "compilation": self.compile,
            "setup": self.setup,
            "assembly": self.assembly,
            "residuals": self.residual,
            "factorization": self.factorization,
            "solution": self.solve,
        }


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Solution(Saved, Shown):
    """The path that a solve found, and how the solve ended.

    Parameters
    ----------
    model, procedure
        What was solved, and how.
    states : tuple of State
        Equilibria in order, the undeformed state (load factor 0) first; the path so far when the solve stopped early.
    status : Status
        How it ended.
    message, advice : str
        One sentence each: what happened with the numbers, and what to do.
    steps : tuple of Step
        Every attempted step.
    findings : tuple of Finding
        What checks noticed before and during the solve.
    timing : Timing
        Where the time went.
    limit_points : tuple of LimitPoint
        Maxima and minima of the pressure that were found on the path, in order.
    """

    model: Model
    procedure: Procedure
    states: tuple[State, ...]
    status: Status
    message: str
    advice: str = ""
    steps: tuple[Step, ...] = ()
    findings: tuple[Finding, ...] = ()
    timing: Timing = field(default_factory=Timing)
    limit_points: tuple[LimitPoint, ...] = ()

    def __repr__(self) -> str:
        end = shorten(self.message.rstrip("."), LONGEST_MESSAGE, placeholder=" …")
        heavy = [each for each in self.findings if each.severity is not Severity.NOTE]
        heavy = [each for each in heavy if each.message.rstrip(".") not in self.message]  # which may begin with one
        warned = "".join(f"; {shorten(str(each), LONGEST_MESSAGE, placeholder=' …')}" for each in heavy[:MOST_SHOWN])
        more = f"; and {len(heavy) - MOST_SHOWN} more findings" if len(heavy) > MOST_SHOWN else ""
        return f"Solution({self.status}, {len(self.states)} states of '{self.model.mesh.name}': {end}{warned}{more})"

    @property
    def converged(self) -> bool:
        """Whether the whole load was reached."""
        return self.status is Status.CONVERGED

    @property
    def complete(self) -> bool:
        """Whether the procedure went as far as requested, past limit points where the load cannot be reached."""
        return self.status in (Status.CONVERGED, Status.FOLLOWED)

    @property
    def iterations(self) -> int:
        """Newton iterations of all attempted steps."""
        return sum(step.iterations for step in self.steps)


class SolveError(NotSolved):
    """A solve that stopped before the whole load was reached; ``solution`` holds the path so far."""

    def __init__(self, solution: Solution) -> None:
        super().__init__(f"{solution.status}: {solution.message} {solution.advice}".strip())
        self.solution = solution
        self.interrupted = solution.status is Status.INTERRUPTED
