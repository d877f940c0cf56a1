"""What a solution holds: states, limit points, first touches, energies, modes and findings."""

from turgor.finding import Finding as Finding
from turgor.finding import Severity as Severity
from turgor.solvers.dynamics.modes import Modes as Modes
from turgor.solvers.energies import Energies as Energies
from turgor.solvers.solution import LimitPoint as LimitPoint
from turgor.solvers.solution import SolveError as SolveError
from turgor.solvers.solution import State as State
from turgor.solvers.solution import Touch as Touch
