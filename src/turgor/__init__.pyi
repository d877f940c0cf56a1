"""The public names of turgor that most scripts need, and the namespaces that hold the others: one line each.

Type checkers and editors read this file as what ``turgor`` holds, and ``__init__.py`` as the list of what to import on
first use. A new public name is a new line here or in the stub of a namespace, in the order that `ruff` keeps.
"""

from turgor import actuators as actuators
from turgor import bodies as bodies
from turgor import cad as cad
from turgor import experiments as experiments
from turgor import files as files
from turgor import jobs as jobs
from turgor import laws as laws
from turgor import measures as measures
from turgor import obstacles as obstacles
from turgor import pictures as pictures
from turgor import setups as setups
from turgor import solutions as solutions
from turgor.adaptivity.measure import measure as measure
from turgor.adaptivity.mesh_to import mesh_to as mesh_to
from turgor.engine.runtime import EngineOptions as EngineOptions
from turgor.errors import TurgorError as TurgorError
from turgor.finding import Finding as Finding
from turgor.finding import Severity as Severity
from turgor.geometry.actuators.fast_pneunet import FastPneuNet as FastPneuNet
from turgor.geometry.geometry import Geometry as Geometry
from turgor.materials.experiments.read_tests import read_test as read_test
from turgor.materials.fitting.fit_laws import fit as fit
from turgor.materials.laws.laws import Yeoh as Yeoh
from turgor.materials.library.records import from_library as from_library
from turgor.materials.material import Material as Material
from turgor.meshing.generate import mesh as mesh
from turgor.meshing.mesh import Mesh as Mesh
from turgor.model.contact import Contact as Contact
from turgor.model.fibers import Fibers as Fibers
from turgor.model.fibers import Winding as Winding
from turgor.model.history import over_time as over_time
from turgor.model.loads import BodyForce as BodyForce
from turgor.model.loads import Gravity as Gravity
from turgor.model.loads import Pressure as Pressure
from turgor.model.loads import Traction as Traction
from turgor.model.model import Membrane as Membrane
from turgor.model.model import Model as Model
from turgor.model.supports import Displacement as Displacement
from turgor.model.supports import Fixed as Fixed
from turgor.model.supports import Radial as Radial
from turgor.model.supports import Shift as Shift
from turgor.model.supports import Symmetry as Symmetry
from turgor.response import Response as Response
from turgor.response import read_response as read_response
from turgor.results.measures.measures import bending_angle as bending_angle
from turgor.results.measures.measures import cavity_volume as cavity_volume
from turgor.results.measures.measures import tip_displacement as tip_displacement
from turgor.solvers.dynamics.modes import natural_frequencies as natural_frequencies
from turgor.solvers.procedures.arc_length import ArcLength as ArcLength
from turgor.solvers.procedures.auto import Auto as Auto
from turgor.solvers.procedures.dynamic import Dynamic as Dynamic
from turgor.solvers.procedures.gas_mass import GasMass as GasMass
from turgor.solvers.procedures.sealed import Sealed as Sealed
from turgor.solvers.procedures.stabilized import Stabilized as Stabilized
from turgor.solvers.procedures.stages import Stage as Stage
from turgor.solvers.procedures.stages import Stages as Stages
from turgor.solvers.procedures.static import Static as Static
from turgor.solvers.procedures.volume_control import VolumeControl as VolumeControl
from turgor.solvers.solution import Solution as Solution
from turgor.solvers.solution import SolveError as SolveError
from turgor.solvers.solution import State as State
from turgor.solvers.solution import Status as Status
from turgor.solvers.solve import solve as solve
from turgor.source import Source as Source

__version__: str
