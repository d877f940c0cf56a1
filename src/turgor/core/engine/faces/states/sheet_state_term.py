"""The load of the states of a sheet: its stress is ℂ : (E − E₀), and −ℂ : E₀ does not depend on its shape."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import membranes
from turgor.core.engine.faces.membrane_term import film_frames, moduli_of
from turgor.core.engine.faces.sheet_moduli import free_stress, has_state
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower
from turgor.core.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class SheetStateTerm(Term):
    """The load of the states of one sheet.

    Parameters
    ----------
    model : Model
    name : str
        Face of the sheet.
    nodes : (f, n) int array
    frames : Frames
        Those in which the membrane is integrated, scaled.
    moduli : (3, 3) or (f, q, 3, 3) array
        Scaled moduli times thickness.
    """

    external = True

    model: Model
    name: str
    nodes: Ints
    frames: membranes.Frames
    moduli: Array

    @property
    def unknowns(self) -> Ints:
        """Displacements of the nodes."""
        return displacements(self.nodes)

    def stress(self, load_factor: float) -> Array:
        """ℂ : E₀ (f, q, 3) times thickness."""
        return free_stress(self.model, self.name, (self.frames, self.moduli), load_factor)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces of ℂ : E₀, with which the sheet grows."""
        f = self.frames
        stress = self.stress(at.load_factor)
        add_at_nodes(out, self.nodes, membranes.membrane_forces(at.position, self.nodes, f.gradients, f.areas, stress))

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Geometric part."""
        f, stress = self.frames, -self.stress(at.load_factor)
        none = np.zeros((*f.areas.shape, 3, 3))
        return lower(membranes.membrane_tangents(at.position, self.nodes, f.gradients, f.areas, none, stress))


def sheet_state_terms(setting: Setting) -> list[SheetStateTerm]:
    """One for each sheet that has a state."""
    model, terms = setting.model, []
    for name in model.membranes:
        if not has_state(model, name):
            continue
        sides = np.ascontiguousarray(model.mesh.face(name))
        frames = film_frames(setting.points, sides, alone=not len(model.mesh.cells))
        terms.append(SheetStateTerm(model, name, sides, frames, moduli_of(setting, name, frames)))
    return terms
