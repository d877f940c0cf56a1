"""ContactTerms: forces, tangent and friction of all contacts of a model, in scaled units."""

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.contact.build import Bodies, build_parts
from turgor.core.engine.contact.couplings import Layout
from turgor.core.engine.contact.friction import Friction
from turgor.core.engine.contact.pair_part import PairPart
from turgor.core.engine.contact.part import Gaps, SearchMode
from turgor.core.engine.contact.settings import PENALTY
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.engine.contact.surface import Surface
from turgor.core.model.model import Model
from turgor.core.model.obstacles.pose import Pose

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

Part = PairPart | ShapePart


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """How near all parts are at one position.

    Parameters
    ----------
    position : (n, 3) array
    gaps : tuple of Gaps
    """

    position: Array
    gaps: tuple[Gaps, ...]

    @property
    def rubs(self) -> bool:
        """Whether friction acts anywhere."""
        return any(gaps.friction is not None and len(gaps.friction.points) > 0 for gaps in self.gaps)

    @property
    def touch(self) -> bool:
        """Whether any point is inside what it touches."""
        return any(gaps.inside.any() for gaps in self.gaps)

    def touch_as(self, other: "Contacts") -> bool:
        """Whether the same points are inside as in other contacts of the same parts."""
        return all(np.array_equal(a.inside, b.inside) for a, b in zip(self.gaps, other.gaps, strict=True))

    def with_friction(self, friction: Friction) -> "Contacts":
        """The same contacts with a friction history."""
        each = friction or (None,) * len(self.gaps)
        return replace(self, gaps=tuple(replace(f, friction=a) for f, a in zip(self.gaps, each, strict=True)))


@dataclass(frozen=True, slots=True, eq=False)
class ContactMemory:
    """Memory of contact along a path.

    Parameters
    ----------
    last : Contacts or None
        The last global search, from which points follow their partners.
    penalty_scales : tuple of (s,) array
        Of each part.
    ties : (keys, list of unknowns) or None
        What the sparsity of the tangent covers; see `turgor.core.engine.contact.couplings.Layout`.
    """

    last: Contacts | None
    penalty_scales: tuple[Array, ...]
    ties: tuple[Ints, list[Ints]] | None


