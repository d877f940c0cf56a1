"""Equations: equilibrium of a section in a helical state, its tangent, and Newton's update."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import LinearSolver, linear_solver
from turgor.core.engine.algebra.pattern import build_pattern, locate
from turgor.core.model.model import Model
from turgor.fast_models.section.kinematics import STRAINS
from turgor.fast_models.section.numbering import Numbering, numbering_of
from turgor.fast_models.section.outlines.bending import Folds, Plates, bending_of
from turgor.fast_models.section.outlines.loops import Loop
from turgor.fast_models.section.outlines.sheets import Sheet, Threads, sheets_of
from turgor.fast_models.section.plane import Plane, boundary_edges, face_edges, plane_of
from turgor.fast_models.section.rubber import Rubber, rubber_of

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Unknowns:
    """A state of a section, scaled.

    Parameters
    ----------
    y : (n, 3) array
        Positions of the nodes in the frame of the section.
    strains : (4,) array
        Stretch, twist and curvatures about y and z.
    p : (m,) array
        Mean stresses.
    multipliers : (g,) array
    pressures : (k,) array
        Of the cavities: as given, or what holds a volume.
    """

    y: Array
    strains: Array
    p: Array
    multipliers: Array
    pressures: Array

    def towards(self, other: "Unknowns", share: float) -> "Unknowns":
        """Straight on from this state to another one, by a share of their distance."""
        return Unknowns(
            y=self.y + share * (other.y - self.y),
            strains=self.strains + share * (other.strains - self.strains),
            p=self.p + share * (other.p - self.p),
            multipliers=self.multipliers + share * (other.multipliers - self.multipliers),
            pressures=self.pressures + share * (other.pressures - self.pressures),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Question:
    """Prescribed values of a state, scaled and for the modeled part.

    Parameters
    ----------
    pressures : (k,) array
        Of the cavities whose volume is free.
    volumes : (k,) array
        Prescribed volumes of the cavities for each length; NaN where the pressure is given.
    strains : (4,) array
        Prescribed strains; NaN where a strain is free.
    forces : (4,) array
        Axial force, torque and moments where the strain is free.
    """

    pressures: Array
    volumes: Array
    strains: Array
    forces: Array

    def towards(self, other: "Question", share: float) -> "Question":
        """Between this question and another one that prescribes the same strains and volumes."""
        return Question(
            pressures=self.pressures + share * (other.pressures - self.pressures),
            volumes=self.volumes + share * (other.volumes - self.volumes),
            strains=self.strains + share * (other.strains - self.strains),
            forces=self.forces + share * (other.forces - self.forces),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Linearized:
    """Equations at a state.

    Parameters
    ----------
    residual : (size,) array
        With the forces that the question gives taken off; without those that hold a strain.
    data : (nnz,) array
        Lower triangle of the core.
    right, below : (core, b), (b, core) arrays
    corner : (b, b) array
    pushed : (size, v) array
        Derivatives of the residual by the unknown pressures, those of the cavities whose volume is prescribed.
    gradients : (v, size) array
        Derivatives of these volumes.
    missed : (v,) array
        What these volumes lack.
    controlled : (v,) array
        Which cavities these are.
    """

    residual: Array
    data: Array
    right: Array
    below: Array
    corner: Array
    pushed: Array
    gradients: Array
    missed: Array
    controlled: Ints


class Equations:
    """Equilibrium of a section.

    Parameters
    ----------
    model : Model
        Of a slice.
    closed : bool
        Whether the pressure in the cavities also pushes on closed ends.

    Attributes
    ----------
    model : Model
    closed : bool
    plane : Plane
    stress : float [Pa]
        Scale of stresses.
    cavities : dict of str to Loop
    outside : Loop
        Outer boundary of the section.
    """

    def __init__(self, model: Model, closed: bool) -> None:
        self.model = model
        self.plane: Plane = plane_of(model.mesh)
        self.stress = max(m.law.shear_modulus for m in model.region_materials.values())
        self.copies = model.mesh.symmetry_factor
        self.closed = closed
        self.rubber: Rubber = rubber_of(model, self.plane, self.stress)
        self.sheets: list[Sheet | Threads] = sheets_of(model, self.plane, self.stress)
        self.bending: list[Plates | Folds] = bending_of(model, self.plane, self.stress)
        self.cavities = {
            name: self._loop(face_edges(self.plane, model.mesh.face(name))) for name in model.mesh.cavities
        }
        self.outside = self._outside(model)
        self.numbers: Numbering = numbering_of(model, self.plane, self.rubber.mean_count)
        self._pieces = self._unknowns_of_pieces()
        self._turns = [self.numbers.turned(nodes) for nodes, _ in self._pieces]
        self._locate()

    @property
    def area(self) -> float:
        """Unit of scaled areas, for the whole section [m²]."""
        return float(self.copies * self.plane.length**2)

    @property
    def rest(self) -> Unknowns:
        """The unloaded state."""
        numbers = self.numbers
        return Unknowns(
            y=self.plane.points.copy(),
            strains=np.array([1.0, 0.0, 0.0, 0.0]),
            p=np.zeros(self.rubber.mean_count),
            multipliers=np.zeros(len(numbers.conditions)),
            pressures=np.zeros(len(self.cavities)),
        )

    def volumes(self, at: Unknowns) -> Array:
        """Volumes of the cavities for each length, (k,)."""
        return np.array([loop.volume(at.y, at.strains) for loop in self.cavities.values()])

    def _loop(self, edges: Ints) -> Loop:
        """A loop in the direction in which it encloses a positive volume."""
        loop = Loop(edges=edges)
        rest = np.array([1.0, 0.0, 0.0, 0.0])
        return loop if loop.volume(self.plane.points, rest) > 0 else Loop(edges=edges[:, [1, 0, 2]])

    def _outside(self, model: Model) -> Loop:
        """Outer boundary without cavities and mirror planes."""
        edges = boundary_edges(self.plane)
        inner = [loop.edges for loop in self.cavities.values()]
        inner += [face_edges(self.plane, model.mesh.face(name)) for name in model.mesh.symmetry_faces]
        known = np.concatenate([np.zeros((0, 3), dtype=np.int64), *inner])
        return Loop(edges=edges[~np.isin(self._key(edges), self._key(known))])

    def _key(self, edges: Ints) -> Ints:
        """A number for each edge, whatever its direction."""
        return np.asarray(np.sort(edges[:, :2], axis=1) @ np.array([len(self.plane.points), 1]))

    def _unknowns_of_pieces(self) -> list[tuple[Ints, Ints]]:
        """Nodes and unknowns of the pieces of each part: rubber, sheets, their bending, cavities."""
        numbers, quads = self.numbers, self.plane.quads
        pieces = [(quads, np.hstack([numbers.of_nodes(quads), numbers.first_mean + self.rubber.mean]))]
        cavities = [loop.edges for loop in self.cavities.values()]
        for nodes in [*(s.vectors.nodes for s in self.sheets), *(each.nodes for each in self.bending), *cavities]:
            pieces.append((nodes, numbers.of_nodes(nodes)))
        return pieces

    def _locate(self) -> None:
        """Find the places of all entries once."""
        core, border = self.numbers.core, self.numbers.border
        pieces = [unknowns for _, unknowns in self._pieces]
        width = max(each.shape[1] for each in pieces)
        padded = [np.pad(core[each], ((0, 0), (0, width - each.shape[1])), constant_values=-1) for each in pieces]
        self._core_size, self._border_size = int(core.max()) + 1, int(border.max()) + 1
        self._pattern = build_pattern(padded[0], self._core_size, *padded[1:])
        rows = np.concatenate([np.repeat(each, each.shape[1], axis=1).ravel() for each in pieces])
        columns = np.concatenate([np.tile(each, (1, each.shape[1])).ravel() for each in pieces])
        inside = np.flatnonzero((core[rows] >= 0) & (core[columns] >= 0) & (core[rows] >= core[columns]))
        places = locate(self._pattern.indptr, self._pattern.indices, core[rows[inside]], core[columns[inside]])
        b = self._border_size
        right = np.flatnonzero((core[rows] >= 0) & (border[columns] >= 0))
        below = np.flatnonzero((border[rows] >= 0) & (core[columns] >= 0))
        corner = np.flatnonzero((border[rows] >= 0) & (border[columns] >= 0))
        self._places = (
            (inside, places.astype(np.int64), len(self._pattern.indices)),
            (right, core[rows[right]] * b + border[columns[right]], self._core_size * b),
            (below, border[rows[below]] * self._core_size + core[columns[below]], self._core_size * b),
            (corner, border[rows[corner]] * b + border[columns[corner]], b * b),
        )
        self._rows = np.concatenate([each.ravel() for each in pieces])
        self.solver: LinearSolver = linear_solver("auto", self._pattern, 1)

    def linearized(self, at: Unknowns, question: Question) -> Linearized | None:
        """Residual and tangent at a state; None where a cell is turned inside out."""
        parts = self._parts(at)
        if parts is None:
            return None
        values, size = np.concatenate([K.ravel() for _, K in parts]), len(self.numbers.core)
        residual = _summed(self._rows, np.concatenate([r.ravel() for r, _ in parts]), size)
        summed = [_summed(to, values[source], n) for source, to, n in self._places]
        b = self._border_size
        right, below = summed[1].reshape(-1, b), summed[2].reshape(b, -1)
        corner = summed[3].reshape(b, b)
        self._add_conditions(at, residual, (right, below, corner))
        first = self.numbers.first_strain
        residual[first : first + STRAINS] -= question.forces
        controlled = np.flatnonzero(~np.isnan(question.volumes))
        return Linearized(
            residual=residual,
            data=summed[0],
            right=right,
            below=below,
            corner=corner,
            pushed=-self._gradients_of(at, controlled, closed=self.closed).T,
            gradients=self._gradients_of(at, controlled, closed=True),
            missed=(question.volumes - self.volumes(at))[controlled],
            controlled=controlled,
        )

    def _gradients_of(self, at: Unknowns, cavities: Ints, *, closed: bool) -> Array:
        """Derivatives (v, size) of the volumes of some cavities, with those by the strains if ends are closed."""
        size = len(self.numbers.core)
        gradients = self.volume_gradients(at, closed=closed) if len(cavities) else []
        return np.array([gradients[k] for k in cavities]).reshape(-1, size)

    def _parts(self, at: Unknowns) -> list[tuple[Array, Array]] | None:
        """Gradients and Hessians of rubber, sheets, their bending and cavities, in the directions of the nodes."""
        rubber = self.rubber.forces(at.y, at.strains, at.p)
        if rubber is None:
            return None
        parts = [rubber]
        for sheet in self.sheets:
            P, A = sheet.response(sheet.vectors.at(at.y, at.strains))
            B = sheet.vectors.derivatives(at.y, at.strains)
            parts.append((sheet.vectors.gradient(B, P), sheet.vectors.hessian(B, P, A)))
        parts += [each.derivatives(at.y, at.strains) for each in self.bending]
        for loop, pressure in zip(self.cavities.values(), at.pressures, strict=True):
            r, K = loop.derivatives(at.y, at.strains)
            if not self.closed:
                r[:, 9:], K[:, 9:] = 0.0, 0.0
            parts.append((-pressure * r, -pressure * K))
        for (r, K), (chosen, turn) in zip(parts, self._turns, strict=True):
            if len(chosen):
                n = turn.shape[1]
                r[chosen, :n] = (turn @ r[chosen, :n, None])[..., 0]
                K[chosen, :n] = turn @ K[chosen, :n]
                K[chosen, :, :n] = K[chosen, :, :n] @ np.swapaxes(turn, 1, 2)
        return parts

    def _add_conditions(self, at: Unknowns, residual: Array, blocks: tuple[Array, Array, Array]) -> None:
        """Add the conditions that fix the section in its frame, and their multipliers."""
        numbers, (right, below, corner) = self.numbers, blocks
        local = np.einsum("nij,gnj->gni", numbers.axes, numbers.conditions).reshape(len(numbers.conditions), -1)
        moved = (at.y - self.plane.points).ravel()
        residual[: local.shape[1]] += at.multipliers @ local
        residual[numbers.first_multiplier :] = numbers.conditions.reshape(len(local), -1) @ moved
        mine = numbers.border[numbers.first_multiplier :]
        core, border = numbers.core[: local.shape[1]], numbers.border[: local.shape[1]]
        for row, place in zip(local, mine, strict=True):
            right[core[core >= 0], place] += row[core >= 0]
            below[place, core[core >= 0]] += row[core >= 0]
            corner[border[border >= 0], place] += row[border >= 0]
            corner[place, border[border >= 0]] += row[border >= 0]

    def volume_gradients(self, at: Unknowns, *, closed: bool | None = None) -> list[Array]:
        """Derivatives (size,) of the volume of each cavity; of open ends, without those by the strains."""
        closed = self.closed if closed is None else closed
        gradients: list[Array] = []
        first = 1 + len(self.sheets) + len(self.bending)
        for k, loop in enumerate(self.cavities.values(), start=first):
            (_, unknowns), (chosen, turn) = self._pieces[k], self._turns[k]
            r, _ = loop.derivatives(at.y, at.strains)
            if not closed:
                r[:, 9:] = 0.0
            if len(chosen):
                r[chosen, :9] = (turn @ r[chosen, :9, None])[..., 0]
            gradients.append(_summed(unknowns.ravel(), r.ravel(), len(self.numbers.core)))
        return gradients

    def update(self, at: Unknowns, equations: Linearized, strains: Array) -> Unknowns:
        """Newton's next state, with prescribed strains where ``strains`` is not NaN."""
        S, behind, rest = self.condensed(equations)
        numbers = self.numbers
        core, border = numbers.core >= 0, numbers.border >= 0
        G, V = equations.pushed, equations.gradients
        of_pressure = self._solved(G[core])
        matrix = np.block(
            [
                [S, G[border] - equations.below @ of_pressure],
                [V[:, border] - V[:, core] @ behind, -V[:, core] @ of_pressure],
            ]
        )
        right = np.concatenate(
            [-equations.residual[border] + equations.below @ rest, equations.missed + V[:, core] @ rest]
        )
        for i in np.flatnonzero(~np.isnan(strains)):
            place = numbers.strains[i]
            matrix[place] = 0.0
            matrix[place, place], right[place] = 1.0, strains[i] - at.strains[i]
        step, pressed = np.split(np.linalg.solve(matrix, right), [len(S)])
        change = np.zeros(len(numbers.core))
        change[border] = step
        change[core] = -rest - behind @ step - of_pressure @ pressed
        pressures = at.pressures.copy()
        pressures[equations.controlled] += pressed
        return replace(self._moved(at, change), pressures=pressures)

    def _moved(self, at: Unknowns, change: Array) -> Unknowns:
        """Add a change (size,) of all unknowns but the pressures."""
        numbers = self.numbers
        first, mean = numbers.first_strain, numbers.first_mean
        moved = np.einsum("nij,ni->nj", numbers.axes, change[:first].reshape(-1, 3))
        return replace(
            at,
            y=at.y + moved,
            strains=at.strains + change[first:mean],
            p=at.p + change[mean : numbers.first_multiplier],
            multipliers=at.multipliers + change[numbers.first_multiplier :],
        )

    def _solved(self, columns: Array) -> Array:
        """Solve the core for columns (core, n), with the factors at hand."""
        if not columns.shape[1]:
            return columns
        return np.stack([self.solver.solve(np.ascontiguousarray(c)) for c in columns.T], axis=1)

    def condensed(self, equations: Linearized) -> tuple[Array, Array, Array]:
        """Schur complement (b, b) of the border; what the core does to its columns (core, b) and to its residual."""
        self.solver.factor(equations.data)
        of_core = equations.residual[self.numbers.core >= 0]
        solved = self._solved(np.column_stack([equations.right, of_core]))
        behind, rest = solved[:, :-1], solved[:, -1]
        return equations.corner - equations.below @ behind, behind, rest

    def size_of(self, equations: Linearized, strains: Array) -> float:
        """Largest residual but those of prescribed strains."""
        free = (self.numbers.core >= 0) | (self.numbers.border >= 0)
        first = self.numbers.first_strain
        free[first : first + STRAINS] &= np.isnan(strains)
        return float(np.abs(equations.residual[free]).max())


def _summed(places: Ints, values: Array, size: int) -> Array:
    """Sum values at their places."""
    return np.asarray(np.bincount(places, values, minlength=size), dtype=np.float64)
