"""Steps of a deck: their times, and what they prescribe."""

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.raw import numbers
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.decks.account import Account
from turgor.job.decks.deck import Deck, words_of
from turgor.job.decks.tracks import (
    FORCE,
    GRAVITY,
    HEAT,
    PRESSURE,
    SHIFT,
    SPIN,
    TRACTION,
    Amplitude,
    Span,
    Tracks,
    amplitude_named,
    amplitudes_of,
    boundary_row,
    mass_target,
)


@dataclass(slots=True)
class Path:
    """What a deck prescribes along its steps.

    Parameters
    ----------
    deck : Deck
    account : Account
    amplitudes : dict of str to Amplitude
        By name, in lower case.
    fixed : dict of (int, int) to Keyword
        Nodes and degrees of freedom that stay, with the keyword that says so.
    initial : dict of int to float
        Temperature of nodes in the shape of the mesh, 0 for the others.
    tracks : Tracks
        What moves and loads.
    ends : list of float [s]
        Ends of the steps so far.
    relaxes, moves, arc_length, stabilized : bool
        Whether a step takes time, one has inertia, one follows limit points, and whether contact alone stops a body.
    """

    deck: Deck
    account: Account
    amplitudes: dict[str, Amplitude] = field(default_factory=dict)
    fixed: dict[tuple[int, int], Keyword] = field(default_factory=dict)
    initial: dict[int, float] = field(default_factory=dict)
    tracks: Tracks = field(default_factory=Tracks)
    ends: list[float] = field(default_factory=list)
    relaxes: bool = False
    moves: bool = False
    arc_length: bool = False
    stabilized: bool = False


def path_of(deck: Deck, initial: dict[int, float], account: Account) -> Path:
    """Read the supports of a deck, and the steps one after another.

    Parameters
    ----------
    deck : Deck
    initial : dict of int to float
        Temperature of nodes in the shape of the mesh.
    account : Account
        Takes what became of each keyword.
    """
    path = Path(deck, account, initial=initial)
    for keyword in (*deck.model, *(each for step in deck.steps for each in step)):
        if keyword.name == "amplitude":
            _attempt(path, keyword, _take_amplitude)
    for keyword in deck.model:
        if keyword.name == "boundary":
            _attempt(path, keyword, _take_boundary)
    for step in deck.steps:
        _take_step(path, step)
    for track in path.tracks.of.values() if path.moves else ():
        track.rise()
    return path


#: What reads one keyword, and says as what it was understood.
Taker: TypeAlias = Callable[[Path, Keyword], str]


def _attempt(path: Path, keyword: Keyword, take: Taker) -> None:
    try:
        path.account.taken(keyword, take(path, keyword))
    except TurgorError as error:
        path.account.missing(keyword, str(error))
    except (IndexError, ValueError) as error:
        path.account.missing(keyword, f"a line of data is damaged ({error})")


def _take_amplitude(path: Path, keyword: Keyword) -> str:
    path.amplitudes[keyword.given.get("name", "").lower()] = amplitudes_of(keyword)
    return "history of the loads that name it"


def _take_step(path: Path, step: tuple[Keyword, ...]) -> None:
    first = step[0]
    if "perturbation" in first.given:
        path.account.missing(first, "a perturbation step has no form here.")
        return
    times = [span for keyword in step if (span := _span_of(path, keyword, first)) is not None]
    if len(times) != 1:
        path.account.missing(first, "the step has no procedure that has a form here: *STATIC, *VISCO or *DYNAMIC.")
        return
    large = "nlgeom" in first.given and first.given["nlgeom"].lower() != "no"
    small = "" if large else "; the deck solves it with small displacements, turgor with large ones"
    path.account.taken(first, f"load factor up to the end of step {len(path.ends) + 1}{small}")
    for keyword in step:
        if keyword.name in _LOADS:
            _attempt(path, keyword, _LOADS[keyword.name])
    path.tracks.follow(times[0])
    path.ends.append(times[0].end)


