"""Model: a mesh with its materials, supports, loads and contact."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from turgor.core.materials.laws.laws import Hooke, Law
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.model.accepted_forms import at_node_sets, given_materials, given_supports
from turgor.core.model.bonds import Bond, parted_mesh
from turgor.core.model.checks.films import check_films
from turgor.core.model.checks.named_points import check_points, points_of
from turgor.core.model.checks.orientations import check_oriented, check_woven
from turgor.core.model.checks.states import check_states
from turgor.core.model.checks.symmetry import check_not_cut, check_turning, check_uncut_shell, check_wedge
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers
from turgor.core.model.loads import Load, Pressure, pressures_among
from turgor.core.model.points import ReferencePoint
from turgor.core.model.sheets import Sheet, Shell
from turgor.core.model.supports import Support, Symmetry
from turgor.foundation.display import Shown, listed
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import one, several
from turgor.foundation.store.saved_objects import Saved

#: Formulations of the cells.
MIXED, CONTINUOUS, DISPLACEMENT = "mixed", "continuous", "displacement"
FORMULATIONS = (MIXED, CONTINUOUS, DISPLACEMENT)


@dataclass(frozen=True, slots=True, init=False)
class Model(Saved, Shown):
    """A mesh with its materials, supports and loads; the question that `solve` answers.

    Parameters
    ----------
    mesh : Mesh
        Cells with named regions and faces.
    materials : mapping of str to Material, Shell or Membrane
        A `Material` for every region, a `Shell` (or a `Membrane`) for any face that is reinforced. A law stands for a
        material of it, a text for the material of the library that has this name and one record only; one alone is that
        of all regions.
    supports : sequence of Support
        What holds the body; the name of a face stands for `Fixed`. Faces named ``symmetry_*`` are mirror planes
        without being listed.
    loads : sequence of Load
        What drives it; each reaches its stated value at load factor 1, or as its history says.
    formulation : str
        ``"mixed"``: mean stresses are degrees of freedom besides the displacements, and cells do not lock, however
        incompressible the rubber. The mean stress jumps where stiffness or traction jumps: between different rubbers,
        at membranes and windings. ``"continuous"``: the mean stress is continuous everywhere, as in the usual
        Taylor–Hood element. ``"displacement"``: there are no mean stresses, as in codes without mixed elements. Both
        are for comparisons with other codes.
    reinforcements : sequence of Fibers
        Threads wound on faces.
    contact : Contact
        Self-contact and obstacles; by default self-contact is found automatically, and there are no obstacles.

    bonds : sequence of Bond
        Bonds between regions that peel off. The nodes of ``mesh`` are doubled there, and it has a face on each side.

    Raises
    ------
    TurgorError
        If a name is unknown, a region has no material, or gravity meets a material without density.
    """

    mesh: Mesh
    materials: Mapping[str, Material | Sheet]
    supports: tuple[Support, ...]
    loads: tuple[Load, ...]
    formulation: str
    reinforcements: tuple[Fibers, ...]
    contact: Contact
    bonds: tuple[Bond, ...]

    def __init__(
        self,
        mesh: Mesh,
        materials: Mapping[str, Material | Sheet | Law | str] | Material | Law | str,
        supports: Support | str | Iterable[Support | str],
        loads: Load | Iterable[Load],
        formulation: str = MIXED,
        reinforcements: Fibers | Iterable[Fibers] = (),
        contact: Contact | None = None,
        bonds: Bond | Iterable[Bond] = (),
    ) -> None:
        one(mesh, Mesh, "mesh of a model", "a Mesh is needed, as mesh(actuator) makes it")
        glued = several(bonds, Bond, "bonds", "Bonds are needed")
        mesh = parted_mesh(mesh, glued)
        given = at_node_sets(given_supports(supports), mesh)
        mirrored = {each.place for each in given if each.mirror}
        added = tuple(Symmetry(face) for face in mesh.symmetry_faces if face not in mirrored)
        acting = several(loads, Load, "loads", "loads are needed, such as Pressure('cavity', 20e3)")
        object.__setattr__(self, "mesh", mesh)
        used = given_materials(materials, mesh)
        object.__setattr__(self, "materials", MappingProxyType(used))
        object.__setattr__(self, "supports", given + added)
        object.__setattr__(self, "formulation", formulation)
        threads = several(reinforcements, Fibers, "reinforcements", "Fibers are needed")
        object.__setattr__(self, "reinforcements", threads)
        bodies = {each.name: each for each in threads} | used
        object.__setattr__(self, "loads", tuple(load.of_materials(bodies) for load in at_node_sets(acting, mesh)))
        object.__setattr__(self, "contact", one(contact or Contact(), Contact, "contact", "a Contact is needed"))
        object.__setattr__(self, "bonds", glued)
        self._check_materials()
        if not len(mesh.cells):
            check_films(mesh, self.membranes, self.loads, self.reinforcements)
        self._check_faces()
        self._check_formulation()
        self._check_foams()

    def __repr__(self) -> str:
        materials = [f"{name}: {used.name}" for name, used in self.region_materials.items()]
        materials += [
            f"{name}: {type(used).__name__.lower()} of {used.material.name}" for name, used in self.membranes.items()
        ]
        acting = [each.label for each in self.supports]
        acting += [load.label for load in self.loads]
        acting += [f"Fibers({each.name})" for each in self.reinforcements]
        acting += [f"Bond({each.name})" for each in self.bonds]
        acting += [f"Obstacle({each.name})" for each in self.contact.obstacles]
        return f"Model('{self.mesh.name}', {self.mesh.counts}; {listed(materials)}; {listed(acting)})"

    def _check_materials(self) -> None:
        for name, material in self.materials.items():
            if isinstance(material, Sheet):
                if name not in self.mesh.faces:
                    raise unknown("face for a sheet", name, self.mesh.faces)
                check_woven(self.mesh, name, material)
            elif name in self.mesh.faces and name not in self.mesh.regions:
                raise TurgorError(
                    f"materials.{name}: '{name}' is a face, and a sheet of '{material.name}' on it needs a thickness; "
                    "give a Shell(material, thickness)."
                )
            elif name not in self.mesh.regions:
                raise unknown("region for a material", name, self.mesh.regions)
            elif isinstance(material.law, Hooke):
                raise TurgorError(
                    f"materials.{name}: the law Hooke of '{material.name}' is for sheets on faces; "
                    "a region needs a hyperelastic law such as NeoHooke or Yeoh; a film of its own takes "
                    "`turgor.core.model.layers.as_solid` of the material."
                )
            else:
                check_oriented(self.mesh, name, material)
        missing = [name for name in self.mesh.regions if name not in self.materials]
        if missing:
            raise TurgorError(f"no material for region {', '.join(missing)}; give one in materials.")
        if any(load.needs_density for load in self.loads):
            for name, material in self.region_materials.items():
                if material.density is None:
                    raise TurgorError(f"materials.{name}: '{material.name}' has no density, and gravity needs it.")

    def _check_faces(self) -> None:
        check_points(self.mesh, self.supports)
        check_wedge(self.mesh, self.reinforcements, self.contact)
        check_turning(self.mesh, self.contact)
        for name, sheet in self.membranes.items():
            if isinstance(sheet, Shell):
                check_uncut_shell(self.mesh, name)
        for acting in (*self.supports, *self.loads):
            check_not_cut(self.mesh, type(acting).__name__, getattr(acting, "face", ""))
        points = self.points
        for support in self.supports:
            for name in support.named_faces:
                if name not in points:
                    self.mesh.face(name)
            support.check(self.mesh)
        for fibers in self.reinforcements:
            for name in fibers.faces:
                self.mesh.face(name)
        for obstacle in self.contact.obstacles:
            if obstacle.face is not None:
                self._check_reachable(obstacle.name, obstacle.face)
        for load in self.loads:
            load.check(self.mesh, points)
        check_states(self.mesh, self.membranes, self.reinforcements, self.loads)

    def _check_reachable(self, obstacle: str, face: str) -> None:
        """Refuse a face between two regions, which no obstacle can touch."""
        count = len(self.mesh.points)
        outer = corner_keys(outer_triangles(self.mesh), count)
        if not np.isin(corner_keys(self.mesh.face(face), count), outer).any():
            raise TurgorError(f"obstacle '{obstacle}': face '{face}' lies inside the actuator; nothing can touch it.")

    def _check_foams(self) -> None:
        """Refuse a foam that gets stiffer or softer: its law is split into two parts, and a factor would scale one."""
        for name in (name for name, material in self.region_materials.items() if material.is_foam):
            for load in self.states_of(name):
                if load.hardens or any(load.stiffness(share) != 1 for share in (0.0, 0.5, 1.0)):
                    raise TurgorError(f"materials.{name} is a foam, whose stiffness stays; leave out {load.label}.")

    def _check_formulation(self) -> None:
        if self.formulation not in FORMULATIONS:
            raise unknown("formulation", self.formulation, FORMULATIONS)
        for name, material in self.region_materials.items():
            if self.formulation == DISPLACEMENT and material.incompressible:
                raise TurgorError(
                    f"materials.{name}: '{material.name}' is incompressible, and the formulation 'displacement' needs "
                    "a finite bulk modulus; take 'mixed', or give one."
                )

    @property
    def region_materials(self) -> dict[str, Material]:
        """The materials of the regions."""
        return {name: m for name, m in self.materials.items() if isinstance(m, Material)}

    @property
    def membranes(self) -> dict[str, Sheet]:
        """The sheets on faces: shells and membranes."""
        return {name: m for name, m in self.materials.items() if isinstance(m, Sheet)}

    @property
    def sheet_masses(self) -> dict[str, float]:
        """Mass per area at rest of each sheet whose material has a density, by its face [kg/m²]."""
        dense = {name: sheet.material.density for name, sheet in self.membranes.items()}
        return {name: self.membranes[name].thickness * each for name, each in dense.items() if each is not None}

    @property
    def sheets_wrinkle(self) -> bool:
        """Whether a sheet bears less compression than tension."""
        return any(sheet.wrinkles for sheet in self.membranes.values())

    @property
    def points(self) -> dict[str, ReferencePoint]:
        """The reference points by their names."""
        return points_of(self.supports)

    def states_of(self, body: str) -> tuple[Load, ...]:
        """Loads that are a state of a body, a sheet or a winding: shrinkage, temperature and the like."""
        return tuple(load for load in self.loads if load.of_bodies and load.place in ("", body))

    @property
    def pressures(self) -> tuple[Pressure, ...]:
        """The follower pressures among the loads."""
        return pressures_among(self.loads)
