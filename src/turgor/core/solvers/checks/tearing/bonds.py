"""Findings about bonds: where one is damaged and opens on a path (T04), and elements that are too long for it (T05)."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.bonds.bond_results import BondResult, bond_results, terms_of
from turgor.core.engine.bonds.settings import BOND
from turgor.core.model.bonds import Bond
from turgor.core.model.model import Model
from turgor.core.solvers.checks.settings import TEARING
from turgor.core.solvers.solution import State
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]

#: Says the load at which values along a path first pass a limit.
Load = Callable[[Sequence[State], Sequence[float], float], str]


def opened_bonds(states: Sequence[State], load: Load, place: Callable[..., str]) -> Iterator[Finding]:
    """Return T04 for each bond that passes half of its strength, and T05 for elements too long for one.

    Parameters
    ----------
    states : sequence of State
        A path from rest.
    load, place : callable
        Words for a load and a place.
    """
    if not states or not states[0].model.bonds:
        return
    path = [bond_results(state.model, state.displacement, state.memory) for state in states]
    for bond in states[0].model.bonds:
        along = [each[bond.name] for each in path]
        uses = [float(np.where(each.bonded, each.use, 0.0).max()) for each in along]
        if max(uses) > TEARING.noted:
            where = place(states[0].model.mesh, _first(along[int(np.argmax(np.array(uses) > TEARING.noted))]))
            yield _opened(bond, states, (uses, along), load, where)
    yield from _too_long(states[0].model)


def _first(at: BondResult) -> Array:
    """Place at rest of the point that is used most."""
    point = np.unravel_index(int(np.argmax(np.where(at.bonded, at.use, 0.0))), at.use.shape)
    return np.asarray(at.place[point])


def _opened(
    bond: Bond, states: Sequence[State], path: tuple[Sequence[float], Sequence[BondResult]], load: Load, where: str
) -> Finding:
    uses, along = path
    last, most = along[-1], max(uses)
    opened = [float(each.area[each.opened].sum()) for each in along]
    whole = float(last.area[last.bonded].sum())
    if most <= 1:
        end = f"passes half of its strength at {load(states, uses, TEARING.noted)} and reaches {100 * most:.0f} % of it"
    elif not opened[-1]:
        end = f"is damaged from {load(states, uses, 1.0)} on; at the end the mean damage is {last.mean_damage:.2g}"
    else:
        first = next(area for area in opened if area > 0) * (1 - ROUND_OFF.same)
        end = (
            f"is damaged from {load(states, uses, 1.0)} on and opens at {load(states, opened, first)}; at the end "
            f"{100 * opened[-1] / whole:.2g} % of it are open, by {last.gap.max() / mm:.2g} mm at most"
        )
    return Finding(
        code="T04",
        severity=Severity.WARNING if most > 1 else Severity.NOTE,
        message=f"The bond '{bond.name}' between '{bond.between[0]}' and '{bond.between[1]}' {end}, first {where}.",
        advice="Drive it less, widen the bond, round the corner where it begins, or take a glue that bears more."
        if most > 1
        else "A clean specimen bears that once; dust, bubbles and cycles weaken a bond. Stay below half, or test it.",
    )


def _too_long(model: Model) -> Iterator[Finding]:
    for bond, term in zip(model.bonds, terms_of(model), strict=True):
        edge = float(np.sqrt(term.weights.sum(axis=1)).mean())
        softer = min(model.region_materials[name].law.shear_modulus for name in bond.between)
        zone = 3 * softer * bond.energy_peel / bond.peel_strength**2
        if edge * BOND.zone > zone:
            yield Finding(
                code="T05",
                severity=Severity.NOTE,
                message=f"Elements of {edge / mm:.2g} mm on the bond '{bond.name}' are long for its zone of damage of "
                f"about {zone / mm:.2g} mm: the load may rise and fall from element to element.",
                advice=f"Take elements of {zone / mm / BOND.zone:.2g} mm there (mesh.face_sizes), or compare two "
                "meshes; where it opens first depends on them least.",
            )
