"""What a solution holds: states, limit points, first touches, energies, modes and findings."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.finding import Finding as Finding
    from turgor.finding import FindingWarning as FindingWarning
    from turgor.finding import Severity as Severity
    from turgor.solvers.dynamics.modes import Modes as Modes
    from turgor.solvers.energies import Energies as Energies
    from turgor.solvers.solution import LimitPoint as LimitPoint
    from turgor.solvers.solution import SolveError as SolveError
    from turgor.solvers.solution import State as State
    from turgor.solvers.solution import Touch as Touch
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