def _span_of(path: Path, keyword: Keyword, first: Keyword) -> Span | None:
    """Time of a step; None for a keyword that is no procedure."""
    if keyword.name not in ("static", "visco", "dynamic"):
        return None
    if path.ends and (keyword.name == "dynamic") != path.moves:
        path.account.missing(keyword, "steps with inertia next to steps without it have no form here.")
    values = list(numbers(keyword.lines[0], keyword.path, "times of a step")) if keyword.lines else []
    period = values[1] if len(values) > 1 and values[1] > 0 else 1.0
    start = path.ends[-1] if path.ends else 0.0
    path.relaxes |= keyword.name == "visco"
    path.moves |= keyword.name == "dynamic"
    path.arc_length |= "riks" in keyword.given
    path.account.taken(keyword, f"procedure, {period:g} s long; turgor chooses its increments")
    usual = "step" if path.moves else "ramp"
    return Span(start=start, end=start + period, at_once=first.given.get("amplitude", usual).lower() == "step")


def _take_boundary(path: Path, keyword: Keyword) -> str:
    if keyword.given.get("op", "mod").lower() == "new":
        _check_restated(path, keyword)
    if set(keyword.given) - {"op", "amplitude"}:
        raise TurgorError(f"{', '.join(set(keyword.given) - {'op', 'amplitude'}).upper()} has no form here.")
    amplitude = amplitude_named(keyword, path.amplitudes)
    nodes, left = 0, set[int]()
    for line in keyword.lines:
        where, value, freedoms = boundary_row(line)
        left |= {each for each in freedoms if each not in path.deck.freedoms}
        numbers_of = _nodes(path.deck, where)
        nodes += len(numbers_of)
        for freedom in (each for each in freedoms if each in path.deck.freedoms):
            for node in numbers_of.tolist():
                _prescribe(path, keyword, (node, freedom), (value, amplitude))
    note = f"; degrees of freedom {sorted(left)}, which its nodes lack, left out" if left else ""
    return f"support of {nodes} nodes{note}"


def _prescribe(path: Path, keyword: Keyword, place: tuple[int, int], stated: tuple[float, Amplitude | None]) -> None:
    """Fix a degree of freedom, or move it in the present step."""
    value, amplitude = stated
    target = (SHIFT, *place)
    if not value and target not in path.tracks.of:
        if path.ends and place not in path.fixed:
            raise TurgorError("a support that begins after the first step has no form here.")
        path.fixed[place] = keyword
        return
    if path.ends and target not in path.tracks.of and place not in path.fixed:
        raise TurgorError("a displacement of a free node that begins after the first step has no form here.")
    path.fixed.pop(place, None)
    path.tracks.state(target, value, amplitude, keyword)


def _check_restated(path: Path, keyword: Keyword) -> None:
    """Refuse ``OP=NEW`` where it removes a support; the keywords of a step count together."""
    step = next((step for step in path.deck.steps if any(each is keyword for each in step)), (keyword,))
    restated = set()
    for line in (line for each in step if each.name == "boundary" for line in each.lines):
        where, _, freedoms = boundary_row(line)
        restated |= {(node, freedom) for node in _nodes(path.deck, where).tolist() for freedom in freedoms}
    moved = {target[1:] for target in path.tracks.of if isinstance(target, tuple) and target[0] == SHIFT}
    if (set(path.fixed) | moved) - restated:
        raise TurgorError("supports that a step removes (OP=NEW) have no form here.")


def _nodes(deck: Deck, where: str) -> NDArray[np.int64]:
    nodes = deck.nodes(where)
    if nodes is None:
        raise unknown("set of nodes", where, deck.content.node_sets)
    if not len(nodes):
        raise TurgorError(f"the set '{where}' has no nodes.")
    return nodes


def _take_forces(path: Path, keyword: Keyword) -> str:
    _check_load(path, keyword, FORCE, {"op", "amplitude"})
    amplitude, count = amplitude_named(keyword, path.amplitudes), 0
    for line in keyword.lines:
        where, freedom, value = words_of(line)[:3]
        if int(freedom) not in path.deck.freedoms:
            last = path.deck.freedoms[-1]
            raise TurgorError(f"a load on degree of freedom {freedom} has no form here; its nodes have 1 to {last}.")
        for node in _nodes(path.deck, where).tolist():
            path.tracks.state((FORCE, node, int(freedom)), float(value), amplitude, keyword)
            count += 1
    return f"{count} forces on nodes"


