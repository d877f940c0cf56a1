"""Fields of a state for measures, files and pictures; each is computed once, when it is first used."""

from collections.abc import Callable, Hashable
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.bonds.bond_results import BondResult, bond_results
from turgor.core.engine.faces.membrane_term import film_fields
from turgor.core.engine.fibers.fiber_trusses import FiberTrusses, discrete_threads
from turgor.core.engine.fields import CellFields, cell_fields, film_average, nodal_average, nodal_mean_stress
from turgor.core.engine.percentiles import PERCENTILE, volume_percentile
from turgor.core.geometry.cad.symmetry.whole import Image, MirrorPlane, images_of
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.proximity import FacingWalls, find_facing_walls
from turgor.core.meshing.refining.region_nodes import RegionNodes, region_nodes
from turgor.core.meshing.surface import outer_triangles
from turgor.core.model.fibers import Fibers
from turgor.core.model.model import DISPLACEMENT, Model
from turgor.core.solvers.solution import State

Array = NDArray[np.float64]
Value = TypeVar("Value")


class MeshFacts:
    """Facts that the states of one path share: mirror planes, walls that may meet, and threads at rest."""

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._threads: list[tuple[Fibers, FiberTrusses]] = []
        self._cached: dict[Hashable, Any] = {}

    def once(self, key: Hashable, make: Callable[[], Value]) -> Value:
        """Return what was made under a key, which is made when it is first requested."""
        if key not in self._cached:
            self._cached[key] = make()
        value: Value = self._cached[key]
        return value

    @cached_property
    def mirrors(self) -> tuple[MirrorPlane, ...]:
        """Mirror planes, one for each face named ``symmetry_*``."""
        return tuple(MirrorPlane(axis, position) for axis, position in self.mesh.mirror_planes)

    @cached_property
    def images(self) -> tuple[Image, ...]:
        """Maps of the modeled part onto all parts of the whole, itself first."""
        return images_of(self.mirrors, self.mesh.wedge)

    @cached_property
    def walls(self) -> FacingWalls:
        """Pairs of outer walls that may meet."""
        return find_facing_walls(self.mesh)

    @cached_property
    def region_nodes(self) -> RegionNodes:
        """The nodes of the mesh, doubled where regions meet."""
        return region_nodes(self.mesh)

    def threads(self, fibers: Fibers) -> FiberTrusses:
        """Threads of a winding where they lie at rest; found once."""
        for known, threads in self._threads:
            if known is fibers:
                return threads
        self._threads.append((fibers, discrete_threads(self.mesh, fibers)))
        return self._threads[-1][1]

    @cached_property
    def surface(self) -> NDArray[np.int64]:
        """The whole surface of the mesh, (f, k): sides of cells that no other cell shares."""
        return outer_triangles(self.mesh)

    def of_whole(self, vector: Array) -> Array:
        """Mean over the whole actuator of a vector of the modeled part.

        What points along a mirror's normal cancels, and so does what points across the axis of a wedge.
        """
        out = np.array(vector, dtype=np.float64)
        for plane in self.mirrors:
            out[..., plane.axis] = 0.0
        return out if self.mesh.wedge is None else self.mesh.wedge.mean(out)


