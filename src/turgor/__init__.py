"""turgor: finite element modeling of soft fluidic actuators, from a specimen to a design decision.

The names that most scripts need are here: ``import turgor as tg``. The others stand in namespaces, such as
``tg.actuators``, ``tg.laws`` and ``tg.measures``. Every name is imported on first use, so that a command that only
reads a file or prints an error does not wait for the engine. A new public name is a new line here or in the file of a
namespace, in the order that `ruff` keeps.
"""

from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from turgor.foundation.display import Shown
from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor import studies as studies
    from turgor import units as units
    from turgor.accuracy.adaptivity.mesh_to import mesh_to as mesh_to
    from turgor.accuracy.gradients.gradient import gradient as gradient
    from turgor.accuracy.laboratory.compare import compare as compare
    from turgor.accuracy.measure import measure as measure
    from turgor.core import setups as setups
    from turgor.core.engine.runtime import EngineOptions as EngineOptions
    from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet as FastPneuNet
    from turgor.core.geometry.geometry import Geometry as Geometry
    from turgor.core.materials.experiments.read_tests import read_test as read_test
    from turgor.core.materials.fitting.fit_laws import fit as fit
    from turgor.core.materials.laws.laws import Yeoh as Yeoh
    from turgor.core.materials.library.records import from_library as from_library
    from turgor.core.materials.material import Material as Material
    from turgor.core.meshing.generate import mesh as mesh
    from turgor.core.meshing.mesh import Mesh as Mesh
    from turgor.core.model.contact import Contact as Contact
    from turgor.core.model.fibers import Fibers as Fibers
    from turgor.core.model.fibers import Winding as Winding
    from turgor.core.model.history import over_time as over_time
    from turgor.core.model.loads import Gravity as Gravity
    from turgor.core.model.loads import Pressure as Pressure
    from turgor.core.model.loads import Traction as Traction
    from turgor.core.model.model import Model as Model
    from turgor.core.model.sheets import Membrane as Membrane
    from turgor.core.model.sheets import Shell as Shell
    from turgor.core.model.supports import Displacement as Displacement
    from turgor.core.model.supports import Fixed as Fixed
    from turgor.core.results.files.vtu import write_vtu as write_vtu
    from turgor.core.results.measures.standard_measures import bending_angle as bending_angle
    from turgor.core.results.measures.standard_measures import cavity_volume as cavity_volume
    from turgor.core.results.measures.standard_measures import tip_displacement as tip_displacement
    from turgor.core.solvers.dynamics.modes import natural_frequencies as natural_frequencies
    from turgor.core.solvers.load import load as load
    from turgor.core.solvers.procedures.arc_length import ArcLength as ArcLength
    from turgor.core.solvers.procedures.auto import Auto as Auto
    from turgor.core.solvers.procedures.dynamic import Dynamic as Dynamic
    from turgor.core.solvers.procedures.gas_mass import GasMass as GasMass
    from turgor.core.solvers.procedures.sealed import Sealed as Sealed
    from turgor.core.solvers.procedures.stabilized import Stabilized as Stabilized
    from turgor.core.solvers.procedures.stages import Stage as Stage
    from turgor.core.solvers.procedures.stages import Stages as Stages
    from turgor.core.solvers.procedures.static import Static as Static
    from turgor.core.solvers.procedures.volume_control import VolumeControl as VolumeControl
    from turgor.core.solvers.solution import Solution as Solution
    from turgor.core.solvers.solution import SolveError as SolveError
    from turgor.core.solvers.solution import Status as Status
    from turgor.core.solvers.solve import resume as resume
    from turgor.core.solvers.solve import solve as solve
    from turgor.fast_models import formulas as formulas
    from turgor.fast_models.section.section import Section as Section
    from turgor.foundation.errors import TurgorError as TurgorError
    from turgor.foundation.response import Response as Response
    from turgor.namespaces import actuators as actuators
    from turgor.namespaces import air as air
    from turgor.namespaces import bodies as bodies
    from turgor.namespaces import cad as cad
    from turgor.namespaces import commands as commands
    from turgor.namespaces import control as control
    from turgor.namespaces import experiments as experiments
    from turgor.namespaces import files as files
    from turgor.namespaces import jobs as jobs
    from turgor.namespaces import laws as laws
    from turgor.namespaces import learning as learning
    from turgor.namespaces import loads as loads
    from turgor.namespaces import measures as measures
    from turgor.namespaces import obstacles as obstacles
    from turgor.namespaces import pictures as pictures
    from turgor.namespaces import real_time as real_time
    from turgor.namespaces import robots as robots
    from turgor.namespaces import rods as rods
    from turgor.namespaces import sections as sections
    from turgor.namespaces import solutions as solutions
    from turgor.namespaces import supports as supports
    from turgor.reduced.reduce import reduce as reduce
    from turgor.studies.optimization.optimize import optimize as optimize
    from turgor.studies.runs.sweep import sweep as sweep
    from turgor.views.pictures.picture import picture as picture
    from turgor.views.report.solution_report import report as report

# So that ``from turgor.namespaces.loads import Gravity`` finds a namespace, too.
__path__.append(str(Path(__file__).parent / "namespaces"))

__version__ = version("turgor")


def _drawing(name: str) -> Any:
    """Return a function that draws values for notebooks; the rooms of these values know nothing of it."""
    return getattr(import_module("turgor.views.notebook.drawing"), name)


Shown.drawing = _drawing


if not TYPE_CHECKING:
    __getattr__, __dir__, __all__ = public(__file__, globals())
