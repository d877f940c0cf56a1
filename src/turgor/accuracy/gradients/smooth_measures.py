"""Smooth measures: those whose derivative by all unknowns at once has a closed form, which the adjoint needs."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.equilibrium import Equilibrium
from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.faces import surfaces
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.core.results.measures.measure import Measure

Array = NDArray[np.float64]

#: Derivative of a measure by the displacement of every node, (n, 3) [SI per m].
ByNode = Callable[[Equilibrium, MeshFacts], Array]


def is_smooth(base: Equilibrium, measure: Measure) -> bool:
    """Return whether the derivative of a measure by all unknowns is known.

    Parameters
    ----------
    base : Equilibrium
    measure : Measure

    Returns
    -------
    bool
    """
    return measure.name in _tip_measures() or bool(_cavities(base, measure.name))


def by_unknowns(base: Equilibrium, measure: Measure, facts: MeshFacts) -> Array:
    """Return the derivative of a smooth measure by the unknowns, (size,) [SI].

    Parameters
    ----------
    base : Equilibrium
    measure : Measure
    facts : MeshFacts
        Of the mesh.

    Returns
    -------
    (size,) array
    """
    system = base.system
    cavities = _cavities(base, measure.name)
    if cavities:
        gradients = Chambers(system, cavities).gradients(base.at.unknowns)
        return np.asarray(gradients.sum(axis=0) * system.length**3)
    by_node = np.zeros((system.node_count, 3))
    by_node[: len(system.model.mesh.points)] = _tip_measures()[measure.name](base, facts) * system.length
    return system.joined(by_node)


def _cavities(base: Equilibrium, name: str) -> tuple[str, ...]:
    """Cavities whose volume a measure is; none where it is something else."""
    cavities = base.state.model.mesh.cavities
    if name == "cavity_volume":
        return cavities
    return tuple(cavity for cavity in cavities if name == f"{cavity}_volume")


def _tip_measures() -> dict[str, ByNode]:
    return {
        "tip_displacement": _tip_displacement,
        "tip_displacement_x": lambda base, facts: _tip_along(base, facts, np.array([1.0, 0, 0])),
        "tip_displacement_y": lambda base, facts: _tip_along(base, facts, np.array([0, 1.0, 0])),
        "tip_displacement_z": lambda base, facts: _tip_along(base, facts, np.array([0, 0, 1.0])),
        "bending_angle": _bending_angle,
    }


def _tip_along(base: Equilibrium, facts: MeshFacts, direction: Array) -> Array:
    """Derivative of the mean displacement of the tip along a direction."""
    weights = surfaces.nodal_weights(facts.mesh.points, facts.mesh.face("tip"))
    return np.outer(weights / weights.sum(), facts.of_whole(direction))


def _tip_displacement(base: Equilibrium, facts: MeshFacts) -> Array:
    displacement = base.system.physical(base.at.unknowns)[0]
    weights = surfaces.nodal_weights(facts.mesh.points, facts.mesh.face("tip"))
    mean = facts.of_whole(weights @ displacement / weights.sum())
    return _tip_along(base, facts, mean / max(float(np.linalg.norm(mean)), 1e-300))


def _bending_angle(base: Equilibrium, facts: MeshFacts) -> Array:
    """Derivative of the heading of the tip's vector area less that of the fixed face."""
    points = facts.mesh.points + base.system.physical(base.at.unknowns)[0]
    return _heading(facts, "tip", points) - _heading(facts, "fixed", points)


def _heading(facts: MeshFacts, face: str, points: Array) -> Array:
    """Derivative (n, 3) of arctan2(−a_z, a_x) of the vector area a of a face."""
    sides = facts.mesh.face(face)
    x, _, z = facts.of_whole(surfaces.vector_area(points, sides))
    slope = facts.of_whole(np.array([z, 0.0, -x]) / (x * x + z * z))
    tables = side_tables(sides.shape[1])
    r, s = (np.einsum("qa,fai->fqi", tables.dN[..., k], points[sides]) for k in range(2))
    local = np.einsum("q,qa,fqi->fai", tables.weights, tables.dN[..., 0], np.cross(s, slope))
    local += np.einsum("q,qa,fqi->fai", tables.weights, tables.dN[..., 1], np.cross(slope, r))
    out = np.zeros_like(points)
    np.add.at(out, sides, local)
    return out
