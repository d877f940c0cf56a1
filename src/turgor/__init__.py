"""turgor: finite element modeling of soft fluidic actuators, from a specimen to a design decision.

The names that most scripts need are here: ``import turgor as tg``. The others stand in namespaces, such as
``tg.actuators``, ``tg.laws`` and ``tg.measures``. Every name is imported on first use, so that a command that only
reads a file or prints an error does not wait for the engine. A new public name is a new line here or in the file of a
namespace, in the order that `ruff` keeps.
"""

import warnings
from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from turgor._lazy import names_in, public
from turgor.shown import Shown

if TYPE_CHECKING:
    from turgor import actuators as actuators
    from turgor import bodies as bodies
    from turgor import cad as cad
    from turgor import experiments as experiments
    from turgor import files as files
    from turgor import formulas as formulas
    from turgor import guidelines as guidelines
    from turgor import jobs as jobs
    from turgor import laws as laws
    from turgor import loads as loads
    from turgor import measures as measures
    from turgor import obstacles as obstacles
    from turgor import pictures as pictures
    from turgor import rods as rods
    from turgor import sections as sections
    from turgor import setups as setups
    from turgor import solutions as solutions
    from turgor import studies as studies
    from turgor import supports as supports
    from turgor.adaptivity.measure import measure as measure
    from turgor.adaptivity.mesh_to import mesh_to as mesh_to
    from turgor.engine.runtime import EngineOptions as EngineOptions
    from turgor.errors import TurgorError as TurgorError
    from turgor.geometry.actuators.fast_pneunet import FastPneuNet as FastPneuNet
    from turgor.geometry.geometry import Geometry as Geometry
    from turgor.gradients.gradient import gradient as gradient
    from turgor.laboratory.compare import compare as compare
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
    from turgor.model.loads import Gravity as Gravity
    from turgor.model.loads import Pressure as Pressure
    from turgor.model.loads import Traction as Traction
    from turgor.model.model import Model as Model
    from turgor.model.sheets import Membrane as Membrane
    from turgor.model.sheets import Shell as Shell
    from turgor.model.supports import Displacement as Displacement
    from turgor.model.supports import Fixed as Fixed
    from turgor.optimization.optimize import optimize as optimize
    from turgor.response import Response as Response
    from turgor.results.files.vtu import write_vtu as write_vtu
    from turgor.results.measures.measures import bending_angle as bending_angle
    from turgor.results.measures.measures import cavity_volume as cavity_volume
    from turgor.results.measures.measures import tip_displacement as tip_displacement
    from turgor.results.pictures.picture import picture as picture
    from turgor.results.report.solution_report import report as report
    from turgor.section.section import Section as Section
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
    from turgor.solvers.solution import Status as Status
    from turgor.solvers.solve import resume as resume
    from turgor.solvers.solve import solve as solve
    from turgor.solvers.stored import load as load
    from turgor.study.sweep import sweep as sweep

#: Names of the release before that have another name now.
_RENAMED = {"Step": "Edit", "TestError": "FitResidual"}

#: Names of the release before that something else does now.
_INSTEAD = {
    "BlockedForce": "solve(setups.blocked_force(model, ...))",
    "Grasp": "solve(setups.grasp(model, ...), Static(max_step=0.1))",
}

__version__ = version("turgor")


def _drawing(name: str) -> Any:
    """Return a function that draws values for notebooks; the rooms of these values know nothing of it."""
    return getattr(import_module("turgor.results.notebook.drawing"), name)


Shown.drawing = _drawing


def _moved(name: str) -> Any:
    """Return the units, or a name that stood here in the release before, with a warning that says where it is now."""
    if name == "units":  # not a namespace: scripts import from it, so that they read as 3 * mm
        return import_module("turgor.units")
    now = _RENAMED.get(name, name)
    for each in sorted(key for key, source in names_in(__file__).items() if source == __name__):
        namespace = import_module(f"turgor.{each}")
        if now in namespace.__all__:
            warnings.warn(f"turgor.{name} is turgor.{each}.{now} now.", DeprecationWarning, stacklevel=3)
            return getattr(namespace, now)
    hint = f"; write {_INSTEAD[name]}" if name in _INSTEAD else ""
    raise AttributeError(f"module 'turgor' has no attribute '{name}'{hint}")


if not TYPE_CHECKING:
    __getattr__, __dir__, __all__ = public(__file__, globals(), _moved)
