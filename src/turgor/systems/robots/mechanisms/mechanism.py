"""Mechanism: arms of segments in series, and grippers of several arms around an object, as chains of rigid links."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from turgor.core.model.obstacles.rigid_shape import RigidShape
from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved, TurgorError, unknown
from turgor.systems.robots.backbone import Array
from turgor.systems.robots.chains.chain import SLIDE, TURN_Y, TURN_Z, Chain, Placed

#: Standard gravity downward.
DOWN = (0.0, 0.0, -9.80665)

#: A coordinate that a segment lacks is this much stiffer than its stiffest one of the same kind, or than this
#: stiffness [N m, N].
LOCKED, STIFF = 1e3, {TURN_Y: 10.0, TURN_Z: 10.0, SLIDE: 1e5}

#: Points on the line of a capsule that an object can touch, and the parts in which pressures rise.
TOUCHED, PARTS = 4, 12


@dataclass(frozen=True, kw_only=True, eq=False)
class Segment(Shown):
    """An actuator of an arm.

    Parameters
    ----------
    chain : Chain
        ``chain_of(reduced).chain``.
    pressures : mapping of str to float [Pa]
        By the names of the chain, or the only one for all.
    roll : float [rad]
        Turn about its axis against the segment before.
    """

    chain: Chain
    pressures: Mapping[str, float]
    roll: float = 0.0

    @property
    def values(self) -> Array:
        """Pressures (p,) in the order of the chain."""
        for name in self.pressures:
            if name not in self.chain.names:
                raise unknown("pressure of a segment", name, self.chain.names)
        out = np.array([float(self.pressures.get(name, 0.0)) for name in self.chain.names])
        for name, value, low, high in zip(self.chain.names, out, self.chain.low, self.chain.high, strict=True):
            if not low - 1e-9 * high <= value <= high * (1 + 1e-9):
                raise TurgorError(
                    f"the pressure '{name}' of a segment is {value / 1e3:.6g} kPa; its chain was fitted from "
                    f"{low / 1e3:.6g} to {high / 1e3:.6g} kPa."
                )
        return out


@dataclass(frozen=True, kw_only=True, eq=False)
class Arm(Shown):
    """Segments in series: each is fixed to the tip of the one before.

    Parameters
    ----------
    segments : sequence of Segment
    name : str
    position : (3,) floats [m]
        Of the base.
    turn : (3,) floats [rad]
        Turns of the base about x, then y, then z of space; without, the arm leaves the base along x.

    Examples
    --------
    >>> Arm(segments=[], name="hand")
    Traceback (most recent call last):
    turgor.TurgorError: the arm 'hand' has no segment; it needs one.
    """

    segments: Sequence[Segment]
    name: str = "arm"
    position: Sequence[float] = (0.0, 0.0, 0.0)
    turn: Sequence[float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        if not self.segments:
            raise TurgorError(f"the arm '{self.name}' has no segment; it needs one.")

    @cached_property
    def chain(self) -> Chain:
        """All links as one chain, without weight."""
        kinds = tuple(kind for kind in (TURN_Y, TURN_Z, SLIDE) if any(kind in s.chain.kinds for s in self.segments))
        chains = [with_kinds(segment.chain, kinds) for segment in self.segments]
        pivots, rolls, end = [], [], np.array(self.position, dtype=np.float64)
        turn = Rotation.from_euler("xyz", np.array(self.turn, dtype=np.float64)).as_matrix()
        for segment, chain in zip(self.segments, chains, strict=True):
            turn = turn @ Rotation.from_rotvec([segment.roll, 0, 0]).as_matrix()
            pivots += [end + turn @ (chain.pivots[0] - chain.base), *chain.pivots[1:]]  # end faces meet
            rolls += [turn, *np.tile(np.eye(3), (chain.links - 1, 1, 1))]
            end, turn = chain.end, np.eye(3)
        gains = np.zeros((sum(len(c.names) for c in chains), sum(len(c.springs) for c in chains)))
        row = column = 0
        for chain in chains:
            gains[row : row + len(chain.names), column : column + len(chain.springs)] = chain.gains
            row, column = row + len(chain.names), column + len(chain.springs)
        names = [f"segment_{k + 1}.{name}" for k, c in enumerate(chains) for name in c.names]
        joined = {
            key: np.concatenate([getattr(c, key) for c in chains])
            for key in ("springs", "growth", "masses", "centers", "inertias", "limits", "capsules", "high", "low")
        }
        return Chain(
            base=np.array(self.position, dtype=np.float64), pivots=np.array(pivots), end=end, kinds=kinds, gains=gains,
            gravity=np.zeros(3), names=tuple(names), rolls=np.array(rolls), **joined,
        )  # fmt: skip


def with_kinds(chain: Chain, kinds: tuple[int, ...]) -> Chain:
    """A chain with more coordinates at each joint, which are almost rigid."""
    if chain.kinds == kinds:
        return chain
    many, places = len(kinds), [kinds.index(kind) for kind in chain.kinds]
    at = (np.arange(chain.links)[:, None] * many + np.array(places)).ravel()
    springs, limits = np.zeros((chain.links * many, 3)), np.zeros((chain.links * many, 2))
    for place, kind in enumerate(kinds):
        same = chain.springs[chain.slides == (kind == SLIDE), 0]
        springs[place::many, 0] = max(STIFF[kind], LOCKED * float(same.max(initial=0.0)))
        limits[place::many] = [-0.01, 0.01]
    gains = np.zeros((len(chain.names), len(springs)))
    springs[at], limits[at], gains[:, at] = chain.springs, chain.limits, chain.gains
    return replace(chain, kinds=kinds, springs=springs, limits=limits, gains=gains)


@dataclass(frozen=True, slots=True, eq=False)
class Touching:
    """Contact of a chain with a rigid object without friction, by a penalty.

    Parameters
    ----------
    shape : RigidShape
    stiffness : float [N/m]
        Of a point of a capsule.
    """

    shape: RigidShape
    stiffness: float

    def pushed(self, chain: Chain, at: Placed) -> tuple[Array, Array]:
        """Points (k, 3) [m] of the lines of the capsules, link by link, and the forces (k, 3) [N] of the object."""
        shares = np.linspace(0.0, 1.0, TOUCHED)[:, None]
        lines = [
            first + shares * (last - first)
            for first, last in zip(chain.capsules[:, :3], chain.capsules[:, 3:6], strict=True)
        ]
        points = np.concatenate([o + line @ turn.T for o, line, turn in zip(at.origins, lines, at.turns, strict=True)])
        distance, normal, _ = self.shape.signed_distance(points)
        depth = np.maximum(np.repeat(chain.capsules[:, 6], TOUCHED) - distance, 0.0)
        return points, self.stiffness * depth[:, None] * normal

    def depth(self, chain: Chain, at: Placed) -> float:
        """Largest depth [m] of a point of a capsule in the object."""
        return float(np.linalg.norm(self.pushed(chain, at)[1], axis=1).max()) / self.stiffness

    def forces(self, chain: Chain, at: Placed) -> Array:
        """Generalized forces (d,)."""
        out = np.zeros(len(chain.springs))
        points, forces = self.pushed(chain, at)
        for k in np.flatnonzero(forces.any(axis=1)):
            out += chain.work(at, int(k) // TOUCHED, points[k], forces[k])
        return out


@dataclass(frozen=True, eq=False)
class ArmState(Shown):
    """Equilibrium of an arm.

    Parameters
    ----------
    name : str
    chain : Chain
    x : (d,) array
        Coordinates.
    placed : Placed
    tip : (3,) array [m]
    turn : (3, 3) array
        Rotation of the tip.
    force : (3,) array [N]
        On the object.
    depth : float [m]
        How far a capsule is inside of the object, which the penalty allows.
    """

    name: str
    chain: Chain
    x: Array
    placed: Placed
    tip: Array
    turn: Array
    force: Array
    depth: float

    @property
    def line(self) -> Array:
        """Base, lines of the capsules and tip (2 n + 2, 3) [m]."""
        lines = np.einsum("nab,nkb->nka", self.placed.turns, self.chain.capsules[:, :6].reshape(-1, 2, 3))
        return np.vstack([self.chain.base, (self.placed.origins[:, None] + lines).reshape(-1, 3), self.tip])


@dataclass(frozen=True, kw_only=True, eq=False)
class Mechanism(Shown):
    """Arms, and an object that they may touch, which does not move.

    Parameters
    ----------
    arms : sequence of Arm
    object : RigidShape, optional
        As `turgor.obstacles` has them.
    gravity : (3,) floats [m/s²]
    contact_stiffness : float [N/m]
        Force by the depth of a point of a capsule in the object.
    """

    arms: Sequence[Arm]
    object: RigidShape | None = None
    gravity: Sequence[float] = DOWN
    contact_stiffness: float = 500.0

    def __post_init__(self) -> None:
        names = [arm.name for arm in self.arms]
        if not names or len(set(names)) < len(names):
            raise TurgorError(f"a mechanism needs arms with names of their own; given: {', '.join(names) or 'none'}.")
        if not 1 <= self.contact_stiffness <= 1e6:
            raise TurgorError(f"contact_stiffness is {self.contact_stiffness:g} N/m; allowed is 1 to 1e6 N/m.")

    def solve(self) -> dict[str, ArmState]:
        """Find the equilibrium of each arm, by its name; pressures rise in parts.

        Raises
        ------
        NotSolved
            If an arm has none.
        """
        return {arm.name: self._solved(arm) for arm in self.arms}

    def _solved(self, arm: Arm) -> ArmState:
        chain = replace(arm.chain, gravity=np.array(self.gravity, dtype=np.float64))
        touching = None if self.object is None else Touching(self.object, self.contact_stiffness)
        pressures, x = np.concatenate([segment.values for segment in arm.segments]), np.zeros(len(chain.springs))
        inside = 0.0 if touching is None else touching.depth(chain, chain.placed(x))
        if inside > 0:
            raise TurgorError(
                f"the arm '{arm.name}' is {inside * 1e3:.3g} mm inside of the object at rest; place one of them "
                "elsewhere."
            )
        try:
            for share in np.arange(PARTS + 1) / PARTS:
                x = chain.equilibrium(share * pressures, x, touching)
        except NotSolved as error:
            raise NotSolved(f"arm '{arm.name}': {error}") from None
        at = chain.placed(x)
        force = np.zeros(3) if touching is None else -touching.pushed(chain, at)[1].sum(axis=0)
        depth = 0.0 if touching is None else touching.depth(chain, at)
        return ArmState(arm.name, chain, x, at, chain.tip(at), at.turns[-1], force, depth)
