"""Continuing: the model of a stage that begins where another one ended, and that of what acts at load factor 0."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.contact import Contact
from turgor.core.model.history import starts, with_history
from turgor.core.model.loads import Load, Pressure, pressures_among
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Path, Vector
from turgor.core.model.supports import Displacement, Support
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]


def with_loads(
    model: Model,
    loads: Sequence[Load],
    displacements: Sequence[Displacement] = (),
    moves: Mapping[str, Vector] | None = None,
) -> Model:
    """Return a model in which loads, displacements and moves replace those on the same faces and obstacles.

    Parameters
    ----------
    model : Model
    loads : sequence of Load
    displacements : sequence of Displacement
        Each in place of one of the same face and directions.
    moves : mapping of str to (3,) floats [m]
        Displacements of obstacles at load factor 1.

    Raises
    ------
    TurgorError
        If two loads act on the same, or there is no such displacement or obstacle.
    """
    stated = _by_place(loads)
    unchanged = [load for load in model.loads if (load.kind, load.place) not in stated]
    new = _by_support(model, displacements)
    supports = [new.get(support.prescribed, support) for support in model.supports]
    moves = moves or {}
    return _with_parts(model, (*unchanged, *loads), supports, _moved(model, _paths(model, 0.0, moves, moves)))


def movable(model: Model, displacements: Sequence[Displacement]) -> Model:
    """Return a model in which fixed faces that later stages move have a displacement of zero.

    Parameters
    ----------
    model : Model
    displacements : sequence of Displacement
        How faces are moved later.
    """
    moved = {each.prescribed for each in displacements}
    supports = [each.as_moved() if each.prescribed in moved else each for each in model.supports]
    unchanged = all(new is old for new, old in zip(supports, model.supports, strict=True))
    return model if unchanged else _with_parts(model, model.loads, supports, model.contact)


def continued(
    model: Model,
    acting: tuple[float, Mapping[str, float]],
    loads: Sequence[Load],
    displacements: Sequence[Displacement] = (),
    moves: Mapping[str, Vector] | None = None,
) -> Model:
    """Return a model that begins with everything that acts at one load factor of another model.

    Loads that are not stated again stay as they are. Those that are go from the old value to the new one; their history
    is the share of this change, by default the load factor.

    Parameters
    ----------
    model : Model
        That of the former stage.
    acting : (float, mapping of str to float [Pa])
        The load factor at which it ended, and the pressures there.
    loads, displacements, moves
        As in `with_loads`; displacements count from the undeformed body, moves from where an obstacle was at first.
    """
    factor, pressures = acting
    new = _by_place(loads)
    stated = {load.face: load for load in pressures_among(loads)}
    out: list[Load] = []
    for face in dict.fromkeys([*pressures, *stated]):
        pressure = pressures.get(face, 0.0)
        if pressure or face in stated:
            out.append(_pressure(face, pressure, stated.get(face)))
    for load in _others(model.loads):
        share = load.share(factor)
        if share or (load.lasting and (load.kind, load.place) not in new):
            out.append(load.continued(share, new.get((load.kind, load.place))))
    out += _others(loads)
    moved = _by_support(model, displacements)
    supports = [each.continued(factor, moved.get(each.prescribed)) for each in model.supports]
    names = [obstacle.name for obstacle in model.contact.obstacles]
    moves = moves or {}
    return _with_parts(
        model, tuple(out), supports, _moved(model, _paths(model, factor, moves, [*names, *moves]), factor)
    )


def _with_parts(model: Model, loads: Sequence[Load], supports: Sequence[Support], contact: Contact) -> Model:
    return Model(
        model.mesh,
        model.materials,
        supports,
        loads,
        formulation=model.formulation,
        reinforcements=model.reinforcements,
        contact=contact,
        bonds=model.bonds,
    )


def _others(loads: Sequence[Load]) -> list[Load]:
    """Loads that are no pressures: their shares go on; of pressures the values go on, which a state reports."""
    pressures = pressures_among(loads)
    return [load for load in loads if load not in pressures]


def _by_place(loads: Sequence[Load]) -> dict[tuple[str, str], Load]:
    loads_by_place: dict[tuple[str, str], Load] = {}
    for load in loads:
        place = (load.kind, load.place)
        if place in loads_by_place:
            raise TurgorError(f"a stage states {' on '.join(filter(None, place))} twice; once is enough.")
        loads_by_place[place] = load
    return loads_by_place


def _by_support(model: Model, displacements: Sequence[Displacement]) -> dict[tuple[str, str], Displacement]:
    known = {support.prescribed for support in model.supports if support.moves}
    for each in displacements:
        if each.prescribed not in known:
            raise TurgorError(
                f"a stage moves '{each.face}' in {each.directions}, and the model does not hold this face in these "
                "directions; hold it with Fixed, or with a Displacement."
            )
    return {each.prescribed: each for each in displacements}


def _paths(model: Model, factor: float, moves: Mapping[str, Vector], names: Iterable[str]) -> dict[str, Path]:
    """Paths of obstacles from where they were at a load factor to where they are moved, if they are."""
    obstacles = {obstacle.name: obstacle for obstacle in model.contact.obstacles}
    paths: dict[str, Path] = {}
    for name in names:
        if name not in obstacles:
            raise unknown("obstacle in the moves of a stage", name, obstacles)
        x, y, z = (float(each) for each in obstacles[name].displacement(factor))
        paths[name] = ((0.0, (x, y, z)), (1.0, moves.get(name, (x, y, z))))
    return paths


def _moved(model: Model, paths: Mapping[str, Path], factor: float | None = None) -> Contact:
    """Contact with other paths; obstacles stay turned as they were at a load factor, where one is given."""
    obstacles = []
    for each in model.contact.obstacles:
        path = paths.get(each.name, each.path)
        stays = each.rotation if factor is None else each.turned_at(factor)
        obstacles.append(replace(each, path=path, rotation=stays))
    return model.contact.with_obstacles(obstacles)


def _pressure(face: str, old: float, new: Pressure | None) -> Pressure:
    """A pressure that begins at ``old`` and stays, or follows the history of a new one."""
    if new is None:
        return with_history(Pressure(face, old), ((0.0, 1.0), (1.0, 1.0)))
    if not old:
        return new
    change = new.pressure - old
    if isinstance(new.history, str):
        top = abs(old) + abs(change)
        text = f"({old / top!r}) + ({change / top!r}) * ({new.history})"
        return with_history(Pressure(face, top), text)
    values = [(factor, old + share * change) for factor, share in new.history]
    top = max(abs(value) for _, value in values)
    return with_history(Pressure(face, top), tuple((factor, value / top) for factor, value in values))


def starting_loads(model: Model) -> tuple[Load, ...]:
    """Return the loads whose share at load factor 0 is not zero, and that act on a body at rest."""
    return tuple(load for load in model.loads if load.acts_at_rest and starts(load.history))


def at_start(model: Model) -> Model | None:
    """Return the model whose equilibrium at load factor 1 is that of another model at load factor 0.

    Faces, points and obstacles that move stay where they are at first.

    Parameters
    ----------
    model : Model

    Returns
    -------
    Model or None
        None where no load is there from the start: the body then begins at rest.
    """
    present = starting_loads(model)
    if not present:
        return None
    bare = replace(model, loads=tuple(load for load in model.loads if load not in present and load.acts_at_rest))
    return continued(bare, (0.0, {}), [with_history(load, ((0.0, 0.0), (1.0, load.share(0.0)))) for load in present])
