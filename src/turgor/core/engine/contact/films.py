"""Films without a solid: both of their sides, and which of these may touch.

A film is thinner than what a penalty resolves, so that a point a little off it could be on either side. Which sides
of two films may touch is therefore decided at rest: those that look at each other there. Two films of one body that
do not see each other at rest, such as the layers of a fold, touch with the sides that look out of the cavity.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.contact.closest import centers_of, points_of
from turgor.core.engine.contact.settings import CONTACT_SEARCH, PENALTY
from turgor.core.engine.contact.surface import Surface, listed, neighbors, of_face
from turgor.core.materials.laws.laws import Hooke
from turgor.core.meshing.bodies.bodies import find_bodies
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

#: Sides that are compared with all others at a time, which bounds the memory.
_BLOCK = 256


def film_surface(model: Model, points: Array, stress: float) -> Surface:
    """Collect both sides of films without a solid, those that look into a cavity first.

    Against contact a film is half as stiff as in its plane: Young's modulus times thickness over the square of an edge.

    Parameters
    ----------
    model : Model
    points : (n, 3) array
        Scaled reference positions.
    stress : float [Pa]
        Scale of stresses.
    """
    mesh = model.mesh
    sides = np.concatenate([mesh.film_sides, mesh.film_sides[:, turned_over(mesh.film_sides.shape[1])]])
    r = side_tables(sides.shape[1])
    _, _, growth = points_of(points, sides, r.N, r.dN)
    weights = growth * r.weights
    height = np.sqrt(weights.sum(axis=1))
    out = Surface(sides, r.N, r.dN, weights, np.zeros(len(sides)), height)
    unit = float(np.linalg.norm(np.ptp(mesh.points, axis=0)) / np.linalg.norm(np.ptp(points, axis=0)))
    for name, sheet in model.membranes.items():
        assert isinstance(sheet.material.law, Hooke)
        own = of_face(mesh, out, name)
        out.spring[own] = PENALTY.films * sheet.material.law.E * sheet.thickness / (stress * unit)
    outward = np.arange(len(sides)) >= len(mesh.film_sides)
    return replace(out, spring=out.spring / height**2, outward=outward)


def turned_over(nodes: int) -> Ints:
    """Order of the nodes of a side as seen from behind."""
    orders = {6: (0, 2, 1, 5, 4, 3), 9: (0, 3, 2, 1, 7, 6, 5, 4, 8)}
    return np.array(orders[nodes])


@dataclass(frozen=True, slots=True, eq=False)
class _Rows:
    """Films i against films j in rows (k,), and what is true of them at rest.

    Parameters
    ----------
    i, j : (k,) int array
    distance : (k,) array
        Of their centers.
    over, under : (k,) array
        Height of j over i along the normal of i, and of i over j along that of j. Normals look into cavities.
    facing : (k,) array
        Cosine between the normals.
    joined : (k,) bool array
        Whether they share a corner.
    same, closed : (k,) bool array
        Whether they belong to one body, and one of them to the skin of a cavity of it.
    tolerance : float
        Height that is zero.
    """

    i: Ints
    j: Ints
    distance: Array
    over: Array
    under: Array
    facing: Array
    joined: Bools
    same: Bools
    closed: Bools
    tolerance: float

    def see(self, turned: tuple[float, float]) -> Bools:
        """Whether two sides look at each other; ``turned`` are 1 for the side along the normal, −1 for the other."""
        over, under, cosine = turned[0] * self.over, turned[1] * self.under, turned[0] * turned[1] * self.facing
        ahead = np.minimum(over, under)
        level = np.where(self.same, -self.tolerance, self.tolerance)
        groove = ahead > CONTACT_SEARCH.above * self.distance
        flat = (ahead > level) & (cosine < np.where(self.joined, -CONTACT_SEARCH.smooth, CONTACT_SEARCH.facing))
        return groove | flat

    def chosen(self, which: Bools) -> "_Rows":
        """Return some of the pairs."""
        names = ("i", "j", "distance", "over", "under", "facing", "joined", "same", "closed")
        return replace(self, **{name: getattr(self, name)[which] for name in names})


def film_exceptions(mesh: Mesh, surface: Surface, points: Array) -> tuple[Ints, Ints]:
    """List for each side (start, list) those which it touches although one looks into a cavity, or never touches.

    Parameters
    ----------
    mesh : Mesh
    surface : Surface
        Both sides of the films, those that look into a cavity first.
    points : (n, 3) array
        Scaled reference positions.

    Raises
    ------
    TurgorError
        If two films lie on each other at rest and do not have a cavity between them.
    """
    count = len(surface.sides) // 2
    sides, reach = surface.sides[:count], CONTACT_SEARCH.reach * float(surface.height.mean())
    center, _, normal = centers_of(points, sides, surface.corners)
    label, skin = np.empty(count, dtype=np.int64), of_face(mesh, surface, *mesh.cavities)[:count]
    for number, body in enumerate(find_bodies(mesh)):
        label[body.cells] = number
    a, b = neighbors(sides, surface.corners)
    joined = np.sort(a * count + b)
    rows: list[Ints] = []
    for start in range(0, count, _BLOCK):
        block = _compared(np.arange(start, min(start + _BLOCK, count)), center, normal, (joined, label, skin), reach)
        _check_apart(mesh, block, float(surface.height.min()))
        rows.append(_exceptions(block, count))
    keys = _different(np.concatenate(rows))
    row, column = np.divmod(keys, 2 * count)
    row, column = np.divmod(_different(np.concatenate([keys, column * 2 * count + row])), 2 * count)
    return listed(row, column, 2 * count)


def _different(keys: Ints) -> Ints:
    """Sorted different keys; NumPy's table of them takes five times as long where most are different."""
    out = np.sort(keys)
    return np.asarray(out[np.append(True, out[1:] != out[:-1])]) if len(out) else out


