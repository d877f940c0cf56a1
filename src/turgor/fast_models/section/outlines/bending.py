"""Bending of the shells of a section: plates on its outlines, and what keeps their angles at nodes small.

The energy is that of `turgor.core.engine.faces.plate_terms`, a C0 interior penalty method, in the helical state of a
section, where a point moves along the rod with w = λ e₁ + κ × y. With y′ and y″ along the outline, and the normal n of
w and y′, the curvatures are

    b₁₁ = n·(κ × w),   b₁₂ = n·(κ × y′) / |Y′|,   b₂₂ = n·y″ / |Y′|² .

An outline bends within its edges and at the nodes between them, by angles θ. For each length of the rod it stores

    ∫ ½ b : ℂ : b dL + Σ ({m} θ + η D / (2 h) θ²),        m = D (b₂₂ + ν b₁₁) ,

with the changes of b, m and θ, the mean {m} of both sides and the length h of the edges. At a mirror plane, θ is the
angle to the plane's normal.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.membranes import plane_stress_moduli
from turgor.core.engine.faces.settings import PLATE
from turgor.core.materials.laws.laws import Hooke
from turgor.core.model.model import Model
from turgor.core.model.sheets import Shell
from turgor.fast_models.section.kinematics import STRAINS
from turgor.fast_models.section.outlines.jets import Jet, angle, cross, dot, unit
from turgor.fast_models.section.plane import Plane, face_edges
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(3)

#: Unloaded strains of the rod.
_REST = np.array([1.0, 0.0, 0.0, 0.0])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plates:
    """Edges of a shell, which bend.

    Parameters
    ----------
    nodes : (e, 3) int array
        Both ends, then the middle.
    points : (n, 3) array
        Positions of the nodes of the section at rest, scaled.
    moduli : (3, 3) array
        Scaled bending stiffness, between b₁₁, b₂₂ and 2 b₁₂.
    """

    nodes: Ints
    points: Array
    moduli: Array
    _rest: Array = field(init=False)
    _metric: Array = field(init=False)

    def __post_init__(self) -> None:
        metric = np.stack([np.linalg.norm(_slopes(x) @ self.points[self.nodes], axis=1) for x in _POINTS])
        object.__setattr__(self, "_metric", metric)
        rest = [self._curvatures(self.points, _REST, k)[1].value for k in range(len(_POINTS))]
        object.__setattr__(self, "_rest", np.stack(rest))

    def derivatives(self, y: Array, strains: Array) -> tuple[Array, Array]:
        """Gradient (e, 9 + 4) and Hessian (e, 13, 13) of the energy of each edge."""
        r, K = np.zeros((len(self.nodes), 9 + STRAINS)), np.zeros((len(self.nodes), 9 + STRAINS, 9 + STRAINS))
        for k, weight in enumerate(_WEIGHTS):
            along, around, both = self._curvatures(y, strains, k)
            bends = (along, around.less(self._rest[k]), both.times(2.0))
            for i in range(3):
                for j in range(3):
                    energy = (bends[i] * bends[j]).times(0.5 * self.moduli[i, j] * weight * self._metric[k])
                    r, K = r + energy.first, K + energy.second
        return r, K

    def _curvatures(self, y: Array, strains: Array, point: int) -> tuple[Jet, Jet, Jet]:
        """b₁₁, b₂₂ and b₁₂ at an integration point of each edge."""
        frame = _frame(self.nodes, y, strains, _POINTS[point])
        scale = 1 / self._metric[point]
        return (
            dot(frame.normal, cross(frame.kappa, frame.along)),
            dot(frame.normal, frame.bend).times(scale**2),
            dot(frame.normal, cross(frame.kappa, frame.slope)).times(scale),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Folds:
    """Nodes of a shell at which it may fold: between two edges, or at a mirror plane.

    Parameters
    ----------
    nodes : (k, 5) or (k, 3) int array
        The first edge, both ends and the middle, ends at the node; end and middle of the second one follow.
    points : (n, 3) array
    stiffness : float
        Scaled D.
    contraction : float
        Poisson's ratio ν.
    mirrors : (k, 3) array or None
        Unit vectors out of the body, where a mirror plane takes the place of the second edge.
    """

    nodes: Ints
    points: Array
    stiffness: float
    contraction: float
    mirrors: Array | None = None
    _rest: tuple[Array, Array] = field(init=False)
    _penalty: Array = field(init=False)

    def __post_init__(self) -> None:
        first = np.linalg.norm(_slopes(1.0) @ self.points[self.nodes[:, :3]], axis=1)
        if self.mirrors is not None:
            inverse = 2.0 / (2 * first)
        else:
            second = np.linalg.norm(_slopes(-1.0) @ self.points[self.nodes[:, [1, 3, 4]]], axis=1)
            inverse = 0.5 / (2 * first) + 0.5 / (2 * second)
        object.__setattr__(self, "_penalty", PLATE.penalty_quadrilaterals * self.stiffness * inverse)
        moment, fold = self._folded(self.points, _REST)
        object.__setattr__(self, "_rest", (moment.value, fold.value))

    def derivatives(self, y: Array, strains: Array) -> tuple[Array, Array]:
        """Gradient (k, m + 4) and Hessian of the energy of each node."""
        moment, fold = (each.less(rest) for each, rest in zip(self._folded(y, strains), self._rest, strict=True))
        energy = moment * fold + (fold * fold).times(0.5 * self._penalty)
        return energy.first, energy.second

    def _folded(self, y: Array, strains: Array) -> tuple[Jet, Jet]:
        """Mean moment and angle."""
        first = _frame(self.nodes, y, strains, 1.0)
        if self.mirrors is not None:
            out = _constant(self.mirrors, first.normal)
            return self._moment(first, 1.0), angle(dot(first.normal, out), dot(first.conormal, out))
        second = _frame(self.nodes, y, strains, -1.0, (1, 3, 4))
        sine, cosine = dot(second.normal, first.conormal).times(-1.0), dot(first.normal, second.normal)
        return self._moment(first, 0.5) + self._moment(second, 0.5), angle(sine, cosine)

    def _moment(self, frame: "_Frame", share: float) -> Jet:
        scale = np.linalg.norm(frame.at_rest(self.points), axis=1)
        across = dot(frame.normal, frame.bend).times(1 / scale**2)
        along = dot(frame.normal, cross(frame.kappa, frame.along)).times(self.contraction)
        return (across + along).times(share * self.stiffness)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Frame:
    """Vectors at one point of each edge: along the rod, along the outline with its derivative, and the normal."""

    nodes: Ints
    where: float
    kappa: Jet
    along: Jet
    slope: Jet
    bend: Jet

    @property
    def normal(self) -> Jet:
        return unit(cross(self.along, self.slope))

    @property
    def conormal(self) -> Jet:
        """Unit vector across the rod's direction in the surface, along the outline."""
        return unit(cross(self.normal, self.along))

    def at_rest(self, points: Array) -> Array:
        """Derivative of the position along the outline at rest, (e, 3)."""
        return np.asarray(_slopes(self.where) @ points[self.nodes])


