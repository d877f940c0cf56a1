"""Assembly: the equations of a reduced model from those of the full one, with nothing sampled yet."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.faces.dead_loads import DeadTerm, dead_terms
from turgor.core.engine.faces.membrane_term import MembraneTerm
from turgor.core.engine.faces.openings import mirror_point
from turgor.core.engine.faces.plate_terms import HingeTerm, PlateTerm
from turgor.core.engine.faces.pressure_term import PressureTerm
from turgor.core.engine.fibers.fiber_term import BendingTerm, FiberTerm
from turgor.core.engine.points.average_term import AverageTerm
from turgor.core.engine.points.rigid_term import RigidTerm
from turgor.core.engine.system import System
from turgor.core.engine.term import Setting
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError
from turgor.reduced.parts.pieces import Pieces
from turgor.reduced.parts.points import Points
from turgor.reduced.parts.polynomials import Cubics, Sheets, packed
from turgor.reduced.states.equations import Equations, Part
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.training import forms
from turgor.reduced.training.layers import Layer, layers_of
from turgor.reduced.training.modes import Modes
from turgor.reduced.training.places import Place, places_of
from turgor.reduced.training.reference_points import check_points

Array = NDArray[np.float64]

#: Scaled pressures by face and dead forces (3 nodes,) at inputs (n,).
Loads = Callable[[Array], tuple[dict[str, float], Array]]


@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """How the loads follow from the inputs; the first of n + 1 inputs is the share of the loads that are none.

    Parameters
    ----------
    faces : tuple of str
        Cavities and other faces under pressure.
    pressures : (k, n + 1) array
        Scaled pressures by the inputs.
    forces : (3 nodes, n + 1) array
        Scaled dead forces on the nodes.
    places : mapping of str to Place
        Of the obstacles.
    """

    faces: tuple[str, ...]
    pressures: Array
    forces: Array
    places: Mapping[str, Place] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Whole:
    """A reduced model with every Gauss point, from which points are chosen.

    Parameters
    ----------
    rubber : Points
        Of all cells.
    cells : (points,) int array
        Cell of each point.
    pieces : tuple of Pieces
        All sides and edges of shells.
    exact : Equations
        All that needs no sampling.
    layers : tuple of Layer
        Fibers and sheets that wrinkle.
    """

    rubber: Points
    cells: NDArray[np.int64]
    pieces: tuple[Pieces, ...]
    exact: Equations
    layers: tuple[Layer, ...] = ()

    @property
    def equations(self) -> Equations:
        """The equations without sampling."""
        return self.with_parts((self.rubber, *self.pieces, *(layer.part for layer in self.layers)))

    def with_parts(self, sampled: tuple[Part, ...]) -> Equations:
        """The equations with sampled parts."""
        return replace(self.exact, parts=(*sampled, *self.exact.parts))


def drive_of(system: System, model_at: Callable[[Mapping[str, float]], Model], inputs: Inputs) -> Drive:
    """Read pressures and dead forces at the middle of the range and at its ends; they are linear in every input."""
    middle = 0.5 * (inputs.low + inputs.high)

    def loads(values: Array) -> tuple[dict[str, float], Array]:
        model = model_at(dict(zip(inputs.keys, values, strict=True)))
        setting = Setting(model, system.points, np.zeros(system.points.shape, dtype=bool), system.dV, system.length,
                          system.stress_scale)  # fmt: skip
        dead = np.zeros_like(system.points)
        for term in dead_terms(setting):
            dead += sum(forces for _, forces in term.parts)
        return {load.face: load.pressure / system.stress_scale for load in model.pressures}, dead.ravel()

    base, dead = loads(middle)
    pressures, forces = np.zeros((len(base), 1 + len(middle))), np.zeros((dead.size, 1 + len(middle)))
    pressures[:, 0], forces[:, 0] = list(base.values()), dead
    for k in range(len(middle)):
        ends = []
        for value in (inputs.low[k], inputs.high[k]):
            moved = middle.copy()
            moved[k] = value
            ends.append(loads(moved))
        step = inputs.high[k] - inputs.low[k]
        pressures[:, k + 1] = [(ends[1][0][face] - ends[0][0][face]) / step for face in base]
        forces[:, k + 1] = (ends[1][1] - ends[0][1]) / step
    pressures[:, 0] -= pressures[:, 1:] @ middle
    forces[:, 0] -= forces[:, 1:] @ middle
    for values in (pressures, forces):  # round-off of the middle
        values[np.abs(values) < 1e-12 * np.abs(values).max(initial=1e-300)] = 0.0
    _check_linear(loads, (pressures, forces), inputs)
    return Drive(tuple(base), pressures, forces, places_of(system, model_at, inputs))


def _check_linear(loads: Loads, linear_parts: tuple[Array, Array], inputs: Inputs) -> None:
    """Refuse inputs in which the loads are not linear, such as components of the direction of gravity."""
    values = inputs.low + np.linspace(0.2, 0.3, len(inputs.low)) * (inputs.high - inputs.low)
    one = np.concatenate([[1.0], values])
    there, dead = loads(values)
    for got, linear in ((np.array(list(there.values())), linear_parts[0] @ one), (dead, linear_parts[1] @ one)):
        if np.abs(got - linear).max(initial=0.0) > 1e-8 * np.abs(got).max(initial=1e-300):
            raise TurgorError(
                f"the loads are not linear in the inputs {', '.join(inputs.keys)}; a reduced model needs that."
            )


def assemble(system: System, drive: Drive, modes: Modes, stresses: Modes) -> Whole:
    """Make the equations in the coordinates of modes (3 n, r) of the displacement and (m, k) of the mean stress."""
    vectors, mesh = modes.vectors, system.model.mesh
    constraint, compliance = forms.constraint(system, vectors, stresses.vectors)
    shift = mirror_point(mesh) / system.length
    R = vectors.shape[1] + 1
    volumes = [forms.volume(system, np.ascontiguousarray(mesh.face(face)), shift, vectors) for face in drive.faces]
    whole = [cavity_volume(mesh, face) / mesh.symmetry_factor / system.length**3 for face in drive.faces]
    for form, at_rest in zip(volumes, whole, strict=True):
        form[0, 0, 0] = at_rest  # caps included
    cubics = np.concatenate([packed(np.array(volumes).reshape(-1, R, R, R)), constraint])
    sheets = [term for term in system.terms.all if isinstance(term, MembraneTerm) and term.field is None]
    exact = []
    if sheets:
        exact.append(Sheets(np.asarray(sum(forms.sheet(system, term, vectors) for term in sheets)), R))
    equations = Equations(tuple(exact), Cubics(cubics, R), drive.pressures, vectors.T @ drive.forces, compliance,
                          forms.moments(system, vectors, stresses.vectors))  # fmt: skip
    bending = (term for term in system.terms.all if isinstance(term, PlateTerm | HingeTerm))
    pieces = tuple(Pieces.of(term, system.points, vectors) for term in bending)
    return Whole(*_rubber(system, vectors), pieces, equations, layers_of(system, vectors))


def _rubber(system: System, vectors: Array) -> tuple[Points, NDArray[np.int64]]:
    """All Gauss points, those of one law one after the other, and the cell of each."""
    materials, regions = system.model.region_materials, system.model.mesh.regions
    by_law: dict[tuple[Law, Material | None], list[str]] = {}
    for name, material in materials.items():
        if material.is_foam or material.has_fibers:
            raise TurgorError(
                f"materials.{name}: '{material.name}' {'is a foam' if material.is_foam else 'has directions'} "
                f"({type(material.law).__name__}); a reduced model takes isotropic rubbers that keep their volume. "
                "Take finite elements."
            )
        if material.flowing_network or material.permanent_set:
            what = "a permanent_set" if material.permanent_set else "the viscoelasticity of Bergström and Boyce"
            raise TurgorError(
                f"materials.{name}: '{material.name}' has {what}, which a reduced model does not have; take finite "
                "elements, a Prony series, or leave it out."
            )
        by_law.setdefault((material.law, material if material.remembers else None), []).append(name)  # type: ignore[arg-type]
    cells = [np.sort(np.concatenate([regions[name] for name in names])) for names in by_law.values()]
    order, count = np.concatenate(cells), system.dV.shape[1]
    G = np.concatenate([forms.gradients(system, vectors, order[part]) for part in forms.chunks(len(order))])
    starts = np.cumsum([0, *(len(each) * count for each in cells)])
    laws, remembering = (tuple(each) for each in zip(*by_law, strict=True))
    if not any(remembering):
        remembering = ()
    weights = np.ascontiguousarray(system.dV[order].ravel())
    points = Points(G, weights, laws, starts, system.stress_scale, remembering)
    return points, np.repeat(order, count)


#: Terms that a reduced model knows.
KNOWN = (PressureTerm, MembraneTerm, PlateTerm, HingeTerm, DeadTerm, FiberTerm, RigidTerm, AverageTerm)


def check_reducible(system: System) -> None:
    """Refuse by name what a reduced model does not have.

    Raises
    ------
    TurgorError
    """
    if not len(system.model.mesh.cells):
        raise TurgorError("reduced models have no films without a solid yet; take finite elements.")
    if not system.element.modes:
        raise TurgorError("reduced models need mean stresses; take the formulation 'mixed' instead of 'displacement'.")
    check_points(system)
    if system.prescribed_values(1.0).any():
        raise TurgorError("reduced models have no supports that move yet; a displacement of the model is prescribed.")
    for term in system.terms.all:
        if isinstance(term, BendingTerm):
            raise TurgorError("reduced models have no fibers that resist bending yet; leave their bending out.")
        if not isinstance(term, KNOWN):
            raise TurgorError(f"reduced models have no {type(term).__name__.removesuffix('Term').lower()} yet.")
        if not term.symmetric:
            raise TurgorError(
                "a pressure acts on an open surface; reduced models need closed cavities, or ones with a fixed rim."
            )
    for part in system.contact.parts:
        if part.coefficient > 0:
            raise TurgorError(
                f"reduced models have no friction; contact '{part.name}' has the coefficient {part.coefficient:g}."
            )
        if part.unknown >= 0:
            raise TurgorError(f"reduced models have no obstacles on springs yet; the model has '{part.name}'.")
