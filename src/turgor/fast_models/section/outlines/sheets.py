"""Sheets and threads on the outlines of a section: membranes, shells and smeared fibers; shells bend in `bending`.

Their tables on the slice are those of the engine; `turgor.fast_models.section.kinematics.from_slice` turns them into
the section's.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_cell
from turgor.core.engine.faces.membranes import MEMBRANE_QUADRATURE_DEGREE, plane_stress_moduli, surface_gradients
from turgor.core.engine.faces.tension_field import TensionField, tension_field
from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.engine.fibers.smeared import smeared_pieces
from turgor.core.materials.laws.laws import Hooke
from turgor.core.model.fibers import DISCRETE, SMEARED, Fibers
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane, Shell
from turgor.fast_models.section.kinematics import Vectors, from_slice
from turgor.fast_models.section.plane import Plane
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sheet:
    """A layer with stress in its plane: two tangent vectors at each point, orthonormal at rest.

    Parameters
    ----------
    vectors : Vectors
    moduli : (3, 3) array
        Scaled moduli times thickness, between E₁₁, E₂₂, 2 E₁₂ and the stresses.
    field : TensionField or None
        Where the layer wrinkles.
    """

    vectors: Vectors
    moduli: Array
    field: TensionField | None = None

    def response(self, t: Array) -> tuple[Array, Array]:
        """Stresses P (f, q, 6) and moduli A (f, q, 6, 6) of vectors t (f, q, 3, 2)."""
        first, second = t[..., 0], t[..., 1]
        strain = np.stack(
            [((first**2).sum(-1) - 1) / 2, ((second**2).sum(-1) - 1) / 2, (first * second).sum(-1)], axis=-1
        )
        if self.field is None:
            stress, moduli = strain @ self.moduli, np.broadcast_to(self.moduli, (*strain.shape, 3))
        else:
            stress, moduli = self.field.stress(strain), self.field.tangent(strain)
        by_vectors = np.zeros((*t.shape[:2], 3, 3, 2))  # of the strains
        by_vectors[..., 0, :, 0], by_vectors[..., 1, :, 1] = first, second
        by_vectors[..., 2, :, 0], by_vectors[..., 2, :, 1] = second, first
        by_vectors = by_vectors.reshape(*t.shape[:2], 3, 6)
        P = (stress[..., None, :] @ by_vectors)[..., 0, :]
        S = np.stack([stress[..., [0, 2]], stress[..., [2, 1]]], axis=-2)
        geometric = np.einsum("ij,fqkl->fqikjl", np.eye(3), S).reshape(*t.shape[:2], 6, 6)
        return P, np.swapaxes(by_vectors, -1, -2) @ moduli @ by_vectors + geometric


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Threads:
    """Smeared fibers: one tangent vector at each point, of length one at rest.

    Parameters
    ----------
    vectors : Vectors
    stiffness : float
        Scaled stiffness per width.
    pushed : float
        Share of the stiffness in compression.
    """

    vectors: Vectors
    stiffness: float
    pushed: float

    def response(self, t: Array) -> tuple[Array, Array]:
        """Tensions P (f, 1, 3) and moduli A (f, 1, 3, 3) of vectors t (f, 1, 3, 1)."""
        vector = t[..., 0]
        stretch = np.linalg.norm(vector, axis=-1)
        taut = stretch >= 1
        tension = self.stiffness * np.where(taut, 1.0, self.pushed) * (stretch - 1)
        slope = self.stiffness * np.where(taut, 1.0, max(self.pushed, FIBERS.slack_tangent))
        n = vector / stretch[..., None]
        dyad = n[..., :, None] * n[..., None, :]
        A = slope[..., None, None] * dyad + (tension / stretch)[..., None, None] * (np.eye(3) - dyad)
        return tension[..., None] * n, A


def sheets_of(model: Model, plane: Plane, stress: float) -> list[Sheet | Threads]:
    """Find the membranes, shells and fibers of a slice, scaled by the plane's length and a stress [Pa]."""
    terms: list[Sheet | Threads] = []
    for name, membrane in model.membranes.items():
        terms.append(_sheet(model, plane, name, membrane, stress))
    for fibers in model.reinforcements:
        terms += _threads(model, plane, smeared(fibers), stress)
    return terms


def smeared(fibers: Fibers) -> Fibers:
    """Return fibers as a section has them: spread over their face.

    Raises
    ------
    TurgorError
        If their direction is given by turns, which depend on a length that a section does not have.
    """
    if fibers.wound.turns is not None:
        raise TurgorError(
            f"fibers on '{fibers.place}': turns is {fibers.wound.turns:g}, but a section has no length; give pitch "
            "(the wound length over the turns) or the angle."
        )
    return replace(fibers, form=SMEARED, bending=False) if fibers.form == DISCRETE else fibers


def _sheet(model: Model, plane: Plane, name: str, membrane: Shell | Membrane, stress: float) -> Sheet:
    law, thickness = membrane.material.law, membrane.thickness / plane.length
    if type(law) is not Hooke:
        raise TurgorError(f"the sheet on '{name}' is woven; a section knows sheets of the law Hooke only.")
    sides = np.ascontiguousarray(model.mesh.face(name))
    moduli = plane_stress_moduli(law) / stress * thickness
    field = tension_field(moduli, membrane.compression) if membrane.wrinkles else None
    layer = (sides, *surface_gradients(model.mesh.points / plane.length, sides))
    return Sheet(vectors=_vectors(plane, sides, layer), moduli=moduli, field=field)


def _vectors(plane: Plane, sides: Ints, layer: tuple[Ints, Array, Array]) -> Vectors:
    """Vectors of a layer of the engine: its nodes, gradients and areas; its points lie above those of the sides."""
    nodes, gradients, areas = layer
    return from_slice(plane, nodes, gradients, _heights(plane, sides), areas)


def _heights(plane: Plane, sides: Ints) -> Array:
    """Height (f, q) of the integration points of membranes."""
    rule = reference_cell(sides.shape[1], MEMBRANE_QUADRATURE_DEGREE[4])
    return np.asarray(plane.height[sides] @ rule.N.T)


def _threads(model: Model, plane: Plane, fibers: Fibers, stress: float) -> list[Threads]:
    pieces = smeared_pieces(model.mesh, fibers)
    height = np.einsum("kn,kn->k", pieces.middle, plane.height[pieces.sides])
    level = np.abs(height - height.min()) < 1e-6 * plane.thickness
    along = pieces.along * plane.length
    weights = pieces.weights / plane.length**2
    share = weights.sum() / weights[level].sum()
    vectors = from_slice(
        plane,
        pieces.sides[level],
        along[level][:, None, :, None],
        height[level][:, None],
        share * weights[level][:, None],
    )
    stiffness = float(pieces.stiffness[0]) / (stress * plane.length)
    return [Threads(vectors=vectors, stiffness=stiffness, pushed=fibers.compression)]
