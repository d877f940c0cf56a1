"""turgor: finite element modeling of soft fluidic actuators, from a specimen to a design decision.

Every public name is here, flat: ``import turgor as tg``. The rooms are imported on first use, so that a command
that only reads a file or prints an error does not wait for the engine.
"""

from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.engine.mass import total_mass as total_mass
    from turgor.engine.runtime import EngineOptions as EngineOptions
    from turgor.errors import TurgorError as TurgorError
    from turgor.finding import Finding as Finding
    from turgor.finding import Severity as Severity
    from turgor.geometry.actuators.bellows_of_revolution import BellowsOfRevolution as BellowsOfRevolution
    from turgor.geometry.actuators.bidirectional_bender import BidirectionalBender as BidirectionalBender
    from turgor.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet as BidirectionalPneuNet
    from turgor.geometry.actuators.contracting_tube import ContractingTube as ContractingTube
    from turgor.geometry.actuators.eccentric_bender import EccentricBender as EccentricBender
    from turgor.geometry.actuators.extending_cylinder import ExtendingCylinder as ExtendingCylinder
    from turgor.geometry.actuators.fast_pneunet import FastPneuNet as FastPneuNet
    from turgor.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender as FiberReinforcedBender
    from turgor.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder as FiberReinforcedCylinder
    from turgor.geometry.actuators.free_bottom_pneunet import FreeBottomPneuNet as FreeBottomPneuNet
    from turgor.geometry.actuators.helical_pneunet import HelicalPneuNet as HelicalPneuNet
    from turgor.geometry.actuators.manta_fin import MantaFin as MantaFin
    from turgor.geometry.actuators.omnidirectional_actuator import OmnidirectionalActuator as OmnidirectionalActuator
    from turgor.geometry.actuators.parallel_bellows import ParallelBellows as ParallelBellows
    from turgor.geometry.actuators.rectangular_bender import RectangularBender as RectangularBender
    from turgor.geometry.actuators.revolute_joint import RevoluteJoint as RevoluteJoint
    from turgor.geometry.actuators.semicircular_bender import SemicircularBender as SemicircularBender
    from turgor.geometry.actuators.slow_pneunet import SlowPneuNet as SlowPneuNet
    from turgor.geometry.actuators.three_extenders import ThreeExtenders as ThreeExtenders
    from turgor.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet as TrapezoidalPneuNet
    from turgor.geometry.actuators.triangular_pneunet import TriangularPneuNet as TriangularPneuNet
    from turgor.geometry.actuators.twisting_tube import TwistingTube as TwistingTube
    from turgor.geometry.actuators.two_material_bender import TwoMaterialBender as TwoMaterialBender
    from turgor.geometry.cad.cad_file import CadFile as CadFile
    from turgor.geometry.cad.inspection import Inspection as Inspection
    from turgor.geometry.cad.inspection import inspect_cad as inspect_cad
    from turgor.geometry.cad.read import read_cad as read_cad
    from turgor.geometry.cad.selectors import ByColor as ByColor
    from turgor.geometry.cad.selectors import ByName as ByName
    from turgor.geometry.cad.selectors import InBox as InBox
    from turgor.geometry.cad.selectors import NearestTo as NearestTo
    from turgor.geometry.cad.selectors import WithNormal as WithNormal
    from turgor.geometry.cad.split import SplitPlane as SplitPlane
    from turgor.geometry.geometry import Geometry as Geometry
    from turgor.geometry.mold import MoldSettings as MoldSettings
    from turgor.geometry.mold import casting_mold as casting_mold
    from turgor.geometry.solids import Block as Block
    from turgor.geometry.solids import RoundBar as RoundBar
    from turgor.geometry.write_step import write_step as write_step
    from turgor.job.convergence import convergence as convergence
    from turgor.job.export import export_job as export_job
    from turgor.job.job import Job as Job
    from turgor.job.read import read_job as read_job
    from turgor.job.run import run_job as run_job
    from turgor.materials.curves import Curve as Curve
    from turgor.materials.curves import curve as curve
    from turgor.materials.doubts import doubts_of as doubts_of
    from turgor.materials.experiments import MaterialTest as MaterialTest
    from turgor.materials.experiments import Step as Step
    from turgor.materials.fit_checks import check_modes as check_modes
    from turgor.materials.fit_checks import check_order as check_order
    from turgor.materials.fit_checks import check_stretch_range as check_stretch_range
    from turgor.materials.fit_history import fit_history as fit_history
    from turgor.materials.fit_record import save_fits as save_fits
    from turgor.materials.fit_record import save_material as save_material
    from turgor.materials.fit_result import Fit as Fit
    from turgor.materials.fit_result import TestError as TestError
    from turgor.materials.fitting import fit as fit
    from turgor.materials.handling import average as average
    from turgor.materials.handling import crop as crop
    from turgor.materials.handling import remove_slack as remove_slack
    from turgor.materials.handling import remove_tail as remove_tail
    from turgor.materials.handling import rest_below as rest_below
    from turgor.materials.handling import select_cycle as select_cycle
    from turgor.materials.handling import set_zero_length as set_zero_length
    from turgor.materials.handling import thin as thin
    from turgor.materials.history_fit import HistoryFit as HistoryFit
    from turgor.materials.laws import ArrudaBoyce as ArrudaBoyce
    from turgor.materials.laws import GeneralizedRivlin as GeneralizedRivlin
    from turgor.materials.laws import Gent as Gent
    from turgor.materials.laws import Hooke as Hooke
    from turgor.materials.laws import MooneyRivlin as MooneyRivlin
    from turgor.materials.laws import NeoHooke as NeoHooke
    from turgor.materials.laws import Ogden as Ogden
    from turgor.materials.laws import Yeoh as Yeoh
    from turgor.materials.laws import YeohN as YeohN
    from turgor.materials.material import Material as Material
    from turgor.materials.ranking import Ranking as Ranking
    from turgor.materials.ranking import rank as rank
    from turgor.materials.read_tests import Specimen as Specimen
    from turgor.materials.read_tests import read_test as read_test
    from turgor.materials.read_tests import read_tests as read_tests
    from turgor.materials.records import from_library as from_library
    from turgor.materials.records import library as library
    from turgor.materials.records import records as records
    from turgor.materials.softening import Mullins as Mullins
    from turgor.materials.stability import first_instability as first_instability
    from turgor.materials.stress_history import StressHistory as StressHistory
    from turgor.materials.stress_history import stress_history as stress_history
    from turgor.materials.viscoelastic import Prony as Prony
    from turgor.meshing.combine import together as together
    from turgor.meshing.exchange import MeshFile as MeshFile
    from turgor.meshing.exchange import mesh_surfaces as mesh_surfaces
    from turgor.meshing.exchange import read_mesh as read_mesh
    from turgor.meshing.exchange import write_stl as write_stl
    from turgor.meshing.generate import mesh as mesh
    from turgor.meshing.mesh import Mesh as Mesh
    from turgor.meshing.placing import mirrored as mirrored
    from turgor.meshing.placing import placed as placed
    from turgor.meshing.sizes import default_size as default_size
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
    from turgor.model.obstacles import Box as Box
    from turgor.model.obstacles import Cylinder as Cylinder
    from turgor.model.obstacles import Obstacle as Obstacle
    from turgor.model.obstacles import Plane as Plane
    from turgor.model.obstacles import RigidSurface as RigidSurface
    from turgor.model.obstacles import SelfContact as SelfContact
    from turgor.model.obstacles import Sphere as Sphere
    from turgor.model.rigid import read_rigid as read_rigid
    from turgor.model.supports import Displacement as Displacement
    from turgor.model.supports import Fixed as Fixed
    from turgor.model.supports import Radial as Radial
    from turgor.model.supports import Symmetry as Symmetry
    from turgor.model.write_inp import compressible as compressible
    from turgor.model.write_inp import write_inp as write_inp
    from turgor.response import Response as Response
    from turgor.response import read_response as read_response
    from turgor.results.contact import ContactResult as ContactResult
    from turgor.results.contact import contact_results as contact_results
    from turgor.results.contact_measures import area_on as area_on
    from turgor.results.contact_measures import blocked_force as blocked_force
    from turgor.results.contact_measures import blocked_force_x as blocked_force_x
    from turgor.results.contact_measures import blocked_force_y as blocked_force_y
    from turgor.results.contact_measures import blocked_force_z as blocked_force_z
    from turgor.results.contact_measures import contact_area as contact_area
    from turgor.results.contact_measures import deepest_penetration as deepest_penetration
    from turgor.results.contact_measures import force_on as force_on
    from turgor.results.contact_measures import grip_force as grip_force
    from turgor.results.contact_measures import holding_force as holding_force
    from turgor.results.contact_measures import maximum_contact_pressure as maximum_contact_pressure
    from turgor.results.contact_measures import pull_distance as pull_distance
    from turgor.results.convergence import Convergence as Convergence
    from turgor.results.fibers import FiberResult as FiberResult
    from turgor.results.fibers import fiber_results as fiber_results
    from turgor.results.history_plots import history_figure as history_figure
    from turgor.results.measures import bending_angle as bending_angle
    from turgor.results.measures import cavity_volume as cavity_volume
    from turgor.results.measures import maximum_fiber_tension as maximum_fiber_tension
    from turgor.results.measures import maximum_principal_stretch as maximum_principal_stretch
    from turgor.results.measures import maximum_von_mises as maximum_von_mises
    from turgor.results.measures import measure as measure
    from turgor.results.measures import reaction as reaction
    from turgor.results.measures import smallest_gap as smallest_gap
    from turgor.results.measures import tip_displacement as tip_displacement
    from turgor.results.measures import tip_displacement_x as tip_displacement_x
    from turgor.results.measures import tip_displacement_y as tip_displacement_y
    from turgor.results.measures import tip_displacement_z as tip_displacement_z
    from turgor.results.measures import twist_angle as twist_angle
    from turgor.results.measures import volume_of as volume_of
    from turgor.results.modes_vtu import write_modes as write_modes
    from turgor.results.reading import Measure as Measure
    from turgor.solvers.blocked_force import BlockedForce as BlockedForce
    from turgor.solvers.driver import solve as solve
    from turgor.solvers.dynamic import Dynamic as Dynamic
    from turgor.solvers.energies import Energies as Energies
    from turgor.solvers.grasp import Grasp as Grasp
    from turgor.solvers.modes import Modes as Modes
    from turgor.solvers.modes import natural_frequencies as natural_frequencies
    from turgor.solvers.path_procedures import ArcLength as ArcLength
    from turgor.solvers.path_procedures import Auto as Auto
    from turgor.solvers.path_procedures import GasMass as GasMass
    from turgor.solvers.path_procedures import VolumeControl as VolumeControl
    from turgor.solvers.procedures import Static as Static
    from turgor.solvers.solution import LimitPoint as LimitPoint
    from turgor.solvers.solution import Solution as Solution
    from turgor.solvers.solution import SolveError as SolveError
    from turgor.solvers.solution import State as State
    from turgor.solvers.solution import Status as Status
    from turgor.solvers.solution import Touch as Touch
    from turgor.solvers.stabilized import Stabilized as Stabilized
    from turgor.solvers.stages import Sealed as Sealed
    from turgor.solvers.stages import Stage as Stage
    from turgor.solvers.stages import Stages as Stages
    from turgor.source import Source as Source