def _compared(block: Ints, center: Array, normal: Array, known: tuple[Ints, Ints, Bools], reach: float) -> _Rows:
    """Films of a block against all that are close: within reach, or about as far as what is seen across a cavity."""
    joined, label, skin = known
    count = len(center)
    i, j = (each.ravel() for each in np.meshgrid(block, np.arange(count), indexing="ij"))
    apart = center[j] - center[i]
    every = _Rows(
        i,
        j,
        np.linalg.norm(apart, axis=1),
        np.einsum("ki,ki->k", apart, normal[i]),
        -np.einsum("ki,ki->k", apart, normal[j]),
        np.einsum("ki,ki->k", normal[i], normal[j]),
        np.isin(i * count + j, joined),
        label[i] == label[j],
        (label[i] == label[j]) & (skin[i] | skin[j]),
        ROUND_OFF.mesh_digits * float(np.ptp(center, axis=0).max()),
    )
    across = np.where(every.see((1, 1)) & ~every.joined, every.distance, np.inf).reshape(len(block), count).min(axis=1)
    limit = reach + 2 * np.where(np.isfinite(across), across, 0.0)
    return every.chosen((every.i != every.j) & (every.distance < np.repeat(limit, count)))


def _exceptions(rows: _Rows, count: int) -> Ints:
    """Keys of the pairs of sides that are exceptions, of 2 ``count`` sides."""
    inner, outer = rows.see((1, 1)), rows.see((-1, -1))
    here, there = rows.see((1, -1)), rows.see((-1, 1))
    mixed = (here != there) & ~inner & ~outer  # both: the films continue each other
    never = inner | ((rows.joined | mixed) & ~outer)
    here, there = here & mixed & ~rows.closed, there & mixed & ~rows.closed  # within a skin is never outside of it
    pairs = (
        (rows.i[inner], rows.j[inner]),
        (rows.i[never] + count, rows.j[never] + count),
        (rows.i[here], rows.j[here] + count),
        (rows.i[there] + count, rows.j[there]),
    )
    return np.concatenate([i * 2 * count + j for i, j in pairs])


def _check_apart(mesh: Mesh, rows: _Rows, size: float) -> None:
    """Refuse films that lie on each other and could be on either side: of two bodies, or with one normal."""
    on = (rows.distance < CONTACT_SEARCH.above * size) & (np.maximum(abs(rows.over), abs(rows.under)) < rows.tolerance)
    wrong = np.flatnonzero(on & (~rows.same | (rows.facing > 0)))
    if len(wrong):
        place = mesh.points[mesh.film_sides[rows.i[wrong[0]]]].mean(axis=0) * 1e3
        raise TurgorError(
            f"'{mesh.name}': films lie on each other at ({place[0]:.4g}, {place[1]:.4g}, {place[2]:.4g}) mm at rest "
            "with no cavity between them, so that nothing says which side of one the other is on; move one away by a "
            "little, such as its thickness, or switch self-contact off."
        )
