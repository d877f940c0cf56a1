"""Settings of contact: every number that was chosen, with its reason and the cases that need it.

Lengths are shares of a length of the mesh, as stated. The cases are twelve of `benchmarks/robustness` whose walls or
obstacles touch; iterations are compared with one number changed. Numbers of the compiled loops are in `search` and
`closest`.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ContactSearchSettings:
    """Settings of the search for partners.

    Parameters
    ----------
    reach : float
        Sides closer than this many of their mean lengths are candidates for contact. With half of it no case changes;
        with a quarter "walls meet in a gap" and "walls meet, one step" do not reach their load.
    near : float
        Points nearer than this share of the cell behind them may touch in the next step. The tangent has room for
        them, and they have a friction history, or a contact that moves over them within a step would have no friction
        there. A point lies inside a rigid body no deeper than this share of a mean length.
    depth : float
        A point is taken to lie inside a side no deeper than this share of the cell behind it. Beyond the whole cell the
        far face of a thin wall would be a neighbor.
    behind : float
        The same for a film, over the penetration that the tolerance allows: what lies further behind is on its other
        side. A converged state has no deeper point.
    above : float
        Two sides with a common node face each other where each lies above the other by this share of their distance.
    facing : float
        Two films face each other at rest where the cosine between their sides is below this, as 72° and more.
    walk : int
        A foot point may cross so many sides between two searches.
    overhang : float
        Foot points may lie this far beyond an edge that joins two sides smoothly, whose kink leaves wedges in front of
        it; beyond a sharp edge there is nothing. No case changes with 0.06. With 0.02, as far as a point keeps its
        partner, a block under a flat side of 98 triangles is off by 5e-4.
    rim : float
        A sharp rim passes a point within this length on both sides of it, over the length of the side of the point, and
        its pressure fades meanwhile. Just less than from the edge of a side to its outermost point (0.113 in a square,
        0.12 in a triangle), so that bodies whose rims meet press with their whole surface. Without it, a plate whose
        rim slides off a block takes 2,980 iterations instead of 29.
    inner_rim : float
        The same for a rim of the body itself, within it, over the length of the side of the point, and no more than the
        point lies within a rim of its own surface: so of two edges that lie on each other both press.
    beyond : float
        That length at most, as a share of the side of the rim: beyond it, foot points on curved sides are in doubt.
    smooth : float
        Cosine between the normals of two sides that join smoothly: below 37°. No case changes with 18° or 66°, as edges
        of actuators are either rounded or sharp.
    nearer : float
        In a global search, a partner is replaced by one that is nearer by this share of the cell behind it. Without
        it, "walls meet, one pressed" takes 119 iterations instead of 92.
    most_triangles : int
        Triangles of a rigid body at most: more do not fit into the memory.
    most_cubes : int
        Cubes of the grid at most, so that a small reach in a large room does not need gigabytes.
    """

    reach: float = 4.0
    near: float = 0.5
    depth: float = 0.25
    behind: float = 2.0
    above: float = 0.1
    facing: float = 0.3
    walk: int = 4
    overhang: float = 0.03
    rim: float = 0.11
    inner_rim: float = 0.25
    beyond: float = 0.3
    smooth: float = 0.8
    nearer: float = 1e-3
    most_triangles: int = 500_000
    most_cubes: int = 400_000


CONTACT_SEARCH = ContactSearchSettings()


@dataclass(frozen=True, slots=True)
class PenaltySettings:
    """Settings of the penalty.

    Parameters
    ----------
    stiffness : float
        Contact stiffness times the height of the cell behind, over Young's modulus at rest. All cases change with it.
    films : float
        The same of films, over Young's modulus times thickness over the height. Films press with the pressure of air,
        which is small compared with their stiffness. With 20, a folded beam does not unfold.
    stiffer_at_once, stiffer : float
        The stiffness of a side grows by the first factor at once at most, and by the second altogether. Without the
        first, "plate that drags" takes 158 iterations instead of 213; no case needs the second.
    deeper : float
        One update of Newton's method deepens no penetration by more than this share of the cell behind the surface.
        Ten of the cases change with twice as much, two of them by a third fewer iterations.
    margin : float
        An update is shortened only if it would deepen a penetration by this factor more. Without it, "walls meet, one
        step" takes 44 iterations instead of 26, and "walls meet, one pressed" 99 instead of 92.
    unseen : float
        Share of an update that is taken if a point without partner would be deep inside a body after it.
    shortest : float
        The shortest share of an update that the limit on penetration requires at once. With 0.01, "walls meet, one
        pressed" takes 101 iterations instead of 92.
    """

    stiffness: float = 20.0
    films: float = 0.5
    stiffer_at_once: float = 4.0
    stiffer: float = 64.0
    deeper: float = 0.04
    margin: float = 1.5
    unseen: float = 0.5
    shortest: float = 0.1


PENALTY = PenaltySettings()


@dataclass(frozen=True, slots=True)
class FrictionSettings:
    """Settings of friction.

    Parameters
    ----------
    elastic_slip : float
        A sticking point slips elastically by this share of the length of a side before it slides, unless a length is
        stated, whatever the pressure; so the tangential stiffness is in proportion to the pressure. The cases "plate
        that sticks" and "plate that drags" change with it.
    settled : float
        Saved limits are valid if none changes by more than this share of the largest.
    sticks : float
        A point sticks while its traction is below this share of the limit.
    """

    elastic_slip: float = 0.005
    settled: float = 1e-4
    sticks: float = 0.999


FRICTION = FrictionSettings()
