"""Liquid: a pressure on faces that grows with depth, as follower forces along the deformed normals."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.sections import plane_sections
from turgor.core.engine.cells.reference import ReferenceCell, liquid_tables
from turgor.core.engine.faces import surfaces
from turgor.core.engine.faces.pressure_term import FollowerTerm
from turgor.core.engine.term import Configuration, Setting, add_at_nodes
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class LiquidTerm(FollowerTerm):
    """Faces that touch the same liquid, whose pressure is g · (x − x₀) at a place x, with x₀ on its level.

    Parameters
    ----------
    sides : (f, n) int array
        Nodes of the sides.
    load : HydrostaticPressure
        The load of one of them.
    gradient : (3,) array
        Scaled gradient g of the whole pressure.
    at_origin : float
        Scaled pressure −g · x₀.
    potential : bool
        Whether there is a potential: the faces are closed, or their rim is fixed.
    """

    sides: Ints
    load: Any
    gradient: Array
    at_origin: float
    potential: bool

    @property
    def _tables(self) -> ReferenceCell:
        return liquid_tables(self.sides.shape[1])

    def _pressures(self, at: Configuration) -> Array:
        """Scaled pressure (f, q) at the quadrature points."""
        places = np.einsum("qa,fai->fqi", self._tables.N, at.position[self.sides])
        pressure = self.at_origin + places @ self.gradient
        if self.load.free_surface:
            pressure = np.maximum(pressure, 0.0)
        return np.asarray(self.load.share(at.load_factor) * pressure)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the pressure times the deformed areas, against the normals."""
        r = self._tables
        weighted = self._pressures(at) * r.weights
        add_at_nodes(out, self.sides, -surfaces.pressure_forces(at.position, self.sides, r.N, r.dN, weighted))

    def _tangents(self, at: Configuration) -> Array:
        """The pressure as the normals turn, and the normals as the pressure changes."""
        r, pressures = self._tables, self._pressures(at)
        weighted = pressures * r.weights
        local = np.asarray(surfaces.pressure_tangents(at.position, self.sides, r.N, r.dN, weighted))
        edges = np.einsum("qad,fai->fqdi", r.dN, at.position[self.sides])
        wet = pressures != 0 if self.load.free_surface else np.ones_like(pressures)
        share = self.load.share(at.load_factor) * wet * r.weights
        normals = share[..., None] * np.cross(edges[:, :, 0], edges[:, :, 1])
        deeper = np.einsum("qa,qb,fqi,j->faibj", r.N, r.N, normals, self.gradient, optimize=True)
        return np.asarray(local + deeper.reshape(local.shape))


def liquid_terms(setting: Setting) -> list[LiquidTerm]:
    """Faces in the same liquid at all times are joined: together they may be closed where each alone is open."""
    alike: dict[Any, list[Any]] = {}
    for load in (load.liquid for load in setting.model.loads):
        if load is not None:
            alike.setdefault(replace(load, face=""), []).append(load)
    if alike and plane_sections(setting.model):
        raise TurgorError("a liquid has no thrust on plane sections; leave it out, or model the whole length.")
    return [_term_of(setting, loads) for loads in alike.values()]


def _term_of(setting: Setting, loads: Iterable[Any]) -> LiquidTerm:
    mesh, (load, *_) = setting.model.mesh, loads
    sides = np.ascontiguousarray(np.concatenate([mesh.carrying_sides(each.face) for each in loads]))
    gradient = np.array(load.gradient)
    return LiquidTerm(
        sides=sides,
        load=load,
        gradient=gradient * setting.length / setting.stress,
        at_origin=float(np.linalg.norm(gradient)) * load.level / setting.stress,
        potential=surfaces.has_potential(setting.points, mesh.leaders[sides], setting.prescribed),
    )
