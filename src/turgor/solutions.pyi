"""What a solution holds: limit points, first touches, energies and modes."""

from turgor.solvers.dynamics.modes import Modes as Modes
from turgor.solvers.energies import Energies as Energies
from turgor.solvers.solution import LimitPoint as LimitPoint
from turgor.solvers.solution import Touch as Touch
