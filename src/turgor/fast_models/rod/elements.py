"""Elements of a rod: forces at the two ends and their tangent, for all elements at once.

An element sees only the twist between its ends, so that it feels no rigid motion, however large. Its strain is this
twist over its length. The internal force is an unknown of the element besides (Hellinger–Reissner): Newton's method
then takes far larger steps. The force varies along the element as equilibrium wants it (dF/ds = ad(ε)ᵀ F), which adds a
term of second order in the length to the compliance, and makes the error one of fourth order.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.rod.frames import commutator, even_sums, logarithm, wrench_matrix

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ElementForces:
    """Contributions of the elements to one iteration of Newton's method.

    Parameters
    ----------
    strain : (e, 6) array
        Twist between the ends over the length.
    first, second : (e, 6) array
        Wrenches on the two ends, in their frames.
    blocks : (e, 2, 2, 6, 6) array
        Tangent: wrench on an end by the motion of an end.
    gap : (e, 6) array
        By how much strain and force miss the law.
    compliance_inverse, coupling, to_strain : arrays
        What `new_force` needs.
    """

    strain: Array
    first: Array
    second: Array
    blocks: Array
    gap: Array
    compliance_inverse: Array
    coupling: Array
    to_strain: tuple[Array, Array]

    def new_force(self, first: Array, second: Array) -> Array:
        """Return by how much the internal forces change (e, 6) when the ends move by twists (e, 6)."""
        ahead, back = self.to_strain
        change = _times(ahead, second) - _times(back, first)
        return _times(self.compliance_inverse, self.gap + _times(self.coupling, change))


@dataclass(frozen=True, slots=True, eq=False)
class Law:
    """Linear elasticity of the elements at one load factor.

    Parameters
    ----------
    length : (e,) array [m]
    compliance : (e, 6, 6) array
        Strain by force.
    rest : (e, 6) array
        Strain without force, the stretch of 1 included.
    """

    length: Array
    compliance: Array
    rest: Array


def element_forces(law: Law, turn: Array, shift: Array, force: Array) -> ElementForces:
    """Return the forces of elements whose second end stands at (turn, shift) in the frame of the first.

    Parameters
    ----------
    law : Law
    turn : (e, 3, 3) array
    shift : (e, 3) array [m]
    force : (e, 6) array
        Internal forces and moments at the middle, of the last update.

    Raises
    ------
    TurgorError
        If an element turns too far.
    """
    twist = logarithm(turn, shift)
    strain = twist / law.length[:, None]
    ad = commutator(twist)
    sums = even_sums(np.einsum("ei,ei->e", twist[:, 3:], twist[:, 3:]))
    square = ad @ ad
    even = np.eye(6) + sums[:, 0, None, None] * square + sums[:, 1, None, None] * (square @ square)
    ahead, back = even + 0.5 * ad, even - 0.5 * ad
    gap, inverse, coupling, internal, wrench, stiffness = _condensed(law, strain, force)
    odd, common = _map_slopes(np.swapaxes(ad, 1, 2), twist, internal, sums)
    by_second = np.swapaxes(ahead, 1, 2) @ stiffness + common + odd
    by_first = np.swapaxes(back, 1, 2) @ stiffness + common - odd
    blocks = np.empty((len(twist), 2, 2, 6, 6))
    blocks[:, 0, 0], blocks[:, 0, 1] = by_first @ back, -by_first @ ahead
    blocks[:, 1, 0], blocks[:, 1, 1] = -by_second @ back, by_second @ ahead
    return ElementForces(
        strain=strain,
        first=-_times(np.swapaxes(back, 1, 2), wrench),
        second=_times(np.swapaxes(ahead, 1, 2), wrench),
        blocks=blocks,
        gap=gap,
        compliance_inverse=inverse,
        coupling=coupling / law.length[:, None, None],
        to_strain=(ahead, back),
    )


def stored_energy(law: Law, strain: Array, force: Array, wall_force: Array) -> Array:
    """Return the strain energy of elements, (e,) [J]; only net forces vary along an element."""
    slope = _times(np.swapaxes(commutator(strain), 1, 2), force)
    even = np.einsum("ei,eij,ej->e", wall_force, law.compliance, wall_force)
    uneven = np.einsum("ei,eij,ej->e", slope, law.compliance, slope)
    return law.length * (0.5 * even + law.length**2 / 24 * uneven)


def _condensed(law: Law, strain: Array, force: Array) -> tuple[Array, ...]:
    """Return gap, inverse compliance, coupling, wrenches and stiffness (by the twist) without the internal force.

    The first wrench is that of the internal force as it is, by which geometric stiffness counts; the second one closes
    the gap, which is how the residual counts it.
    """
    share = (law.length**2 / 12)[:, None, None]
    slopes = np.swapaxes(commutator(strain), 1, 2)
    turned = wrench_matrix(force)
    turned_compliance = np.swapaxes(turned, 1, 2) @ law.compliance
    weighted = share * turned_compliance @ turned
    effective = law.compliance + share * np.swapaxes(slopes, 1, 2) @ law.compliance @ slopes
    lagging = _times(law.compliance, _times(turned, strain))
    coupling = np.eye(6) - share * (turned_compliance @ slopes - np.swapaxes(commutator(lagging), 1, 2))
    gap = strain - law.rest - _times(effective, force)
    inverse = np.asarray(np.linalg.inv(effective), dtype=np.float64)
    through = coupling @ inverse
    internal = force - _times(weighted, strain)
    wrench = internal + _times(through, gap)
    stiffness = (through @ np.swapaxes(coupling, 1, 2) - weighted) / law.length[:, None, None]
    return gap, inverse, np.swapaxes(coupling, 1, 2), internal, wrench, stiffness


def _map_slopes(lowered: Array, twist: Array, wrench: Array, sums: Array) -> tuple[Array, Array]:
    """Return how the maps from the twist to the ends change with the twist, times the wrench: odd and even part."""
    powers, slopes = [wrench], [np.zeros_like(lowered)]
    for _ in range(4):
        slopes.append(lowered @ slopes[-1] + wrench_matrix(powers[-1]))
        powers.append(_times(lowered, powers[-1]))
    even = sums[:, 0, None, None] * slopes[2] + sums[:, 1, None, None] * slopes[4]
    by_angle = 2 * (sums[:, 2, None] * powers[2] + sums[:, 3, None] * powers[4])
    even[:, :, 3:] += by_angle[:, :, None] * twist[:, None, 3:]
    return 0.5 * slopes[1], even


def _times(matrices: Array, vectors: Array) -> Array:
    return (matrices @ vectors[..., None])[..., 0]