class StateFields:
    """A state with its fields.

    Stresses and stretches at the nodes are averaged over the cells of one region. A node where regions meet has a value
    for each of them: the first n values belong to the n nodes of the mesh, and ``facts.region_nodes`` says to which
    node and region each of the d values belongs. With one region d equals n.

    Parameters
    ----------
    state : State
        Equilibrium at one point of the path.
    facts : MeshFacts
        What states of the same mesh share; made here if it is not given.
    """

    def __init__(self, state: State, facts: MeshFacts | None = None) -> None:
        self.state = state
        self.facts = facts or MeshFacts(state.model.mesh)
        self._cached: dict[Hashable, Any] = {}

    def once(self, key: Hashable, make: Callable[[], Value]) -> Value:
        """Return what was made of this state under a key, which is made when it is first requested."""
        if key not in self._cached:
            self._cached[key] = make()
        value: Value = self._cached[key]
        return value

    @property
    def model(self) -> Model:
        """The question."""
        return self.state.model

    @property
    def mesh(self) -> Mesh:
        """The mesh of the model."""
        return self.state.model.mesh

    @property
    def displacement(self) -> Array:
        """Displacement of every node, (n, 3) [m]."""
        return self.state.displacement

    @cached_property
    def points(self) -> Array:
        """Current positions of all nodes, (n, 3) [m]."""
        return self.mesh.points + self.state.displacement

    @cached_property
    def cells(self) -> CellFields:
        """Stresses and stretches at the quadrature points of the cells."""
        state = self.state
        return cell_fields(self.model, state.displacement, state.mean_stress, state.memory, state.load_factor)

    @cached_property
    def von_mises(self) -> Array:
        """Von Mises stress averaged at the nodes of each region, (d,) [Pa]."""
        if not len(self.mesh.cells):
            return np.maximum(film_average(self.model, _von_mises(self._films[0])), 0.0)
        return np.maximum(self._averaged(self.cells.von_mises), 0.0)

    @cached_property
    def stretch(self) -> Array:
        """Largest principal stretch averaged at the nodes of each region, (d,)."""
        if not len(self.mesh.cells):
            return film_average(self.model, self._films[1])
        return self._averaged(self.cells.stretch)

    @cached_property
    def contact_pressure(self) -> Array:
        """Contact pressure at the nodes, (n,) [Pa]: that of all contacts together, zero where nothing touches."""
        total = np.zeros(len(self.mesh.points))
        for touch in self.state.touches.values():
            total += touch.pressure
        return total

    @cached_property
    def bonds(self) -> dict[str, BondResult]:
        """Bonds between bodies by their names."""
        return bond_results(self.model, self.state.displacement, self.state.memory)

    @cached_property
    def bond_damage(self) -> Array:
        """Damage of bonds at the nodes of their sides, (n,), zero elsewhere: 0 as new, 1 open."""
        nodal = [bond.nodal_damage for bond in self.bonds.values()]
        return np.asarray(np.max([np.zeros(len(self.mesh.points)), *nodal], axis=0))

    @cached_property
    def cauchy_stress(self) -> Array:
        """Cauchy stress averaged at the nodes of each region, (d, 3, 3) [Pa]."""
        if not len(self.mesh.cells):
            return film_average(self.model, self._films[0])
        return self._averaged(self.cells.cauchy)

    @cached_property
    def _films(self) -> tuple[Array, Array]:
        """Stress and stretch at points of films without a solid."""
        return film_fields(self.model, self.displacement, self.state.load_factor)

    @cached_property
    def mean_stress(self) -> Array:
        """Mean stress at the nodes of each region, (d,) [Pa]: the multiplier, interpolated between its values.

        Where there is a foam or no multiplier, that of the points is averaged.
        """
        if not len(self.mesh.cells):
            return np.asarray(np.trace(self.cauchy_stress, axis1=1, axis2=2) / 3)
        foams = any(material.is_foam for material in self.model.region_materials.values())
        if foams or self.model.formulation == DISPLACEMENT:
            return self._averaged(self.cells.mean_stress)
        return nodal_mean_stress(self.model, self.state.mean_stress, self.facts.region_nodes)

    @cached_property
    def von_mises_p99(self) -> float:
        """Von Mises stress that 99 % of the volume stay below, of films 99 % of the nodes [Pa]."""
        if not len(self.mesh.cells):
            return float(np.percentile(self.von_mises, PERCENTILE))
        return volume_percentile(self.cells, self.cells.von_mises)

    @cached_property
    def stretch_p99(self) -> float:
        """Largest principal stretch that 99 % of the volume stay below, of films 99 % of the nodes."""
        if not len(self.mesh.cells):
            return float(np.percentile(self.stretch, PERCENTILE))
        return volume_percentile(self.cells, self.cells.stretch)

    def settle(self) -> None:
        """Compute what is shown, and drop the fields at the quadrature points, the largest by far."""
        for name in ("von_mises_p99", "stretch_p99", "von_mises", "stretch", "cauchy_stress"):
            getattr(self, name)
        self.__dict__.pop("cells", None)
        self.__dict__.pop("_films", None)

    def _averaged(self, values: Array) -> Array:
        return nodal_average(self.mesh, values, self.facts.region_nodes)


def _von_mises(stress: Array) -> Array:
    """Von Mises stress (...) of stresses (..., 3, 3)."""
    deviator = stress - np.trace(stress, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
    return np.asarray(np.sqrt(1.5 * (deviator**2).sum(axis=(-2, -1))))