def _frame(nodes: Ints, y: Array, strains: Array, where: float, own: Sequence[int] = (0, 1, 2)) -> _Frame:
    """Vectors at a parameter from −1 to 1 of edges, whose nodes stand at the places ``own`` among all of a piece."""
    count, size = nodes.shape
    variables = 3 * size + STRAINS
    edges = nodes[:, list(own)]

    def spread(numbers: Array) -> Jet:
        value = np.einsum("a,eai->ei", numbers, y[edges])
        first = np.zeros((count, 3, variables))
        for number, place in zip(numbers, own, strict=True):
            for i in range(3):
                first[:, i, 3 * place + i] = number
        return Jet(value, first, np.zeros((count, 3, variables, variables)))

    first = np.zeros((count, 3, variables))
    first[:, :, 3 * size + 1 :] = np.eye(3)
    kappa = Jet(np.broadcast_to(strains[1:], (count, 3)), first, np.zeros((count, 3, variables, variables)))
    first = np.zeros((count, 3, variables))
    first[:, 0, 3 * size] = 1.0
    value = np.broadcast_to(np.array([strains[0], 0.0, 0.0]), (count, 3))
    stretch = Jet(value, first, np.zeros((count, 3, variables, variables)))
    shape = np.array([where * (where - 1) / 2, where * (where + 1) / 2, 1 - where**2])
    along = stretch + cross(kappa, spread(shape))
    bend = spread(np.array([1.0, 1.0, -2.0]))
    return _Frame(nodes=edges, where=where, kappa=kappa, along=along, slope=spread(_slopes(where)), bend=bend)


