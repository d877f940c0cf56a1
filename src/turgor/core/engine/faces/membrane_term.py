"""Membranes and shells: thin layers on faces that stretch in their plane."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import membranes
from turgor.core.engine.faces.plate_edges import plate_terms
from turgor.core.engine.faces.settings import FILM
from turgor.core.engine.faces.sheet_moduli import free_stress, has_state, sheet_moduli
from turgor.core.engine.faces.tension_field import TensionField, tension_field
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower
from turgor.core.meshing.cells import QUADRILATERAL
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane, Shell

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: What frames have at each point besides its area.
FRAMES = ("e1", "e2", "normal", "gradients")


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
    moduli : (3, 3) or (f, q, 3, 3) array
        Scaled moduli times thickness; those of each Gauss point where the layer is woven.
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
        return 0.5 * float((self.areas * (strain * self._times(strain)).sum(axis=-1)).sum())

    def stresses(self, position: Array, update: Array) -> Array:
        """Stress times thickness (f, q, 3); where the layer wrinkles, followed by the linearized strain (f, q, 6)."""
        strain = self._linear(position, update, np.eye(3))
        if self.field is None:
            return self._times(strain)
        return np.concatenate([self.field.stress(strain), strain], axis=-1)

    def strains(self, position: Array) -> Array:
        """Green's strain (f, q, 3): 11, 22, and twice 12."""
        return self._linear(position, np.zeros_like(position), np.eye(3))

    def continued(self, position: Array, update: Array, last: Array) -> Array:
        """Stress and strain of an update; where the layer wrinkles, both are linear in it."""
        strain = self._linear(position, update, np.eye(3))
        if self.field is None:
            return self._times(strain)
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

    def _times(self, strain: Array) -> Array:
        """Stress (f, q, 3) of a strain that does not wrinkle."""
        return np.asarray((self.moduli @ strain[..., None])[..., 0])

    def _linear(self, position: Array, update: Array, moduli: Array) -> Array:
        """Moduli times the strain linearized for an update, (f, q, 3)."""
        stress = membranes.membrane_stress(position, update, self.nodes, self.gradients, self.areas, moduli)
        return np.asarray(stress)


def membrane_terms(setting: Setting) -> list[MembraneTerm]:
    """One for each membrane and shell; `plate_terms` makes the bending of shells."""
    model, terms = setting.model, []
    for name, membrane in model.membranes.items():
        sides = np.ascontiguousarray(model.mesh.face(name))
        frames = film_frames(setting.points, sides, alone=not len(model.mesh.cells))
        moduli, alone = moduli_of(setting, name, frames), not len(model.mesh.cells)
        field = tension_field(moduli, membrane.compression, alone=alone) if membrane.wrinkles else None
        terms.append(MembraneTerm(sides, frames.gradients, frames.areas, moduli, field))
    return terms


def moduli_of(setting: Setting, name: str, frames: membranes.Frames) -> Array:
    """Scaled moduli times thickness of a sheet, (3, 3) or those of each point."""
    sheet = setting.model.membranes[name]
    scale = sheet.thickness / (setting.length * setting.stress)
    return sheet_moduli(sheet, frames.e1, frames.e2) * scale


def film_frames(points: Array, sides: Ints, *, alone: bool) -> membranes.Frames:
    """Frames at the points where a sheet is integrated.

    Nine-node sides have as many strains at 2 × 2 points as nodes to move, and rubber resists what these strains do not
    see: that the middles of edges move against the corners. A film ``alone`` gets a share of 3 × 3 points besides.
    """
    few = membranes.surface_frames(points, sides)
    if not alone or sides.shape[1] != QUADRILATERAL.nodes:
        return few
    share, many = FILM.full_share, membranes.surface_frames(points, sides, FILM.full_degree)
    areas = np.concatenate([(1 - share) * few.areas, share * many.areas], axis=1)
    joined = {name: np.concatenate([getattr(few, name), getattr(many, name)], axis=1) for name in FRAMES}
    return membranes.Frames(**joined, areas=areas)


