"""Causes: why a path may have ended where it did, from its last state, with advice that fits.

A path ends for one of a few reasons that look alike to Newton's method: the law turns over, a film wrinkles, a wall
balloons, or the load is far beyond what rubber bears. Each leaves its mark in the last state.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.bonds.bond_results import bond_results
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.fields import elastic_gradients
from turgor.core.engine.percentiles import weighted_percentile
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.laws.stability import Mode, first_instability
from turgor.core.materials.material import Material
from turgor.core.solvers.checks.membranes import Compression, bears_compression
from turgor.core.solvers.checks.settings import CAUSES, REPORTS
from turgor.core.solvers.pressures import pressures_of
from turgor.core.solvers.solution import State

Array = NDArray[np.float64]

#: Tests, and the ratio of the second to the first logarithmic stretch of deformations that resemble each.
TESTS: tuple[tuple[Mode, float, float], ...] = (
    ("uniaxial", -np.inf, -0.25),
    ("planar", -0.25, 0.5),
    ("equibiaxial", 0.5, np.inf),
)


@dataclass(frozen=True, slots=True)
class Why:
    """One sentence about the cause, with a space before it, and one of advice."""

    message: str
    advice: str


def cause_text(why: Why | None) -> str:
    """Return the sentence of a cause; nothing where none was found."""
    return "" if why is None else why.message


def cause_in(state: State) -> Why | None:
    """Find the cause that a state shows by itself: a bond, a law that turns over, a wrinkled film, too much load."""
    return softened_bond(state) or turned_law(state) or wrinkled_film(state) or overload(state)


def softened_bond(state: State) -> Why | None:
    """Say which bond is damaged, so that it bears less the more it opens."""
    for bond in bond_results(state.model, state.displacement, state.memory).values():
        use = float(np.where(bond.bonded, bond.use, 0.0).max())
        if use > CAUSES.bond or bond.mean_damage > 0:
            return Why(
                f" The bond '{bond.name}' is at its strength (mean damage {bond.mean_damage:.2g}): it bears less the "
                "more it opens.",
                "That is where it fails under this load. To go on, prescribe the volume of the cavity or a motion, "
                "follow the path by its length (ArcLength), or let it jump (Stabilized); T05 says whether elements are "
                "too long for it.",
            )
    return None


def turned_law(state: State) -> Why | None:
    """Say which law has an extreme of its stress at stretches that were reached, be it in a few cells only."""
    model = state.model
    gradients, weight = elastic_gradients(model, state.displacement, state.load_factor)
    for name, material in model.region_materials.items():
        cells = model.mesh.regions[name]
        turn = _turn(material, _principal_stretches(gradients[cells]), weight[cells].ravel())
        if turn is not None:
            mode, limit, share = turn
            return Why(
                f" The law of '{material.name}' turns over at stretch {limit:.3g} in {mode} tension, and "
                f"{100 * share:.2g} % of '{name}' is stretched as far: beyond it the stress falls while the rubber "
                "stretches.",
                "Stay below this stretch, or take a law that is stable there (M06): fit again with a stability "
                "constraint, or choose another record. A finer mesh does not help.",
            )
    return None


def wrinkled_film(state: State) -> Why | None:
    """Say which membrane is compressed so much that it must wrinkle on its rubber."""
    for name in bears_compression(state.model):
        compression = Compression.of(state, name)
        if compression.wrinkled > REPORTS.notable_share:
            return Why(
                f" The film on '{name}' is compressed in {100 * compression.wrinkled:.0f} % of its area, by up to "
                f"{compression.largest:.3g} N/m; it has no bending stiffness and wrinkles there.",
                f"Let '{name}' bend as a sheet does: make it a shell. A film that wrinkles bears hardly any "
                "compression: let it bear none (compression = 0).",
            )
    return None


def balloon(states: Sequence[State]) -> Why | None:
    """Say that a wall thins faster than its rubber stiffens: the limit point of a balloon."""
    last = states[-1]
    model = last.model
    if not len(model.mesh.cells):
        return None  # a film that does not stretch; a flat cavity has no volume at rest
    driven = [name for name, pressure in pressures_of(last).items() if pressure > 0 and name in model.mesh.cavities]
    grown = {name: _growth(last, name) for name in driven}
    stretch = largest_stretch(last)
    if not grown or max(grown.values()) < CAUSES.balloon or stretch < CAUSES.stretched:
        return None
    name = max(grown, key=lambda each: grown[each])
    return Why(
        f" It is a balloon: '{name}' has {grown[name]:.3g} times its volume, and its wall, stretched to {stretch:.3g}, "
        "thins faster than the rubber stiffens.",
        "To bear more it needs fibers, a thicker wall, or a rubber whose law stiffens earlier.",
    )


def overload(state: State) -> Why | None:
    """Say that the rubber is stretched farther than any test of it."""
    model = state.model
    for name, material in model.region_materials.items():
        tested = None if material.stretch_range is None else material.stretch_range[1]
        stretch = largest_stretch(state, name)
        if stretch > (tested or CAUSES.breaks):
            known = f"its tests end at {tested:.3g}" if tested else f"elastomers bear about {CAUSES.breaks:.3g}"
            return Why(
                f" '{name}' is stretched to {stretch:.3g}; {known}.",
                "The load is more than the rubber bears: ask for less, and check the units of the load and of the "
                "law. A finer mesh does not help.",
            )
    return None


def largest_stretch(state: State, region: str | None = None) -> float:
    """Stretch that 99 % of the volume stay below, of the body or of a region."""
    gradients, weight = elastic_gradients(state.model, state.displacement, state.load_factor)
    chosen = slice(None) if region is None else state.model.mesh.regions[region]
    return weighted_percentile(_principal_stretches(gradients[chosen])[:, 0], weight[chosen].ravel())


def _principal_stretches(gradients: Array) -> Array:
    """Principal stretches (n, 3) at every point, the largest first."""
    F = gradients.reshape(-1, 3, 3)
    return np.asarray(np.sqrt(np.linalg.eigvalsh(np.swapaxes(F, 1, 2) @ F))[:, ::-1], dtype=np.float64)


def _turn(material: Material, stretches: Array, weight: Array) -> tuple[str, float, float] | None:
    """The test in which the stress of a law has an extreme, where, and the share of the volume that is stretched so.

    Every point counts for the test that its deformation resembles most.
    """
    isochoric = stretches / np.cbrt(stretches.prod(axis=1))[:, None]
    far = isochoric[:, 0] > CAUSES.stretched
    if not isinstance(material.law, Law) or not far.any():
        return None
    logs = np.log(isochoric)
    second = np.where(far, logs[:, 1], -1.0) / np.where(far, logs[:, 0], 1.0)  # −½ uniaxial, 0 planar, 1 equibiaxial
    turning = []
    for mode, low, high in TESTS:
        like = far & (second >= low) & (second < high)
        upper = CAUSES.turns_ahead * float(isochoric[like, 0].max(initial=1.0))
        limit = first_instability(material.law, mode, upper=upper, lower=1.0)
        if limit is not None:
            turned = like & (CAUSES.turns_ahead * isochoric[:, 0] >= limit)
            turning.append((mode, limit, float(weight[turned].sum() / weight.sum())))
    worst = max(turning, key=lambda each: each[2], default=None)
    return worst if worst is not None and worst[2] > CAUSES.turned_volume else None


def _growth(state: State, name: str) -> float:
    """Volume of a cavity over that at rest [-]."""
    mesh = state.model.mesh
    return cavity_volume(mesh, name, state.displacement) / cavity_volume(mesh, name)
