"""Supports and loads of a .feb file as keywords of a deck."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError, near_match
from turgor.job.decks.febio.curves import Curve
from turgor.job.decks.febio.elements import Element
from turgor.job.decks.febio.meshes import FebMesh

#: Degrees of freedom by the letters of FEBio.
DIRECTIONS = {"x": 1, "y": 2, "z": 3}

#: Those of the back faces of shells.
BACK = ("sx", "sy", "sz")

Rows = Iterator[Keyword]


@dataclass(slots=True)
class Prescribed:
    """What a .feb file prescribes, while it is read.

    Parameters
    ----------
    mesh : FebMesh
    curves : mapping of str to Curve or Element
        Load curves by their ``id``; an element where one has no form.
    end, first : float [s]
        End of the last step, and of the first increment, in which supports jump.
    sides : mapping
        Cell and label of a side, by its corners.
    sheets : bool
        Whether there are shells.
    used : dict of str to str
        Names in the deck of the surfaces that a load or contact has named.
    loaded : dict
        Amplitude of what has a load: a surface, or a node and a degree of freedom.
    """

    mesh: FebMesh
    curves: Mapping[str, Curve | Element]
    end: float
    first: float
    sides: Mapping[frozenset[int], tuple[int, str]]
    sheets: bool
    used: dict[str, str] = field(default_factory=dict)
    loaded: dict[object, str] = field(default_factory=dict)

    def claim(self, target: object, name: str, *, adds: bool = False) -> None:
        """Refuse a second load on a target, which a deck would take in place of the first one."""
        if target in self.loaded and not (adds and self.loaded[target] == name):
            raise TurgorError(f"a second load on {target} has no form here; add it to the first.")
        self.loaded[target] = name

    def amplitude(self, value: Element, *, starts: bool) -> tuple[float, str, list[Keyword]]:
        """Factor of a value that a curve multiplies, the name of its amplitude, and the keyword that defines it.

        ``starts`` says whether it may be there from the start; else it grows in the first increment.
        """
        if value.given.get("type", "const") not in ("const", ""):
            raise TurgorError("a value that varies over place has no form here.")
        factors = value.numbers()
        if len(factors) != 1:
            value.fail(f"it has {len(factors)} numbers; one is needed.")
        name, rows = self.history(value, starts=starts)
        return factors[0], name, rows

    def history(self, value: Element, *, starts: bool) -> tuple[str, list[Keyword]]:
        """Name of the amplitude of a value, and the keyword that defines it; a value without a curve is constant."""
        number = value.given.get("lc", "")
        curve = self.curves.get(number) if number not in ("", "0") else Curve(points=[(0.0, 1.0), (self.end, 1.0)])
        if curve is None:
            value.fail(f"there is no load curve '{number}'{near_match(number, self.curves) or '.'}")
        if isinstance(curve, Element):
            raise TurgorError(f"{curve.label} in line {curve.line} has no form here; points on lines have one.")
        points = curve.over(self.end)
        if points[0][1] and not starts:
            points = [(0.0, 0.0), *((t, f) for t, f in points if t > self.first)]
            points.insert(1, (self.first, curve.over(self.first)[-1][1]))
        name = f"curve {number or 'none'}{'' if starts else ' of a support'}"
        lines = [f"{time!r}, {factor!r}" for time, factor in points]
        return name, [value.keyword("amplitude", lines, {"name": name, "time": "total time"})]


def boundary_rows(state: Prescribed, bc: Element) -> Rows:
    """Keywords of one support."""
    kind = bc.given.get("type", bc.tag)
    take = _SUPPORTS.get(kind)
    if take is None:
        yield bc.missing(f"the support '{kind}' has no form here; these have one: {', '.join(_SUPPORTS)}.")
        return
    yield from _attempt(take, state, bc)


def load_rows(state: Prescribed, load: Element) -> Rows:
    """Keywords of one load."""
    kind = load.given.get("type", "")
    take = _LOADS.get((load.tag, kind))
    if take is None:
        known = ", ".join(f"'{kind}'" for _, kind in _LOADS)
        yield load.missing(f"the load '{kind}' has no form here; these have one: {known}.")
        return
    yield from _attempt(take, state, load)


def _attempt(take: Callable[[Prescribed, Element], list[Keyword]], state: Prescribed, element: Element) -> Rows:
    """Keywords, or why there are none; what is damaged names its own line and ends the import."""
    try:
        yield from take(state, element)
    except TurgorError as error:
        if str(error).startswith(f"'{element.path}', line"):
            raise
        yield element.missing(str(error))


def _fixed(state: Prescribed, bc: Element) -> list[Keyword]:
    """``<x_dof>1</x_dof>`` of FEBio 4, ``<dofs>x,y</dofs>`` of FEBio 3, or ``bc="x,y"`` of FEBio 2."""
    words = (bc.given.get("bc") or bc.word("dofs")).replace(" ", "").split(",")
    words += [each.tag.removesuffix("_dof") for each in bc.children if each.tag.endswith("_dof") and _on(each)]
    nodes = state.mesh.nodes_of(bc, bc.given.get("node_set", ""))
    lines = [f"{node}, {freedom}" for word in words for node, freedom in _places(state, nodes, word)]
    if not lines:
        return [bc.unneeded("it fixes nothing that nodes of solids have")]
    return [bc.keyword("boundary", lines)]


def _places(state: Prescribed, nodes: list[int], word: str) -> list[tuple[int, int]]:
    """Nodes and degrees of freedom that FEBio calls by a word; ``sx`` is that of the back of a shell."""
    if word in DIRECTIONS:
        return [(node, DIRECTIONS[word]) for node in nodes]
    backs = [state.mesh.backs[node] for node in nodes if node in state.mesh.backs]
    return [(node, DIRECTIONS[word[1]]) for node in backs] if word in BACK else []


def _shell_fixed(state: Prescribed, bc: Element) -> list[Keyword]:
    if state.sheets:
        raise TurgorError("degrees of freedom of shells on solids have no form here.")
    return _fixed(state, bc)


def _moved(state: Prescribed, bc: Element) -> list[Keyword]:
    word = bc.given.get("bc") or bc.word("dof")
    value = bc.first("value", "scale")
    places = _places(state, state.mesh.nodes_of(bc, bc.given.get("node_set", "")), word)
    if not places:
        raise TurgorError(f"the degree of freedom '{word}' has no form here; x, y and z have one.")
    if value is None:
        bc.fail("it has no <value>.")
    factor, name, rows = state.amplitude(value, starts=False)
    lines = [f"{node}, {freedom}, {freedom}, {factor!r}" for node, freedom in places]
    if not factor:
        return [bc.keyword("boundary", lines)]
    return [*rows, bc.keyword("boundary", lines, {"amplitude": name})]


def _rigid(state: Prescribed, bc: Element) -> list[Keyword]:
    return []  # its nodes follow the rigid body; see `rigid.py`


def _nodal(state: Prescribed, load: Element) -> list[Keyword]:
    nodes = state.mesh.nodes_of(load, load.given.get("node_set", ""))
    value = load.first("value", "scale")
    if value is None:
        load.fail("it has no <value>.")
    if load.first("dof") is not None:
        word = load.word("dof")
        if word not in DIRECTIONS:
            raise TurgorError(f"the degree of freedom '{word}' has no form here; x, y and z have one.")
        factor, name, rows = state.amplitude(value, starts=True)
        parts = {DIRECTIONS[word]: factor}
    else:
        parts = {freedom: part for freedom, part in enumerate(_vector(value), start=1) if part}
        name, rows = state.history(value, starts=True)
    for node in nodes:
        for freedom in parts:
            state.claim(f"node {node} along {'xyz'[freedom - 1]}", name, adds=True)
    lines = [f"{node}, {freedom}, {part!r}" for node in nodes for freedom, part in parts.items()]
    return [*rows, load.keyword("cload", lines, {"amplitude": name})]


def _pressure(state: Prescribed, load: Element) -> list[Keyword]:
    value = load.first("pressure")
    if value is None:
        load.fail("it has no <pressure>.")
    if _on(load.first("linear")) or _on(load.first("shell_bottom")):
        raise TurgorError("pressure that does not follow its surface, or on the bottom of shells, has no form here.")
    factor, name, rows = state.amplitude(value, starts=True)
    surface, more = _surface(state, load)
    state.claim(f"surface '{load.given.get('surface', '')}'", name)
    return [*rows, *more, load.keyword("dsload", [f"{surface}, P, {factor!r}"], {"amplitude": name})]


def _traction(state: Prescribed, load: Element) -> list[Keyword]:
    """A dead load per reference area: ``<scale>`` times the vector."""
    scale, vector = load.first("scale"), load.first("traction")
    if vector is None:
        load.fail("it has no <traction>.")
    if scale is not None and "lc" in vector.given:
        raise TurgorError("a traction with a curve of its own besides that of <scale> has no form here.")
    parts = _vector(vector)
    size = float(np.linalg.norm(parts))
    if scale is None:
        factor, (name, rows) = 1.0, state.history(vector, starts=True)
    else:
        factor, name, rows = state.amplitude(scale, starts=True)
    surface, more = _surface(state, load)
    state.claim(f"traction of '{load.given.get('surface', '')}' along {parts}", name)
    line = f"{surface}, TRVEC, {factor * size!r}, " + ", ".join(repr(part) for part in parts)
    return [*rows, *more, load.keyword("dsload", [line], {"amplitude": name, "follower": "no"})]


def _body_force(state: Prescribed, load: Element) -> list[Keyword]:
    """An acceleration of all cells: FEBio subtracts the vector of a ``const`` load from the forces."""
    if load.given.get("elem_set"):
        raise TurgorError("a force on a part of the cells has no form here; it acts on all.")
    rows: list[Keyword] = []
    names: list[str] = []
    vector = [0.0, 0.0, 0.0]
    for place, axis in enumerate("xyz"):
        value = load.first(axis)
        if value is not None and (factor := _single(value)):
            vector[place] = -factor
            name, more = state.history(value, starts=True)
            rows, names = [*rows, *more], [*names, name]
    size = float(np.linalg.norm(vector))
    if not size:
        return [load.unneeded("it is zero")]
    state.claim("all cells", names[0])
    if len(set(names)) > 1:
        raise TurgorError("a force whose parts follow different curves has no form here.")
    line = f"FEBIO_ALL, GRAV, {size!r}, " + ", ".join(repr(part / size) for part in vector)
    return [*rows, load.keyword("dload", [line], {"amplitude": names[0]})]


def _surface(state: Prescribed, user: Element) -> tuple[str, list[Keyword]]:
    """Name of a surface in the deck, and the keyword that defines it."""
    return surface_named(state, user, user.given.get("surface", ""))


def surface_named(state: Prescribed, user: Element, name: str) -> tuple[str, list[Keyword]]:
    """Name of a surface in the deck, and the keyword that defines it where none has yet."""
    facets = state.mesh.facet_rows(user, name)
    if name in state.used:
        return state.used[name], []
    sides = [state.sides.get(frozenset(facet)) for facet in facets]
    if None in sides:
        owner = state.mesh.owners[f"surface {name}"]
        raise TurgorError(f"the surface '{name}' in line {owner.line} has facets that are no sides of solid cells.")
    plain = "".join(letter if letter.isalnum() or letter in "_-" else "_" for letter in name)
    state.used[name] = (
        plain
        if plain.lower() not in {each.lower() for each in state.used.values()}
        else f"{plain}_{len(state.used) + 1}"
    )
    lines = [f"{side[0]}, {side[1]}" for side in sides if side is not None]
    owner = state.mesh.owners[f"surface {name}"]
    return state.used[name], [owner.keyword("surface", lines, {"name": state.used[name], "type": "element"})]


def _vector(value: Element) -> list[float]:
    parts = value.numbers()
    if value.given.get("type", "const") not in ("const", "vector", "") or len(parts) != 3:
        raise TurgorError(f"{value.label} must be a vector of three numbers; one that varies over place has no form.")
    return parts


def _single(value: Element) -> float:
    parts = value.numbers()
    if len(parts) != 1:
        value.fail(f"it has {len(parts)} numbers; one is needed.")
    return parts[0]


def _on(flag: Element | None) -> bool:
    return flag is not None and flag.text.strip() not in ("", "0", "false")


_SUPPORTS: Mapping[str, Callable[[Prescribed, Element], list[Keyword]]] = {
    "zero displacement": _fixed,
    "fix": _fixed,
    "prescribed displacement": _moved,
    "prescribe": _moved,
    "rigid": _rigid,
    "prescribed shell displacement": _moved,
    "zero shell displacement": _shell_fixed,
    "zero rotation": _shell_fixed,
}

_LOADS: Mapping[tuple[str, str], Callable[[Prescribed, Element], list[Keyword]]] = {
    ("nodal_load", "nodal_force"): _nodal,
    ("nodal_load", "nodal_load"): _nodal,
    ("surface_load", "pressure"): _pressure,
    ("surface_load", "traction"): _traction,
    ("body_load", "const"): _body_force,
}