def least_tension(model: Model, name: str, displacement: Array, load_factor: float) -> tuple[Array, Array]:
    """Compute the smaller principal force per width of a membrane that bears compression.

    Parameters
    ----------
    model : Model
    name : str
        Face of the membrane.
    displacement : (n, 3) array [m]
    load_factor : float
        At which its states are taken.

    Returns
    -------
    force : (f, q) array [N/m]
        Per reference width, negative in compression.
    area : (f, q) array [m²]
        Area of each point.
    """
    term = _alone(model, name)
    position = model.mesh.points + displacement
    mean, radius = _circle(_stress(model, name, (term, position), load_factor))
    return mean - radius, term.areas


def largest_tension(model: Model, name: str, displacement: Array, load_factor: float) -> tuple[Array, Array, Array]:
    """Compute stretch and nominal stress of a sheet along its larger principal stress, bending left out.

    Parameters
    ----------
    model : Model
    name : str
        Face of the sheet.
    displacement : (n, 3) array [m]
    load_factor : float
        At which its states are taken.

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
    mean, radius = _circle(_stress(model, name, (term, position), load_factor))
    strain = term.strains(position) * (1.0, 1.0, 0.5)
    stretch = np.sqrt(1 + 2 * sum(_circle(strain)))
    return stretch, stretch * (mean + radius) / sheet.thickness, term.areas


def _alone(model: Model, name: str) -> MembraneTerm:
    """Make the term of one sheet, in SI units."""
    at_rest = np.zeros(model.mesh.points.shape, dtype=bool)
    terms = membrane_terms(Setting(model, model.mesh.points, at_rest, np.empty((0, 0)), 1.0, 1.0))
    return terms[list(model.membranes).index(name)]


def _stress(model: Model, name: str, at: tuple[MembraneTerm, Array], load_factor: float) -> Array:
    """Stress times thickness (f, q, 3) of a term in SI units at positions, with the states of the sheet."""
    term, position = at
    stress = np.asarray(term.stresses(position, np.zeros_like(position))[..., :3])
    if not has_state(model, name):
        return stress
    frames = film_frames(model.mesh.points, term.nodes, alone=not len(model.mesh.cells))
    return stress - free_stress(model, name, (frames, term.moduli), load_factor)


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
    shell, moved = Shell(sheet.material, sheet.thickness, warp=sheet.warp), mesh.points + displacement
    others = {face: Membrane(each.material, each.thickness, warp=each.warp) for face, each in model.membranes.items()}
    alone = replace(model, materials={**model.region_materials, **others, name: shell})
    setting = Setting(alone, mesh.points, np.zeros(mesh.points.shape, dtype=bool), np.empty((0, 0)), 1.0, 1.0)
    return sum(term.energy(moved) for term in plate_terms(setting))


def film_fields(model: Model, displacement: Array, load_factor: float) -> tuple[Array, Array]:
    """Compute Cauchy stress and largest principal stretch of films without a solid at 2 × 2 points of each side.

    The thickness counts as that at rest.

    Parameters
    ----------
    model : Model
    displacement : (n, 3) array [m]
    load_factor : float
        At which the states of films are taken.

    Returns
    -------
    stress : (f, 4, 3, 3) array [Pa]
    stretch : (f, 4) array
        Sheets follow each other in the order of the model.
    """
    points, fields = model.mesh.points, []
    setting = Setting(model, points, np.zeros(points.shape, dtype=bool), np.empty((0, 0)), 1.0, 1.0)
    for (name, sheet), term in zip(model.membranes.items(), membrane_terms(setting), strict=True):
        F = np.einsum("fqak,fai->fqik", term.gradients[:, :4], (points + displacement)[term.nodes])
        S = _stress(model, name, (term, points + displacement), load_factor)[:, :4, [0, 2, 2, 1]]
        S = S.reshape(*F.shape[:2], 2, 2)
        right = np.swapaxes(F, -1, -2) @ F
        grown = np.sqrt(np.maximum(np.linalg.det(right), np.finfo(float).tiny))[..., None, None]
        cauchy = F @ S @ np.swapaxes(F, -1, -2) / (grown * sheet.thickness)
        fields.append((cauchy, np.sqrt(np.linalg.eigvalsh(right)[..., -1])))
    return np.concatenate([stress for stress, _ in fields]), np.concatenate([stretch for _, stretch in fields])
