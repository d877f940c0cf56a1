"""What a solution holds: states, limit points, first touches, energies, modes and findings."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.solvers.buckling.buckling_modes import BucklingModes as BucklingModes
    from turgor.core.solvers.buckling.buckling_modes import buckling_modes as buckling_modes
    from turgor.core.solvers.buckling.imperfection import imperfect as imperfect
    from turgor.core.solvers.dynamics.modes import Modes as Modes
    from turgor.core.solvers.energies import Energies as Energies
    from turgor.core.solvers.remeshing.remesh import Remeshed as Remeshed
    from turgor.core.solvers.remeshing.remesh import TransferError as TransferError
    from turgor.core.solvers.remeshing.remesh import remesh as remesh
    from turgor.core.solvers.solution import LimitPoint as LimitPoint
    from turgor.core.solvers.solution import SolveError as SolveError
    from turgor.core.solvers.solution import State as State
    from turgor.core.solvers.solution import Touch as Touch
    from turgor.foundation.finding import Finding as Finding
    from turgor.foundation.finding import FindingWarning as FindingWarning
    from turgor.foundation.finding import Severity as Severity
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