def _slopes(where: float) -> Array:
    """Derivatives of the shape functions of both ends and the middle at a parameter from −1 to 1."""
    return np.array([where - 0.5, where + 0.5, -2 * where])


def _constant(vectors: Array, like: Jet) -> Jet:
    return Jet(vectors, np.zeros_like(like.first), np.zeros_like(like.second))


def bending_of(model: Model, plane: Plane, stress: float) -> list[Plates | Folds]:
    """Find what bends in a slice, scaled by the plane's length and a stress [Pa]; faces with equal shells are one.

    Raises
    ------
    TurgorError
        If more than two edges of a shell meet at a node.
    """
    shells = {name: sheet for name, sheet in model.membranes.items() if isinstance(sheet, Shell)}
    terms: list[Plates | Folds] = []
    for first, shell in shells.items():
        names = [name for name, other in shells.items() if other == shell]
        if names[0] == first:
            edges = np.concatenate([face_edges(plane, model.mesh.face(name)) for name in names])
            terms += _bending(edges, plane, shell, stress, model.mesh.mirror_planes)
    return terms


def _bending(
    edges: Ints, plane: Plane, shell: Shell, stress: float, mirrors: Sequence[tuple[int, float]]
) -> list[Plates | Folds]:
    law = shell.material.law
    assert isinstance(law, Hooke)  # `sheets_of` refuses woven ones
    moduli = plane_stress_moduli(law) * shell.second_moment / (stress * plane.length**3)
    D = float(moduli[0, 0])
    terms: list[Plates | Folds] = [Plates(nodes=edges, points=plane.points, moduli=moduli)]
    inner, ends = _folds(edges)
    if len(inner):
        terms.append(Folds(nodes=inner, points=plane.points, stiffness=D, contraction=law.nu))
    for axis, position in mirrors:
        at = (position - plane.origin[axis]) / plane.length
        there = ends[np.abs(plane.points[ends[:, 1], axis] - at) < 1e-6]
        if len(there):
            out = np.zeros((len(there), 3))
            out[:, axis] = np.sign(at - plane.points[there[:, 2], axis])
            terms.append(Folds(nodes=there, points=plane.points, stiffness=D, contraction=law.nu, mirrors=out))
    return terms


def _folds(edges: Ints) -> tuple[Ints, Ints]:
    """Nodes (k, 5) of two edges that meet, and those (m, 3) of edges that end, turned so that they end at the node."""
    both = np.concatenate([edges, edges[:, [1, 0, 2]]])
    order = np.argsort(both[:, 1], kind="stable")
    _, first, count = np.unique(both[order, 1], return_index=True, return_counts=True)
    if (count > 2).any():
        raise TurgorError(
            f"{count.max()} edges of a shell meet at one node of the section; a sheet may bend and fold, not branch. "
            "Leave a face out, or make one a membrane."
        )
    pairs = first[count == 2]
    one, other = both[order[pairs]], both[order[pairs + 1]]
    return np.column_stack([one, other[:, 0], other[:, 2]]), both[order[first[count == 1]]]
