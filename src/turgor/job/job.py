"""Job: the description of one run, independent of its file."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.material import Material
from turgor.core.meshing.bodies.assembly import Assembly
from turgor.core.meshing.default_settings import chosen_settings
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.core.meshing.settings import MeshSettings
from turgor.core.model.bonds import Bond
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers
from turgor.core.model.loads import Load
from turgor.core.model.rigid import RigidFile
from turgor.core.model.sheets import Sheet
from turgor.core.model.supports import Fixed, Support
from turgor.core.setups.setup_values import Setup
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.static import Static
from turgor.foundation.errors import unknown
from turgor.foundation.registry import Registry, class_of_file, name_in
from turgor.job.tables.points import Rig

if TYPE_CHECKING:
    from turgor.core.results.measures.measure import Measure


class Actuator(Protocol):
    """Interface of every actuator family: dimensions as dataclass fields, and `build` for their shape."""

    def build(self) -> Geometry:
        """Build the shape with named regions and faces."""


#: Actuator families by their name in job files: the classes in their folder; the keys of a family are its fields.
ACTUATORS: Registry[type[Actuator]] = Registry(
    "turgor.core.geometry.actuators", class_of_file(lambda kind: hasattr(kind, "build"))
)


#: Actuators that are meshes when they are built.
MESHED = (MeshFile, Assembly)


def actuator_type(actuator: Actuator) -> str:
    """Return the name that job files use for the family of an actuator.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> actuator_type(FastPneuNet())
    'fast_pneunet'
    """
    if isinstance(actuator, CadFile):
        return "cad_file"
    if isinstance(actuator, MeshFile):
        return "mesh_file"
    if isinstance(actuator, Assembly):
        return "assembly"
    name = name_in(ACTUATORS, actuator)
    if name is None:
        raise unknown("actuator type", type(actuator).__name__, ACTUATORS)
    return name


def standard_measures(faces: Collection[str] | None = None) -> tuple[str, ...]:
    """Return the names of the default measures of a run, of a part with some faces if they are given.

    Examples
    --------
    >>> standard_measures()[0], standard_measures(["fixed"])[0]
    ('bending_angle', 'principal_stretch_p99')
    """
    from turgor.core.results.measures.measures import fitting_measures  # here: it loads the engine
    from turgor.core.results.measures.standard_measures import STANDARD_MEASURES

    return tuple(measure.name for measure in (STANDARD_MEASURES if faces is None else fitting_measures(faces)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Output:
    """Output of a run besides the response, the path and the lock file.

    Parameters
    ----------
    measures : tuple of str
        Names of the measures in ``response.csv``, in this order.
    markers : mapping of str to (3,) floats [m]
        Points on or near the surface, by name; their coordinates follow the measures.
    fields : bool
        Whether to write the fields of every state for ParaView.
    pictures : bool
        Whether to draw the actuator, undeformed and deformed.
    report : bool
        Whether to write the HTML report.
    mesh_error : bool or "linear"
        Whether to estimate the mesh error of every measure, which takes up to half the time of the solve; ``"linear"``
        takes less.
    """

    measures: tuple[str, ...] = field(default_factory=standard_measures)
    markers: Mapping[str, tuple[float, float, float]] = field(default_factory=dict)
    fields: bool = True
    pictures: bool = True
    report: bool = True
    mesh_error: bool | str = True

    def chosen(self) -> "tuple[Measure, ...]":
        """Return all that is measured: the measures, then the coordinates of the markers."""
        from turgor.core.results.measures.markers import marker  # here: it loads the engine
        from turgor.core.results.measures.measures import find_measure

        coordinates = (each for name, point in self.markers.items() for each in marker(name, point))
        return (*map(find_measure, self.measures), *coordinates)


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """One run: actuator, mesh, materials, supports, loads, procedure and output.

    Parameters
    ----------
    name : str
        Name of the run; the default folder of results is ``<name>-results``.
    actuator : Actuator
        Dimensions of the actuator.
    mesh : MeshSettings
        Sizes and kind of the cells.
    mesh_target : float or None [-]
        Target of the relative mesh error of one measure at the last state; None leaves the mesh as it is.
    mesh_target_measure : str or None
        Name of this measure; the first one of the output if it is not given.
    mesh_most_unknowns : int
        Largest number of unknowns of a refined mesh.
    imperfection : tuple of float [m]
        Largest deviations of the stress-free shape along the first buckling modes; none by default.
    materials : mapping of str to Material, Shell or Membrane
        A material for every region and a sheet for every face that is reinforced.
    supports : tuple of Support
        Supports; those of mirror planes are added by themselves.
    loads : tuple of Pressure, Gravity or Force
        Loads.
    fibers : mapping of str to Fibers
        Windings by name.
    bonds : mapping of str to Bond
        Bonds by name.
    points : mapping of str to Rig
        Reference points by name, with their supports and loads.
    contact : Contact
        Surfaces that may come into contact.
    rigid_files : mapping of str to RigidFile
        STL files of obstacles, for the lock file.
    setup : BlockedForce, Grasp or None
        Change of the model for an experiment, such as a plate before the tip.
    procedure : Static, VolumeControl, GasMass, ArcLength, Auto, Stabilized, Dynamic or Stages
        Procedure; `Static` where there is a setup.
    output : Output
        Files to write.
    threads : int or None
        Number of threads; None takes all processors. Only the last digits of the results depend on it.
    built : (Actuator, Geometry) or None
        What was built when the job was read, so that it is not built twice.
    """

    name: str
    actuator: Actuator
    mesh: MeshSettings = field(default_factory=MeshSettings)
    mesh_target: float | None = None
    mesh_target_measure: str | None = None
    mesh_most_unknowns: int = 200_000
    imperfection: tuple[float, ...] = ()
    materials: Mapping[str, Material | Sheet]
    supports: tuple[Support, ...] = (Fixed("fixed"),)
    loads: tuple[Load, ...]
    fibers: Mapping[str, Fibers] = field(default_factory=dict)
    bonds: Mapping[str, Bond] = field(default_factory=dict)
    points: Mapping[str, Rig] = field(default_factory=dict)
    contact: Contact = field(default_factory=Contact)
    rigid_files: Mapping[str, RigidFile] = field(default_factory=dict)
    setup: Setup | None = None
    procedure: Procedure = field(default_factory=Static)
    output: Output = field(default_factory=Output)
    threads: int | None = None
    built: tuple[Actuator, Geometry] | None = field(default=None, compare=False, repr=False)

    @property
    def all_supports(self) -> tuple[Support, ...]:
        """The supports, and the reference points with theirs."""
        return (*self.supports, *(each for rig in self.points.values() for each in (rig.point, *rig.holds)))

    @property
    def all_loads(self) -> tuple[Load, ...]:
        """The loads, and those of reference points."""
        return (*self.loads, *(load for rig in self.points.values() for load in rig.loads))

    def geometry(self) -> Geometry:
        """Return the shape of the actuator; it is built unless it was when the job was read."""
        if self.built is not None and self.built[0] is self.actuator:
            return self.built[1]
        return self.actuator.build()

    @property
    def mesh_size(self) -> float:
        """Target edge length [m]: that of the settings, or the default for the actuator."""
        size = self.mesh_settings.size
        assert size is not None  # chosen where it was not given
        return size

    @property
    def mesh_settings(self) -> MeshSettings:
        """Settings of the mesh, with the default size and kind of cells where none is given."""
        open_still = self.mesh.size is None or self.mesh.cells is None
        return chosen_settings(self.geometry(), self.mesh) if open_still else self.mesh