class ContactTerms:
    """Forces and tangents of all contacts of a model.

    Parameters
    ----------
    model : Model
    surface : Surface
        The whole surface of the mesh, scaled.
    points : (n, 3) array
        Scaled reference positions.
    scales : (length, stress)
    first_unknown : int
        The unknowns of sprung bodies begin here, three of each.
    like : ContactTerms, optional
        Those of a mesh with the same cells whose nodes are elsewhere by little; the search at rest is not repeated.
    """

    def __init__(
        self,
        model: Model,
        surface: Surface,
        points: Array,
        scales: tuple[float, float],
        first_unknown: int,
        like: "ContactTerms | None" = None,
    ) -> None:
        self._length, self._stress = scales
        self._tolerance = model.contact.tolerance
        self.bodies = Bodies.of(model, scales, first_unknown)
        self._known: Contacts | None = None
        self.parts: list[Part] = build_parts(
            model, surface, points, scales, self.bodies, () if like is None else like.parts
        )

    def memory(self, layout: Layout) -> ContactMemory:
        """The memory of contact up to now."""
        return ContactMemory(self._known, tuple(part.penalty_scale for part in self.parts), layout.ties)

    def restore(self, memory: ContactMemory, layout: Layout) -> None:
        """Know again what was learned."""
        self._known = memory.last
        for part, scale in zip(self.parts, memory.penalty_scales, strict=True):
            part.penalty_scale = scale
        if memory.ties is not None:
            layout.renew(*memory.ties)

    def look(
        self,
        position: Array,
        springs: Array,
        factor: float,
        known: Contacts | None = None,
        how: SearchMode = SearchMode.FOLLOW,
    ) -> Contacts:
        """Find the contacts at a position and load factor; ``springs`` are the unknowns of sprung bodies, in rows.

        A global search is made once in a step; in between, points follow their ``known`` partners from side to side:
        by default those of the last search.
        """
        known = known or self._known
        gaps = []
        for k, part in enumerate(self.parts):
            pose = self._pose(part, springs, factor)
            gaps.append(part.look(position, pose, None if known is None else known.gaps[k], how))
        out = Contacts(position, tuple(gaps))
        if known is None or how is SearchMode.GLOBAL:
            self._known = out
        return out

    def _pose(self, part: Part, springs: Array, load_factor: float) -> Pose:
        obstacle = part.obstacle
        if obstacle is None:
            return Pose(np.zeros(3))
        beyond = springs[self.bodies.names.index(part.name)] if part.unknown >= 0 else 0.0
        return obstacle.pose(load_factor).scaled(self._length, beyond)

    def forces(self, at: Contacts, springs: Array) -> tuple[Array, Array]:
        """Internal forces on the nodes (n, 3), and the imbalance of the sprung bodies (b, 3)."""
        count = len(at.position)
        out, bodies = np.zeros((count, 3)), self.bodies.springs[:, None] * springs
        for part, gaps in zip(self.parts, at.gaps, strict=True):
            force = part.forces(at.position, gaps)
            out += force[:count]
            if part.unknown >= 0:
                bodies[self.bodies.names.index(part.name)] += force[count:].sum(axis=0)
        return out, bodies

    def energy(self, at: Contacts, springs: Array) -> float:
        """Scaled energy of penetration and springs; friction stores none."""
        stored = sum(part.energy(gaps) for part, gaps in zip(self.parts, at.gaps, strict=True))
        return float(stored + 0.5 * (self.bodies.springs[:, None] * springs**2).sum())

    def prepare(self, layout: Layout, at: Contacts) -> None:
        """Extend the sparsity pattern of the tangent by the degrees of freedom that contact couples."""
        offset, needed = 0, []
        for part, gaps in zip(self.parts, at.gaps, strict=True):
            needed.append(part.keys(gaps) + offset)
            offset += part.key_count
        if layout.covers(np.concatenate([np.zeros(0, dtype=np.int64), *needed])):
            return
        offset, ready, unknowns = 0, [], []
        for part, gaps in zip(self.parts, at.gaps, strict=True):
            keys = part.ready_keys(gaps)
            ready.append(keys + offset)
            unknowns.append(part.tied_unknowns(keys))
            offset += part.key_count
        layout.renew(np.concatenate(ready), unknowns)

    def add_tangents(self, data: Array, layout: Layout, at: Contacts) -> None:
        """Add all tangents to the lower triangle."""
        for part, gaps in zip(self.parts, at.gaps, strict=True):
            for ties in part.tangents(at.position, gaps):
                ties.add_to(data, layout.pattern)
        for k, unknown in enumerate(self.bodies.unknowns):
            data[layout.pattern.diagonal[unknown : unknown + 3]] += self.bodies.springs[k]

    def shortening(self, old: Contacts, new: Contacts) -> float:
        """Share of the way from old to new after which no penetration has deepened too much; 1 if none has."""
        share = 1.0
        for part, before, after in zip(self.parts, old.gaps, new.gaps, strict=True):
            deeper = PENALTY.deeper * part.surface.height[:, None]
            start = before.pressed
            allowed = np.minimum(start, 0.0) - deeper
            gap = np.minimum(after.pressed, part.passed(new.position, before, after))
            bad = gap < allowed - (PENALTY.margin - 1) * deeper
            known = bad & np.isfinite(start)
            way = (start[known] - allowed[known]) / (start[known] - gap[known])
            share = min(share, float(way.min(initial=1.0)), 1.0 if known.sum() == bad.sum() else PENALTY.unseen)
        return max(share, PENALTY.shortest)

    def rubbing(self, at: Contacts, size: int) -> sp.csc_matrix | None:
        """The unsymmetric part of the tangent (size, size), of friction and of rims that pass points; None without."""
        pairs = zip(self.parts, at.gaps, strict=True)
        parts = [each(at.position, gaps) for part, gaps in pairs for each in (part.rubbing, part.fading)]
        matrices = [
            _entries(each.pulled, each.pull, size).T @ _entries(each.pressed, each.change, size)
            for each in parts
            if each is not None
        ]
        return sum(matrices[1:], matrices[0]).tocsc() if matrices else None

    def settled(self, at: Contacts) -> tuple[Friction, bool]:
        """The friction history with the present limits, and whether any differs noticeably from that before."""
        each = [part.settled(gaps) for part, gaps in zip(self.parts, at.gaps, strict=True)]
        return tuple(friction for friction, _ in each), any(changed for _, changed in each)

    def remembered(self, at: Contacts) -> Friction:
        """The friction history of a converged state, from which points slip in the next step; empty where none do."""
        if not any(part.coefficient > 0 for part in self.parts):
            return ()
        pairs = zip(self.parts, at.gaps, strict=True)
        return tuple(part.anchored(at.position, gaps) if part.coefficient > 0 else None for part, gaps in pairs)

    def share_of_tolerance(self, part: Part, gaps: Gaps) -> float:
        """Penetration as a share of what the tolerance allows, at the worst place."""
        return float(self._shares(part, gaps).max(initial=0.0))

    def _shares(self, part: Part, gaps: Gaps) -> Array:
        """Deepest penetration of each side (s,) as a share of what the tolerance allows there."""
        return np.asarray(np.maximum(-gaps.pressed.min(axis=1), 0.0) / (self._tolerance * part.surface.height))

    def stiffen(self, at: Contacts) -> bool:
        """Raise the penalty of sides that are penetrated beyond the tolerance; return whether any could be raised."""
        raised = False
        for part, gaps in zip(self.parts, at.gaps, strict=True):
            depth = self._shares(part, gaps)
            factor = np.clip(1.2 * depth, 1.0, PENALTY.stiffer_at_once)
            scale = np.where(depth > 1, np.minimum(part.penalty_scale * factor, PENALTY.stiffer), part.penalty_scale)
            raised |= bool((scale > part.penalty_scale).any())
            part.penalty_scale = scale
        return raised


def _entries(unknowns: Ints, values: Array, size: int) -> sp.csr_matrix:
    """A row for each point, with values (k, m) at its unknowns, −1 for none."""
    rows, columns = np.nonzero(unknowns >= 0)
    places = (rows, unknowns[rows, columns])
    return sp.csr_matrix((values[rows, columns], places), shape=(len(unknowns), size))
