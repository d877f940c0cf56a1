"""Tip response: how the slices move under a unit of moments and a force on the tip, from the tangent of the full model.

The forces on the nodes are those that do work on the rotation, or on the mean place, of the slice at the tip.
"""

from dataclasses import dataclass

import numpy as np

from turgor.accuracy.gradients.equilibrium import equilibrium_of
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.core.solvers.procedures.static import Static
from turgor.reduced.states.answer import ReducedState
from turgor.systems.robots.backbone import Array, Backbone, rotations_of


@dataclass(frozen=True, slots=True, eq=False)
class TipLoad:
    """A moment [N m] or a force [N] on the tip, along axes of space.

    Parameters
    ----------
    moment, force : (3,) arrays
    """

    moment: Array
    force: Array


@dataclass(frozen=True, slots=True, eq=False)
class TipResponse:
    """A state, and how its slices move under loads on the tip.

    Parameters
    ----------
    answer : ReducedState
    frames : (turns, places)
        Of the slices of the full state, the base first.
    loads : tuple of TipLoad
    moved : tuple of (turns, places)
        Frames after a small share of each load.
    share : tuple of float
        This share.
    """

    answer: ReducedState
    frames: tuple[Array, Array]
    loads: tuple[TipLoad, ...]
    moved: tuple[tuple[Array, Array], ...]
    share: tuple[float, ...]


def tip_response(
    answer: ReducedState, backbone: Backbone, bends: tuple[int, ...], options: EngineOptions
) -> TipResponse:
    """Solve for the loads that chains have springs against: moments about some axes of space, a force along the tip.

    Parameters
    ----------
    answer : ReducedState
    backbone : Backbone
    bends : tuple of int
        Axes of the moments.
    options : EngineOptions
    """
    mesh = answer.reduced.model.mesh
    facts = MeshFacts(mesh)
    base = equilibrium_of(answer.state(), Static(), options)
    system, rest = base.system, moved_nodes(base.system, base.at.unknowns)
    frames = frames_of(backbone, facts, rest)
    along = frames[0][-1][:, 0]
    loads = [TipLoad(np.eye(3)[axis], np.zeros(3)) for axis in bends] + [TipLoad(np.zeros(3), along)]
    moved, shares = [], []
    for load in loads:
        by_node = np.zeros((system.node_count, 3))
        by_node[backbone.slices[-1].nodes] = _nodal(load, backbone, frames[0][-1], facts)
        right = system.joined(by_node) / (system.stress_scale * system.length**2)
        right[system.prescribed] = 0.0
        change = base.answer(right, np.zeros(len(base.scalars)))[0]
        motion = moved_nodes(system, change)
        share = 1e-4 * backbone.length / max(float(np.abs(motion).max()), 1e-300)
        moved.append(frames_of(backbone, facts, rest + share * motion))
        shares.append(share)
    return TipResponse(answer, frames, tuple(loads), tuple(moved), tuple(shares))


def moved_nodes(system: System, unknowns: Array) -> Array:
    """Displacement (n, 3) [m] of the nodes of the mesh."""
    return np.asarray(system.displacement(unknowns) * system.length)


def frames_of(backbone: Backbone, facts: MeshFacts, displacement: Array) -> tuple[Array, Array]:
    """Frames of the slices of a displacement (n, 3), the base first."""
    moments, places = [], []
    for each in backbone.slices:
        moment = np.zeros((3, 3))
        for image in facts.images:
            arm = each.arms(image.of(facts.mesh.points[each.nodes]))
            moment += np.einsum("n,na,nb->ab", each.weights, displacement[each.nodes] @ image.turn.T, arm)
        moments.append(each.second + moment / len(facts.images))
        places.append(each.center + facts.of_whole(each.weights @ displacement[each.nodes]))
    turns = np.concatenate([np.eye(3)[None], rotations_of(np.array(moments))])
    return turns, np.concatenate([backbone.base[None], np.array(places)])


def _nodal(load: TipLoad, backbone: Backbone, turn: Array, facts: MeshFacts) -> Array:
    """Forces (k, 3) [N] on the nodes of the modeled part at the tip.

    With S = R Σ w X ⊗ A Rᵀ the rotation changes by (tr S − S)⁻¹ Σ w R A × δx, for small strains of the slice.
    """
    tip = backbone.slices[-1]
    spread = turn @ tip.second @ turn.T
    spin = np.linalg.solve(np.trace(spread) * np.eye(3) - spread, load.moment)
    arms = tip.arms(facts.mesh.points[tip.nodes]) @ turn.T
    forces = tip.weights[:, None] * (np.cross(spin, arms) + load.force)
    return np.asarray(forces / len(facts.images))
