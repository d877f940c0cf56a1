"""Failure: how much of its elongation at break and of its strength each part of a model uses in a state.

Of regions, sheets and threads whose material states a strength, the values that 99 % of the volume, area or length stay
below count: the largest value at a sharp edge grows with every finer mesh.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.membrane_term import largest_tension
from turgor.core.engine.fibers.fiber_trusses import discrete_threads
from turgor.core.engine.fibers.smeared import smeared_pieces
from turgor.core.engine.fibers.tension import piece_tension, smooth_tension, tangents
from turgor.core.engine.fibers.thread_rest import ThreadRest
from turgor.core.engine.fields import CellFields
from turgor.core.engine.percentiles import weighted_percentile
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import side_type
from turgor.core.model.fibers import DISCRETE, Fibers
from turgor.core.model.model import Model

Array = NDArray[np.float64]

#: Quantities that are compared with what a material bears.
STRETCH, STRESS = "stretch", "stress"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Use:
    """How much one part of a model uses of what its material bears.

    Parameters
    ----------
    part : str
        What it is, such as ``"'body'"`` or ``"threads on 'outside'"``.
    material : str
        Name of the material.
    quantity : str
        ``"stretch"`` or ``"stress"``, the nominal one [Pa].
    value, limit : float
        The value that 99 % of the part stay below, and that at break.
    share : float
        Share of the elongation at break, or of the strength.
    place : (3,) array [m]
        Where the value is largest, in the undeformed body.
    """

    part: str
    material: str
    quantity: str
    value: float
    limit: float
    share: float
    place: Array


@dataclass(frozen=True, slots=True, eq=False)
class _Part:
    """One part in a state: stretch and nominal stress at its points, their weights and places."""

    name: str
    material: Material
    stretch: Array
    stress: Array
    weight: Array
    places: Array


def states_strength(model: Model) -> bool:
    """Whether the material of a region, a sheet or a thread states what it bears.

    Parameters
    ----------
    model : Model
    """
    sheets = (sheet.material for sheet in model.membranes.values())
    threads = (fibers.material for fibers in model.reinforcements)
    return any(each.strength is not None for each in (*model.region_materials.values(), *sheets, *threads))


def uses(
    model: Model, displacement: Array, cells: Callable[[], CellFields], load_factor: float = 1.0
) -> tuple[Use, ...]:
    """Compare stretches and stresses of a state with what the materials bear.

    Parameters
    ----------
    model : Model
    displacement : (n, 3) array [m]
    cells : callable
        ``cells() -> CellFields`` of the state; called only if the material of a region states a strength.
    load_factor : float
        At which the states of sheets and windings are taken.

    Returns
    -------
    tuple of Use
        Regions first, then sheets and threads; of each the stretch before the stress.
    """
    return tuple(use for part in _parts(model, displacement, cells, load_factor) for use in _compared(part))


def _compared(part: _Part) -> Iterator[Use]:
    strength = part.material.strength
    assert strength is not None
    for quantity, values, limit, base in (
        (STRETCH, part.stretch, strength.ultimate_stretch, 1.0),
        (STRESS, part.stress, strength.tensile_strength, 0.0),
    ):
        if limit is not None:
            value = weighted_percentile(values, part.weight)
            yield Use(
                part=part.name,
                material=part.material.name,
                quantity=quantity,
                value=value,
                limit=limit,
                share=(value - base) / (limit - base),
                place=part.places[np.unravel_index(int(values.argmax()), values.shape)[0]],
            )


def _parts(model: Model, displacement: Array, cells: Callable[[], CellFields], load_factor: float) -> Iterator[_Part]:
    """Yield the parts whose material states a strength."""
    stated = {name: each for name, each in model.region_materials.items() if each.strength is not None}
    if stated:
        at, mesh = cells(), model.mesh
        nominal = at.nominal_stress
        middles = _middles(mesh.points, mesh.cells, mesh.cell_type.corners)
        for name, material in stated.items():
            of = mesh.regions[name]
            yield _Part(f"'{name}'", material, at.stretch[of], nominal[of], at.weight[of], middles[of])
    for name, sheet in model.membranes.items():
        if sheet.material.strength is not None:
            sides = model.mesh.face(name)
            places = _middles(model.mesh.points, sides, side_type(sides.shape[1]).corners)
            pulled = largest_tension(model, name, displacement, load_factor)
            yield _Part(f"the sheet on '{name}'", sheet.material, *pulled, places)
    for fibers in model.reinforcements:
        if fibers.material.strength is not None:
            yield _threads(model, fibers, displacement, load_factor)


def _middles(points: Array, nodes: NDArray[np.int64], corners: int) -> Array:
    return np.asarray(points[nodes[:, :corners]].mean(axis=1))


def _threads(model: Model, fibers: Fibers, displacement: Array, load_factor: float) -> _Part:
    threads = discrete_threads(model.mesh, fibers).pieces if fibers.form == DISCRETE else None
    pieces = threads or smeared_pieces(model.mesh, fibers)
    rest = ThreadRest.of(model.states_of(fibers.name), load_factor)
    single = np.linalg.norm(tangents(pieces, model.mesh.points + displacement), axis=1) / rest.length
    tension = smooth_tension(pieces, piece_tension(fibers, single, rest))
    area = np.pi * fibers.diameter**2 / 4
    places = np.einsum("ka,kai->ki", pieces.middle, model.mesh.points[pieces.sides])
    stretch = 1 + tension / (fibers.stretching_stiffness * rest.stiffness)
    return _Part(f"threads on '{fibers.place}'", fibers.material, stretch, tension / area, pieces.weights, places)