_ROOMS = {
    "turgor.engine.mass": ("total_mass",),
    "turgor.engine.runtime": ("EngineOptions",),
    "turgor.errors": ("TurgorError",),
    "turgor.finding": (
        "Finding",
        "Severity",
    ),
    "turgor.geometry.actuators.bellows_of_revolution": ("BellowsOfRevolution",),
    "turgor.geometry.actuators.bidirectional_bender": ("BidirectionalBender",),
    "turgor.geometry.actuators.bidirectional_pneunet": ("BidirectionalPneuNet",),
    "turgor.geometry.actuators.contracting_tube": ("ContractingTube",),
    "turgor.geometry.actuators.eccentric_bender": ("EccentricBender",),
    "turgor.geometry.actuators.extending_cylinder": ("ExtendingCylinder",),
    "turgor.geometry.actuators.fast_pneunet": ("FastPneuNet",),
    "turgor.geometry.actuators.fiber_reinforced_bender": ("FiberReinforcedBender",),
    "turgor.geometry.actuators.fiber_reinforced_cylinder": ("FiberReinforcedCylinder",),
    "turgor.geometry.actuators.free_bottom_pneunet": ("FreeBottomPneuNet",),
    "turgor.geometry.actuators.helical_pneunet": ("HelicalPneuNet",),
    "turgor.geometry.actuators.manta_fin": ("MantaFin",),
    "turgor.geometry.actuators.omnidirectional_actuator": ("OmnidirectionalActuator",),
    "turgor.geometry.actuators.parallel_bellows": ("ParallelBellows",),
    "turgor.geometry.actuators.rectangular_bender": ("RectangularBender",),
    "turgor.geometry.actuators.revolute_joint": ("RevoluteJoint",),
    "turgor.geometry.actuators.semicircular_bender": ("SemicircularBender",),
    "turgor.geometry.actuators.slow_pneunet": ("SlowPneuNet",),
    "turgor.geometry.actuators.three_extenders": ("ThreeExtenders",),
    "turgor.geometry.actuators.trapezoidal_pneunet": ("TrapezoidalPneuNet",),
    "turgor.geometry.actuators.triangular_pneunet": ("TriangularPneuNet",),
    "turgor.geometry.actuators.twisting_tube": ("TwistingTube",),
    "turgor.geometry.actuators.two_material_bender": ("TwoMaterialBender",),
    "turgor.geometry.cad.cad_file": ("CadFile",),
    "turgor.geometry.cad.inspection": (
        "Inspection",
        "inspect_cad",
    ),
    "turgor.geometry.cad.read": ("read_cad",),
    "turgor.geometry.cad.selectors": (
        "ByColor",
        "ByName",
        "InBox",
        "NearestTo",
        "WithNormal",
    ),
    "turgor.geometry.cad.split": ("SplitPlane",),
    "turgor.geometry.geometry": ("Geometry",),
    "turgor.geometry.mold": (
        "MoldSettings",
        "casting_mold",
    ),
    "turgor.geometry.solids": (
        "Block",
        "RoundBar",
    ),
    "turgor.geometry.write_step": ("write_step",),
    "turgor.job.convergence": ("convergence",),
    "turgor.job.export": ("export_job",),
    "turgor.job.job": ("Job",),
    "turgor.job.read": ("read_job",),
    "turgor.job.run": ("run_job",),
    "turgor.materials.curves": (
        "Curve",
        "curve",
    ),
    "turgor.materials.doubts": ("doubts_of",),
    "turgor.materials.experiments": (
        "MaterialTest",
        "Step",
    ),
    "turgor.materials.fit_checks": (
        "check_modes",
        "check_order",
        "check_stretch_range",
    ),
    "turgor.materials.fit_history": ("fit_history",),
    "turgor.materials.fit_record": (
        "save_fits",
        "save_material",
    ),
    "turgor.materials.fit_result": (
        "Fit",
        "TestError",
    ),
    "turgor.materials.fitting": ("fit",),
    "turgor.materials.handling": (
        "average",
        "crop",
        "remove_slack",
        "remove_tail",
        "rest_below",
        "select_cycle",
        "set_zero_length",
        "thin",
    ),
    "turgor.materials.history_fit": ("HistoryFit",),
    "turgor.materials.laws": (
        "ArrudaBoyce",
        "GeneralizedRivlin",
        "Gent",
        "Hooke",
        "MooneyRivlin",
        "NeoHooke",
        "Ogden",
        "Yeoh",
        "YeohN",
    ),
    "turgor.materials.material": ("Material",),
    "turgor.materials.ranking": (
        "Ranking",
        "rank",
    ),
    "turgor.materials.read_tests": (
        "Specimen",
        "read_test",
        "read_tests",
    ),
    "turgor.materials.records": (
        "from_library",
        "library",
        "records",
    ),
    "turgor.materials.softening": ("Mullins",),
    "turgor.materials.stability": ("first_instability",),
    "turgor.materials.stress_history": (
        "StressHistory",
        "stress_history",
    ),
    "turgor.materials.viscoelastic": ("Prony",),
    "turgor.meshing.combine": ("together",),
    "turgor.meshing.exchange": (
        "MeshFile",
        "mesh_surfaces",
        "read_mesh",
        "write_stl",
    ),
    "turgor.meshing.generate": ("mesh",),
    "turgor.meshing.mesh": ("Mesh",),
    "turgor.meshing.placing": (
        "mirrored",
        "placed",
    ),
    "turgor.meshing.sizes": ("default_size",),
    "turgor.model.contact": ("Contact",),
    "turgor.model.fibers": (
        "Fibers",
        "Winding",
    ),
    "turgor.model.history": ("over_time",),
    "turgor.model.loads": (
        "BodyForce",
        "Gravity",
        "Pressure",
        "Traction",
    ),
    "turgor.model.model": (
        "Membrane",
        "Model",
    ),
    "turgor.model.obstacles": (
        "Box",
        "Cylinder",
        "Obstacle",
        "Plane",
        "RigidSurface",
        "SelfContact",
        "Sphere",
    ),
    "turgor.model.rigid": ("read_rigid",),
    "turgor.model.supports": (
        "Displacement",
        "Fixed",
        "Radial",
        "Symmetry",
    ),
    "turgor.model.write_inp": (
        "compressible",
        "write_inp",
    ),
    "turgor.response": (
        "Response",
        "read_response",
    ),
    "turgor.results.contact": (
        "ContactResult",
        "contact_results",
    ),
    "turgor.results.contact_measures": (
        "area_on",
        "blocked_force",
        "blocked_force_x",
        "blocked_force_y",
        "blocked_force_z",
        "contact_area",
        "deepest_penetration",
        "force_on",
        "grip_force",
        "holding_force",
        "maximum_contact_pressure",
        "pull_distance",
    ),
    "turgor.results.convergence": ("Convergence",),
    "turgor.results.fibers": (
        "FiberResult",
        "fiber_results",
    ),
    "turgor.results.history_plots": ("history_figure",),
    "turgor.results.measures": (
        "bending_angle",
        "cavity_volume",
        "maximum_fiber_tension",
        "maximum_principal_stretch",
        "maximum_von_mises",
        "measure",
        "reaction",
        "smallest_gap",
        "tip_displacement",
        "tip_displacement_x",
        "tip_displacement_y",
        "tip_displacement_z",
        "twist_angle",
        "volume_of",
    ),
    "turgor.results.modes_vtu": ("write_modes",),
    "turgor.results.reading": ("Measure",),
    "turgor.solvers.blocked_force": ("BlockedForce",),
    "turgor.solvers.driver": ("solve",),
    "turgor.solvers.dynamic": ("Dynamic",),
    "turgor.solvers.energies": ("Energies",),
    "turgor.solvers.grasp": ("Grasp",),
    "turgor.solvers.modes": (
        "Modes",
        "natural_frequencies",
    ),
    "turgor.solvers.path_procedures": (
        "ArcLength",
        "Auto",
        "GasMass",
        "VolumeControl",
    ),
    "turgor.solvers.procedures": ("Static",),
    "turgor.solvers.solution": (
        "LimitPoint",
        "Solution",
        "SolveError",
        "State",
        "Status",
        "Touch",
    ),
    "turgor.solvers.stabilized": ("Stabilized",),
    "turgor.solvers.stages": (
        "Sealed",
        "Stage",
        "Stages",
    ),
    "turgor.source": ("Source",),
}
_ROOM_OF = {name: room for room, names in _ROOMS.items() for name in names}

__version__ = version("turgor")
__all__ = sorted(_ROOM_OF)


def __getattr__(name: str) -> Any:
    if name not in _ROOM_OF:
        raise AttributeError(f"module 'turgor' has no attribute '{name}'")
    value = getattr(import_module(_ROOM_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_ROOM_OF])
