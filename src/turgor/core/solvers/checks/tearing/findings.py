"""Findings about tearing: where a path passes half and all of what a material bears (T01, T02), and its life (T03)."""

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from turgor.core.engine.fields import cell_fields
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.drive import drive_text
from turgor.core.model.model import Model
from turgor.core.solvers.checks.settings import TEARING
from turgor.core.solvers.checks.tearing.bonds import opened_bonds
from turgor.core.solvers.checks.tearing.cracking import Cracking, cracking_along
from turgor.core.solvers.checks.tearing.uses import STRETCH, Use, states_strength, uses
from turgor.core.solvers.solution import State
from turgor.foundation.finding import Finding, Severity
from turgor.units import MPa, kPa, mm


def tearing_findings(states: Sequence[State]) -> tuple[Finding, ...]:
    """Return T01 and T02 for parts that pass half of what they bear, T03 for cracks that grow, T04 and T05 for bonds.

    Parameters
    ----------
    states : sequence of State
        A path from rest.
    """
    return (*_passed(states), *_life(states), *opened_bonds(states, _load, _place))


def _passed(states: Sequence[State]) -> Iterator[Finding]:
    if not states or not states_strength(states[0].model):
        return
    path = [_uses_of(state) for state in states]
    for key in path[-1]:
        shares = [each[key].share for each in path]
        worst = path[int(np.argmax(shares))][key]
        if worst.share > TEARING.noted:
            yield _finding(states, worst, shares)


def _uses_of(state: State) -> dict[tuple[str, str], Use]:
    cells = partial(cell_fields, state.model, state.displacement, state.mean_stress, state.memory, state.load_factor)
    return {(use.part, use.quantity): use for use in uses(state.model, state.displacement, cells, state.load_factor)}


def _finding(states: Sequence[State], worst: Use, shares: Sequence[float]) -> Finding:
    stretch, part, torn = worst.quantity == STRETCH, worst.part, max(shares) > 1
    what = "elongation at break" if stretch else "tensile strength"
    of = f"stretch {worst.limit:.3g}" if stretch else f"{worst.limit / MPa:.3g} MPa"
    end = f"all of it at {_load(states, shares, 1.0)}" if torn else f"reaches {100 * worst.share:.0f} % of it"
    return Finding(
        code="T01" if stretch else "T02",
        severity=Severity.WARNING,
        message=f"{part[0].upper()}{part[1:]} of '{worst.material}' passes half of its {what} ({of}) at "
        f"{_load(states, shares, TEARING.noted)} and {end}, most {'stretched' if stretch else 'stressed'} "
        f"{_place(states[-1].model.mesh, worst.place)}.",
        advice="Expect it to tear there: make the wall thicker or rounder, drive it less, or take a material that "
        "bears more."
        if torn
        else "A first pull may go well; many cycles, notches and bubbles tear it earlier. Stay below half, or test it.",
    )


def _load(states: Sequence[State], values: Sequence[float], limit: float) -> str:
    """Say the load at which values along a path first pass a limit, interpolated between the states."""
    at = next(i for i, value in enumerate(values) if value > limit)
    if at == 0:
        return _drive(states[0], states[0], 0.0)
    share = (limit - values[at - 1]) / (values[at] - values[at - 1])
    return _drive(states[at - 1], states[at], share)


def _drive(before: State, after: State, share: float) -> str:
    """Say the pressures between two states, or the load factor where nothing presses."""
    factor = before.load_factor + share * (after.load_factor - before.load_factor)
    between = {
        name: (1 - share) * before.pressures.get(name, 0.0) + share * pressure
        for name, pressure in after.pressures.items()
    }
    if not between:
        return drive_text(after.model, factor, 3) or f"load factor {factor:.3g}"
    if max(between.values()) - min(between.values()) <= 1e-9 * max(map(abs, between.values())):
        return f"{next(iter(between.values())) / kPa:.3g} kPa"
    return ", ".join(f"{name} {pressure / kPa:.3g} kPa" for name, pressure in between.items())


def _place(mesh: Mesh, place: np.ndarray) -> str:
    """Name the smallest face near a place of the undeformed body, and its coordinates."""
    distances = np.linalg.norm(mesh.points - place, axis=1)
    reach = TEARING.near * float(distances.min())
    near = [
        (len(sides), name)
        for name, sides in mesh.faces.items()
        if not name.startswith(("symmetry_", "cyclic_")) and float(distances[np.unique(sides)].min()) <= reach
    ]
    coordinates = ", ".join(f"{value / mm:.3g}" for value in place)
    names = " and ".join(f"'{name}'" for _, name in sorted(near)[:2])
    return f"near the face{'s' if len(near) > 1 else ''} {names}, at ({coordinates}) mm" if near else (
        f"at ({coordinates}) mm"
    )  # fmt: skip


def _life(states: Sequence[State]) -> Iterator[Finding]:
    if not states or all(each.crack_growth is None for each in states[0].model.region_materials.values()):
        return
    path = list(cracking_along(states))
    at = int(np.argmax([each.tearing for each in path]))
    yield _life_finding(states[at].model, path[at], _drive(states[at], states[at], 0.0))


def _life_finding(model: Model, worst: Cracking, load: str) -> Finding:
    material = model.region_materials[worst.region]
    growth = material.crack_growth
    assert growth is not None
    fast, usual, slow = worst.cycles
    tear = "" if worst.share is None else f", {100 * worst.share:.2g} % of its tear strength"
    grows = f"A flaw of {growth.flaw / mm:.3g} mm in '{worst.region}' of '{material.name}' has a tearing energy of "
    energy = f"{worst.tearing:.3g} J/m²{tear}, at {load}"
    if usual == np.inf:
        life = f"below the threshold of {growth.threshold:.3g} J/m²: it does not grow"
    else:
        life = f"it grows through in about {_count(usual)} cycles ({_count(fast)} to {_count(slow)})"
    few = usual < TEARING.few_cycles
    return Finding(
        code="T03",
        severity=Severity.WARNING if few else Severity.NOTE,
        message=f"{grows}{energy}; {life}.",
        advice="Drive it less, make the wall thicker where it stretches most, or accept that it is replaced."
        if few
        else "The number is as good as its growth law: a factor of ten is common between batches.",
    )


def _count(cycles: float) -> str:
    """Two digits of a number of cycles."""
    return "infinitely many" if cycles == np.inf else f"{float(f'{cycles:.2g}'):,.0f}"