def _take_cell_loads(path: Path, keyword: Keyword) -> str:
    _check_load(path, keyword, PRESSURE, {"op", "amplitude"})
    amplitude = amplitude_named(keyword, path.amplitudes)
    meanings, whole = set(), dict[Hashable, set[int]]()
    for line in keyword.lines:
        where, label, *values = words_of(line)
        cells = path.deck.cells(where)
        if cells is None:
            raise unknown("set of cells", where, path.deck.content.cell_sets)
        label = label.upper()
        if label in ("GRAV", "CENTRIF"):
            target = mass_target(label, values)
            path.tracks.state(target, float(values[0]), amplitude, keyword)
            whole.setdefault((target, values[0]), set()).update(cells.tolist())
            meanings.add("gravity" if label == "GRAV" else "centrifugal force")
        elif len(label) == 2 and label[0] == "P" and label[1].isdigit():
            path.tracks.state((PRESSURE, where, f"S{label[1]}"), float(values[0]), amplitude, keyword)
            meanings.add("pressure that follows the surface")
        else:
            raise TurgorError(f"the load {label} has no form here; P1 to P6, GRAV and CENTRIF have one.")
    if any(not cells.issuperset(path.deck.solid_numbers.tolist()) for cells in whole.values()):
        raise TurgorError("gravity or a centrifugal force on a part of the cells has no form here; it acts on all.")
    return " and ".join(sorted(meanings))


def _take_surface_loads(path: Path, keyword: Keyword) -> str:
    _check_load(path, keyword, PRESSURE, {"op", "amplitude", "follower"})
    amplitude = amplitude_named(keyword, path.amplitudes)
    meanings = set()
    for line in keyword.lines:
        surface, label, value, *direction = words_of(line)
        dead = keyword.given.get("follower", "yes").lower() == "no"
        if label.upper() not in ("P", "TRVEC") or (label.upper() == "TRVEC") != dead:
            raise TurgorError(f"the load {label.upper()} has no form here; P has one, and TRVEC with FOLLOWER=NO.")
        sides = path.deck.surface(surface)
        if sides is None:
            raise unknown("surface", surface, path.deck.content.surfaces)
        if not sides:
            raise TurgorError(f"the surface '{surface}' has no sides of cells that are read.")
        known = path.deck.surface_name(surface)
        target = (TRACTION, known, tuple(map(float, direction[:3]))) if dead else (PRESSURE, known, "")
        path.tracks.state(target, float(value), amplitude, keyword)
        meanings.add("traction, fixed in direction" if dead else "pressure that follows the surface")
    return " and ".join(sorted(meanings))


def _take_temperatures(path: Path, keyword: Keyword) -> str:
    _check_load(path, keyword, HEAT, {"op", "amplitude"})
    amplitude, count = amplitude_named(keyword, path.amplitudes), 0
    for line in keyword.lines:
        where, value = words_of(line)[:2]
        for node in _nodes(path.deck, where).tolist():
            rest = path.initial.get(node, 0.0)
            if amplitude is not None and rest:
                raise TurgorError("an amplitude of a temperature has no form here unless the initial one is 0.")
            path.tracks.state((HEAT, node), float(value) - rest, amplitude, keyword)
            count += 1
    return f"temperature of {count} nodes"


def _check_load(path: Path, keyword: Keyword, kind: str, known: set[str]) -> None:
    """Refuse parameters that change what a load is, and end former loads where the keyword says so."""
    if strange := set(keyword.given) - known:
        raise TurgorError(f"{', '.join(sorted(strange)).upper()} has no form here.")
    if keyword.given.get("op", "mod").lower() == "new":
        others = (GRAVITY, SPIN) if keyword.name == "dload" else (TRACTION,)
        for each in (kind, *others) if kind == PRESSURE else (kind,):
            path.tracks.end_all(each)


_LOADS: Mapping[str, Taker] = {
    "boundary": _take_boundary,
    "cload": _take_forces,
    "dload": _take_cell_loads,
    "dsload": _take_surface_loads,
    "temperature": _take_temperatures,
}
