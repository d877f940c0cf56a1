"""Membranes and shells: thin layers on faces that stretch in their plane."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import membranes
from turgor.core.engine.faces.plate_edges import plate_terms
from turgor.core.engine.faces.tension_field import TensionField, tension_field
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower
from turgor.core.materials.laws.laws import Hooke
from turgor.core.model.model import Model
from turgor.core.model.sheets import Shell

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class MembraneTerm(Term):
    """A layer with in-plane stress, which may wrinkle.

    Parameters
    ----------
    nodes : (f, n) int array
        Nodes of the sides.
    gradients : (f, q, n, 2) array
        In-plane gradients of the shape functions at the Gauss points.
    areas : (f, q) array
        Areas of the Gauss points.
    moduli : (3, 3) array
        Scaled moduli times thickness.
    field : TensionField or None
        Where the layer wrinkles.
    """

    nodes: Ints
    gradients: Array
    areas: Array
    moduli: Array
    field: TensionField | None = None

    @property
    def unknowns(self) -> Ints:
        """Displacements of the nodes."""
        return displacements(self.nodes)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the internal forces of the stress."""
        stress = np.ascontiguousarray(self.stresses(at.position, np.zeros_like(at.position))[..., :3])
        local = membranes.membrane_forces(at.position, self.nodes, self.gradients, self.areas, stress)
        add_at_nodes(out, self.nodes, local)

    def energy(self, position: Array) -> float:
        """Energy of the strain over the area."""
        strain = self._linear(position, np.zeros_like(position), np.eye(3))
        if self.field is not None:
            return float((self.areas * self.field.energy(strain)).sum())
        return 0.5 * float(np.einsum("fq,fqi,ij,fqj->", self.areas, strain, self.moduli, strain))

    def stresses(self, position: Array, update: Array) -> Array:
        """Stress times thickness (f, q, 3); where the layer wrinkles, followed by the linearized strain (f, q, 6)."""
        if self.field is None:
            return self._linear(position, update, self.moduli)
        strain = self._linear(position, update, np.eye(3))
        return np.concatenate([self.field.stress(strain), strain], axis=-1)

    def strains(self, position: Array) -> Array:
        """Green's strain (f, q, 3): 11, 22, and twice 12."""
        return self._linear(position, np.zeros_like(position), np.eye(3))

    def continued(self, position: Array, update: Array, last: Array) -> Array:
        """Stress and strain of an update; where the layer wrinkles, both are linear in it."""
        if self.field is None:
            return self._linear(position, update, self.moduli)
        strain = self._linear(position, update, np.eye(3))
        return np.concatenate([self._expanded(strain, last), strain], axis=-1)

    def correction(self, at: Configuration, stresses: Array) -> Array | None:
        """Forces of the stress linearized about ``stresses``, beyond those of the stress itself."""
        if self.field is None:
            return None
        strain = self._linear(at.position, np.zeros_like(at.position), np.eye(3))
        beyond = np.ascontiguousarray(self._expanded(strain, stresses) - self.field.stress(strain))
        out = np.zeros_like(at.position)
        local = membranes.membrane_forces(at.position, self.nodes, self.gradients, self.areas, beyond)
        add_at_nodes(out, self.nodes, local)
        return out

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Material part, and the geometric part of the stresses."""
        if self.field is None:
            moduli, stress = np.broadcast_to(self.moduli, (*self.areas.shape, 3, 3)), stresses
        else:
            about = self.field.linearized_about(stresses[..., :3], stresses[..., 3:])
            moduli, stress = self.field.tangent(about), self.field.stress(about)
        parts = np.ascontiguousarray(moduli), np.ascontiguousarray(stress)
        return lower(membranes.membrane_tangents(at.position, self.nodes, self.gradients, self.areas, *parts))

    def _expanded(self, strain: Array, given: Array) -> Array:
        """Stress (f, q, 3) of a strain, linearized about what is given."""
        assert self.field is not None
        about = self.field.linearized_about(given[..., :3], given[..., 3:])
        change = np.einsum("fqij,fqj->fqi", self.field.tangent(about), strain - about)
        return np.asarray(self.field.stress(about) + change)

    def _linear(self, position: Array, update: Array, moduli: Array) -> Array:
        """Moduli times the strain linearized for an update, (f, q, 3)."""
        stress = membranes.membrane_stress(position, update, self.nodes, self.gradients, self.areas, moduli)
        return np.asarray(stress)


def membrane_terms(setting: Setting) -> list[MembraneTerm]:
    """One for each membrane and shell; `plate_terms` makes the bending of shells."""
    model, terms = setting.model, []
    for name, membrane in model.membranes.items():
        law, scale = membrane.material.law, membrane.thickness / (setting.length * setting.stress)
        assert isinstance(law, Hooke)
        moduli = membranes.plane_stress_moduli(law) * scale
        field = tension_field(moduli, membrane.compression) if membrane.wrinkles else None
        sides = np.ascontiguousarray(model.mesh.face(name))
        terms.append(MembraneTerm(sides, *membranes.surface_gradients(setting.points, sides), moduli, field))
    return terms


def least_tension(model: Model, name: str, displacement: Array) -> tuple[Array, Array]:
    """Compute the smaller principal force per width of a membrane that bears compression.

    Parameters
    ----------
    model : Model
    name : str
        Face of the membrane.
    displacement : (n, 3) array [m]

    Returns
    -------
    force : (f, q) array [N/m]
        Per reference width, negative in compression.
    area : (f, q) array [m²]
        Area of each point.
    """
    term = _alone(model, name)
    position = model.mesh.points + displacement
    mean, radius = _circle(term.stresses(position, np.zeros_like(position)))
    return mean - radius, term.areas


def largest_tension(model: Model, name: str, displacement: Array) -> tuple[Array, Array, Array]:
    """Compute stretch and nominal stress of a sheet along its larger principal stress, bending left out.

    Parameters
    ----------
    model : Model
    name : str
        Face of the sheet.
    displacement : (n, 3) array [m]

    Returns
    -------
    stretch : (f, q) array [-]
    stress : (f, q) array [Pa]
        Force per initial area.
    area : (f, q) array [m²]
        Area of each point.
    """
    term, sheet = _alone(model, name), model.membranes[name]
    position = model.mesh.points + displacement
    mean, radius = _circle(term.stresses(position, np.zeros_like(position)))
    strain = term.strains(position) * (1.0, 1.0, 0.5)
    stretch = np.sqrt(1 + 2 * sum(_circle(strain)))
    return stretch, stretch * (mean + radius) / sheet.thickness, term.areas


def _alone(model: Model, name: str) -> MembraneTerm:
    """Make the term of one sheet, in SI units."""
    sheet = model.membranes[name]
    only = replace(model, materials={**model.region_materials, name: sheet})
    at_rest = np.zeros(model.mesh.points.shape, dtype=bool)
    return membrane_terms(Setting(only, model.mesh.points, at_rest, np.empty((0, 0)), 1.0, 1.0))[0]


def _circle(tensor: Array) -> tuple[Array, Array]:
    """Center and radius of Mohr's circle of a plane tensor (..., 3): components 11, 22, 12."""
    half = 0.5 * (tensor[..., 0] - tensor[..., 1])
    return 0.5 * (tensor[..., 0] + tensor[..., 1]), np.hypot(half, tensor[..., 2])


def bending_energy(model: Model, name: str, displacement: Array) -> float:
    """Compute the energy that a membrane would store by bending, were it a shell with free edges [J].

    Parameters
    ----------
    model : Model
    name : str
        Face of the membrane.
    displacement : (n, 3) array [m]

    Raises
    ------
    TurgorError
        If the sheet branches, so that it cannot bend.
    """
    mesh, sheet = model.mesh, model.membranes[name]
    shell, moved = Shell(sheet.material, sheet.thickness), mesh.points + displacement
    alone = replace(model, materials={**model.region_materials, name: shell})
    setting = Setting(alone, mesh.points, np.zeros(mesh.points.shape, dtype=bool), np.empty((0, 0)), 1.0, 1.0)
    return sum(term.energy(moved) for term in plate_terms(setting))
